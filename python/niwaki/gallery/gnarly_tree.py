"""A gnarly tree: tapering segments that bend, and branches that grow out of the bark.

This is the generative process of dissertation 5.5 and, with other inference, of 2.3.3 (figure 2.5). Each segment is
turned a little from the segment before; behind the bend it is a clean cone, on which branches stand. Futures decide
whether there is a branch and where. A branch tends to leave a level limb upwards, and an upright limb in any direction.
The base of a branch lies on its parent's bark, so that the two touch and do not intersect.
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
#: A bark has ten sides; its corners are at the ring's radius times this number.
OUTSIDE = 1.0 / cos(pi / 10.0)
#: Cosine and sine of eight directions about a limb, for `upness`.
AROUND = [(cos(2.0 * pi * k / 8.0), sin(2.0 * pi * k / 8.0)) for k in range(8)]


@model
def gnarly_tree(smallest=0.1, fork=0.5, decay=0.1):
    """Grow the trunk from the ground at the origin, with its branches.

    A branch ends at the radius `smallest`, as a share of the trunk's radius. `fork` is the probability of a branch on
    each segment. A branch continues after its segment i with probability exp(-decay i).
    """
    thick = uniform(1.5, 2.0)
    start = Frame(vec(0.0, 0.0, 0.0), SKY, vec(0.0, 0.0, -1.0), thick)
    branch(start, None, 0, (thick * smallest, fork, decay))


@model
def branch(start, bark, i, habit):
    """Grow the `i`-th segment of a branch from `start`, perhaps a side branch on it, and perhaps the next segment.

    The first segment of a branch grows from `bark`. `habit` has the least radius, the probability of a side branch and
    the decay of the probability to continue.
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
    """Perhaps grow a branch on the cone from `split` to `end`, at its middle."""
    if flip(habit[1]):
        mean, sd = upness(end)
        angle = gaussian(mean, sd)
        thick = min(uniform(0.9, 1.0) * end.radius, 0.5 * norm(end.center - split.center))
        start, bark = on_the_bark(split, end, angle, thick)
        branch(start, bark, 0, habit)


def ahead(start, yaw, pitch, length, radius):
    """Return the frame `length` ahead of `start`, turned by `yaw` about its up and by `pitch` sideways."""
    side = cross(start.up, start.forward)
    forward = rotate(rotate(start.forward, start.up, yaw), side, pitch)
    return Frame(start.center + length * forward, forward, rotate(start.up, side, pitch), radius)


def behind_the_bend(start, end):
    """Return the frame after which the segment from `start` to `end` is a cone, level with the bend's inside."""
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
    """Return mean and standard deviation of the angle at which a branch leaves `limb`, mostly on its upper side."""
    high, side = limb.up.y, cross(limb.forward, limb.up).y
    looks = [0.5 * (1.0 + c * high + s * side) for c, s in AROUND]
    highest = max(looks)
    return 2.0 * pi * looks.index(highest) / 8.0, lerp(pi, pi / 8.0, highest - min(looks))


def on_the_bark(low, high, angle, thick):
    """Return the frame of a branch at the middle of a cone, at right angles to its side, and the bark at its base."""
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
