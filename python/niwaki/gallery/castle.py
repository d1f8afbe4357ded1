"""Castles: a ring of towers with walls between them, a gate, and a keep in the middle.

The towers stand on a ring of corners. Each may be round or square, and ends in a cone, a pyramid or battlements.
"""

from math import atan2, cos, pi, sin

from niwaki import arch, box, choose, cone, cylinder, emit, flip, future, model, rotation, uniform, vec

TITLE = "castles of towers and walls"
TARGET = "fortress"
VOXEL = 0.6
PARTICLES = 300

STONE, DARK, SLATE, TIMBER = (0.80, 0.75, 0.66), (0.70, 0.65, 0.57), (0.30, 0.36, 0.45), (0.36, 0.25, 0.17)


@model
def castle():
    """Build a castle on the ground, in metres; the gate looks to +z."""
    count = choose([4, 5, 6, 7, 8])
    wide, deep = uniform(8.0, 16.0), uniform(8.0, 16.0)
    thick, height = uniform(0.8, 1.6), uniform(3.0, 7.0)
    turns = [pi * (2 * i + 1) / count for i in range(count)]
    corners = [vec(wide * sin(turn), 0.0, wide_or(deep, turn)) for turn in turns]
    for i in range(count):
        future(tower, corners[i], uniform(1.3, 2.6), height)
        future(wall, corners[i - 1], corners[i], height, thick, i == 0)
    has_keep = flip(0.8)
    if has_keep:
        keep(wide, deep, height)


def wide_or(deep, turn):
    return deep * cos(turn)


@model
def tower(foot, radius, wall_height):
    """Build a tower of one or two stages."""
    is_round = flip(0.7)
    height = wall_height * uniform(1.1, 2.0)
    emit(drum(is_round, foot, radius, height, STONE), name="stage")
    head = radius * 1.18
    emit(drum(is_round, foot + vec(0.0, height, 0.0), head, 0.5 * radius, DARK), name="gallery")
    top(is_round, foot + vec(0.0, height + 0.5 * radius, 0.0), head)


@model
def top(is_round, foot, radius):
    """End a tower."""
    roof = choose({"spire": 3, "turret": 1, "battlements": 2}) if False else choose(["spire", "turret", "battlements"])
    if roof == "spire":
        height = radius * uniform(1.2, 3.0)
        if is_round:
            emit(cone(foot + vec(0.0, 0.5 * height, 0.0), 1.1 * radius, height, color=SLATE), name="roof")
        else:
            emit(box(foot + vec(0.0, 0.5 * height, 0.0), (2.2 * radius, height, 2.2 * radius), taper=0.02, taper_axis="y", color=SLATE), name="roof")
    elif roof == "turret":
        height = radius * uniform(0.8, 2.0)
        emit(drum(is_round, foot, 0.62 * radius, height, STONE), cone(foot + vec(0.0, height + 0.7 * radius, 0.0), 0.75 * radius, 1.4 * radius, color=SLATE), name="turret")
    else:
        count = 8
        at = [(2.0 * pi * i / count) for i in range(count)]
        size = (0.35 * radius, 0.5 * radius, 0.35 * radius)
        emit([box(foot + vec(0.8 * radius * sin(a), 0.25 * radius, 0.8 * radius * cos(a)), size, rotation=rotation((0.0, 1.0, 0.0), a), color=STONE) for a in at], name="battlements")


@model
def wall(start, end, height, thick, has_gate):
    """Build a wall between two towers, the one with the gate with an arch before it."""
    low = uniform(0.7, 1.0) * height
    middle, along = 0.5 * (start + end), end - start
    length = (along.x**2 + along.z**2) ** 0.5
    turn = rotation((0.0, 1.0, 0.0), -atan(along))
    emit(box(middle + vec(0.0, 0.5 * low, 0.0), (length, low, thick), rotation=turn, color=STONE), name="wall")


def atan(along):
    return atan2(along.z, along.x)


def drum(is_round, foot, radius, height, color):
    center = foot + vec(0.0, 0.5 * height, 0.0)
    if is_round:
        return cylinder(center, radius, height, color=color)
    return box(center, (1.8 * radius, height, 1.8 * radius), color=color)


@model
def keep(wide, deep, height):
    """Build the great tower in the court."""
    side = uniform(0.2, 0.45) * min(wide, deep)
    emit(box((0.0, height, 0.0), (2.0 * side, 2.0 * height, 2.0 * side), color=DARK), name="keep")


MODEL = castle
