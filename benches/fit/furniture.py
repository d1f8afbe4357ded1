"""Generators of furniture: a table of eight reals, a shelf with counts and switches, a chair of three kinds."""

from __future__ import annotations

from .parameters import Values, choice, real, switch, whole
from .solids import Part, block, cylinder, standing

TABLE = [
    real("width", 0.8, 2.0),
    real("depth", 0.5, 1.2),
    real("height", 0.5, 1.1),
    real("top", 0.03, 0.15),
    real("leg", 0.04, 0.2),
    real("inset", 0.0, 0.2),
    real("shelf_at", 0.1, 0.6),
    real("shelf", 0.03, 0.12),
]


def table(p: Values) -> list[Part]:
    width, depth, height, top, leg, inset = (p[row.name] for row in TABLE[:6])
    parts = standing(0, height - top, 0, width, top, depth)
    for x in (-1, 1):
        for z in (-1, 1):
            across, along = width / 2 - inset - leg / 2, depth / 2 - inset / 2 - leg / 2
            parts += standing(x * across, 0, z * along, leg, height - top / 2, leg)
    return parts + standing(
        0, p["shelf_at"] * height, 0, width - 2 * inset - leg, p["shelf"], depth - inset - leg
    )


SHELF = [
    real("width", 0.6, 2.0),
    real("height", 0.6, 2.2),
    real("depth", 0.2, 0.6),
    real("board", 0.02, 0.08),
    whole("shelves", 1, 8),
    whole("dividers", 0, 4),
    switch("back"),
    switch("feet"),
    real("foot_height", 0.05, 0.3, lambda p: p["feet"]),
    real("overhang", 0.0, 0.15),
    switch("crown"),
    real("crown_height", 0.05, 0.3, lambda p: p["crown"]),
]


def shelf(p: Values) -> list[Part]:
    width, height, depth, board = (p[row.name] for row in SHELF[:4])
    foot = p["foot_height"] if p["feet"] else 0.0
    half, top = width / 2, foot + height
    parts = block((-half, foot, 0), (-half + board, top, depth))
    parts += block((half - board, foot, 0), (half, top, depth))
    for number in range(p["shelves"] + 1):
        y = foot + number * (height - board) / p["shelves"]
        parts += block((-half, y, 0), (half, y + board, depth))
    for number in range(p["dividers"]):
        x = -half + (number + 1) * width / (p["dividers"] + 1)
        parts += block((x - board / 2, foot, 0), (x + board / 2, top, depth))
    if p["back"]:
        parts += block((-half, foot, depth - board), (half, top, depth))
    if p["feet"]:
        for side in (-1, 1):
            for z in (0.0, depth - 2 * board):
                x = side * (half - board)
                parts += block((x - board, 0, z), (x + board, foot + board / 2, z + 2 * board))
    over = p["overhang"]
    parts += block((-half - over, top - board, -over), (half + over, top, depth))
    if p["crown"]:
        parts += block((-half, top - board / 2, depth - 2 * board), (half, top + p["crown_height"], depth))
    return parts


def _has_slats(p: Values) -> bool:
    return p["back"] and p["back_kind"] != "solid"


CHAIR = [
    real("seat_w", 0.35, 0.8),
    real("seat_d", 0.35, 0.8),
    real("seat_h", 0.3, 0.7),
    real("seat_t", 0.03, 0.15),
    choice("legs", "four", "pedestal", "sled"),
    real("leg_t", 0.03, 0.12),
    real("leg_inset", 0.0, 0.12, lambda p: p["legs"] == "four"),
    switch("stretcher", lambda p: p["legs"] == "four"),
    real("stretcher_h", 0.1, 0.8, lambda p: p["stretcher"]),
    real("base_r", 0.15, 0.4, lambda p: p["legs"] == "pedestal"),
    real("base_t", 0.02, 0.1, lambda p: p["legs"] == "pedestal"),
    real("runner_h", 0.02, 0.1, lambda p: p["legs"] == "sled"),
    switch("back"),
    real("back_h", 0.2, 0.9, lambda p: p["back"]),
    choice("back_kind", "solid", "slats", "rungs", when=lambda p: p["back"]),
    whole("slats", 2, 8, _has_slats),
    real("back_t", 0.03, 0.12, lambda p: p["back"]),
    switch("arms"),
    real("arm_h", 0.12, 0.35, lambda p: p["arms"]),
    real("arm_t", 0.03, 0.1, lambda p: p["arms"]),
]


def chair(p: Values) -> list[Part]:
    width, depth, height, thick, leg = p["seat_w"], p["seat_d"], p["seat_h"], p["seat_t"], p["leg_t"]
    parts = standing(0, height - thick, 0, width, thick, depth)
    up = height - thick / 2
    if p["legs"] == "four":
        x, z = width / 2 - p["leg_inset"] - leg / 2, depth / 2 - p["leg_inset"] - leg / 2
        for side in (-1, 1):
            parts += standing(side * x, 0, z, leg, up, leg) + standing(side * x, 0, -z, leg, up, leg)
        if p["stretcher"]:
            y, bar = p["stretcher_h"] * (height - thick), 0.8 * leg
            parts += standing(-x, y, 0, bar, bar, 2 * z) + standing(x, y, 0, bar, bar, 2 * z)
            parts += standing(0, y, 0, 2 * x, bar, bar)
    elif p["legs"] == "pedestal":
        parts += cylinder(0, 0, 0, leg, up) + cylinder(0, 0, 0, p["base_r"], p["base_t"], 24)
    else:
        for side in (-1, 1):
            x = side * (width / 2 - leg / 2)
            parts += standing(x, 0, 0, leg, p["runner_h"], depth)
            for z in (-1, 1):
                parts += standing(x, 0, z * (depth / 2 - leg / 2), leg, up, leg)
    if p["back"]:
        parts += _back(p, width, depth, height, thick)
    if p["arms"]:
        arm = p["arm_t"]
        for side in (-1, 1):
            x = side * (width / 2 - arm / 2)
            parts += standing(x, height + p["arm_h"], 0, arm, arm, depth)
            parts += standing(x, up, depth / 2 - 0.03, arm, p["arm_h"] + thick / 2 + 0.01, 0.05)
    return parts


def _back(p: Values, width: float, depth: float, height: float, thick: float) -> list[Part]:
    tall, deep, up = p["back_h"], p["back_t"], height - thick / 2
    z = -depth / 2 + deep / 2
    if p["back_kind"] == "solid":
        return standing(0, up, z, width, tall + thick / 2, deep)
    parts = standing(0, height + tall - 0.08, z, width, 0.08, deep)
    for side in (-1, 1):
        parts += standing(side * (width / 2 - 0.025), up, z, 0.05, tall + thick / 2, deep)
    count = p["slats"]
    for number in range(count):
        if p["back_kind"] == "slats":
            parts += standing(-width / 2 + (number + 1) * width / (count + 1), up, z, 0.035, tall, deep)
        else:
            y = height + (number + 0.5) * (tall - 0.08) / count
            parts += standing(0, y, z, width - 0.04, 0.035, deep)
    return parts
