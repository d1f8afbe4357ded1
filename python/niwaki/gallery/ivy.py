"""Ivy on a wall: tips that climb, branch and carry leaves, in the plane of the wall.

The wall is at z = 0. A branch begins in its parent: a round joint lets the two overlap there and nowhere else.
"""

from math import cos, sin

from niwaki import ellipsoid, emit, flip, future, gaussian, limb, look, model, rotation, uniform, vec
from niwaki.words import choose

TITLE = "ivy on a wall"
TARGET = "wreath"
VOXEL = 0.08
PARTICLES = 300

BARK = (0.36, 0.29, 0.20)
GREENS = [(0.20, 0.38, 0.17), (0.28, 0.48, 0.20), (0.38, 0.56, 0.24), (0.16, 0.32, 0.18)]
STEP, THICK, OUT = 0.25, 0.035, (0.0, 0.0, 1.0)


@model
def ivy():
    """Grow ivy from the foot of the wall."""
    tip(vec(0.0, 0.0, 0.1), 0.0, THICK, 0)


@model
def tip(start, angle, thick, age):
    """Climb one step, with leaves, and go on, branch or end; the angle is from straight up."""
    look(start, vec(-sin(angle), cos(angle), 0.0))
    angle = angle + gaussian(0.0, 0.35)
    end = start + STEP * vec(-sin(angle), cos(angle), 0.0)
    leaves = [leaf(start + t * (end - start), angle, side) for t, side in ((0.3, -1.0), (0.8, 1.0))]
    emit(limb(start, end, thick, 0.96 * thick, joint="round", color=BARK), leaves, name="shoot")
    goes_on = flip(0.9 if age < 14 else 0.0)
    if goes_on:
        future(tip, end, angle, 0.96 * thick, age + 1)
        branches = flip(0.3)
        if branches:
            side = choose([-1.0, 1.0])
            future(tip, start + 0.6 * (end - start), angle + side * uniform(0.5, 1.3), 0.8 * thick, age + 1)


def leaf(foot, angle, side):
    """Return a leaf beside its stem, turned towards the light."""
    size = uniform(0.08, 0.15)
    turn = angle + side * uniform(0.4, 1.4)
    middle = foot + vec(-sin(turn), cos(turn), 0.0) * 0.55 * size + vec(0.0, 0.0, 0.05)
    tilt = rotation(OUT, turn) * rotation((1.0, 0.0, 0.0), gaussian(0.35, 0.2))
    return ellipsoid(middle, (0.75 * size, size, 0.03), rotation=tilt, color=choose(GREENS))


MODEL = ivy
