"""A cloud-pruned garden tree: a bending trunk, side branches that reach outwards, flat clouds of foliage on their ends.

This tree gave the project its name. Each limb begins on the ring at which the limb before it ends, so that neighbours
touch and do not intersect; a side branch begins on a ring on its parent's bark. Futures decide whether there is a side
branch, where it goes and what it carries. A branch and its cloud are a single part, and so are the last limb of the
trunk and the crown: so no limb ends without foliage, and a cloud may close around the limb that
carries it.
"""

from math import cos, pi, sin
from typing import Any

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

TITLE = "a cloud-pruned garden tree"
TARGET = "niwaki"
VOXEL = 0.5
PARTICLES = 1000

BARK = (0.41, 0.32, 0.26)
LEAVES = ((0.28, 0.39, 0.22), (0.34, 0.45, 0.26), (0.24, 0.35, 0.21), (0.31, 0.42, 0.25))
UP = vec(0.0, 1.0, 0.0)


@model
def niwaki_tree():
    """Grow the trunk from the ground at the origin to its crown, then two chances of a side branch on each limb.

    The lowest limb stays bare. The trunk is complete before any branch may block it. It bends most in x, because such
    a tree has a front.
    """
    start, forward, radius = vec(0.0, 0.0, 0.0), UP, uniform(1.2, 2.0)
    limbs: list[Any] = []
    going_on = True
    while going_on:
        ahead = normalize(0.35 * forward + vec(gaussian(0.0, 0.45), 1.0, gaussian(0.0, 0.25)))
        end = start + uniform(1.5, 3.5) * ahead
        thin = radius * uniform(0.8, 0.92)
        going_on = len(limbs) < 4 or (thin > 0.5 and flip(0.65))
        crown = [] if going_on else foliage(end, ahead, thin, 0.0)
        emit(limb(start, end, radius, thin, forward, ahead, color=BARK), crown)
        limbs = limbs + [(start, end, radius, thin)]
        start, forward, radius = end, ahead, thin
    for low, high, low_radius, high_radius in limbs[1:]:
        for _ in range(2):
            future(side_branch, low, high, low_radius, high_radius)


@model
def side_branch(low, high, low_radius, high_radius):
    """Perhaps grow a branch with a cloud on the limb from `low` to `high`, sideways, seldom downwards."""
    if flip(0.6):
        where = uniform(0.1, 0.9)
        along = normalize(high - low)
        out = rotate(across(along), along, uniform(0.0, 2.0 * pi))
        radius = lerp(low_radius, high_radius, where)
        start = low + where * (high - low) + 1.02 * radius * out
        thick = uniform(0.3, 0.5) * radius
        ahead = normalize(level(out) + uniform(-0.1, 0.6) * UP)
        elbow = start + uniform(0.5, 2.5) * ahead
        turned = normalize(bend(ahead, 0.3) + 0.1 * UP)
        end = elbow + uniform(0.5, 2.5) * turned
        thin = 0.8 * thick
        limbs = [
            limb(start, elbow, thick, thin, out, ahead, color=BARK),
            limb(elbow, end, thin, 0.8 * thin, ahead, turned, color=BARK),
        ]
        emit(limbs + foliage(end, turned, 0.8 * thin, uniform(0.0, 0.4)))


@model
def foliage(tip, forward, radius, shift):
    """Make a short last limb and a cloud above `tip`; the cloud's middle is `shift` of its size ahead."""
    size = uniform(1.6, 3.4)
    high = uniform(1.0, 1.8)
    tufts = discrete_uniform(4, 6)
    turn = uniform(0.0, 2.0 * pi)
    end = tip + min(1.6 * radius, 0.6 * high) * normalize(forward + UP)
    base = tip + 0.6 * radius * UP + shift * size * level(forward)
    ring = [tuft(base, size, high, turn, k, tufts) for k in range(tufts)]
    top = cylinder(
        base + 0.55 * high * UP, 0.7 * size, 0.9 * high, top_radius=0.5 * size, bevel=0.95, color=LEAVES[1]
    )
    return [limb(tip, end, radius, 0.7 * radius, forward, UP, color=BARK)] + ring + [top]


def tuft(base, size, high, turn, k, tufts):
    """Make the `k`-th tuft around the middle of a cloud; sizes of tufts differ a little."""
    angle = turn + 2.0 * pi * k / tufts
    large = 0.45 + 0.07 * cos(2.4 * k + turn)
    place = base + 0.6 * size * vec(cos(angle), 0.0, sin(angle))
    tall = (0.72 + 0.1 * sin(3.1 * k + turn)) * high
    return cylinder(
        place + 0.5 * tall * UP,
        large * size,
        tall,
        top_radius=0.8 * large * size,
        bevel=0.95,
        color=LEAVES[k % 4],
    )


@model
def bend(forward, sd):
    """Draw a direction near `forward`, by two small turns about the directions across it."""
    side = across(forward)
    return rotate(rotate(forward, side, gaussian(0.0, sd)), cross(forward, side), gaussian(0.0, sd))


def across(direction):
    """Return a unit vector at right angles to `direction`."""
    side = cross(direction, vec(0.0, 0.0, 1.0))
    if norm(side) < 0.1:
        side = cross(direction, vec(1.0, 0.0, 0.0))
    return normalize(side)


def level(direction):
    """Return `direction` without most of its rise."""
    return vec(direction.x, 0.15 * direction.y, direction.z)


MODEL = niwaki_tree
