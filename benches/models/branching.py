"""A recursive branching program: the model of `webppl/branching.wppl` and `limit/src/branching.rs`.

Each segment draws an angle, a length and whether it forks; a factor says how near its end lies to the circle
of radius depth + 1. The constant in the factor keeps trees at about a hundred choices under resampling.
"""

from math import cos, sin, sqrt

from niwaki import factor, flip, gaussian, model, uniform


@model
def tree():
    """Grow the whole tree from the origin, along +x."""
    branch(0.0, 0.0, 0.0, 0)


@model
def branch(x, y, heading, depth):
    """Grow a segment from (x, y) in the direction `heading` (radians), then what grows from its end."""
    angle = gaussian(heading, 0.3)
    length = uniform(0.5, 1.5)
    end_x = x + length * cos(angle)
    end_y = y + length * sin(angle)
    error = (sqrt(end_x * end_x + end_y * end_y) - (depth + 1)) / 1.5
    factor(0.35 - 0.5 * error * error)
    if depth < 5:
        if flip(0.7):
            branch(end_x, end_y, angle + 0.5, depth + 1)
            branch(end_x, end_y, angle - 0.5, depth + 1)
        else:
            branch(end_x, end_y, angle, depth + 1)
