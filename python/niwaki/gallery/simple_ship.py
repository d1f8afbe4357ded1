"""The simplified spaceship of dissertation figure 5.2: a row of blocks, with wings that are rows of blocks.

Fifteen lines of process show the effect of an order. Body segments bring the ship closer to its target faster than
wings, so under a fixed order mostly particles without the first wings survive. Body and wings are both futures, so that
a random order can postpone the wings.
"""

from math import exp

from niwaki import box, emit, flip, future, model, uniform

TITLE = "a simplified ship: blocks with wings of blocks"
TARGET = "dart"
VOXEL = 0.25
PARTICLES = 300

HULL = ((0.80, 0.79, 0.76), (0.70, 0.71, 0.72))
WING = ((0.42, 0.46, 0.52), (0.83, 0.41, 0.20))


@model
def simple_ship():
    """Build from the tail at z = -6 forwards."""
    future(body, 0, -6.0)


@model
def body(i, rear):
    """Place the `i`-th block of the body, and postpone its wings and the next block."""
    if flip(exp(-0.12 * i)):
        length = uniform(1.0, 3.0)
        width = uniform(1.0, 2.5)
        height = uniform(0.6, 1.6)
        front = rear + length
        emit(box((0.0, 0.0, rear + 0.5 * length), (width, height, length), color=HULL[i % 2]))
        future(wing, 0, 0.5 * width, rear, front)
        future(body, i + 1, front)


@model
def wing(j, root, rear, front):
    """Perhaps place a pair of blocks beside the last pair, at `root` from the middle and within its length."""
    if flip(0.5 if j == 0 else exp(-0.25 * j)):
        span = uniform(0.5, 2.0)
        chord = uniform(0.5, 1.0) * (front - rear)
        height = uniform(0.2, 0.5)
        middle = uniform(rear + 0.5 * chord, front - 0.5 * chord) - 0.3 * chord
        place, size = root + 0.5 * span, (span, height, chord)
        emit(
            box((place, 0.0, middle), size, color=WING[j % 2]),
            box((-place, 0.0, middle), size, color=WING[j % 2]),
        )
        future(wing, j + 1, root + span, middle - 0.5 * chord, middle + 0.5 * chord)


MODEL = simple_ship
