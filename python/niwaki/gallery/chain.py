"""A chain of straight strokes that follows a drawing: the smallest program of its kind (dissertation 6.2.1).

The dissertation shows only a figure of the program; the numbers here are Niwaki's.
"""

from math import atan2, cos, pi, sin

from niwaki import emit, flip, gaussian, look, model, stroke

TITLE = "a chain of strokes, in the plane"
DRAWS = "ink"
WINDOW = ((-12.0, -2.0), (12.0, 22.0))
DRAWING = "scribbles/042"
PARTICLES = 300

LENGTH, WIDTH = 2.0, 0.75
INK = (0.08, 0.08, 0.09)


@model
def chain(x=0.0, y=0.0, ahead=(0.0, 1.0)):
    """Begin at (x, y), at first roughly in the direction `ahead`."""
    link(x, y, atan2(ahead[1], ahead[0]))


@model
def link(x, y, angle):
    """Draw a stroke, and perhaps another stroke at its end."""
    look((x, y), (cos(angle), sin(angle)))
    angle = angle + gaussian(0.0, pi / 8.0)
    end_x, end_y = x + LENGTH * cos(angle), y + LENGTH * sin(angle)
    emit(stroke((x, y, 0.0), (end_x, end_y, 0.0), WIDTH, color=INK))
    look((end_x, end_y), (cos(angle), sin(angle)))
    if flip(0.5):
        link(end_x, end_y, angle)


MODEL = chain
