"""Traces of a circuit board: the vines, with a score for half of a board with many edges (dissertation 6.5.3)."""

from math import pi

from niwaki import fill_drawing, gaussian, look, model
from niwaki.gallery.vines import WIDTH, branch

TITLE = "a circuit board, in the plane"
DRAWS = "circuit"
WINDOW = ((-12.0, -2.0), (12.0, 22.0))
PARTICLES = 600


@model
def circuit():
    """Grow from the middle of the lower border, at first roughly upwards."""
    look((0.0, 0.0), (0.0, 1.0))
    start_angle = gaussian(pi / 2.0, pi / 6.0)
    branch(0.0, 0.0, start_angle, WIDTH)


def score():
    """Return the score for filling half of the board, in 50 by 50 pixels."""
    return fill_drawing(WINDOW, (50, 50), 0.5)


MODEL = circuit
SCORE = score
