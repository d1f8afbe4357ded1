"""Obstacles, and the volumes to fill around them."""

from __future__ import annotations

import numpy as np

from niwaki.targets.examples.lofts import Mesh, block, loft, slab, solid
from niwaki.targets.target import Target


def ledges() -> Target:
    """Make a wall beside the root, at x from -3.3 to -2, with three narrow ledges that reach out over it."""
    wall = block((-3.3, 0.0, -9.3), (-2.0, 22.8, 9.3))
    shelves = [block((-2.6, 10.6, z - 1.5), (8.9, 11.6, z + 1.5)) for z in (-6.0, 0.0, 6.0)]
    return solid("ledges", [wall, *shelves])


def funnel() -> Target:
    """Make a square funnel 23 high that widens upwards: a volume to fill above the ledges."""
    low, high = (2.9, 2.1), (13.8, 9.9)
    rims = [[(-w, y, -d), (w, y, -d), (w, y, d), (-w, y, d)] for y, (w, d) in ((0.0, low), (22.8, high))]
    return solid("funnel", [loft(rims)])


def emblem(tilt: float = 0.0) -> Target:
    """Make the project's mark, 10 wide and 1.5 thick, lying in the air: a hoop and a pruned tree.

    The root is not below its middle but below the widest gap between its trunk and its hoop: a tree that is two to
    three units thick can grow through there, or around.

    Parameters
    ----------
    tilt
        Turns it about x, degrees.
    """
    thick = (-0.75, 0.75)
    turns = 2.0 * np.pi * np.arange(48) / 48
    hoop = []
    for turn in turns:
        inner, outer = (radius * np.array([np.cos(turn), np.sin(turn)]) for radius in (4.5, 5.0))
        hoop.append(
            [(x, y, z) for (x, z), y in ((outer, -0.75), (inner, -0.75), (inner, 0.75), (outer, 0.75))]
        )
    trunk = [
        (-0.45, 4.5),
        (0.55, 4.5),
        (0.2, 2.0),
        (0.75, -0.2),
        (0.2, -2.0),
        (-0.3, -2.0),
        (0.1, -0.1),
        (-0.35, 1.9),
    ]
    parts = [loft(hoop, closed=True)]
    parts += [slab(piece, *thick) for piece in (trunk[0:3] + trunk[7:], trunk[2:4] + trunk[6:], trunk[3:7])]
    for x, z, wide, deep in ((0.0, -2.7, 1.7, 0.75), (-1.75, 0.35, 1.35, 0.6), (1.6, 1.3, 1.0, 0.5)):
        outline = np.stack([x + wide * np.cos(turns[::2]), z + deep * np.sin(turns[::2])], axis=1)
        parts.append(slab(outline, *thick))
    parts += [slab([(-1.8, 0.1), (0.2, 0.5), (0.1, 1.1), (-1.8, 0.6)], *thick)]
    parts += [slab([(0.2, 1.6), (1.6, 1.1), (1.6, 1.5), (0.3, 2.2)], *thick)]
    return solid("emblem", [_placed(part, np.radians(tilt), 7.05) for part in parts])


def gem() -> Target:
    """Make a cut stone 18 high: a narrow foot, widest at two thirds, a chamfered top; to fill around the emblem."""
    turn = 2.0 * np.pi * (np.arange(8) + 0.5) / 8
    rims = [(0.0, 2.4), (2.0, 3.4), (11.2, 8.2), (13.4, 8.2), (17.9, 4.6)]
    stone = loft([np.stack([r * np.cos(turn), np.full(8, y), r * np.sin(turn)], axis=1) for y, r in rims])
    return solid("gem", [stone])


def _placed(mesh: Mesh, angle: float, height: float) -> Mesh:
    """Turn a mesh about x, lift it, and move its widest gap to above the origin."""
    vertices, faces = mesh
    c, s = np.cos(angle), np.sin(angle)
    turned = vertices @ np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])
    return turned + np.array([-2.6, height + 4.0 * s, 0.8]), faces
