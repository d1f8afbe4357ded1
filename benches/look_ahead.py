"""Look-ahead beside half as many particles more: guides that ship, taught by `niwaki.guides.train_look_ahead`.

    python benches/look_ahead.py [--model vines] [--seeds 2] [--limit 100] [--json out/look-ahead.json]
    python benches/look_ahead.py --picture docs/pictures/guides/look-ahead.png     # vines in ten glyphs, no table

For each model a guide is taught on the training scribbles and their mirror images (each eighth scribble judges the
line), by seed 1. Then held-out drawings are searched, which no training saw: by N particles, by N with a look-ahead of
0.2, by N with the same of a line in the score so far alone, and by 1.5 N without; tempered resampling and one thread.
Methods take turns, drawing by drawing, so that a busy machine is busy for all of them. A row has mean, median and worst
tenth of the similarities of the best run, the share of stumps (below 0.1), the mean of the estimates of the log
evidence, particle-steps and CPU milliseconds of a search; the differences to 1.5 N have standard errors, search by
search.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
import warnings
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import gallery, guides
from niwaki.draw.flat.drawing import drawing
from niwaki.gallery import vines
from niwaki.guides.report import STUMP
from niwaki.search import SearchWarning
from niwaki.targets import drawings
from pages import beside, stacked

STRENGTH = 0.2
SIZES = (10, 20, 50)
#: Pixels along a side of a picture.
SIDE = 84
COLLECTIONS = ("glyphs", "scribbles", "silhouettes")


def taught(name: str, looks: bool) -> nw.Guide:
    """The guide that ships with a model of the gallery, taught to look ahead, or to judge by the score so far alone."""
    entry = gallery.entry(name)
    assert entry is not None and entry.window is not None
    page, shipped = entry.window, guides.shipped(entry.model)
    assert shipped is not None
    training = [drawings.drawing(drawing) for drawing in drawings.names("scribbles", "training")]
    learned = [drawing for i, drawing in enumerate(training) if i % guides.EVERY]
    return guides.train_look_ahead(
        shipped,
        entry.model,
        [*learned, *(drawing.mirrored() for drawing in learned)],
        lambda drawing: drawing.score(page),
        lambda drawing: drawing.place(page),
        held_out=training[:: guides.EVERY],
        searches=3000,
        looks=looks,
        seed=1,
    )


def searched(search: nw.Search) -> tuple[float, float, float, float]:
    """Similarity of the best run, log evidence (nats), particle-steps and CPU milliseconds of a search."""
    start = time.process_time()
    result: Any = search.run(threads=1)
    cost = 1000 * (time.process_time() - start)
    best = max(result, key=lambda sample: sample.log_joint)
    return best.similarity, result.log_evidence, result.info.steps, cost


def ways(particles: int, guide: nw.Guide, blind: nw.Guide) -> dict[str, nw.Smc]:
    """The methods that are compared."""

    def own(n: int, drawing: nw.Guide = guide, **more: Any) -> nw.Smc:
        return nw.smc(n, resampling="tempered", guide=drawing, **more)

    more = particles * 3 // 2
    return {
        f"{particles}": own(particles),
        f"{particles}, looking ahead": own(particles, look_ahead=STRENGTH),
        f"{particles}, by the score alone": own(particles, blind, look_ahead=STRENGTH),
        f"{more}": own(more),
    }


def compare(
    name: str, guide: nw.Guide, blind: nw.Guide, seeds: int, limit: int | None
) -> list[dict[str, Any]]:
    """Print and return a row for each collection, number of particles and method."""
    entry = gallery.entry(name)
    assert entry is not None and entry.window is not None
    rows = []
    for collection in COLLECTIONS:
        chosen = [drawings.drawing(drawing) for drawing in drawings.names(collection, "held-out")[:limit]]
        cases = [(tuple(drawing.place(entry.window)), drawing.score(entry.window)) for drawing in chosen]
        for particles in SIZES:
            ends: dict[str, list[tuple[float, float, float, float]]] = {}
            for seed in range(seeds):
                for args, score in cases:
                    for way, method in ways(particles, guide, blind).items():
                        search = nw.Search(entry.model, args, score=score, method=method, seed=seed)
                        ends.setdefault(way, []).append(searched(search))
            most = np.array(list(ends.values())[-1])
            for way, results in ends.items():
                row = summed(np.array(results), most)
                rows.append({"model": name, "drawings": collection, "particles": way, **row})
                print(line(rows[-1]), flush=True)
    return rows


def summed(scores: np.ndarray[Any, Any], most: np.ndarray[Any, Any]) -> dict[str, Any]:
    """Return the text of a row: `(searches, 4)` of a method, and of the one with the most particles."""
    alike, evidence, steps, cost = scores.T

    def by(column: int) -> tuple[float, float]:
        more = scores[:, column] - most[:, column]
        return float(more.mean()), float(more.std() / math.sqrt(len(more)))

    return {
        "searches": len(scores),
        "mean": float(alike.mean()),
        "median": float(np.median(alike)),
        "p10": float(np.quantile(alike, 0.1)),
        "stumps": float(np.mean(alike < STUMP)),
        "log evidence": float(evidence.mean()),
        "steps": float(steps.mean()),
        "ms": float(cost.mean()),
        "mean by": by(0),
        "log evidence by": by(1),
    }


def line(row: dict[str, Any]) -> str:
    """A row of the table."""
    (mean, error), (log, log_error) = row["mean by"], row["log evidence by"]
    beside = "" if error == 0.0 else f"{mean:+.3f} ({error:.3f}), {log:+.0f} ({log_error:.0f})"
    return (
        f"| {row['model']}, {row['drawings']} | {row['particles']} | {row['mean']:.3f} | {row['median']:.3f} "
        f"| {row['p10']:.3f} | {row['stumps']:.1%} | {row['log evidence']:.0f} | {row['steps']:.0f} "
        f"| {row['ms']:.1f} | {beside} |"
    )


def drawn(path: Path) -> None:
    """Vines in each twentieth held-out glyph by ten particles, by ten that look ahead, and by fifteen; one seed."""
    guide = taught("vines", looks=True)
    chosen = [drawings.drawing(glyph) for glyph in drawings.names("glyphs", "held-out")[::20]]
    rows = []
    for way, method in ways(10, guide, guide).items():
        if way.endswith("alone"):
            continue
        cells = []
        for glyph in chosen:
            args, score = glyph.place(vines.WINDOW), glyph.score(vines.WINDOW)
            result = nw.run(vines.vines, *args, method=method, score=score, seed=0, threads=1)
            best = max(result, key=lambda sample: sample.log_joint)
            page = {"style": vines.DRAWS, "window": glyph.window(vines.WINDOW), "under": glyph.greys < 255}
            cells.append(drawing(best.scene, size=(SIDE, SIDE), **page).convert("RGB"))
        rows.append(
            (f"{way} particles" if way.isdecimal() else way.replace(",", " particles,"), beside(cells))
        )
    stacked(rows).quantize(32).save(path, optimize=True)


def main() -> int:
    """Teach, compare, print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--model", action="append", choices=("vines", "lightning"))
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--limit", type=int, help="so many drawings of each collection; all when left out")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    warnings.simplefilter("ignore", SearchWarning)
    if options.picture is not None:
        drawn(options.picture)
        return 0
    print(
        "| drawings | particles | mean | median | p10 | stumps | log evidence | steps | CPU, ms | less 1.5 N |"
    )
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    rows = []
    for name in options.model or ("vines", "lightning"):
        start, cpu = time.perf_counter(), time.process_time()
        guide = taught(name, looks=True)
        took = time.perf_counter() - start, time.process_time() - cpu
        blind = taught(name, looks=False)
        print(
            f"{name}: {guide.report['look_ahead']}, {took[0]:.0f} s ({took[1]:.0f} s of CPU)", file=sys.stderr
        )
        rows += compare(name, guide, blind, options.seeds, options.limit)
    if options.json is not None:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
