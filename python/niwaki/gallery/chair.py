"""Chairs: a seat on legs, with or without a back and arms.

Words name the kinds: hold `legs/kind` at "sled", or `back/kind` at "spindles", and the search varies the rest.
"""

from math import cos, pi, sin

from niwaki import arch, box, choose, cylinder, emit, flip, limb, model, sphere, torus, uniform

TITLE = "chairs of many kinds"
TARGET = "armchair"
VOXEL = 0.025
PARTICLES = 300

OAK, WALNUT, LINEN = (0.74, 0.55, 0.34), (0.40, 0.26, 0.17), (0.86, 0.80, 0.70)


@model
def chair():
    """Build a chair that faces +z, in metres."""
    width, depth = uniform(0.36, 0.75), uniform(0.36, 0.75)
    height, thick = uniform(0.3, 0.6), uniform(0.03, 0.12)
    wood = choose([OAK, WALNUT])
    seat = box((0.0, height + 0.5 * thick, 0.0), (width, thick, depth), bevel=0.25 * thick, color=LINEN)
    emit(seat, name="seat")
    legs(width, depth, height, wood)
    has_back = flip(0.85)
    if has_back:
        back(width, depth, height + thick, wood)
    has_arms = flip(0.4)
    if has_arms:
        arms(width, depth, height + thick, wood)


@model
def legs(width, depth, height, wood):
    """Support a seat whose lower side is at `height`."""
    kind = choose(["straight", "splayed", "pedestal", "sled"])
    thick = uniform(0.012, 0.035)
    corners = [(x, z) for x in (-0.5, 0.5) for z in (-0.5, 0.5)]
    wide, deep = width - 2.0 * thick, depth - 2.0 * thick
    if kind == "straight":
        size = (2.0 * thick, height, 2.0 * thick)
        emit([box((x * wide, 0.5 * height, z * deep), size, color=wood) for x, z in corners], name="legs")
    elif kind == "splayed":
        out = uniform(1.05, 1.3)
        feet = [
            ((x * wide * out, thick, z * deep * out), (0.8 * x * wide, height, 0.8 * z * deep))
            for x, z in corners
        ]
        emit([limb(foot, top, 0.7 * thick, thick, color=wood) for foot, top in feet], name="legs")
    elif kind == "pedestal":
        foot = uniform(0.35, 0.5) * min(width, depth)
        post = cylinder((0.0, 0.5 * height, 0.0), 1.5 * thick, height, color=wood)
        emit(post, cylinder((0.0, 0.02, 0.0), foot, 0.04, top_radius=0.7 * foot, color=wood), name="legs")
    else:
        runner = [
            box((x * wide, thick, 0.0), (2.0 * thick, 2.0 * thick, depth), color=wood) for x in (-0.5, 0.5)
        ]
        size = (2.0 * thick, height, 2.0 * thick)
        posts = [box((x * wide, 0.5 * height, z * 0.7 * deep), size, color=wood) for x, z in corners]
        emit(runner, posts, name="legs")


@model
def back(width, depth, floor, wood):
    """Build a back at the rear edge of the seat, from `floor` up."""
    kind = choose(["panel", "spindles", "rungs", "hoop"])
    height, thick = uniform(0.2, 0.7), uniform(0.012, 0.03)
    z, wide = thick - 0.5 * depth, width - 2.0 * thick
    sides = [
        box((x * wide, floor + 0.5 * height, z), (2.0 * thick, height, 2.0 * thick), color=wood)
        for x in (-0.5, 0.5)
    ]
    rail = box((0.0, floor + height - thick, z), (wide, 4.0 * thick, 1.6 * thick), color=wood)
    if kind == "panel":
        pad = box(
            (0.0, floor + 0.55 * height, z), (wide, 0.8 * height, 2.4 * thick), bevel=thick, color=LINEN
        )
        emit(sides, pad, name="back")
    elif kind == "spindles":
        count = choose([3, 4, 5, 6, 7])
        at = [wide * ((i + 1) / (count + 1) - 0.5) for i in range(count)]
        emit(
            sides,
            rail,
            [cylinder((x, floor + 0.5 * height, z), 0.6 * thick, height, color=wood) for x in at],
            name="back",
        )
    elif kind == "rungs":
        count = choose([2, 3, 4])
        at = [floor + height * (i + 1) / count - thick for i in range(count)]
        emit(
            sides,
            [box((0.0, y, z), (wide, 0.35 * height / count, 1.4 * thick), color=wood) for y in at],
            name="back",
        )
    else:
        emit(
            arch((0.0, floor + 0.5 * height, z), (width, height, 2.0 * thick), 2.0 * thick, color=wood),
            name="back",
        )


@model
def arms(width, depth, floor, wood):
    """Build two arms that end at the back."""
    height, thick = uniform(0.12, 0.3), uniform(0.015, 0.05)
    kind = choose(["open", "closed"])
    for side in (-0.5, 0.5):
        x = side * (width - 2.0 * thick)
        rest = box(
            (x, floor + height, 0.1 * depth),
            (2.0 * thick, 1.4 * thick, 0.8 * depth),
            bevel=0.3 * thick,
            color=wood,
        )
        if kind == "open":
            post = box((x, floor + 0.5 * height, 0.4 * depth), (1.4 * thick, height, 1.4 * thick), color=wood)
            emit(rest, post, name="arm")
        else:
            emit(
                rest,
                box((x, floor + 0.5 * height, 0.1 * depth), (1.6 * thick, height, 0.8 * depth), color=LINEN),
                name="arm",
            )


MODEL = chair
