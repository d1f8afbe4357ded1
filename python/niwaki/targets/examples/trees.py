"""Volumes to fill with plants: they stand on the ground, their root at the origin."""

from __future__ import annotations

import numpy as np

from niwaki.targets.examples.lofts import ball, cloud, loft, solid, tube
from niwaki.targets.target import Target


def niwaki() -> Target:
    """Make a cloud-pruned garden tree 20 high: an S-bent leaning trunk, limbs, five flat clouds."""
    trunk = tube(
        [(0, 0, 0), (0.5, 2.2, 0.1), (1.9, 4.8, 0.3), (2.6, 7.4, 0.3), (1.6, 10.2, 0.0), (-0.6, 12.8, -0.4)]
        + [(-1.6, 15.0, -0.5), (-1.2, 17.2, -0.4)],
        [1.75, 1.45, 1.3, 1.15, 1.0, 0.85, 0.7, 0.55],
    )
    limbs = [
        tube([(2.3, 5.9, 0.3), (4.4, 6.9, 0.9), (6.4, 7.4, 1.3)], [0.75, 0.6, 0.5]),
        tube([(2.3, 8.4, 0.2), (0.0, 9.3, 1.2), (-2.8, 9.6, 1.7)], [0.7, 0.6, 0.45]),
        tube([(0.6, 11.6, -0.2), (2.8, 12.6, -0.8), (4.6, 12.9, -1.2)], [0.6, 0.5, 0.4]),
        tube([(-1.3, 14.0, -0.4), (-3.4, 14.6, -1.0), (-4.8, 14.8, -1.3)], [0.5, 0.45, 0.4]),
    ]
    clouds = [
        cloud((6.7, 8.0, 1.4), (3.1, 1.2, 3.0)),
        cloud((-3.9, 10.2, 1.8), (3.0, 1.15, 2.8)),
        cloud((5.0, 13.5, -1.4), (2.6, 1.1, 2.5)),
        cloud((-5.2, 15.2, -1.4), (2.3, 1.05, 2.2)),
        cloud((-0.9, 18.2, -0.4), (3.0, 1.5, 2.8)),
    ]
    return solid("niwaki", [trunk, *limbs, *clouds])


def bent_tube() -> Target:
    """Make a long tube, bent like an S and leaning to +z, with an egg-shaped crown on top; 26 high."""
    path = [
        (0, 0, 0),
        (0.1, 3.6, -0.6),
        (-0.2, 8.0, 0.3),
        (-0.1, 12.0, 3.0),
        (0.2, 15.2, 6.0),
        (0.1, 18.4, 7.5),
    ]
    path.append((0.0, 21.0, 7.8))
    trunk = tube(path, [1.85, 1.8, 1.7, 1.6, 1.55, 1.5, 1.4])
    return solid("bent_tube", [trunk, ball((0.0, 22.0, 7.9), (3.2, 3.9, 3.2), egg=0.18)])


def forked_tree() -> Target:
    """Make a leaning trunk that forks into two arms with a ball on each; 25 high and 28 wide."""
    trunk = tube([(0, 0, 0), (-0.4, 3.0, 0), (0.2, 6.5, 0), (1.4, 9.5, 0)], [2.0, 1.8, 1.7, 1.6])
    left = tube(
        [(1.3, 8.6, 0), (-0.6, 11.5, 0.1), (-4.0, 13.8, 0.2), (-6.6, 16.4, 0.2)], [1.5, 1.3, 1.15, 1.0]
    )
    right = tube([(1.2, 8.8, 0), (3.2, 11.8, 0), (6.4, 14.6, -0.2), (9.2, 17.6, -0.2)], [1.5, 1.3, 1.2, 1.05])
    balls = [ball((-7.2, 17.2, 0.2), (5.2, 4.4, 5.2)), ball((10.0, 20.0, -0.2), (5.6, 4.8, 5.6))]
    return solid("forked_tree", [trunk, left, right, *balls])


def umbrella() -> Target:
    """Make a forked trunk under one wide, flat crown; 23 high and 30 wide."""
    trunk = tube([(0, 0, 0), (0.5, 3.2, 0), (0.2, 6.5, 0), (1.2, 9.8, 0)], [2.0, 1.8, 1.6, 1.5])
    left = tube(
        [(1.1, 9.0, 0), (-1.8, 12.0, 0.4), (-5.5, 14.4, 0.6), (-8.0, 17.0, 0.8)], [1.4, 1.2, 1.0, 0.9]
    )
    right = tube(
        [(1.1, 9.2, 0), (4.0, 12.4, -0.3), (8.2, 15.0, -0.6), (11.2, 17.6, -0.8)], [1.4, 1.2, 1.0, 0.9]
    )
    return solid("umbrella", [trunk, left, right, cloud((1.8, 18.2, 0.0), (15.0, 4.4, 7.4))])


def fan() -> Target:
    """Make an upright fan 12 wide, 11 high and 4.4 deep."""
    turn = np.linspace(np.pi, 0.0, 25)
    rim = np.stack([6.0 * np.cos(turn), 5.0 + 6.0 * np.sin(turn)], axis=1)
    outline = np.concatenate([[(-1.2, 0.0)], rim, [(1.2, 0.0)]])
    return solid("fan", [loft([[(x, y, z) for x, y in outline] for z in (-2.2, 2.2)])])
