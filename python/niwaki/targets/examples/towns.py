"""Volumes on the ground to fill with towers."""

from __future__ import annotations

import numpy as np

from niwaki.targets.examples.lofts import block, loft, solid
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
