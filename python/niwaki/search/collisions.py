"""Parts of a scene that break the constraints of a search, and a run that has such parts.

The engine's sketches judge part by part, as they do when a search explains why every run was impossible
(`crates/run/src/blame.rs`). Here all parts that break a constraint are listed, not only the first.
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

#: The most runs of the prior, and the most parts that are compared with one another.
TRIES, PARTS = 50, 1_000


def breaking(scene: Scene, specs: Sequence[_engine.SketchSpec]) -> list[str]:
    """List the addresses of the parts that break a constraint, alone or with another part, in the order of the scene.

    Parameters
    ----------
    scene
        A scene; parts after the first 1,000 are left out.
    specs
        The constraints, `Score.specs`.
    """
    empty = _engine.Sketch(specs)
    addresses: set[str] = set()
    boxes: list[tuple[Part, np.ndarray, np.ndarray]] = []
    for part in scene.parts[:PARTS]:
        if empty.fork().add(part.shapes) is not None:
            addresses.add(part.address)
            continue
        corners = np.concatenate([shape.vertices() for shape in part.shapes])
        low, high = corners.min(axis=0), corners.max(axis=0)
        for other, other_low, other_high in boxes:
            if (low > other_high).any() or (high < other_low).any():
                continue
            both = empty.fork()
            both.add(other.shapes)
            if both.add(part.shapes) is not None:
                addresses |= {part.address, other.address}
        boxes.append((part, low, high))
    return [part.address for part in scene.parts if part.address in addresses]


def example(search: Search) -> tuple[Scene, list[str]] | None:
    """Draw a scene from the prior that breaks a constraint of a search, and list the parts; None if no scene does."""
    free = replace(search, score=Score(), method=Forward(), choices=None, polish=None, runs=1, keep="all")
    for number in range(TRIES):
        scene = replace(free, seed=(search.seed + number) % 2**64).run().best.scene
        addresses = breaking(scene, search.score.specs)
        if addresses:
            return scene, addresses
    return None
