"""Vines that grow into a shape, with leaves and flowers (dissertation 6.5.2).

A branch is a straight stroke, a little thinner than the stroke before, and turned a little. Along it there may be a
leaf, at its end a flower; then the whole vine ends, or continues in one branch or two. Without a drawing, a vine ends
after about three strokes; long vines come from the score of a drawing.
"""

from math import atan2, cos, pi, sin

from niwaki import disc, ellipse, emit, flip, gaussian, look, model, stroke
from niwaki.words import choose

TITLE = "vines with leaves and flowers, in the plane"
DRAWS = "vines"
WINDOW = ((-12.0, -2.0), (12.0, 22.0))
DRAWING = "scribbles/026"
PARTICLES = 600
RESAMPLING = "tempered"

WIDTH = 0.75
THINNER = 0.975
THINNEST = 0.15 * WIDTH
LENGTH = 2.0
LEAF_WIDTH = 1.3 * WIDTH
LEAF_LENGTH = 2.09859154929577 * LEAF_WIDTH
FLOWER = WIDTH

STEM, LEAF, PETALS = (0.30, 0.22, 0.13), (0.35, 0.55, 0.18), (0.85, 0.36, 0.50)
#: Leaves lie behind the branches, flowers in front.
BEHIND, BETWEEN, IN_FRONT = -1.0, 0.0, 1.0


@model
def vines(x=0.0, y=0.0, ahead=(0.0, 1.0)):
    """Grow from (x, y), at first roughly in the direction `ahead`."""
    look((x, y), ahead)
    start_angle = gaussian(atan2(ahead[1], ahead[0]), pi / 6.0)
    branch(x, y, start_angle, WIDTH)


@model
def branch(x, y, angle, width):
    """Draw a stroke with its leaf, flower and next strokes; return whether the vine is still alive."""
    look((x, y), (cos(angle), sin(angle)))
    angle = angle + gaussian(0.0, pi / 8.0)
    width = THINNER * width
    end_x, end_y = x + LENGTH * cos(angle), y + LENGTH * sin(angle)
    emit(stroke((x, y, BETWEEN), (end_x, end_y, BETWEEN), width, color=STEM))
    look((end_x, end_y), (cos(angle), sin(angle)))

    leaf = choose(["none", "left", "right"])
    if leaf != "none":
        side = 1.0 if leaf == "left" else -1.0
        leaf_angle = angle + gaussian(side * pi / 4.0, pi / 12.0)
        center_x = 0.5 * (x + end_x) + 0.5 * LEAF_LENGTH * cos(leaf_angle)
        center_y = 0.5 * (y + end_y) + 0.5 * LEAF_LENGTH * sin(leaf_angle)
        emit(ellipse((center_x, center_y, BEHIND), LEAF_LENGTH, LEAF_WIDTH, leaf_angle, color=LEAF))

    flower = flip(0.5)
    if flower:
        emit(disc((end_x, end_y, IN_FRONT), FLOWER, color=PETALS))

    terminate = flip(0.5)
    alive = not terminate
    if alive and width > THINNEST:
        first = flip(0.66)
        if first:
            alive = branch(end_x, end_y, angle, width)
        if alive:
            second = flip(0.5)
            if second:
                alive = branch(end_x, end_y, angle, width)
    return alive


MODEL = vines
