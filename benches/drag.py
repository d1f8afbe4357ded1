"""How often a part that is dragged arrives, and how long that takes: `python benches/drag.py [DRAGS]`.

Random drags of random parts of five gallery models: each to a point at most a tenth of the scene away, in the plane
that faces the camera of our pictures. "pointer": what counts is where the part is seen; "point": the depth counts,
too. A quarter of the choices is held in every drag, and must not move. A drag arrives within 1 % of the scene's size,
or is refused with a reason.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections import Counter
from typing import Any

import niwaki as nw
import numpy as np
from niwaki.gallery import entry as find
from niwaki.search.drag import Drag, Dragging
from niwaki.search.drag.source import NEAR

#: The models, and how a run of each is searched for.
MODELS = ("simple-ship", "spaceship", "building", "gnarly-tree", "niwaki-tree")

#: From the scene to the camera of our pictures.
VIEW = np.array([0.62, 0.36, 0.7])


def refusal(reason: str) -> str:
    """The kind of a reason."""
    for kind, words in {
        "held": "held",
        "range": "end of its range",
        "dimension": " only",
        "impossible": "impossible",
        "source": "follows from the source",
    }.items():
        if words in reason:
            return kind
    return "no nearer"


def main(drags: int) -> None:
    """Drag, and print a table."""
    print(f"load {os.getloadavg()[0]:.1f}, {drags} drags each, within {NEAR:.0%} of the scene's size")
    print("| model | what counts | arrived | refused | first response, ms | all answers, ms | answers |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name in MODELS:
        sample = grown(name)
        for counts in ("pointer", "point"):
            print(row(name, sample, counts, drags), flush=True)


def grown(name: str) -> Any:
    """The best of a short search."""
    entry = find(name)
    assert entry is not None
    target = entry.target()
    return nw.grow(entry.model, target, voxel=entry.voxel, particles=entry.particles, seed=1).best


def row(name: str, sample: Any, counts: str, drags: int) -> str:
    """A line of the table."""
    rng = np.random.default_rng(1)
    view = VIEW / np.linalg.norm(VIEW)
    names = [address for address, family in sample.families.items() if family != "delta"]
    boxes = np.array([shape.aabb() for part in sample.parts for shape in part.shapes])
    size = float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
    first, whole, reached, refused, arrived = [], [], [], Counter[str](), 0
    for _ in range(drags):
        part = sample.parts[rng.integers(len(sample.parts))]
        low, high = (np.array(corner) for corner in part.shapes[rng.integers(len(part.shapes))].aabb())
        aim = rng.normal(size=3)
        aim -= view * (aim @ view)
        aim *= rng.uniform(0.01, 0.1) * size / np.linalg.norm(aim)
        middle = (low + high) / 2
        held = [name for name in names if rng.random() < 0.25]
        along = view if counts == "pointer" else None
        start = time.perf_counter()
        drag = Dragging(sample.search, sample, part.address, grab=middle, along=along, hold=held)
        drag.move(middle + aim)
        first.append(time.perf_counter() - start)
        answer = drag.to(middle + aim)
        whole.append(time.perf_counter() - start)
        check(sample, answer, held)
        reached.append(len(answer.answers))
        arrived += bool(answer.answers)
        if not answer.answers:
            assert answer.reason
            refused[refusal(answer.reason)] += 1
    many = ", ".join(f"{kind} {count}" for kind, count in refused.most_common()) or "0"
    mean = statistics.mean(n for n in reached if n) if arrived else 0.0
    return (
        f"| {name} | {counts} | {arrived} | {many} | {1e3 * statistics.median(first):.0f} | "
        f"{1e3 * statistics.median(whole):.0f} | {mean:.1f} |"
    )


def check(sample: Any, answer: Drag, held: list[str]) -> None:
    """What was held stays to the bit, and an answer is where it says."""
    for item in answer.answers:
        after = item.sample.choices
        assert all(name not in after or after[name] == sample.choices[name] for name in held)
        assert item.share <= NEAR


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
