"""The problems: what a person asks for, with the parts by which completeness is judged (`complete`).

A target is given (one of the package's own) or made from a seed. Searches see the whole and know of no parts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import niwaki as nw
import numpy as np
from experiments import experiment
from niwaki.draw.scene import Scene
from niwaki.gallery import entry, named_target
from niwaki.targets.examples.lofts import block, solid
from niwaki.targets.sketches import automatic_voxel

from searches import drawings, measures, models, targets
from searches.measures import Points

#: Whether points (n, 3) belong to a part of a given target, by the part's name.
Regions = Mapping[str, Callable[[Points], Any]]


@dataclass(frozen=True)
class Case:
    """A problem with one of its targets.

    Attributes
    ----------
    target, score
        What `niwaki.grow` is given.
    measure
        The share of each part that a scene has.
    obstacle : Target or None
        For pictures.
    """

    target: nw.Target | None
    score: nw.Score | None
    measure: Callable[[Scene], dict[str, float]]
    obstacle: nw.Target | None = None


@dataclass(frozen=True)
class Problem:
    """One row of the bench.

    Attributes
    ----------
    name : str
    kind : str
        What makes it a problem of its own.
    model : Model
    case : callable
        The case of a seed; given targets ignore the seed.
    is_made : bool
        Whether the targets are made from seeds.
    is_costly : bool
        Whether a search that lives takes half a minute: the quick form leaves it out, unless it is named.
    """

    name: str
    kind: str
    model: nw.Model[..., Any]
    case: Callable[[int], Case]
    is_made: bool = field(default=False, kw_only=True)
    is_costly: bool = field(default=False, kw_only=True)


def random_of(number: int, seed: int) -> np.random.Generator:
    """The numbers of a seed, others for each kind."""
    return np.random.default_rng([number, seed])


def made(make: Callable[[np.random.Generator], targets.Parts], number: int) -> Callable[[int], Case]:
    """Cases of a kind of solid."""
    return lambda seed: of_parts(make.__name__, make(random_of(number, seed)))


def of_parts(name: str, parts: targets.Parts, obstacle: nw.Target | None = None) -> Case:
    """A case of named meshes, to fill around an obstacle."""
    target = solid(name, list(parts.values()))
    voxel = automatic_voxel(target)
    points = {part: measures.inside(mesh, voxel) for part, mesh in parts.items()}
    score = None if obstacle is None else nw.floor() * nw.avoid(obstacle)
    return Case(target, score, lambda scene: measures.covered(scene, points, voxel), obstacle)


def given(target_name: str, regions: Regions, avoid: str | None = None) -> Callable[[int], Case]:
    """The case of one of the package's own solids, whose parts are regions of it."""

    def case(seed: int) -> Case:
        target = named_target(target_name)
        voxel = automatic_voxel(target)
        everywhere = measures.cells_of(target, voxel)
        points = {name: everywhere[has(everywhere)] for name, has in regions.items()}
        obstacle = None if avoid is None else named_target(avoid)
        score = None if obstacle is None else nw.floor() * nw.avoid(obstacle)
        return Case(target, score, lambda scene: measures.covered(scene, points, voxel), obstacle)

    return case


def beside(x: float, z: float, half: float) -> Callable[[Points], Any]:
    """The region within `half` of (x, z) along both axes."""
    return lambda p: (np.abs(p[:, 0] - x) < half) & (np.abs(p[:, 2] - z) < half)


def around(x: float, y: float, z: float, radius: float) -> Callable[[Points], Any]:
    """The region within `radius` of a point."""
    return lambda p: np.linalg.norm(p - (x, y, z), axis=1) < radius


def sheath(seed: int) -> Case:
    """A trunk through a tight sheath."""
    parts, around = targets.sheathed(random_of(3, seed))
    return of_parts("sheathed", parts, solid("sheath", [around]))


def shelves(seed: int) -> Case:
    """A cone with shelves across it."""
    parts, across = targets.shelved(random_of(4, seed))
    return of_parts("shelved", parts, solid("shelves", across))


