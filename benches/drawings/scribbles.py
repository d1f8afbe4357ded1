"""Scribbles: strokes of a brush, made by code, all starting at the same point near the lower border and going up.

Each is the union of discs along smooth curves. Lengths are in shares of the image, y upwards. What is too small, too
full or not in one piece is drawn again.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFilter
from scipy import ndimage

Curve = NDArray[np.float64]

#: Pixels of the large image, and of the final one.
LARGE, SMALL = 300, 50
START = (0.5, 1.0 / 12.0)
#: The brush's mean width, as shares of the image: thin, medium, thick.
WIDTHS = (1.9 / 24.0, 2.6 / 24.0, 3.2 / 24.0)
BORDER = 0.08


def scribble(dice: np.random.Generator) -> tuple[NDArray[np.uint8], str]:
    """One scribble, (50, 50) with 255 for paper, and its kind."""
    kinds = list(KINDS)
    chances = np.array([KINDS[kind][1] for kind in kinds])
    kind = str(dice.choice(kinds, p=chances / chances.sum()))
    while True:
        lines = KINDS[kind][0](dice)
        if lines is None:
            continue
        ink = _drawn(lines, dice, kind == "blob")
        if _is_good(ink, dice):
            return _small(ink), kind


def _is_good(ink: NDArray[np.bool_], dice: np.random.Generator) -> bool:
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    tall, wide = len(rows) / LARGE, len(columns) / LARGE
    fill = ink.mean()
    is_connected = ndimage.label(ink, np.ones((3, 3)))[1] == 1
    at_start = ink[round((1.0 - START[1]) * LARGE), LARGE // 2]
    good = is_connected and at_start and tall >= 0.35 and max(tall, wide) >= 0.62 and 0.075 <= fill <= 0.45
    return bool(good and (fill > 0.13 or dice.random() < 0.25))


def _drawn(lines: list[Curve], dice: np.random.Generator, solid: bool) -> NDArray[np.bool_]:
    image = Image.new("L", (LARGE, LARGE))
    pen = ImageDraw.Draw(image)
    mean = float(dice.choice(WIDTHS))
    for line in lines:
        smooth = _spline(line)
        knots = np.exp(dice.normal(0.0, 0.22, int(dice.integers(2, 5))))
        widths = mean * np.interp(np.linspace(0, 1, len(smooth)), np.linspace(0, 1, len(knots)), knots)
        for (x, y), width in zip(smooth, np.clip(widths, 1.6 / 24.0, 3.9 / 24.0), strict=True):
            u, v, r = x * LARGE, (1.0 - y) * LARGE, 0.5 * width * LARGE
            pen.ellipse((u - r, v - r, u + r, v + r), fill=255)
        if solid:
            pen.polygon([(x * LARGE, (1.0 - y) * LARGE) for x, y in smooth], fill=255)
    soft = image.filter(ImageFilter.GaussianBlur(1.2))
    return np.asarray(soft) >= 128


def _small(ink: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """Means of areas, so that paper stays white."""
    cell = LARGE // SMALL
    share = ink.reshape(SMALL, cell, SMALL, cell).mean(axis=(1, 3))
    return np.rint(255.0 * (1.0 - share)).astype(np.uint8)


def _spline(points: Curve, steps: int = 60) -> Curve:
    """A smooth curve through the points (Catmull & Rom 1974)."""
    ends = np.concatenate([[2 * points[0] - points[1]], points, [2 * points[-1] - points[-2]]])
    pieces = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        t = np.linspace(0.0, 1.0, steps, endpoint=False)[:, None]
        square, cube = t * t, t * t * t
        pieces.append(
            0.5
            * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * square + (3 * b - a - 3 * c + d) * cube)
        )
    return np.concatenate([*pieces, points[-1:]])


def _inside(line: Curve) -> bool:
    return bool((line > BORDER).all() and (line < 1.0 - BORDER).all())


def _walk(dice: np.random.Generator, start: Curve, angle: float, count: int, bend: float) -> Curve | None:
    """A random walk that stays on the page, or none."""
    points = [start]
    for _ in range(count):
        for _ in range(12):
            turned = angle + dice.normal(0.0, bend)
            step = dice.uniform(0.16, 0.34)
            ahead = points[-1] + step * np.array([np.cos(turned), np.sin(turned)])
            if _inside(ahead):
                points.append(ahead)
                angle = turned
                break
        else:
            return None
    return np.array(points)


def stroke(dice: np.random.Generator) -> list[Curve] | None:
    """A free stroke, straight or curly."""
    bend = float(dice.choice([0.35, 0.8, 1.2]))
    line = _walk(dice, np.array(START), np.pi / 2 + dice.normal(0.0, 0.3), int(dice.integers(3, 8)), bend)
    return None if line is None else [line]


def snake(dice: np.random.Generator) -> list[Curve] | None:
    """A wave that climbs."""
    waves, reach = dice.uniform(1.0, 2.6), dice.uniform(0.12, 0.34)
    t = np.linspace(0.0, 1.0, 24)
    top, grows = dice.uniform(0.78, 0.9), dice.uniform(0.5, 1.0)
    x = 0.5 + reach * np.sin(2.0 * np.pi * waves * t) * t**grows * dice.choice([-1.0, 1.0])
    line = np.stack([x, START[1] + (top - START[1]) * t], axis=1)
    return [line] if _inside(line[1:]) else None


def spiral(dice: np.random.Generator) -> list[Curve] | None:
    """A spiral on a stem."""
    side = dice.choice([-1.0, 1.0])
    turns, large = dice.uniform(1.1, 1.6), dice.uniform(0.26, 0.32)
    t = np.linspace(0.0, 1.0, 40)
    radius, angle = large * (1.0 - 0.72 * t), 2.0 * np.pi * turns * t
    center = np.array([0.5 - side * large, 0.58])
    curl = center + np.stack([side * radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    shift = np.array([dice.uniform(-0.06, 0.06) + side * 0.12, 0.0])
    line = np.concatenate([[START], curl + shift])
    return [line] if _inside(line) else None


def loop(dice: np.random.Generator) -> list[Curve] | None:
    """A ring on a stem, perhaps with a spoke or a tail."""
    a, b = dice.uniform(0.17, 0.32), dice.uniform(0.17, 0.3)
    foot = dice.uniform(START[1], 0.4)
    center = np.array([0.5 + dice.uniform(-0.1, 0.1), foot + b])
    angle = np.linspace(-np.pi / 2, 1.5 * np.pi, 30)
    wobble = 1.0 + dice.uniform(0.0, 0.16) * np.sin(int(dice.integers(2, 4)) * angle + dice.uniform(0, 6.3))
    ring = center + np.stack([a * wobble * np.cos(angle), b * wobble * np.sin(angle)], axis=1)
    lines = [np.concatenate([[START], ring]) if foot > 0.16 else ring + (START - ring[0])]
    if dice.random() < 0.5:
        way = dice.uniform(0.0, np.pi)
        lines.append(np.array([lines[0][0], center + 0.5 * a * np.array([np.cos(way), np.sin(way)])]))
    return lines if all(_inside(line) for line in lines) else None


def tree(dice: np.random.Generator) -> list[Curve] | None:
    """A trunk that forks, and forks again."""
    count = int(dice.integers(3, 8))
    lines: list[Curve] = []
    tips = [(np.array(START), np.pi / 2 + dice.normal(0.0, 0.2))]
    while tips and len(lines) < count:
        start, angle = tips.pop(0)
        length = dice.uniform(0.2, 0.36)
        middle = start + 0.5 * length * np.array([np.cos(angle), np.sin(angle)])
        angle += dice.normal(0.0, 0.35)
        end = middle + 0.6 * length * np.array([np.cos(angle), np.sin(angle)])
        if not _inside(np.array([middle, end])):
            continue
        lines.append(np.array([start, middle, end]))
        opening = dice.uniform(0.4, 0.9)
        tips += [(end, angle + opening), (end, angle - opening)]
    return lines if len(lines) >= 3 else None


def blob(dice: np.random.Generator) -> list[Curve] | None:
    """A solid round shape that stands on the start."""
    a, b = dice.uniform(0.14, 0.3), dice.uniform(0.2, 0.36)
    angle = np.linspace(-np.pi / 2, 1.5 * np.pi, 40)
    wobble = 1.0 + dice.uniform(0.02, 0.25) * np.sin(int(dice.integers(2, 5)) * (angle - np.pi / 2))
    edge = np.stack([a * wobble * np.cos(angle), b * wobble * np.sin(angle)], axis=1)
    edge += np.array(START) - edge[0] + np.array([0.0, -0.02])
    return [edge] if _inside(edge[5:-5]) else None


#: Forms like letters on a grid of 0 to 1 by 0 to 1, the first stroke from the lower middle.
FORMS: tuple[tuple[tuple[tuple[float, float], ...], ...], ...] = (
    (((0.5, 0), (0.5, 0.5), (0.5, 1)), ((0, 1), (0.5, 1), (1, 1))),
    (((0.5, 0), (0.5, 0.5)), ((0.5, 0.5), (0.1, 1)), ((0.5, 0.5), (0.9, 1))),
    (((0.4, 0), (0.4, 0.5), (0.4, 1)), ((0.4, 1), (1, 1)), ((0.4, 0.5), (0.85, 0.5))),
    (((0.5, 0), (0.5, 0.5), (0.5, 1)), ((0, 0.6), (1, 0.6))),
    (((0.5, 0), (0, 0.3), (0, 0.75), (0.5, 1), (1, 0.8)),),
    (((0.5, 0), (1, 0.2), (0.9, 0.45), (0.1, 0.55), (0.05, 0.85), (0.5, 1), (1, 0.9)),),
    (((0.35, 0), (0.65, 0.5), (1, 1)), ((1, 1), (0, 1))),
    (((0.1, 0), (0.1, 1)), ((0.1, 0.6), (0.5, 0.8), (0.9, 0.5), (0.9, 0))),
    (((0.5, 0), (0, 0.4), (0, 1)), ((0.5, 0), (1, 0.4), (1, 1))),
    (((0, 0), (1, 1)), ((0.5, 0.5), (0, 1)), ((0.5, 0.5), (1, 0))),
    (((0.2, 0), (0.2, 1)), ((0.2, 0), (1, 0))),
    (((0.2, 0), (0.2, 1)), ((0.2, 0.4), (0.9, 1)), ((0.4, 0.55), (0.95, 0))),
    (((0.5, 0), (0.5, 0.35), (0.15, 0.6), (0.2, 0.9), (0.6, 1), (0.9, 0.8), (0.75, 0.55)),),
    (((0.5, 0), (0.5, 0.5)), ((0.5, 0.5), (0, 0.6), (0, 1)), ((0.5, 0.5), (1, 0.6), (1, 1))),
)


def letter(dice: np.random.Generator) -> list[Curve] | None:
    """A form like a letter, a little distorted."""
    form = FORMS[int(dice.integers(len(FORMS)))]
    wide, tall = dice.uniform(0.42, 0.66), dice.uniform(0.6, 0.78)
    lean, mirror = dice.normal(0.0, 0.1), dice.choice([-1.0, 1.0])
    origin = form[0][0][0]
    jitter: dict[tuple[float, float], Curve] = {}
    lines = []
    for part in form:
        points = []
        for x, y in part:
            moved = jitter.setdefault((x, y), dice.normal(0.0, 0.02, 2))
            u, v = mirror * (x - origin) * wide, y * tall
            points.append(np.array(START) + (np.array([u + lean * v, v]) + (moved if y > 0 else 0.0)))
        lines.append(np.array(points))
    return lines if all(_inside(line) for line in lines) else None


KINDS: dict[str, tuple[Callable[[np.random.Generator], list[Curve] | None], float]] = {
    "stroke": (stroke, 0.28),
    "snake": (snake, 0.10),
    "spiral": (spiral, 0.05),
    "loop": (loop, 0.16),
    "tree": (tree, 0.18),
    "letter": (letter, 0.17),
    "blob": (blob, 0.06),
}
