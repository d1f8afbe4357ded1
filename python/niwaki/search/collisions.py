"""Which parts of a scene break the constraints of a search, and a run that shows it.

The engine's sketches judge part by part, as they do when a search says why every run was impossible
(`crates/run/src/blame.rs`); here every part is found, not the first alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from niwaki import _engine
from niwaki.draw.assembly import Part
from niwaki.draw.scene import Scene
from niwaki.methods import Forward
from niwaki.search.request import Search
from niwaki.targets.sketches import Score

#: Runs of the prior that are tried, and the most parts that are compared with one another.
TRIES, PARTS = 50, 1_000


def breaking(scene: Scene, specs: Sequence[_engine.SketchSpec]) -> list[str]:
    """Addresses of the parts that break a constraint, alone or with another part; in the order of the scene.

    Parameters
    ----------
    scene
        Of at most 1,000 parts; later ones are left out.
    specs
        `Score.specs`.
    """
    empty = _engine.Sketch(specs)
    found: set[str] = set()
    others: list[tuple[Part, np.ndarray, np.ndarray]] = []
    for part in scene.parts[:PARTS]:
        if empty.fork().add(part.shapes) is not None:
            found.add(part.address)
            continue
        corners = np.concatenate([shape.vertices() for shape in part.shapes])
        low, high = corners.min(axis=0), corners.max(axis=0)
        for other, other_low, other_high in others:
            if (low > other_high).any() or (high < other_low).any():
                continue
            both = empty.fork()
            both.add(other.shapes)
            if both.add(part.shapes) is not None:
                found |= {part.address, other.address}
        others.append((part, low, high))
    return [part.address for part in scene.parts if part.address in found]


def example(search: Search) -> tuple[Scene, list[str]] | None:
    """The scene of a run of the prior that breaks a constraint of the search, and the parts that do; None for none."""
    free = replace(search, score=Score(), method=Forward(), choices=None, polish=None, runs=1, keep="all")
    for number in range(TRIES):
        scene = replace(free, seed=(search.seed + number) % 2**64).run().best.scene
        found = breaking(scene, search.score.specs)
        if found:
            return scene, found
    return None
