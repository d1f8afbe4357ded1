"""Castles: a ring of towers, round or square, with walls between them, a gate, and a keep in the court."""

from math import atan2, cos, pi, sin

from niwaki import box, choose, cone, cylinder, emit, flip, future, model, norm, rotation, uniform, vec

TITLE = "castles of towers and walls"
TARGET = "fortress"
VOXEL = 0.6
PARTICLES = 300

STONE, DARK, SLATE, TIMBER = (0.80, 0.75, 0.66), (0.68, 0.63, 0.55), (0.30, 0.36, 0.46), (0.30, 0.21, 0.14)


@model
def castle():
    """Build a castle on the ground, in metres, with its gate to +z."""
    count, wide, deep = choose([4, 5, 6, 7, 8]), uniform(7.0, 16.0), uniform(7.0, 16.0)
    height, thick, radius = uniform(3.0, 8.0), uniform(0.8, 1.6), uniform(1.3, 3.2)
    turns = [2.0 * pi * (i + 0.5) / count for i in range(count)]
    corners = [vec(wide * sin(turn), 0.0, deep * cos(turn)) for turn in turns]
    for i in range(count):
        future(tower, corners[i], radius, height)
        future(wall, corners[i - 1], corners[i], radius, height, thick, i == 0)
    has_keep = flip(0.8)
    if has_keep:
        side, z = uniform(0.15, 0.3) * min(wide, deep), uniform(-0.2, 0.1) * deep
        tower(vec(0.0, 0.0, z), side, height)


@model
def tower(foot, most, wall_height):
    """Build a tower and end it."""
    is_round = flip(0.6)
    radius, height = uniform(0.7, 1.0) * most, wall_height * uniform(1.1, 2.4)
    head, top = 1.15 * radius, foot + vec(0.0, height + 0.4 * radius, 0.0)
    shaft = drum(is_round, foot, radius, height, STONE)
    for slit in ((0.3, 0.12 * height, 9.0), (9.0, 0.12 * height, 0.3)):
        shaft = shaft - box(foot + vec(0.0, 0.7 * height, 0.0), slit, color=TIMBER)
    gallery = drum(is_round, top - vec(0.0, 0.4 * radius, 0.0), head, 0.4 * radius, DARK)
    emit(shaft, gallery, name="tower")
    end, tall = choose({"spire": 3, "turret": 1, "battlements": 2}), uniform(0.8, 2.6) * radius
    if end == "spire":
        middle, size = top + vec(0.0, 0.5 * tall, 0.0), (1.6 * head, tall, 1.6 * head)
        square = box(middle, size, taper=0.02, taper_axis="y", color=SLATE)
        emit(cone(middle, 1.1 * head, tall, color=SLATE) if is_round else square, name="roof")
    elif end == "turret":
        spire = cone(top + vec(0.0, tall + 0.8 * radius, 0.0), 0.8 * radius, 1.6 * radius, color=SLATE)
        emit(drum(is_round, top, 0.62 * radius, tall, STONE), spire, name="turret")
    else:
        inside = drum(is_round, top, 0.75 * head, radius, STONE)
        crown = drum(is_round, top, head, 0.5 * radius, STONE) - inside
        for i in range(3):
            turn = rotation((0.0, 1.0, 0.0), pi * i / 3)
            size = (0.4 * head, 0.5 * radius, 3.0 * head)
            crown = crown - box(top + vec(0.0, 0.5 * radius, 0.0), size, rotation=turn, color=STONE)
        emit(crown, name="battlements")


@model
def wall(start, end, radius, height, thick, has_gate):
    """Build a wall between two towers; the gate is a hole in it."""
    along, low = end - start, uniform(0.6, 1.0) * height
    turn = rotation((0.0, 1.0, 0.0), -atan2(along.z, along.x))
    length, foot = max(norm(along) - 2.2 * radius, 0.5), 0.5 * (start + end)
    solid = box(foot + vec(0.0, 0.5 * low, 0.0), (length, low, thick), rotation=turn, bevel=0.0, color=STONE)
    if has_gate:
        size = (min(3.0, 0.5 * length), 0.5 * low, thick + 1.0)
        solid = solid - box(foot + vec(0.0, 0.2 * low, 0.0), size, rotation=turn, color=TIMBER)
    emit(solid, name="wall")


def drum(is_round, foot, radius, height, color):
    """Return a round or square stage of a tower."""
    center = foot + vec(0.0, 0.5 * height, 0.0)
    square = box(center, (1.4 * radius, height, 1.4 * radius), color=color)
    return cylinder(center, radius, height, color=color) if is_round else square


MODEL = castle
