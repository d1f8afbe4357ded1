"""Guides of all kinds for the vines, from the same traces.

The dissertation's recipe for traces: a population of 600 without a guide, for a drawing that is picked at random; its
best run, where it has ten primitives or more.
"""

import json
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, replace
from os import cpu_count
from types import ModuleType
from typing import Any

import niwaki as nw
import numpy as np
from judging import likeliest
from niwaki import _engine
from niwaki.gallery import vines
from niwaki.guides import Training, train_guide
from niwaki.methods import Guide
from niwaki.result import Sample
from niwaki.search import Search
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from places import Places

#: Traces of the dissertation's guides here. Its figure 6.10 gains little from more.
TRACES = 600
#: Fewest primitives of a trace.
FEWEST = 10
#: Which of the training scribbles judge a guide while it is trained.
EVERY = 5

#: What the dissertation's network reads beside position and direction.
PLACE = ("width",)
#: The dissertation's network with less and less to see (6.5.2).
ABLATIONS = {
    "full": Training.dissertation(reads=PLACE),
    "target": Training.dissertation(reads=PLACE, looks="target"),
    "local": Training.dissertation(reads=PLACE, looks=False),
    "constants": Training.dissertation(reads=False, looks=False),
}
#: Gaussians of each mixture; numbers of traces; seeds of training.
COMPONENTS = (1, 2, 4)
SIZES = (12, 25, 50, 100, 200, 400, TRACES)
SEEDS = (1, 2)


def scribbles() -> tuple[list[Drawing], list[Drawing]]:
    """Scribbles to learn from, with their mirror images, and others of the training scribbles to judge by."""
    every = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    learned = [drawing for i, drawing in enumerate(every) if i % EVERY]
    return learned + [drawing.mirrored() for drawing in learned], every[::EVERY]


def ended(sample: Sample) -> bool:
    """Whether a run is worth learning from."""
    return bool(sample.primitives >= FEWEST)


def best(sample: Search) -> Sample:
    """The likeliest run of a search."""
    return likeliest(sample.run(threads=1))


def traced(model: ModuleType, count: int, seed: int = 1) -> list[tuple[Search, Sample]]:
    """So many traces of a gallery's model."""
    learned, _ = scribbles()
    draw, traces = np.random.default_rng(seed), []
    with ThreadPoolExecutor(cpu_count()) as pool:
        while len(traces) < count:
            picks = [learned[i] for i in draw.integers(len(learned), size=count - len(traces))]
            jobs = [
                Search(
                    model.MODEL,
                    drawing.place(model.WINDOW),
                    score=drawing.score(model.WINDOW),
                    method=nw.smc(600, resampling="residual"),
                    seed=int(draw.integers(2**63)),
                )
                for drawing in picks
            ]
            traces += [(job, run) for job, run in zip(jobs, pool.map(best, jobs), strict=True) if ended(run)]
    return traces


def fitted(pairs: Sequence[tuple[Search, Sample]], training: Training, seed: int = 1) -> Guide:
    """A guide from traces, of which the first tenth judges."""
    lessons = _engine.Lessons()
    for number, (job, run) in enumerate(pairs):
        lessons.add(job.task, run._run, number < max(1, len(pairs) // 10))
    settings = asdict(training) | {"model": pairs[0][0].model.name, "seed": seed}
    engine, report = lessons.train(pairs[0][0].task, json.dumps(settings), None, None)
    assert report["diverged"] is None, report["diverged"]
    return Guide(engine.data())


def wanted(places: Places) -> dict[str, tuple[int, Training, int]]:
    """All guides from these traces: how many of them, the training, and its seed."""
    plans = {name: (TRACES, training, 1) for name, training in ABLATIONS.items()}
    plans["averaged"] = (TRACES, Training.dissertation(reads=PLACE, averaging=0.998), 1)
    for count in COMPONENTS[:-1]:
        plans[f"full-{count}"] = (TRACES, Training.dissertation(reads=PLACE, components=count), 1)
    for count in SIZES:
        if SIZES[0] < count < TRACES:
            plans[f"full-of-{count}"] = (count, ABLATIONS["full"], 1)
        plans |= {f"ours-of-{count}-{seed}": (count, Training(), seed) for seed in SEEDS}
    if places.quick:
        plans = {
            name: (min(count, 20), replace(training, steps=50), seed)
            for name, (count, training, seed) in plans.items()
        }
    return plans


def teach(places: Places) -> None:
    """Train all guides that are missing, from the same traces."""
    missing = {name: how for name, how in wanted(places).items() if not places.has(name)}
    if not missing:
        return
    start = time.process_time()
    pairs = traced(vines, max(count for count, _, _ in missing.values()))
    print(f"{len(pairs)} traces: {time.process_time() - start:.0f} s of CPU", flush=True)

    def one(item: tuple[str, tuple[int, Training, int]]) -> None:
        name, (count, training, seed) = item
        places.guide(name, lambda: fitted(pairs[:count], training, seed))
        print(f"{name} is trained", flush=True)

    with ThreadPoolExecutor(cpu_count()) as pool:
        list(pool.map(one, missing.items()))


def taught(places: Places, name: str) -> Guide:
    """A guide from these traces."""
    if not places.has(name):
        teach(places)
    return places.guide(name, lambda: fitted([], Training()))


def ours(places: Places, model: ModuleType, seed: int = 1, **settings: Any) -> Guide:
    """Our guide by its usual recipe."""
    learned, judged = scribbles()
    name = "-".join(
        ["ours", model.MODEL.name, str(seed), *(f"{key}{value}" for key, value in settings.items())]
    )
    return places.guide(
        name,
        lambda: train_guide(
            model.MODEL,
            learned,
            lambda drawing: drawing.score(model.WINDOW),
            lambda drawing: drawing.place(model.WINDOW),
            held_out=judged,
            keep=ended,
            rounds=(10, 10) if places.quick else (150, 400),
            training=Training(**settings),
            seed=seed,
        ),
    )
