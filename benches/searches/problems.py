"""The problems: what a person asks for, and when that person would call the result complete.

A target is given (one of the package's own) or made from a seed. Searches see the whole; completeness is judged part by
part, each with the least share of it that a result must have. These shares lie in the gap between results that have
the part and results that lack it, where there is a gap, and each says why it is what it is.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import niwaki as nw
import numpy as np
from niwaki.draw.scene import Scene
from niwaki.gallery import entry, named_target
from niwaki.targets.examples.lofts import solid
from niwaki.targets.sketches import automatic_voxel

from searches import measures, targets
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
    least : dict
        The least share of a part, by the part's name or its last word; what is not named here need not be there.
    why : str
        Why the least shares are these.
    is_made : bool
        Whether the targets are made from seeds.
    """

    name: str
    kind: str
    model: nw.Model[..., Any]
    case: Callable[[int], Case]
    least: Mapping[str, float]
    why: str
    is_made: bool = field(default=False, kw_only=True)

    def is_complete(self, shares: Mapping[str, float]) -> bool:
        """Whether the shares that a case's `measure` gives are enough; a dead search has none."""
        asked = {name: self.least.get(name, self.least.get(name.split()[-1])) for name in shares}
        return bool(shares) and all(
            share >= asked[name] for name, share in shares.items() if asked[name] is not None
        )


def made(
    make: Callable[[np.random.Generator], targets.Parts], number: int, voxel: float | None = None
) -> Callable[[int], Case]:
    """Cases of a kind of solid: seed k gives target k; kinds with different numbers draw different numbers."""

    def case(seed: int) -> Case:
        parts = make(np.random.default_rng([number, seed]))
        return of_parts(make.__name__, parts)

    return case


def of_parts(name: str, parts: targets.Parts, score: nw.Score | None = None) -> Case:
    """A case of named meshes."""
    target = solid(name, list(parts.values()))
    voxel = automatic_voxel(target)
    points = {name: measures.inside(mesh, voxel) for name, mesh in parts.items()}
    return Case(target, score, lambda scene: measures.covered(scene, points, voxel))


def given(
    target_name: str, regions: Regions, score: Callable[[], nw.Score] | None = None
) -> Callable[[int], Case]:
    """The case of one of the package's own solids, whose parts are regions of it."""

    def case(seed: int) -> Case:
        target = named_target(target_name)
        voxel = automatic_voxel(target)
        everywhere = measures.cells_of(target, voxel)
        points = {name: everywhere[has(everywhere)] for name, has in regions.items()}
        return Case(target, score and score(), lambda scene: measures.covered(scene, points, voxel))

    return case


def model(name: str) -> nw.Model[..., Any]:
    """A model of the gallery."""
    found = entry(name)
    assert found is not None, f"no model {name} in the gallery"
    return found.model


PROBLEMS = (
    Problem(
        "forked stems",
        "forked volumes",
        model("gnarly-tree"),
        made(targets.forked_stem, 1),
        {"arm": 0.5, "ball": 0.1},
        "an arm without a branch is covered to a third at most, by the trunk at its foot, and its ball not at all; "
        "with one, to six tenths and more",
        is_made=True,
    ),
    Problem(
        "leaning discs",
        "discs",
        model("gnarly-tree"),
        made(targets.leaning_disc, 2),
        {"4": 0.1},
        "a quarter with less than a tenth looks bare: one branch grazes it",
        is_made=True,
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
        {"hull": 0.6, "wings": 0.4, "pods": 0.4},
        "half of a part is there or all of it is missing",
    ),
)


def problem(name: str) -> Problem:
    """Find the problem of that name."""
    return next(one for one in PROBLEMS if one.name == name)
