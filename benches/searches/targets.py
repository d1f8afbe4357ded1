"""Solids that are made from seeds: each is a table of named parts, closed meshes which may overlap.

Lengths are scene units, y is up. Sizes are drawn so that the model of the problem can fill them: trunks as thick as
its trees', lots as wide as its towers.
"""

from __future__ import annotations

import numpy as np
from niwaki.targets.examples.lofts import Mesh, ball, loft, tube
from numpy.typing import ArrayLike, NDArray

Parts = dict[str, Mesh]
Random = np.random.Generator


def direction(azimuth: float, elevation: float) -> NDArray[np.float64]:
    """A unit vector, (3,); angles in radians."""
    level = np.cos(elevation)
    return np.array([level * np.cos(azimuth), np.sin(elevation), level * np.sin(azimuth)])


def stem(random: Random, height: float, lean: float) -> list[NDArray[np.float64]]:
    """Points of a trunk from the origin, which ends up to `lean` away from above it."""
    x, z = random.uniform(-lean, lean, 2)
    bend_x, bend_z = random.uniform(-0.5, 0.5, 2)
    path = [(0.0, 0.0), (0.14 * x, 0.14 * z), (0.7 * x + bend_x, 0.7 * z + bend_z), (x, z)]
    rises = (0.0, 0.35 * height, 0.7 * height, height)
    return [np.array([x, y, z]) for (x, z), y in zip(path, rises, strict=True)]


def forked_stem(random: Random) -> Parts:
    """A trunk that forks into two arms, with a ball on each, of different sizes, along x or along z."""
    trunk = stem(random, random.uniform(7.5, 10.5), 1.6)
    parts = {"trunk": tube(trunk, [2.0, 1.8, 1.7, 1.6])}
    azimuth = 0.5 * np.pi * random.integers(4) + random.uniform(-0.2, 0.2)
    for name, turn in (("one", 0.0), ("other", np.pi + random.uniform(-0.3, 0.3))):
        ahead = direction(azimuth + turn, random.uniform(0.65, 1.0))
        foot, reach = trunk[-1] - [0.0, 0.8, 0.0], random.uniform(8.0, 11.0)
        sag = random.uniform(-0.8, 0.8) * np.array([0.0, 1.0, 0.0])
        path = [foot, foot + 0.35 * reach * ahead + sag, foot + 0.7 * reach * ahead, foot + reach * ahead]
        radius = random.uniform(3.8, 5.2)
        parts[f"{name} arm"] = tube(path, [1.5, 1.35, 1.2, 1.05])
        parts[f"{name} ball"] = ball(path[-1] + 0.6 * radius * ahead, (radius, 0.9 * radius, radius))
    return parts


def leaning_disc(random: Random) -> Parts:
    """A leaning trunk under a round, flat disc that leans with it."""
    trunk = stem(random, random.uniform(9.0, 12.0), 3.5)
    radius, thick = random.uniform(6.0, 8.5), random.uniform(1.6, 2.4)
    normal = direction(random.uniform(0.0, 2.0 * np.pi), random.uniform(0.8, 1.25))
    middle = trunk[-1] + 0.5 * thick * normal
    return {"trunk": tube(trunk, [2.0, 1.8, 1.6, 1.4])} | {
        f"disc, {k + 1} of 4": lying(quarter(radius, thick, k), normal, middle) for k in range(4)
    }


def quarter(radius: float, thick: float, k: int, sides: int = 9) -> Mesh:
    """The `k`-th quarter of a disc about y, its rim rounded."""
    turn = 0.5 * np.pi * (k + np.linspace(0.0, 1.0, sides))
    sections = []
    for height, share in ((-0.5, 0.85), (-0.2, 1.0), (0.2, 1.0), (0.5, 0.85)):
        rim = np.stack([np.cos(turn), np.zeros(sides), np.sin(turn)], axis=1) * share * radius
        sections.append(np.concatenate([np.zeros((1, 3)), rim]) + [0.0, height * thick, 0.0])
    return loft(sections)


def lying(mesh: Mesh, normal: ArrayLike, middle: ArrayLike) -> Mesh:
    """A mesh about y, turned to lie about `normal` and moved to `middle`."""
    up = np.asarray(normal) / np.linalg.norm(normal)
    side = np.cross(up, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side)
    return mesh[0] @ np.stack([side, up, np.cross(side, up)]) + np.asarray(middle), mesh[1]
