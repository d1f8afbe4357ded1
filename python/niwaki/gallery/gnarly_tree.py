"""A gnarly tree: tapering segments that bend, and branches that grow out of the bark.

The generative process of dissertation 5.5 and, with other inference, of 2.3.3 (figure 2.5). Each segment runs along a
frame that is turned a little from the one before; behind the bend it is a clean cone, where branches stand. Whether
there is a branch, and where, is decided inside a future. A branch rather leaves a level limb upwards, and an upright
one anywhere. Its base is laid onto its parent's bark, so that the two touch and do not intersect.
"""

from math import cos, exp, pi, sin

from niwaki import (
    cross,
    dot,
    emit,
    flip,
    future,
    gaussian,
    model,
    norm,
    normalize,
    rotate,
    segment,
    uniform,
    vec,
)
from niwaki.words import Bark, Frame, lerp

TITLE = "a gnarly tree of welded, tapering segments"
TARGET = "bent_tube"
VOXEL = 0.4
PARTICLES = 300

WOOD = (0.47, 0.39, 0.32)
SKY = vec(0.0, 1.0, 0.0)
#: A bark's polygon with ten sides lies between the ring's radius and that times this.
OUTSIDE = 1.0 / cos(pi / 10.0)
#: Cosine and sine of the eight directions about a limb in which its up-ness is looked at.
AROUND = [(cos(2.0 * pi * k / 8.0), sin(2.0 * pi * k / 8.0)) for k in range(8)]


@model
def gnarly_tree(smallest=0.1, fork=0.5, decay=0.1):
    """Grow the trunk from the ground at the origin, and everything that grows from it.

    `smallest` is the radius, as a share of the trunk's, at which a branch ends; `fork` the odds of a branch on each
    segment; a branch continues after its segment i with probability exp(-decay i).
    """
    thick = uniform(1.5, 2.0)
    start = Frame(vec(0.0, 0.0, 0.0), SKY, vec(0.0, 0.0, -1.0), thick)
    branch(start, None, 0, (thick * smallest, fork, decay))


@model
def branch(start, bark, i, habit):
    """Grow the `i`-th segment of a branch from `start`, perhaps a side branch on it, and perhaps the next segment.

    `bark` is what the first segment of a branch grows from; `habit` the least radius, the chance of a side branch and
    the decay of going on.
    """
    least, _, decay = habit
    if start.radius >= least:
        yaw = gaussian(0.0, pi / 12.0)
        pitch = gaussian(0.0, pi / 12.0)
        length = uniform(3.0, 5.0) * start.radius
        end = ahead(start, yaw, pitch, length, uniform(0.7, 0.9) * start.radius)
        split = behind_the_bend(start, end)
        emit(segment(start, split, end, bark, color=WOOD))
        future(side_branch, split, end, habit)
        if flip(exp(-decay * i)):
            branch(end, None, i + 1, habit)


@model
def side_branch(split, end, habit):
    """Perhaps a branch on the cone from `split` to `end`, at its middle."""
    if flip(habit[1]):
        mean, sd = upness(end)
        angle = gaussian(mean, sd)
        thick = min(uniform(0.9, 1.0) * end.radius, 0.5 * norm(end.center - split.center))
        start, bark = on_the_bark(split, end, angle, thick)
        branch(start, bark, 0, habit)


def ahead(start, yaw, pitch, length, radius):
    """The frame at `length` ahead of `start`, in a direction turned by `yaw` about its up and by `pitch` sideways."""
    side = cross(start.up, start.forward)
    forward = rotate(rotate(start.forward, start.up, yaw), side, pitch)
    return Frame(start.center + length * forward, forward, rotate(start.up, side, pitch), radius)


def behind_the_bend(start, end):
    """The frame after which the segment from `start` to `end` is a cone: level with the bend's inside."""
    inward = end.forward - dot(end.forward, start.forward) * start.forward
    inward = start.up if norm(inward) == 0.0 else normalize(inward)
    outside, inside = start.center - start.radius * inward, start.center + start.radius * inward
    tip = end.center - end.radius * normalize(inward - dot(inward, end.forward) * end.forward)
    along = tip - outside
    level = outside + dot(inside - outside, end.forward) / dot(along, end.forward) * along
    radius = 0.5 * norm(level - inside)
    center = 0.5 * (inside + 0.1 * radius * end.forward + level)
    return Frame(center, end.forward, end.up, radius)


def upness(limb):
    """Mean and standard deviation of the angle at which a branch leaves `limb`: rather where its side looks up."""
    high, side = limb.up.y, cross(limb.forward, limb.up).y
    looks = [0.5 * (1.0 + c * high + s * side) for c, s in AROUND]
    highest = max(looks)
    return 2.0 * pi * looks.index(highest) / 8.0, lerp(pi, pi / 8.0, highest - min(looks))


def on_the_bark(low, high, angle, thick):
    """The frame of a branch at the middle of a cone, at right angles to its side, and the bark around its base."""
    out = rotate(high.up, high.forward, angle)
    middle = 0.5 * (low.center + high.center)
    center = middle + 0.5 * (low.radius + high.radius) * OUTSIDE * out
    up = normalize(high.center + high.radius * out - center)
    side = normalize(cross(up, center - middle))
    axis = high.center - low.center
    below = dot(center - thick * up - low.center, axis) / dot(axis, axis)
    above = dot(center + thick * up - low.center, axis) / dot(axis, axis)
    bark = Bark(
        low.center + below * axis,
        lerp(low.radius, high.radius, below),
        low.center + above * axis,
        lerp(low.radius, high.radius, above),
    )
    return Frame(center, cross(side, up), up, thick), bark


MODEL = gnarly_tree
