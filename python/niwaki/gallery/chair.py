"""Chairs: a seat on legs, with or without a back and arms. Words name the kinds: hold the legs at "sled"."""

from niwaki import arch, box, choose, cylinder, emit, future, limb, model, uniform
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
    for part, floor in ((legs, height), (back, height + thick), (arms, height + thick)):
        future(part, width, depth, floor, wood)


@model
def legs(width, depth, height, wood):
    """Support a seat whose lower side is at `height`."""
    kind, t = choose(["straight", "splayed", "pedestal", "sled"]), uniform(0.024, 0.07)
    corners = [(x * (width - t), z * (depth - t)) for x in SIDES for z in SIDES]
    if kind == "splayed":
        out = uniform(1.05, 1.3)
        tops = [((x * out, 0.5 * t, z * out), (0.8 * x, height, 0.8 * z)) for x, z in corners]
        emit([limb(foot, top, 0.35 * t, 0.5 * t, color=wood) for foot, top in tops], name="legs")
    elif kind == "pedestal":
        foot = uniform(0.35, 0.5) * min(width, depth)
        post = cylinder((0.0, 0.5 * height, 0.0), 0.75 * t, height, color=wood)
        emit(post, cylinder((0.0, 0.02, 0.0), foot, 0.04, top_radius=0.7 * foot, color=wood), name="legs")
    else:
        posts = [block(x, 0.0, z, t, height, t, wood) for x, z in corners]
        runners = [block(x * (width - t), 0.0, 0.0, t, t, depth, wood) for x in SIDES]
        emit(posts, runners if kind == "sled" else [], name="legs")


@model
def back(width, depth, floor, wood):
    """Build a back at the rear edge of the seat, from `floor` up."""
    kind = choose({"none": 1, "panel": 2, "spindles": 2, "rungs": 2, "hoop": 2})
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
        at = linspace(floor + 0.3 * height, floor + 0.85 * height, choose([2, 3, 4]))
        emit(sides, [block(0.0, y, z, wide, 0.1 * height, 0.7 * t, wood) for y in at], name="back")
    elif kind == "hoop":
        emit(arch((0.0, floor + 0.5 * height, z), (width, height, t), t, color=wood), name="back")


@model
def arms(width, depth, floor, wood):
    """Build two arms that end at the back."""
    kind, height, t = choose({"none": 3, "open": 1, "closed": 1}), uniform(0.12, 0.3), uniform(0.03, 0.1)
    at, long, cover = (0.4, 0.7 * t, wood) if kind == "open" else (0.1, 0.8 * depth, LINEN)
    for x in [] if kind == "none" else [side * (width - t) for side in SIDES]:
        rest = block(x, floor + height, 0.1 * depth, t, 0.7 * t, 0.8 * depth, wood)
        emit(rest, block(x, floor, at * depth, 0.75 * t, height, long, cover), name="arm")


def block(x, y, z, width, height, depth, color):
    """Return a box that stands at a height of `y`."""
    return box((x, y + 0.5 * height, z), (width, height, depth), color=color)


MODEL = chair
