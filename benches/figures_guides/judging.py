"""Searches for what is held out, and what they cost.

Protocol of the dissertation's code: one search for each drawing and seed; of its runs the one with the highest prior
and score counts; its similarity is reported. Times are CPU seconds of one thread.
"""

import statistics
import time
from collections.abc import Iterable, Sequence
from types import ModuleType
from typing import Any

import niwaki as nw
import numpy as np
from niwaki.methods import Guide
from niwaki.result import Sample
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from places import Places, Row

#: Below this similarity a run is a stump.
STUMP = 0.1


def held_out(collection: str, quick: bool = False) -> list[Drawing]:
    """The held-out drawings of a collection."""
    names = drawings.names(collection, "held-out")
    return [drawings.drawing(name) for name in (names[:4] if quick else names)]


def likeliest(runs: Iterable[Sample]) -> Sample:
    """The run with the highest prior and score."""
    return max(runs, key=lambda run: run.log_score + run.log_prior)


def grown(
    model: ModuleType, drawing: Drawing, particles: int, resampling: str, guide: Guide | None, seed: int
) -> Sample:
    """The result of one search."""
    method = nw.smc(particles, resampling=resampling, guide=guide)
    result = nw.run(
        model.MODEL,
        *drawing.place(model.WINDOW),
        score=drawing.score(model.WINDOW),
        method=method,
        seed=seed,
        threads=1,
    )
    return likeliest(result)


def judged(
    places: Places,
    model: ModuleType,
    name: str,
    guide: Guide | None,
    particles: int,
    *,
    resampling: str = "residual",
    collection: str = "glyphs",
    seed: int = 1,
) -> Row:
    """The similarities of a collection's results, and CPU seconds of a search."""
    key = {
        "model": model.MODEL.name,
        "guide": name,
        "particles": particles,
        "resampling": resampling,
        "set": collection,
        "seed": seed,
    }

    def measure() -> Row:
        every = held_out(collection, places.quick)
        # The first search compiles.
        grown(model, every[0], particles, resampling, guide, seed)
        start = time.process_time()
        samples = [
            grown(model, drawing, particles, resampling, guide, seed + 1000 * i)
            for i, drawing in enumerate(every)
        ]
        seconds = (time.process_time() - start) / len(every)
        row: Row = {
            "cpu": round(seconds, 6),
            "similarities": [round(run.similarity or 0.0, 4) for run in samples],
        }
        print(described(key | row), flush=True)
        return row

    return places.row(f"of-{name}", key, measure)


def summary(rows: Sequence[Row]) -> dict[str, Any]:
    """Median, its 95 % band, mean, the tenth percentile and the share of stumps of all searches of some rows."""
    all_of = np.array([x for row in rows for x in row["similarities"]])
    return {
        "median": float(np.median(all_of)),
        "band": float(1.96 * all_of.std() / np.sqrt(len(all_of))),
        "mean": float(all_of.mean()),
        "p10": float(np.quantile(all_of, 0.1)),
        "stumps": float(np.mean(all_of < STUMP)),
        "ms": 1000.0 * statistics.fmean(row["cpu"] for row in rows),
        "searches": len(all_of),
    }


def described(row: Row) -> str:
    """A row for people."""
    stats = summary([row])
    return (
        f"{row['model']:<10}{row['guide']:<22}{row['set']:<12}N={row['particles']:<4}{row['resampling']:<11}"
        f"mean {stats['mean']:.3f}  median {stats['median']:.3f}  p10 {stats['p10']:.3f}  stumps {stats['stumps']:4.0%}"
        f"  {stats['ms']:6.1f} ms"
    )