def counted(seed: int) -> Case:
    """Boards of a shelf, whose number counts, too."""
    parts = targets.counted_boards(random_of(13, seed))
    case = of_parts("counted_boards", parts)

    def measure(scene: Scene) -> dict[str, float]:
        return case.measure(scene) | {"number": float(len(scene) == len(parts))}

    return replace(case, measure=measure)


def of_view(score: nw.Score, parts: Mapping[str, measures.Mask]) -> Case:
    """A case of an image."""
    return Case(None, score, lambda scene: measures.agreeing(scene, score.views[0], parts))


def skyline(seed: int) -> Case:
    """A silhouette from far away, level with the ground."""
    parts = drawings.skyline(random_of(9, seed))
    half = 0.5 * drawings.HEIGHT
    front = nw.Camera.orthographic((0.0, half, 60.0), (0.0, half, 0.0), height=drawings.HEIGHT)
    return of_view(nw.match_image(np.any(list(parts.values()), axis=0), front), parts)


def stroke(seed: int) -> Case:
    """A curve as a shadow under a slanting sun, every pixel as important as another."""
    parts = drawings.stroke(random_of(10, seed))
    ground = nw.Receiver.floor(0.0, (-11.0, -11.0), (11.0, 11.0))
    return of_view(nw.match_shadow(np.any(list(parts.values()), axis=0), (0.4, -1.0, 0.2), ground), parts)


def face(seed: int) -> Case:
    """The face of figure 5.7, whose profile weighs more than the rest."""
    score = experiment("face-of-blocks").score()
    rows = np.arange(score.views[0].image.shape[0])[:, None]
    columns = np.ones((1, score.views[0].image.shape[1]), dtype=bool)
    return of_view(score, {"upper half": (rows < 125) & columns, "lower half": (rows >= 125) & columns})


def digits(seed: int) -> Case:
    """The digits of figure 5.8."""
    score = experiment("digits-of-pipes").score()
    columns = np.arange(score.views[0].image.shape[1])[None, :]
    rows = np.ones((score.views[0].image.shape[0], 1), dtype=bool)
    return of_view(score, {"digit four": (columns < 120) & rows, "digit two": (columns > 135) & rows})


def wall_and_tower(seed: int) -> Case:
    """A wall with a tower at its left end."""
    parts = {f"stone {i + 1}": block((i, 0.0, -0.5), (i + 1.0, 2.0, 0.5)) for i in range(8)} | {
        "tower": block((-2.0, 0.0, -0.5), (0.0, 4.0, 0.5))
    }
    return of_parts("wall_and_tower", parts)


def model(name: str) -> nw.Model[..., Any]:
    """A model of the gallery."""
    gallery_entry = entry(name)
    assert gallery_entry is not None, f"no model {name} in the gallery"
    return gallery_entry.model


TREE, BUILDING = model("gnarly-tree"), model("building")

