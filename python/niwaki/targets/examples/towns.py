"""Volumes on the ground: a town's blocks, and massings of houses, castles, bridges, furniture and vessels."""

from __future__ import annotations

import numpy as np

from niwaki.targets.examples.lofts import Mesh, block, curve, loft, ring, solid
from niwaki.targets.target import Target


def crescent() -> Target:
    """Make a crescent open to +z, 25 wide: a low wall that rises to a tower in the middle."""
    steps = 24
    sections = []
    for angle in np.linspace(-0.62 * np.pi, 0.62 * np.pi, steps + 1):
        bend = abs(angle) / (0.62 * np.pi)
        middle = np.exp(-((bend / 0.16) ** 4))
        end = 1.0 / (1.0 + np.exp(-(bend - 0.86) / 0.03))
        height = 2.6 + 9.4 * middle + 3.2 * end
        thick = 2.1 + 0.4 * middle + 0.3 * end
        out = np.array([np.sin(angle), 0.0, -np.cos(angle)])
        inner, outer = out * (10.6 - thick), out * (10.6 + thick)
        up = np.array([0.0, height, 0.0])
        sections.append(np.array([outer, inner, inner + up, outer + up]) + [0.0, 0.0, 8.0])
    return solid("crescent", [loft(sections)])


def downtown() -> Target:
    """Make a hill of a town 27 square, whose streets stay free: blocks that rise to the middle, one corner a park."""
    lots = [-9.3, 0.0, 9.3]
    heights = [[7.0, 12.0, 6.0], [13.0, 24.0, 15.0], [0.8, 14.0, 8.0]]
    parts = []
    for x, row in zip(lots, heights, strict=True):
        for z, height in zip(lots, row, strict=True):
            parts.append(block((x - 4.1, 0.0, z - 4.1), (x + 4.1, min(height, 0.55 * height + 2.0), z + 4.1)))
            if height > 1.0:
                parts.append(block((x - 2.7, 0.0, z - 2.7), (x + 2.7, height, z + 2.7)))
    return solid("downtown", parts)


def armchair() -> Target:
    """Make an armchair 0.72 wide, with a leaning back, that faces +z."""
    legs = [block((x, 0.0, z), (x + 0.05, 0.36, z + 0.05)) for x in (-0.36, 0.31) for z in (-0.3, 0.26)]
    seat = block((-0.36, 0.36, -0.31), (0.36, 0.46, 0.31))
    rows = ((0.46, -0.25), (0.98, -0.31))
    back = loft(
        [[(x, y, z + s) for x, s in ((0.36, 0), (-0.36, 0), (-0.36, -0.07), (0.36, -0.07))] for y, z in rows]
    )
    arms = [block((x, 0.46, -0.25), (x + 0.07, 0.68, 0.28)) for x in (-0.36, 0.29)]
    return solid("armchair", [*legs, seat, back, *arms])


def farmstead() -> Target:
    """Make a long house with a cross wing and a lean-to, 19 wide."""
    parts = [
        *_gabled((-5.0, 5.0), (-3.2, 3.2), 3.4, 7.2, False),
        *_gabled((4.6, 9.4), (-3.5, 5.5), 3.0, 6.0, True),
    ]
    parts += [block((-9.5, 0.0, -2.2), (-5.0, 2.6, 2.2)), block((-2.6, 4.0, -0.5), (-1.6, 8.8, 0.5))]
    return solid("farmstead", parts)


def _gabled(
    x: tuple[float, float], z: tuple[float, float], eaves: float, ridge: float, turned: bool
) -> list[Mesh]:
    """Return a block with a gable roof, its ridge along x, or along z if it is turned."""
    walls = block((x[0], 0.0, z[0]), (x[1], eaves, z[1]))
    across, along = (x, z) if turned else (z, x)
    low, high, middle = across[0] - 0.4, across[1] + 0.4, 0.5 * sum(across)
    ends = [
        [(low, eaves, at), (high, eaves, at), (middle, ridge, at)] for at in (along[0] - 0.3, along[1] + 0.3)
    ]
    return [walls, loft(ends if turned else [[(at, y, side) for side, y, at in end] for end in ends])]


def fortress() -> Target:
    """Make a square fortress 26 wide: four round towers, one of them high, walls, and a keep near the rear."""
    parts = []
    for x, z, height, radius in (
        (-10.0, 10.0, 9.0, 2.4),
        (10.0, 10.0, 9.0, 2.4),
        (10.0, -10.0, 12.0, 2.8),
        (-10.0, -10.0, 9.0, 2.4),
    ):
        parts.append(_turned([(0.0, radius), (height, radius)], (x, z)))
        parts.append(_turned([(height, 1.2 * radius), (height + 2.6 * radius, 0.05)], (x, z)))
    for low, high in (
        ((-10, 9.4), (10, 10.6)),
        ((-10, -10.6), (10, -9.4)),
        ((-10.6, -10), (-9.4, 10)),
        ((9.4, -10), (10.6, 10)),
    ):
        parts.append(block((low[0], 0.0, low[1]), (high[0], 5.5, high[1])))
    parts.append(block((-3.5, 0.0, -5.5), (3.5, 13.0, 1.5)))
    return solid("fortress", parts)


def viaduct() -> Target:
    """Make a bridge of three arches over a gap 24 wide, with a deck 4.2 above its banks."""
    deck = block((-14.0, 3.4, -1.7), (14.0, 4.2, 1.7))
    parts = [deck]
    for middle in (-8.0, 0.0, 8.0):
        turns = np.linspace(0.0, np.pi, 17)
        crown = [(middle - 3.2 * np.cos(turn), 3.0 * np.sin(turn) - 0.2) for turn in turns]
        for (x0, y0), (x1, y1) in zip(crown, crown[1:], strict=False):
            parts.append(loft([[(x0, y0, z), (x1, y1, z), (x1, 3.4, z), (x0, 3.4, z)] for z in (-1.4, 1.4)]))
    parts += [block((x - 0.8, -5.0, -1.4), (x + 0.8, 3.4, 1.4)) for x in (-12.0, -4.0, 4.0, 12.0)]
    return solid("viaduct", parts)


def amphora() -> Target:
    """Make a solid amphora 1 high."""
    knots = [
        (0.0, 0.14),
        (0.05, 0.1),
        (0.3, 0.27),
        (0.6, 0.33),
        (0.78, 0.2),
        (0.86, 0.09),
        (0.95, 0.1),
        (1.0, 0.15),
    ]
    return solid("amphora", [_turned([(float(y), float(r)) for y, r in curve(knots)], (0.0, 0.0))])


def wreath() -> Target:
    """Make a heart 2.4 high and 0.2 deep that lies on the wall z = 0, its tip at the root."""
    turns = np.linspace(0.0, 2.0 * np.pi, 61)[:-1]
    x = 16.0 * np.sin(turns) ** 3
    y = 13.0 * np.cos(turns) - 5.0 * np.cos(2 * turns) - 2.0 * np.cos(3 * turns) - np.cos(4 * turns)
    outline = np.stack([x, y + 17.0], axis=1) * (2.4 / 29.0)
    sections = [np.concatenate([outline, np.full((60, 1), z)], axis=1) for z in (0.0, 0.2)]
    return solid("wreath", [loft(sections)])


def _turned(profile: list[tuple[float, float]], foot: tuple[float, float]) -> Mesh:
    """Turn a profile of heights and radii about a vertical axis."""
    return loft([ring((foot[0], y, foot[1]), (0.0, 1.0, 0.0), r, r, 32) for y, r in profile])
