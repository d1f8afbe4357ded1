"""A cloud-pruned garden tree: limbs that bend as they grow, and pads of foliage where they end.

The tree that this project is named after, in our own words: each limb begins on the ring where the one before it
ended, so that neighbours touch and do not intersect. Side branches are futures. A branch ends in a cloud of foliage,
which is one primitive with the last limb under it.
"""

from math import pi

from niwaki import (
    cross,
    cylinder,
    discrete_uniform,
    dot,
    emit,
    flip,
    future,
    gaussian,
    lerp,
    limb,
    model,
    norm,
    normalize,
    rotate,
    uniform,
    vec,
)

TITLE = "a cloud-pruned garden tree"
TARGET = "niwaki"
VOXEL = 0.5

BARK = (0.42, 0.30, 0.22)
LEAVES = ((0.25, 0.42, 0.20), (0.31, 0.48, 0.22), (0.21, 0.38, 0.22))
UP = vec(0.0, 1.0, 0.0)


@model
def niwaki_tree():
    """Grow the trunk from the ground at the origin."""
    branch(vec(0.0, 0.0, 0.0), UP, uniform(1.0, 2.0), 0)


@model
def branch(start, forward, radius, depth):
    """Grow limbs from `start` in the direction `forward`, then a cloud; side branches are left to futures."""
    going_on = True
    while going_on:
        length = uniform(1.5, 3.5) if depth == 0 else uniform(1.0, 3.0)
        ahead = normalize(bend(forward, 0.3 if depth == 0 else 0.2) + 0.1 * UP)
        end = start + length * ahead
        thin = radius * uniform(0.75, 0.95)
        emit(limb(start, end, radius, thin, forward, ahead, color=BARK))
        if depth == 0:
            future(side_branch, start + 0.4 * length * ahead, ahead, lerp(radius, thin, 0.4))
            future(side_branch, start + 0.8 * length * ahead, ahead, lerp(radius, thin, 0.8))
        start, forward, radius = end, ahead, thin
        going_on = radius > 0.25 and flip(0.85 if depth == 0 else 0.35)
    if flip(0.85):
        cloud(start, forward, radius)


@model
def side_branch(middle, along, radius):
    """Perhaps a branch that leaves a limb around `middle` sideways and a little upwards."""
    if flip(0.5):
        turn = uniform(0.0, 2.0 * pi)
        out = normalize(rotate(across(along), along, turn) + uniform(0.0, 0.5) * along)
        thin = radius * uniform(0.35, 0.6)
        # The first ring lies outside the parent, whose sides are flat between the corners of its rings.
        start = middle + (1.05 * radius / dot(out, rotate(across(along), along, turn))) * out
        branch(start, out, thin, 1)


@model
def cloud(tip, forward, radius):
    """Foliage on a short last limb: flat tufts around a middle one."""
    across_size = uniform(1.0, 4.0)
    high = across_size * uniform(0.4, 0.6)
    end = tip + 0.6 * forward
    middle = end + (0.35 * high) * UP
    tufts = discrete_uniform(4, 6)
    turn = uniform(0.0, 2.0 * pi)
    ring = [tuft(middle, across_size, high, turn + 2.0 * pi * k / tufts, k) for k in range(tufts)]
    top = cylinder(
        middle + 0.18 * high * UP,
        0.62 * across_size,
        high,
        top_radius=0.45 * across_size,
        bevel=0.95,
        color=LEAVES[1],
    )
    emit(limb(tip, end, radius, 0.7 * radius, forward, forward, color=BARK), ring + [top])


def tuft(middle, across_size, high, angle, k):
    """One of the tufts around the middle of a cloud."""
    out = rotate(vec(1.0, 0.0, 0.0), UP, angle)
    size = 0.5 * across_size
    place = middle + 0.5 * across_size * out - 0.08 * high * UP
    return cylinder(place, size, 0.75 * high, top_radius=0.72 * size, bevel=0.95, color=LEAVES[k % 3])


@model
def bend(forward, sd):
    """A direction near `forward`: two small turns about the directions across it."""
    one = across(forward)
    return rotate(rotate(forward, one, gaussian(0.0, sd)), cross(forward, one), gaussian(0.0, sd))


def across(direction):
    """A unit vector at right angles to `direction`."""
    side = cross(direction, vec(0.0, 0.0, 1.0))
    if norm(side) < 0.1:
        side = cross(direction, vec(1.0, 0.0, 0.0))
    return normalize(side)


MODEL = niwaki_tree
