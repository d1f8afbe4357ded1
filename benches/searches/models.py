"""Models of the bench: each is small, and has a kind of decision that the gallery's lack."""

from math import cos, pi, sin

from niwaki import (
    box,
    discrete_uniform,
    emit,
    flip,
    future,
    gaussian,
    model,
    normalize,
    rotation,
    sweep,
    uniform,
    vec,
)
from niwaki.gallery.building import NOWHERE, tower

UP = vec(0.0, 1.0, 0.0)
#: What is left free at each end of a wall, so that walls that meet at a corner do not intersect; scene units.
JOINT = 0.3
THICK = 0.6
BOARD = 0.6


@model
def archipelago():
    """Found up to three towns of towers anywhere on a field: how many is decided before there is anything."""
    for _ in range(discrete_uniform(1, 3)):
        future(found_town)


@model
def found_town():
    """Begin a town, which spreads by itself."""
    x, z = uniform(-18.0, 18.0), uniform(-10.0, 10.0)
    tower(0, (x - 2.0, x + 2.0, z - 2.0, z + 2.0), NOWHERE)


@model
def walls():
    """Build thin walls from the origin on: where one begins is decided by those before it."""
    wall(0.0, 0.0, uniform(0.0, 2.0 * pi), 0)


@model
def wall(x, z, heading, i):
    """Build the `i`-th wall from (x, z), perhaps one aside from its end, and perhaps the next."""
    length = uniform(2.5, 6.0)
    height = uniform(2.0, 4.0)
    middle = 0.5 * length
    center = (x + middle * cos(heading), 0.5 * height, z - middle * sin(heading))
    size = (length - 2.0 * JOINT, height, THICK)
    emit(box(center, size, rotation=rotation(UP, heading), bevel=0.0))
    end_x, end_z = x + length * cos(heading), z - length * sin(heading)
    if i < 9:
        future(aside, end_x, end_z, heading, i)
        if flip(0.85):
            wall(end_x, end_z, heading + gaussian(0.0, 0.5), i + 1)


@model
def aside(x, z, heading, i):
    """Perhaps walls that leave at about a right angle, to either side."""
    if flip(0.3):
        wall(x, z, heading + (0.5 if flip(0.5) else -0.5) * pi + gaussian(0.0, 0.15), i + 1)


@model
def wall_and_tower():
    """Build a wall of eight stones from the right, and a tower at its left end that must not be too wide."""
    future(stones)
    future(wide_tower)


@model
def stones():
    """Build all eight."""
    for i in range(8):
        height = uniform(1.0, 2.0)
        emit(box((7.5 - i, 0.5 * height, 0.0), (0.96, height, 1.0)))


@model
def wide_tower():
    """Build the tower from x = -2 to the right: wide ones match more of the target at once."""
    width = uniform(1.0, 8.0)
    emit(box((0.5 * width - 2.0, 2.0, 0.0), (width, 4.0, 1.0)))


@model
def stem():
    """Draw a stem out of a pot: the number of its pieces is decided first, and each leans from the one before."""
    half = uniform(0.5, 1.0)
    emit(box((0.0, -0.5, 0.0), (3.0, 1.0, 3.0), bevel=0.0))
    tip, ahead = vec(0.0, 0.4, 0.0), vec(0.0, 1.0, 0.0)
    path = [tip]
    for _ in range(discrete_uniform(2, 16)):
        ahead = normalize(ahead + vec(gaussian(0.0, 0.2), 0.0, gaussian(0.0, 0.2)))
        tip = tip + uniform(1.0, 2.0) * ahead
        path = path + [tip]
    emit(sweep([(-half, -half), (half, -half), (half, half), (-half, half)], path))


@model
def shelf():
    """Build a shelf of a height: the number of its boards is decided first, then how their gaps share the height."""
    width, height = uniform(4.0, 8.0), uniform(6.0, 20.0)
    emit(box((0.0, 0.5 * BOARD, 0.0), (width, BOARD, 3.0), bevel=0.0))
    gaps = [uniform(0.5, 4.0) for _ in range(discrete_uniform(1, 8))]
    y, scale = 0.0, height / sum(gaps)
    for gap in gaps:
        y = y + scale * gap
        emit(box((0.0, y + 0.5 * BOARD, 0.0), (width, BOARD, 3.0), bevel=0.0))
