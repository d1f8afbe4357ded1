"""Lightning in a shape: the vines without leaves and flowers, drawn as light (dissertation 6.5.2)."""

from math import atan2, cos, pi, sin

from niwaki import emit, flip, gaussian, look, model, stroke
from niwaki.gallery.vines import LENGTH, THINNER, THINNEST, WIDTH

TITLE = "lightning, in the plane"
DRAWS = "lightning"
WINDOW = ((-12.0, -2.0), (12.0, 22.0))
DRAWING = "letters/R"
PARTICLES = 600
RESAMPLING = "tempered"

LIGHT = (0.42, 0.50, 1.0)


@model
def lightning(x=0.0, y=0.0, ahead=(0.0, 1.0)):
    """Strike from (x, y), at first roughly in the direction `ahead`."""
    look((x, y), ahead)
    start_angle = gaussian(atan2(ahead[1], ahead[0]), pi / 6.0)
    bolt(x, y, start_angle, WIDTH)


@model
def bolt(x, y, angle, width):
    """Draw a stroke and the strokes after it; return whether the lightning still continues."""
    look((x, y), (cos(angle), sin(angle)))
    angle = angle + gaussian(0.0, pi / 8.0)
    width = THINNER * width
    end_x, end_y = x + LENGTH * cos(angle), y + LENGTH * sin(angle)
    emit(stroke((x, y, 0.0), (end_x, end_y, 0.0), width, color=LIGHT))
    look((end_x, end_y), (cos(angle), sin(angle)))

    terminate = flip(0.5)
    alive = not terminate
    if alive and width > THINNEST:
        first = flip(0.66)
        if first:
            alive = bolt(end_x, end_y, angle, width)
        if alive:
            second = flip(0.5)
            if second:
                alive = bolt(end_x, end_y, angle, width)
    return alive


MODEL = lightning
