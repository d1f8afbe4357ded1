"""A staghorn coral: arms that rise from one foot, fork, bend towards the light and end in pale, round tips.

Both arms of a fork begin on the ring at which their parent ends, in the same `emit`, so that the fork has one skin.
Futures decide whether an arm continues and whether it forks.
"""

from math import cos, pi, sin

from niwaki import (
    cross,
    cylinder,
    discrete_uniform,
    emit,
    flip,
    future,
    gaussian,
    limb,
    model,
    norm,
    normalize,
    rotate,
    uniform,
    vec,
)
from niwaki.words import lerp

TITLE = "a staghorn coral"
TARGET = "fan"
VOXEL = 0.5
PARTICLES = 500

UP = vec(0.0, 1.0, 0.0)
FOOT = (0.56, 0.30, 0.30)
DEEP, TIP = vec(0.78, 0.38, 0.31), vec(0.98, 0.88, 0.76)
#: An arm no thicker than this ends.
THINNEST = 0.2
#: Distance of the arms from the middle of the foot.
RIM = 0.85


@model
def coral():
    """Place a foot on the ground, with arms that may rise from the rim of its top."""
    emit(cylinder((0.0, 0.4, 0.0), 1.9, 0.8, top_radius=RIM + 0.6, bevel=0.7, color=FOOT))
    count = discrete_uniform(3, 5)
    turn = uniform(0.0, 2.0 * pi)
    for k in range(count):
        future(first_arm, turn + 2.0 * pi * k / count)


@model
def first_arm(azimuth):
    """Perhaps grow an arm on the foot, at an angle about its middle, leaning outwards."""
    if flip(0.9):
        thick = uniform(0.4, 0.5)
        start = vec(RIM * cos(azimuth), 0.8, RIM * sin(azimuth))
        way, rise = gaussian(azimuth, 0.4), uniform(0.6, 1.5)
        ahead = vec(cos(rise) * cos(way), sin(rise), cos(rise) * sin(way))
        one = stretch(start, ahead, thick)
        emit(skinned(start, UP, thick, one))
        future(arm, one[0], one[1], one[2])


@model
def arm(tip, ahead, thick):
    """Perhaps continue from `tip`, with one arm or a fork of two."""
    if thick > THINNEST and flip(0.82):
        if flip(0.6):
            across = rotate(side(ahead), ahead, uniform(0.0, 2.0 * pi))
            opening = uniform(0.9, 1.3)
            share = uniform(0.35, 0.65)
            one = stretch(tip, lift(rotate(ahead, across, share * opening)), thick)
            two = stretch(tip, lift(rotate(ahead, across, (share - 1.0) * opening)), thick)
            emit(skinned(tip, ahead, thick, one), skinned(tip, ahead, thick, two))
            future(arm, one[0], one[1], one[2])
            future(arm, two[0], two[1], two[2])
        else:
            bent = rotate(
                rotate(ahead, side(ahead), gaussian(0.0, 0.2)), cross(ahead, side(ahead)), gaussian(0.0, 0.2)
            )
            one = stretch(tip, lift(bent), thick)
            emit(skinned(tip, ahead, thick, one))
            future(arm, one[0], one[1], one[2])


@model
def stretch(tip, ahead, thick):
    """Return the end, the direction and the end radius of a stretch from `tip`."""
    return tip + uniform(3.0, 4.8) * thick * ahead, ahead, thick * uniform(0.8, 0.93)


def skinned(tip, ahead, thick, stretch_end):
    """Make the limb of a stretch; thin limbs are pale."""
    end, turned, thin = stretch_end
    return limb(tip, end, thick, thin, ahead, turned, color=skin(thin))


def skin(thick):
    """Return the colour at a thickness: deep near the foot, pale at the tips."""
    share = min(1.0, max(0.0, (0.5 - thick) / (0.5 - THINNEST)))
    color = DEEP + share * share * (TIP - DEEP)
    return color.x, color.y, color.z


def lift(ahead):
    """Return the direction, bent a little towards the light."""
    return normalize(ahead + lerp(0.22, 0.0, max(0.0, ahead.y)) * UP)


def side(direction):
    """Return a unit vector at right angles to `direction`."""
    across = cross(direction, vec(0.0, 0.0, 1.0))
    if norm(across) < 0.1:
        across = cross(direction, vec(1.0, 0.0, 0.0))
    return normalize(across)


MODEL = coral
