"""Generators of buildings and vessels: a spiral stair, a vase of ten radii, a house with roofs of four kinds."""

from __future__ import annotations

import math

import numpy as np

from .parameters import Values, choice, real, switch, whole
from .solids import CORNERS, Part, block, cylinder, hexahedron, lathe, standing

STAIR = [
    whole("steps", 6, 24),
    real("height", 1.0, 3.0),
    real("radius", 0.6, 1.5),
    real("inner", 0.1, 0.4),
    real("turn", 90.0, 540.0),
    real("tread", 0.03, 0.15),
    switch("pole"),
    real("pole_extra", 0.0, 0.6, lambda p: p["pole"]),
    switch("rail"),
    real("rail_height", 0.3, 1.0, lambda p: p["rail"]),
]


def stair(p: Values) -> list[Part]:
    turn = math.radians(p["turn"]) / p["steps"]
    parts: list[Part] = []
    for number in range(p["steps"]):
        top, angle = (number + 1) * p["height"] / p["steps"], number * turn
        parts += _wedge(p["inner"], p["radius"], angle, angle + min(1.05 * turn, 2.5), top - p["tread"], top)
        if p["rail"]:
            middle, far = angle + turn / 2, p["radius"] - 0.05
            x, z = far * math.cos(middle), -far * math.sin(middle)
            parts += standing(x, top - 0.01, z, 0.05, p["rail_height"] + 0.01, 0.05)
    if p["pole"]:
        parts += cylinder(0, 0, 0, p["inner"] + 0.02, p["height"] + p["pole_extra"])
    return parts


def _wedge(inner: float, outer: float, start: float, end: float, low: float, high: float) -> list[Part]:
    around = [(inner, start), (outer, start), (outer, end), (inner, end)]
    return hexahedron([(r * math.cos(a), y, -r * math.sin(a)) for y in (low, high) for r, a in around])


VASE = [real(f"r{number}", 0.12, 0.8) for number in range(10)]


def vase(p: Values) -> list[Part]:
    rows, height = 28, 1.6
    knots = np.array([p[row.name] for row in VASE])
    places = np.linspace(0, len(knots) - 1, rows)
    index = np.clip(places.astype(int), 0, len(knots) - 2)
    u = places - index
    ends = np.r_[2 * knots[0] - knots[1], knots, 2 * knots[-1] - knots[-2]]
    a, b, c, d = ends[index], ends[index + 1], ends[index + 2], ends[index + 3]
    # Catmull-Rom.
    radii = 0.5 * (2 * b + (c - a) * u + (2 * a - 5 * b + 4 * c - d) * u**2 + (3 * b - a - 3 * c + d) * u**3)
    return lathe(np.maximum(radii, 0.05), np.linspace(0, height, rows))


BUILDING = [
    real("width", 0.8, 2.0),
    real("depth", 0.6, 1.6),
    whole("floors", 1, 6),
    real("floor_h", 0.2, 0.45),
    choice("roof", "flat", "gable", "hip", "shed"),
    real("roof_h", 0.1, 0.8, lambda p: p["roof"] != "flat"),
    real("parapet", 0.03, 0.2, lambda p: p["roof"] == "flat"),
    whole("bays", 0, 6),
    real("bay_w", 0.3, 0.9, lambda p: p["bays"]),
    real("bay_out", 0.04, 0.25, lambda p: p["bays"]),
    real("bay_h", 0.3, 0.9, lambda p: p["bays"]),
    switch("porch"),
    real("porch_w", 0.2, 0.8, lambda p: p["porch"]),
    real("porch_d", 0.1, 0.5, lambda p: p["porch"]),
    switch("wing"),
    choice("wing_side", "left", "right", "rear", when=lambda p: p["wing"]),
    real("wing_l", 0.3, 1.2, lambda p: p["wing"]),
    real("wing_d", 0.3, 0.9, lambda p: p["wing"]),
    whole("wing_floors", 1, 4, lambda p: p["wing"]),
    switch("chimney"),
    real("chimney_x", -0.4, 0.4, lambda p: p["chimney"]),
    real("chimney_h", 0.1, 0.6, lambda p: p["chimney"]),
    switch("tower"),
    real("tower_h", 0.2, 1.2, lambda p: p["tower"]),
]


def building(p: Values) -> list[Part]:
    width, depth, storey = p["width"], p["depth"], p["floor_h"]
    eaves = p["floors"] * storey
    parts = standing(0, 0, 0, width, eaves, depth) + _roof(p, width, depth, eaves)
    for floor in range(p["floors"]):
        for number in range(p["bays"]):
            cell, tall = width / p["bays"], storey * p["bay_h"]
            x, y = -width / 2 + (number + 0.5) * cell, floor * storey + (storey - tall) / 2
            parts += standing(x, y, depth / 2, cell * p["bay_w"], tall, 2 * p["bay_out"])
    if p["porch"]:
        wide, deep = p["porch_w"] * width, p["porch_d"]
        parts += standing(0, storey - 0.06, depth / 2 + deep / 2, wide, 0.06, deep + 0.02)
        for side in (-1, 1):
            parts += standing(side * (wide / 2 - 0.03), 0, depth / 2 + deep - 0.03, 0.06, storey - 0.03, 0.06)
    if p["wing"]:
        parts += _wing(p, width, depth, storey)
    if p["chimney"]:
        tall = p["chimney_h"] + 0.1 + (p["roof_h"] or 0.0)
        parts += standing(p["chimney_x"] * width, eaves - 0.1, -0.2 * depth, 0.14, tall, 0.14)
    if p["tower"]:
        parts += standing(width / 2 - 0.15, 0, depth / 2 - 0.15, 0.4, eaves + p["tower_h"], 0.4)
    return parts


def _roof(p: Values, width: float, depth: float, eaves: float) -> list[Part]:
    x, z, low = width / 2 + 0.05, depth / 2 + 0.05, eaves - 0.02
    if p["roof"] == "flat":
        return block((-x, low, -z), (x, eaves + p["parapet"], z))
    ridge = eaves + p["roof_h"]
    bottom = [(-x, low, -z), (x, low, -z), (x, low, z), (-x, low, z)]
    if p["roof"] == "shed":
        top = [(-x, ridge, -z), (x, ridge, -z), (x, low + 0.05, z), (-x, low + 0.05, z)]
    else:
        half = x if p["roof"] == "gable" else 0.45 * x
        top = [(-half, ridge, -0.02), (half, ridge, -0.02), (half, ridge, 0.02), (-half, ridge, 0.02)]
    return [(np.array(bottom + top, float), CORNERS[:, ::-1])]


def _wing(p: Values, width: float, depth: float, storey: float) -> list[Part]:
    tall, far = p["wing_floors"] * storey, p["wing_l"]
    if p["wing_side"] == "rear":
        half = p["wing_d"] * width / 2
        return block((-half, 0, -depth / 2 - far), (half, tall, -depth / 2 + 0.02))
    half = p["wing_d"] * depth / 2
    if p["wing_side"] == "left":
        return block((-width / 2 - far, 0, -half), (-width / 2 + 0.02, tall, half))
    return block((width / 2 - 0.02, 0, -half), (width / 2 + far, tall, half))
