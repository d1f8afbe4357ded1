"""Chairs: a seat on legs, with or without a back and arms.

Words name the kinds: hold the legs at "sled" or the back at "spindles", and a search varies the rest.
"""

from niwaki import arch, box, choose, cylinder, emit, flip, future, limb, model, uniform
from niwaki.words import linspace

TITLE = "chairs of many kinds"
TARGET = "armchair"
VOXEL = 0.025
PARTICLES = 300

OAK, WALNUT, LINEN = (0.74, 0.55, 0.34), (0.40, 0.26, 0.17), (0.86, 0.80, 0.70)
SIDES = (-0.5, 0.5)


@model
def chair():
    """Build a chair that faces +z, in metres."""
    width, depth = uniform(0.36, 0.75), uniform(0.36, 0.75)
    height, thick = uniform(0.3, 0.6), uniform(0.03, 0.12)
    emit(block(0.0, height, 0.0, width, thick, depth, LINEN), name="seat")
    wood = choose([OAK, WALNUT])
    future(legs, width, depth, height, wood)
    future(upper, width, depth, height + thick, wood)


@model
def upper(width, depth, floor, wood):
    """Perhaps build a back, and perhaps arms."""
    has_back = flip(0.85)
    if has_back:
        future(back, width, depth, floor, wood)
    has_arms = flip(0.4)
    if has_arms:
        future(arms, width, depth, floor, wood)


@model
def legs(width, depth, height, wood):
    """Support a seat whose lower side is at `height`."""
    kind = choose(["straight", "splayed", "pedestal", "sled"])
    t = uniform(0.024, 0.07)
    wide, deep = width - t, depth - t
    corners = [(x * wide, z * deep) for x in SIDES for z in SIDES]
    if kind == "straight":
        emit([block(x, 0.0, z, t, height, t, wood) for x, z in corners], name="legs")
    elif kind == "splayed":
        out = uniform(1.05, 1.3)
        tops = [((x * out, 0.5 * t, z * out), (0.8 * x, height, 0.8 * z)) for x, z in corners]
        emit([limb(foot, top, 0.35 * t, 0.5 * t, color=wood) for foot, top in tops], name="legs")
    elif kind == "pedestal":
        foot = uniform(0.35, 0.5) * min(width, depth)
        post = cylinder((0.0, 0.5 * height, 0.0), 0.75 * t, height, color=wood)
        emit(post, cylinder((0.0, 0.02, 0.0), foot, 0.04, top_radius=0.7 * foot, color=wood), name="legs")
    else:
        runners = [block(x * wide, 0.0, 0.0, t, t, depth, wood) for x in SIDES]
        emit(runners, [block(x, 0.0, 0.7 * z, t, height, t, wood) for x, z in corners], name="legs")


@model
def back(width, depth, floor, wood):
    """Build a back at the rear edge of the seat, from `floor` up."""
    kind = choose(["panel", "spindles", "rungs", "hoop"])
    height, t = uniform(0.2, 0.7), uniform(0.024, 0.06)
    z, wide = 0.5 * t - 0.5 * depth, width - t
    sides = [block(x * wide, floor, z, t, height, t, wood) for x in SIDES]
    if kind == "panel":
        emit(sides, block(0.0, floor + 0.15 * height, z, wide, 0.8 * height, 1.2 * t, LINEN), name="back")
    elif kind == "spindles":
        bars = linspace(-0.5 * wide, 0.5 * wide, choose([5, 6, 7, 8, 9]))
        rail = block(0.0, floor + height - 2.0 * t, z, wide, 2.0 * t, 0.8 * t, wood)
        emit(sides, rail, [block(x, floor, z, 0.5 * t, height, 0.5 * t, wood) for x in bars], name="back")
    elif kind == "rungs":
        count = choose([2, 3, 4])
        at = [floor + height * (i + 0.6) / count for i in range(count)]
        emit(sides, [block(0.0, y, z, wide, 0.35 * height / count, 0.7 * t, wood) for y in at], name="back")
    else:
        emit(arch((0.0, floor + 0.5 * height, z), (width, height, t), t, color=wood), name="back")


@model
def arms(width, depth, floor, wood):
    """Build two arms that end at the back."""
    kind, height, t = choose(["open", "closed"]), uniform(0.12, 0.3), uniform(0.03, 0.1)
    for side in SIDES:
        x = side * (width - t)
        rest = block(x, floor + height, 0.1 * depth, t, 0.7 * t, 0.8 * depth, wood)
        if kind == "open":
            emit(rest, block(x, floor, 0.4 * depth, 0.7 * t, height, 0.7 * t, wood), name="arm")
        else:
            emit(rest, block(x, floor, 0.1 * depth, 0.8 * t, height, 0.8 * depth, LINEN), name="arm")


def block(x, y, z, width, height, depth, color):
    """Return a box that stands at a height of `y`."""
    return box((x, y + 0.5 * height, z), (width, height, depth), color=color)


MODEL = chair
