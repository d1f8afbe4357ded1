"""Guides for models in space: trained, and compared with searches that cost the same.

    python benches/guides_in_space.py train gnarly-tree [FILE]    # the guide that comes with the package
    python benches/guides_in_space.py compare                     # those in space that do: 20 seeds, six targets each
    SEEDS=5 python benches/guides_in_space.py compare FILE

Scores are those that `niwaki.grow` gives: no self-intersection, and a volume to fill; searches have its power. Traces
are the results of `niwaki.grow`'s usual search, then those of guided particles. `compare` runs 30 guided particles on
targets that were not learned from, beside as many unguided ones as cost the same, and the usual search without and
with the guide. CPU seconds are those of the process, on one thread; methods take turns on each seed. A search that
dies counts with the score of the empty scene. Leaves `guides_in_space.json` in the folder of benches, and prints its
tables.
"""

from __future__ import annotations

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

import json
import math
import sys
import time
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import guides
from niwaki.guides.report import sentence
from niwaki.methods import Guide, Method
from niwaki.search import SearchWarning
from space.targets import KINDS, Kind, empty, kind, score

SHIPPED = Path(guides.__file__).parent / "shipped"
RECORD = Path(__file__).parent / "guides_in_space.json"

#: The power of `niwaki.grow`'s searches.
POWER = 16.0
PARTICLES = 30
#: The first searches for traces are the usual one, the later ones this.
LATER = nw.smc(100, power=POWER)
#: One target in so many is held out while a guide is trained.
EVERY = 10
#: Seeds of the runs that find out how many particles cost the same.
PILOTS = range(1000, 1004)


@dataclass(frozen=True)
class Recipe:
    """How a guide is trained.

    Attributes
    ----------
    rounds : tuple of int
        Searches of each round.
    least : float
        A worse log score is no trace, nats.
    hidden : (int, int)
        Units of the network.
    resampling : str
        Of guided particles: for ships what was better on made targets, for trees after six seeds on three that are
        tried.
    """

    rounds: tuple[int, ...]
    least: float
    hidden: tuple[int, int]
    resampling: str


RECIPES = {
    "spaceship": Recipe((2000,), -12.0, (64, 48), "tempered"),
    "gnarly-tree": Recipe((300, 400, 600), -math.inf, (38, 32), "systematic"),
}


def smc(particles: int, name: str, guide: Guide | None = None) -> Method:
    """A population as sharp as that of `niwaki.grow`."""
    resampling = "systematic" if guide is None else RECIPES[name].resampling
    return nw.smc(particles, power=POWER, resampling=resampling, guide=guide)


def train(name: str, seed: int = 1) -> Guide:
    """Train the guide of a model."""
    of, recipe = kind(name), RECIPES[name]
    targets = [score(target) for target in of.learned()]
    return guides.train_guide(
        of.model,
        [target for i, target in enumerate(targets) if i % EVERY],
        lambda target: target,
        held_out=targets[::EVERY],
        rounds=recipe.rounds,
        searches=(nw.improve(), LATER),
        judge=nw.smc(PARTICLES, power=POWER, resampling=recipe.resampling),
        keep=lambda sample: sample.has_ended and sample.log_score > recipe.least,
        training=guides.Training(hidden=recipe.hidden),
        seed=seed,
        progress=lambda now: (
            print(f"  {now.traces} traces: {sentence(now.summary())}", flush=True) if now.is_judged else None
        ),
    )


def home(name: str) -> Path:
    """Where the package has the guide of a model."""
    return SHIPPED / f"{name.replace('-', '_')}.guide"


def searched(of: Kind, score: nw.Score, method: Method, seed: int) -> tuple[float, float]:
    """The best log score of a search, and its CPU seconds."""
    start = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SearchWarning)
        try:
            best = nw.run(of.model, score=score, method=method, seed=seed, threads=1).best.log_score
        except nw.InputError as error:
            if error.code != "everything-impossible":
                raise
            best = -np.inf
    return max(best, empty(score)) if best == -np.inf else best, time.process_time() - start


