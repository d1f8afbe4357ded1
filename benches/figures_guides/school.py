"""Guides of all kinds for the vines, from the same traces.

The dissertation's recipe for traces: a population of 600 without a guide, for a drawing that is picked at random; its best
run, where it has ten primitives or more.
"""

import json
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from os import cpu_count
from types import ModuleType
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import _engine
from niwaki.guides import Training, train_guide
from niwaki.methods import Guide
from niwaki.result import Sample
from niwaki.search import Search
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from places import Places

#: Traces of the dissertation's guides here. Its figure 6.10 gains nothing from more.
TRACES = 1000
#: Fewest primitives of a trace.
FEWEST = 10
#: Which of the training scribbles judge a guide while it is trained.
EVERY = 5

PLACE = ("width",)
#: The dissertation's network with less and less to see (6.5.2).
ABLATIONS = {
    "full": Training.dissertation(reads=PLACE),
    "target": Training.dissertation(reads=PLACE, looks="target"),
    "local": Training.dissertation(reads=PLACE, looks=False),
    "constants": Training.dissertation(reads=False, looks=False),
}
AVERAGED = Training.dissertation(reads=PLACE, averaging=0.998)


def scribbles() -> tuple[list[Drawing], list[Drawing]]:
    """Scribbles to learn from, with their mirror images, and others of the training scribbles to judge by."""
    every = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    learned = [one for i, one in enumerate(every) if i % EVERY]
    return learned + [one.mirrored() for one in learned], every[::EVERY]


def ended(sample: Sample) -> bool:
    """Whether a run is worth learning from."""
    return bool(sample.primitives >= FEWEST)


def best(sample: Search) -> Sample:
    """The likeliest run of a search."""
    return max(sample.run(threads=1), key=lambda one: one.log_score + one.log_prior)


def traced(model: ModuleType, count: int, seed: int = 1) -> list[tuple[Search, Sample]]:
    """So many traces of a gallery's model."""
    learned, _ = scribbles()
    draw, found = np.random.default_rng(seed), []
    with ThreadPoolExecutor(cpu_count()) as pool:
        while len(found) < count:
            picks = [learned[i] for i in draw.integers(len(learned), size=count - len(found))]
            jobs = [
                Search(
                    model.MODEL,
                    one.place(model.WINDOW),
                    score=one.score(model.WINDOW),
                    method=nw.smc(600, resampling="residual"),
                    seed=int(draw.integers(2**63)),
                )
                for one in picks
            ]
            found += [(job, run) for job, run in zip(jobs, pool.map(best, jobs), strict=True) if ended(run)]
    return found


def fitted(pairs: Sequence[tuple[Search, Sample]], training: Training, seed: int = 1) -> Guide:
    """A guide from traces, of which the first tenth judges."""
    lessons = _engine.Lessons()
    for number, (job, run) in enumerate(pairs):
        lessons.add(job.task, run._run, number < max(1, len(pairs) // 10))
    settings = asdict(training) | {"model": pairs[0][0].model.name, "seed": seed}
    engine, told = lessons.train(pairs[0][0].task, json.dumps(settings), None, None)
    assert told["diverged"] is None, told["diverged"]
    return Guide(engine.data())


def taught(
    places: Places, model: ModuleType, wanted: Mapping[str, tuple[int, Training, int]]
) -> dict[str, Guide]:
    """Guides by name, each from its number of traces by its training and its seed."""
    missing = [name for name in wanted if not places.has(name)]
    count = max((wanted[name][0] for name in missing), default=0)
    pairs: list[Any] = []
    if missing:
        start = time.process_time()
        pairs = traced(model, 20 if places.quick else count)
        print(f"{len(pairs)} traces: {time.process_time() - start:.0f} s of CPU", flush=True)
    guides = {}
    for name, (traces, training, seed) in wanted.items():
        if places.quick:
            training = Training(**asdict(training) | {"steps": 50})
        start = time.process_time()
        guides[name] = places.guide(
            name, lambda traces=traces, training=training, seed=seed: fitted(pairs[:traces], training, seed)
        )
        if name in missing:
            print(f"{name}: {time.process_time() - start:.0f} s of CPU", flush=True)
    return guides


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
            lambda one: one.score(model.WINDOW),
            lambda one: one.place(model.WINDOW),
            held_out=judged,
            keep=ended,
            rounds=(10, 10) if places.quick else (150, 400),
            training=Training(**settings),
            seed=seed,
        ),
    )
