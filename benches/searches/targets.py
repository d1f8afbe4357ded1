"""Solids that are made from seeds: each is a table of named parts, closed meshes which may overlap.

Lengths are scene units, y is up. Sizes are drawn so that the model of the problem can fill them: trunks as thick as
its trees', lots as wide as its towers.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from niwaki.targets.examples.lofts import Mesh, ball, block, curve, loft, rectangle, ring, section, slab, tube
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
    profile = [(-0.5 * thick, 0.85), (-0.2 * thick, 1.0), (0.2 * thick, 1.0), (0.5 * thick, 0.85)]
    rim = [(height, share * radius) for height, share in profile]
    quarters = {f"disc {k + 1}": lying(quarter(rim, k), normal, middle) for k in range(4)}
    return {"trunk": tube(trunk, [2.0, 1.8, 1.6, 1.4])} | quarters


def quarter(profile: Sequence[tuple[float, float]], k: int, sides: int = 9) -> Mesh:
    """The `k`-th quarter of a solid of revolution about y, by heights and radii."""
    turn = 0.5 * np.pi * (k + np.linspace(0.0, 1.0, sides))
    rim = np.stack([np.cos(turn), np.zeros(sides), np.sin(turn)], axis=1)
    return loft([np.concatenate([np.zeros((1, 3)), radius * rim]) + [0.0, y, 0.0] for y, radius in profile])


def lying(mesh: Mesh, normal: ArrayLike, middle: ArrayLike) -> Mesh:
    """A mesh about y, turned to lie about `normal` and moved to `middle`."""
    up = np.asarray(normal) / np.linalg.norm(normal)
    side = np.cross(up, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side)
    return mesh[0] @ np.stack([side, up, np.cross(side, up)]) + np.asarray(middle), mesh[1]


def sheathed(random: Random) -> tuple[Parts, Mesh]:
    """A bent trunk with a crown, and a tight sheath around the middle of the trunk that nothing may touch."""
    trunk = stem(random, random.uniform(15.0, 18.0), 4.5)
    crown = random.uniform(3.5, 4.5)
    parts = {
        "trunk": tube(trunk, [2.1, 2.0, 1.8, 1.6]),
        "crown": ball(trunk[-1] + [0.0, 0.8 * crown, 0.0], (crown, crown, crown)),
    }
    line = curve(trunk)
    first, last = (round(share * len(line)) for share in (0.25, 0.85))
    along = np.gradient(line, axis=0)
    inner, outer = (
        [ring(line[k], along[k], 2.2 + room, 2.2 + room, 16) for k in range(first, last)]
        for room in (1.7, 2.6)
    )
    return parts, loft([*outer, *inner[::-1]], closed=True)


def long_stem(random: Random) -> Parts:
    """A stem of about ten pieces that winds upwards out of a pot, in four quarters."""
    height, radius = random.uniform(14.0, 18.0), random.uniform(0.7, 0.9)
    swing, turn, phase = random.uniform(1.0, 2.0), random.uniform(1.0, 2.0), random.uniform(0.0, 2.0 * np.pi)
    rise = np.linspace(0.0, 1.0, 41)
    angle = phase + turn * np.pi * rise
    x, z = (swing * (wave(angle) - wave(phase)) * np.minimum(1.0, 2.0 * rise) for wave in (np.cos, np.sin))
    line = np.stack([x, height * rise, z], axis=1)
    along = np.gradient(line, axis=0)
    rings = [ring(point, ahead, radius, radius, 16) for point, ahead in zip(line, along, strict=True)]
    quarters = {f"quarter {k + 1}": loft(rings[10 * k : 10 * k + 11]) for k in range(4)}
    return {"pot": block((-1.5, -1.0, -1.5), (1.5, 0.0, 1.5))} | quarters


def counted_boards(random: Random) -> Parts:
    """The boards of a shelf, four to seven with gaps of any height, as wide as one another."""
    half, y, parts = random.uniform(2.2, 3.8), 0.0, {}
    for k in range(random.integers(4, 8)):
        parts[f"board {k + 1}"] = block((-half, y, -1.5), (half, y + 0.6, 1.5))
        y += 0.6 + random.uniform(0.8, 3.5)
    return parts


def shelved(random: Random) -> tuple[Parts, list[Mesh]]:
    """A cone that widens upwards, in quarters, and three shelves across it at different heights and sides."""
    wide, high = random.uniform(7.0, 9.0), random.uniform(16.0, 19.0)
    parts = {
        "foot": loft([ring((0.0, y, 0.0), (0.0, 1.0, 0.0), r, r, 16) for y, r in ((0.0, 2.6), (6.0, 4.4))])
    }
    rim = [(6.0, 4.4), (0.75 * high, wide), (high, 0.7 * wide)]
    parts |= {f"quarter {k + 1}": quarter(rim, k) for k in range(4)}
    shelves = []
    for y, turn in zip((5.5, 8.5, 11.5), random.permutation(4)[:3], strict=True):
        near, half = random.uniform(2.4, 3.2), random.uniform(2.0, 3.5)
        corners = np.array([(near, y, -half), (near + 7.0, y + 0.8, half)])
        spun = corners @ spin(0.5 * np.pi * turn)
        shelves.append(block(spun.min(axis=0), spun.max(axis=0)))
    return parts, shelves


def spin(angle: float) -> NDArray[np.float64]:
    """Turn rows (n, 3) about y by an angle, radians."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def thin_walls(random: Random) -> Parts:
    """Thin walls in a row from the origin on, which bend, and one or two that leave it at right angles."""
    heading, place = random.uniform(0.0, 2.0 * np.pi), np.zeros(2)
    height, parts, count = random.uniform(2.5, 3.5), {}, 5
    leaving = set(random.choice(np.arange(1, count), size=random.integers(1, 3), replace=False))
    for k in range(count):
        parts[f"wall {k + 1}"], end = upright(place, heading, random.uniform(3.5, 5.0), height)
        if k in leaving:
            aside = heading + 0.5 * np.pi * random.choice([-1.0, 1.0])
            parts[f"side {k + 1}"], _ = upright(place, aside, random.uniform(4.0, 6.0), height)
        place, heading = end, heading + random.normal(0.0, 0.4)
    return parts