def cost(of: Kind, score: nw.Score, method: Method) -> float:
    """Mean CPU seconds of the pilot runs."""
    return float(np.mean([searched(of, score, method, seed)[1] for seed in PILOTS]))


def as_costly(of: Kind, score: nw.Score, budget: float) -> int:
    """How many unguided particles cost so many CPU seconds."""
    particles = 60
    for _ in range(2):
        spent = cost(of, score, smc(particles, of.name))
        particles = max(2, round(particles * min(8.0, max(0.125, budget / spent))))
    return particles


def compare(of: Kind, guide: Guide, seeds: Sequence[int]) -> Iterator[dict[str, Any]]:
    """One record for each target."""
    for target in of.tried_on():
        target_score = score(target)
        guided, usual = smc(PARTICLES, of.name, guide), nw.improve()
        for method in (guided, usual):
            searched(of, target_score, method, 0)  # compiled and voxelised now
        same_cost = as_costly(of, target_score, cost(of, target_score, guided))
        methods = {
            "30 guided": guided,
            "unguided": smc(same_cost, of.name),
            "usual search": usual,
            "usual search, guided": nw.improve(guide=guide),
        }
        rows: dict[str, list[tuple[float, float]]] = {name: [] for name in methods}
        for seed in seeds:
            for name, method in methods.items():
                rows[name].append(searched(of, target_score, method, seed))
        columns = {
            name: {
                "scores": [round(s, 3) for s, _ in row],
                "cpu": float(f"{np.mean([c for _, c in row]):.3g}"),
            }
            for name, row in rows.items()
        }
        yield {
            "model": of.name,
            "target": target.name,
            "empty": round(empty(target_score), 2),
            "particles": {"30 guided": PARTICLES, "unguided": same_cost},
            "methods": columns,
        }


def table(records: Sequence[Mapping[str, Any]]) -> str:
    """Mean / median / worst log score and CPU milliseconds of each method, target by target, and over all."""
    names = list(records[0]["methods"])
    lines = ["| target | " + " | ".join(names) + " |", "| --- |" + " --- |" * len(names)]

    def cell(scores: Sequence[float], cpu: float) -> str:
        s = np.array(scores)
        return f"{s.mean():.1f} / {np.median(s):.1f} / {s.min():.1f}, {1000 * cpu:.0f} ms"

    for record in records:
        cells = [cell(record["methods"][name]["scores"], record["methods"][name]["cpu"]) for name in names]
        lines.append(f"| {record['target']} | " + " | ".join(cells) + " |")
    together = []
    for name in names:
        scores = [s for record in records for s in record["methods"][name]["scores"]]
        together.append(cell(scores, float(np.mean([record["methods"][name]["cpu"] for record in records]))))
    return "\n".join([*lines, "| all | " + " | ".join(together) + " |"] if len(records) > 1 else lines)


def main(arguments: list[str]) -> int:
    """Train a guide, or compare those that there are."""
    match arguments:
        case ["train", name, *place]:
            start = time.process_time()
            guide = train(name)
            path = Path(place[0]) if place else home(name)
            path.parent.mkdir(exist_ok=True)
            guide.save(path)
            print(
                f"{guide}, {len(guide.data) / 1000:.0f} kB, {time.process_time() - start:.0f} s of CPU: {path}"
            )
        case ["compare", *places]:
            seeds = range(int(os.environ.get("SEEDS", "20")))
            places_found = [Path(place) for place in places] or [
                home(model.name) for model in KINDS if home(model.name).is_file()
            ]
            old = json.loads(RECORD.read_text()) if RECORD.is_file() else []
            for path in places_found:
                guide = Guide.load(path)
                name = guide.model.replace("_", "-")
                old, records = [record for record in old if record["model"] != name], []
                for record in compare(kind(name), guide, seeds):
                    records.append(record)
                    print(table([record]).splitlines()[-1], flush=True)
                    RECORD.write_text(json.dumps(old + records, indent=1) + "\n")
                print(table(records))
        case _:
            print(__doc__)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
