"""Targets for guides in space: those that a guide learns from, and six others that it is tried on.

Most are made: scenes of the model itself, drawn from its prior without self-intersection, and solids from seeds as
those of `searches.targets`. A scene of the prior is kept if an empty scene would score badly, so that there is
something to fill. Seeds of what is learned from begin at `LEARNED`, those of what is tried at `TRIED`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import _engine
from niwaki.gallery import entry, named_target
from niwaki.targets.examples.lofts import solid
from searches import targets as made

LEARNED, TRIED = 500_000, 900_000

Solid = Callable[[np.random.Generator], Any]


@dataclass(frozen=True)
class Own:
    """Scenes of the model as targets.

    Attributes
    ----------
    args : tuple
        The model's arguments.
    empty : float
        The empty scene scores less, nats.
    count : int
        How many are learned from.
    """

    args: tuple[Any, ...]
    empty: float
    count: int


@dataclass(frozen=True)
class Kind:
    """What a guide of a model is for.

    Attributes
    ----------
    name : str
        Of the model in the gallery.
    given : tuple of str
        The package's own targets, which are tried.
    own : tuple of Own
    solids : tuple
        Makers of solids; the numbers of their seeds are their places.
    count : int
        How many of each solid are learned from.
    tried : tuple of int
        How many of each solid are tried.
    """

    name: str
    given: tuple[str, ...]
    own: tuple[Own, ...]
    solids: tuple[Solid, ...]
    count: int
    tried: tuple[int, ...]

    @property
    def model(self) -> nw.Model[..., Any]:
        """The model."""
        model_entry = entry(self.name)
        assert model_entry is not None
        return model_entry.model

    def learned(self) -> list[nw.Target]:
        """What a guide learns from, well mixed."""
        solids = [
            scene
            for k, own in enumerate(self.own)
            for scene in self.scenes(own, LEARNED + 100_000 * k, own.count)
        ]
        solids += [
            lofted(make, k, LEARNED + i) for i in range(self.count) for k, make in enumerate(self.solids)
        ]
        order = np.random.default_rng(1).permutation(len(solids))
        return [solids[i] for i in order]

    def tried_on(self) -> list[nw.Target]:
        """Six targets that are not learned from."""
        solids = [named_target(name) for name in self.given]
        for k, (make, count) in enumerate(zip(self.solids, self.tried, strict=True)):
            solids += [lofted(make, k, TRIED + i) for i in range(count)]
        left = 6 - len(solids)
        return solids + [
            scene
            for k, own in enumerate(self.own[:left])
            for scene in self.scenes(own, TRIED + 10_000 * k, 1)
        ]

    def scenes(self, own: Own, seed: int, count: int) -> list[nw.Target]:
        """Scenes of the model from `seed` on."""
        solids: list[nw.Target] = []
        while len(solids) < count:
            seed += 1
            free = nw.no_self_intersection()
            scene = nw.run(
                self.model, *own.args, score=free, method=nw.smc(10), seed=seed, threads=1
            ).best.scene
            if len(scene) < 3:
                continue
            target = nw.Target(*scene.merged(fine=False), f"own {seed}")
            if empty(score(target)) < own.empty:
                solids.append(target)
        return solids


def lofted(make: Solid, number: int, seed: int) -> nw.Target:
    """A solid of a seed."""
    parts = make(np.random.default_rng([number, seed]))
    if isinstance(parts, tuple):
        parts = parts[0]
    return solid(f"{make.__name__} {seed}", list(parts.values()))


def score(target: nw.Target) -> nw.Score:
    """What `niwaki.grow` scores."""
    return nw.no_self_intersection() * nw.match_volume(target)


def empty(of: nw.Score) -> float:
    """The log score of an empty scene, nats."""
    return _engine.Sketch(of.specs).log_score()


KINDS: Sequence[Kind] = (
    Kind(
        "spaceship",
        given=("ship", "dart"),
        own=(Own((), -15.0, 200), Own((), -40.0, 100)),
        solids=(made.hull,),
        count=100,
        tried=(2,),
    ),
    Kind(
        "gnarly-tree",
        given=("bent_tube", "forked_tree"),
        own=(Own((0.4,), -20.0, 60), Own((0.3,), -12.0, 60)),
        solids=(made.forked_stem, made.leaning_disc, made.sheathed),
        count=60,
        tried=(1, 1, 1),
    ),
)


def kind(name: str) -> Kind:
    """The kind of that name."""
    return next(candidate for candidate in KINDS if candidate.name == name)