def upright(
    place: NDArray[np.float64], heading: float, length: float, height: float, thick: float = 0.8
) -> tuple[Mesh, NDArray[np.float64]]:
    """A wall from a place (x, z) on, and where it ends; headings turn from +x to -z."""
    ahead = np.array([np.cos(heading), -np.sin(heading)])
    across = 0.5 * thick * np.array([-ahead[1], ahead[0]])
    end = place + length * ahead
    return slab([place - across, end - across, end + across, place + across], 0.0, height), end


def row_of_towers(random: Random) -> Parts:
    """Four to six towers side by side on a winding path of lots, of very different heights."""
    return lots(random, (0.0, 0.0), random.integers(4, 7), "tower")


def lots(random: Random, first: tuple[float, float], count: int, word: str) -> Parts:
    """Towers on a path of `count` lots that does not cross itself."""
    path = [(0, 0)]
    while len(path) < count:
        x, z = path[-1]
        free = [p for p in ((x + 1, z), (x - 1, z), (x, z + 1), (x, z - 1)) if p not in path]
        # A path that has run into itself goes on from where it began.
        path.append(free[random.integers(len(free))] if free else (min(p[0] for p in path) - 1, path[0][1]))
    parts = {}
    for k, (i, j) in enumerate(path):
        x, z, half = first[0] + 3.5 * i, first[1] + 3.5 * j, random.uniform(1.5, 1.75)
        high = random.uniform(3.0, 10.0)
        parts[f"{word} {k + 1}"] = block((x - half, 0.0, z - half), (x + half, high, z + half))
    return parts


def two_islands(random: Random) -> Parts:
    """Two groups of towers, far apart."""
    x, z = random.uniform(9.0, 13.0), random.uniform(-5.0, 5.0)
    return lots(random, (x, z), random.integers(2, 4), "east") | lots(
        random, (-x, -z), random.integers(2, 4), "west"
    )


def town(random: Random) -> Parts:
    """Nine blocks between streets, of any height; one or two are low greens."""
    heights = random.uniform(5.0, 20.0, 9)
    heights[random.choice(9, size=random.integers(1, 3), replace=False)] = 0.8
    parts = {}
    for k, high in enumerate(heights):
        x, z, half = 9.3 * (k // 3 - 1), 9.3 * (k % 3 - 1), 4.1 if high < 1.0 else random.uniform(2.6, 4.0)
        word = "green" if high < 1.0 else "block"
        parts[f"{word} {k + 1}"] = block((x - half, 0.0, z - half), (x + half, high, z + half))
    return parts


def hull(random: Random) -> Parts:
    """A ship, nose towards +z, symmetric in x: a hull that tapers, swept wings, a pod at the end of each."""
    wide, high, nose = random.uniform(1.1, 1.7), random.uniform(0.7, 1.1), random.uniform(4.0, 8.0)
    parts = {
        "hull": loft(
            [
                rectangle(share * wide, -share * high, share * high, z)
                for z, share in ((-5.2, 0.8), (-4.0, 1.0), (0.5 * nose, 0.9), (nose, 0.4))
            ]
        )
    }
    span, sweep = random.uniform(5.0, 9.0), random.uniform(-2.0, 4.0)
    root, tip = random.uniform(3.5, 5.0), random.uniform(1.5, 3.0)
    long, thick = random.uniform(3.0, 7.0), random.uniform(0.6, 0.9)
    for side, name in ((1.0, "left"), (-1.0, "right")):
        wing = [(0.9 * wide, 1.0, 1.0 - root), (span, 1.0 - sweep, 1.0 - sweep - tip)]
        parts[f"{name} wing"] = loft([section(side * x, front, back, 0.0, 0.4) for x, front, back in wing])
        middle = 1.0 - sweep - 0.5 * tip
        ends = [middle + 0.5 * long * end for end in (-1.0, 1.0)]
        parts[f"{name} pod"] = loft([ring((side * span, 0.0, z), (0, 0, 1), thick, thick, 6) for z in ends])
    return parts
