"""Vases turned on a wheel: a hollow body of any profile, with a foot, a lip and handles."""

from math import pi, sin

from niwaki import choose, emit, model, revolve, sweep, uniform

TITLE = "vases with handles"
TARGET = "amphora"
VOXEL = 0.035
PARTICLES = 300

CLAY, SLIP, GLAZE, CREAM = (0.70, 0.40, 0.26), (0.22, 0.20, 0.20), (0.20, 0.42, 0.46), (0.90, 0.86, 0.76)
ROWS, WALL = 24, 0.02


@model
def vase():
    """Turn a vase on the ground, in metres."""
    color = choose([CLAY, SLIP, GLAZE, CREAM])
    height = uniform(0.3, 1.2)
    knots = [uniform(0.05, 0.42) for _ in range(7)]
    line = [(spline(knots, i * 6.0 / ROWS), height * i / ROWS) for i in range(ROWS + 1)]
    inside = [(max(r - WALL, 0.0), max(y, 0.05 * height)) for r, y in line[2:]]
    body = revolve([(0.0, 0.0)] + line + list(reversed(inside)) + [(0.0, 0.05 * height)], color=color)
    handles = choose({"none": 2, "one": 1, "two": 2})
    if handles == "none":
        emit(body, name="body")
    else:
        low, high = uniform(0.3, 0.55), uniform(0.7, 0.95)
        sides = [1.0] if handles == "one" else [-1.0, 1.0]
        emit(body, [handle(knots, height, low, high, side, color) for side in sides], name="body")


def handle(knots, height, low, high, side, color):
    """Return a bow from the body to the neck."""
    first, last = spline(knots, 6.0 * low), spline(knots, 6.0 * high)
    at = [i / 8.0 for i in range(9)]
    reach = 0.06 + 0.5 * height * (high - low)
    path = [
        (
            side * (first + t * (last - first) - 0.01 + reach * sin(pi * t)),
            height * (low + t * (high - low)),
            0.0,
        )
        for t in at
    ]
    return sweep([(0.022 * x, 0.022 * y) for x, y in RING], path, color=color)


def spline(knots, t):
    """Return a smooth curve through knots at whole numbers (Catmull and Rom)."""
    i = min(int(t), len(knots) - 2)
    x = t - i
    b, c = knots[i], knots[i + 1]
    a, d = knots[max(i - 1, 0)], knots[min(i + 2, len(knots) - 1)]
    return 0.5 * (2 * b + (c - a) * x + (2 * a - 5 * b + 4 * c - d) * x**2 + (3 * (b - c) + d - a) * x**3)


RING = [(1.0, 0.0), (0.7, 0.7), (0.0, 1.0), (-0.7, 0.7), (-1.0, 0.0), (-0.7, -0.7), (0.0, -1.0), (0.7, -0.7)]

MODEL = vase