PROBLEMS = (
    Problem(
        "forked stems",
        "forked volumes",
        TREE,
        made(targets.forked_stem, 1),
        is_made=True,
    ),
    Problem(
        "leaning discs",
        "discs",
        TREE,
        made(targets.leaning_disc, 2),
        is_made=True,
    ),
    Problem(
        "sheaths",
        "tight shells",
        TREE,
        sheath,
        is_made=True,
    ),
    Problem(
        "shelves",
        "obstacles",
        TREE,
        shelves,
        is_made=True,
    ),
    Problem(
        "ledges",
        "obstacles",
        TREE,
        given(
            "funnel",
            {
                "foot": lambda p: p[:, 1] < 8.0,
                "front": lambda p: (p[:, 1] > 12.0) & (p[:, 0] > 0.0) & (p[:, 2] > 2.0),
                "back": lambda p: (p[:, 1] > 12.0) & (p[:, 0] > 0.0) & (p[:, 2] < -2.0),
            },
            avoid="ledges",
        ),
        is_costly=True,
    ),
    Problem(
        "bent tube",
        "tall volumes",
        TREE,
        given(
            "bent_tube",
            {
                "lower trunk": lambda p: p[:, 1] < 10.0,
                "upper trunk": lambda p: (p[:, 1] > 10.0) & (p[:, 1] < 18.0),
                "crown": lambda p: p[:, 1] > 18.5,
            },
        ),
    ),
    Problem(
        "thin walls",
        "thin walls",
        models.walls,
        made(targets.thin_walls, 5),
        is_made=True,
    ),
    Problem(
        "rows of towers",
        "towers",
        BUILDING,
        made(targets.row_of_towers, 6),
        is_made=True,
    ),
    Problem(
        "crescent",
        "towns",
        BUILDING,
        given(
            "crescent",
            {
                "tower": lambda p: (np.abs(p[:, 0]) < 3.0) & (p[:, 2] < 2.0) & (p[:, 1] > 4.0),
                "left wing": lambda p: p[:, 0] < -6.0,
                "right wing": lambda p: p[:, 0] > 6.0,
            },
        ),
    ),
    Problem(
        "two islands",
        "far islands",
        models.archipelago,
        made(targets.two_islands, 7),
        is_made=True,
    ),
    Problem(
        "towns",
        "towns",
        model("downtown"),
        made(targets.town, 8),
        is_made=True,
    ),
    Problem(
        "downtown",
        "towns",
        model("downtown"),
        given(
            "downtown",
            {
                f"block {x} {z}": beside(9.3 * x, 9.3 * z, 4.2)
                for x in (-1, 0, 1)
                for z in (-1, 0, 1)
                if (x, z) != (1, -1)
            },
        ),
    ),
    Problem(
        "ship",
        "ships",
        model("spaceship"),
        given(
            "ship",
            {
                "hull": lambda p: np.abs(p[:, 0]) < 1.5,
                "wings": lambda p: (np.abs(p[:, 0]) > 2.0) & (np.abs(p[:, 0]) < 7.0),
                "pods": lambda p: np.abs(p[:, 0]) > 7.4,
            },
        ),
    ),
    Problem(
        "hulls",
        "ships",
        model("spaceship"),
        made(targets.hull, 11),
        is_made=True,
    ),
    Problem(
        "dart",
        "ships",
        model("simple-ship"),
        given(
            "dart",
            {
                "tail": lambda p: (np.abs(p[:, 0]) < 0.9) & (p[:, 2] < 0.0),
                "nose": lambda p: (np.abs(p[:, 0]) < 0.9) & (p[:, 2] > 1.0),
                "wings": lambda p: np.abs(p[:, 0]) > 2.0,
            },
        ),
    ),
    Problem(
        "garden tree",
        "clouds on limbs",
        model("niwaki-tree"),
        given(
            "niwaki",
            {
                "cloud one": around(6.7, 8.0, 1.4, 2.6),
                "cloud two": around(-3.9, 10.2, 1.8, 2.5),
                "cloud three": around(5.0, 13.5, -1.4, 2.2),
                "cloud four": around(-5.2, 15.2, -1.4, 2.0),
                "crown": around(-0.9, 18.2, -0.4, 2.6),
            },
        ),
    ),
    Problem(
        "coral fan",
        "corals",
        model("coral"),
        given(
            "fan",
            {
                "left third": lambda p: p[:, 0] < -2.0,
                "middle third": lambda p: np.abs(p[:, 0]) < 2.0,
                "right third": lambda p: p[:, 0] > 2.0,
            },
        ),
    ),
    Problem(
        "wall and tower",
        "decisions that block",
        models.wall_and_tower,
        wall_and_tower,
    ),
    Problem(
        "skylines",
        "silhouettes",
        BUILDING,
        skyline,
        is_made=True,
    ),
    Problem(
        "strokes",
        "shadows",
        model("toy-blocks"),
        stroke,
        is_made=True,
    ),
    Problem(
        "face of blocks",
        "shadows with weights",
        model("toy-blocks"),
        face,
    ),
    Problem(
        "digits of pipes",
        "shadows of nets",
        model("pipes"),
        digits,
    ),
    Problem(
        "long stems",
        "levels",
        models.stem,
        made(targets.long_stem, 12),
        is_made=True,
    ),
    Problem(
        "counted boards",
        "levels",
        models.shelf,
        counted,
        is_made=True,
    ),
)


def problem(name: str) -> Problem:
    """Find the problem of that name."""
    return next(candidate for candidate in PROBLEMS if candidate.name == name)
