"""A run of a model without a target: what the model makes by itself, before any search."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from niwaki.errors import NiwakiError
from niwaki.methods import Forward
from niwaki.result import Sample
from niwaki.search import Search
from niwaki.shell.references import ModelReference

#: Runs from which the middle one by size is taken; the most attempts, since a model may break its own constraints.
RUNS, TRIES = 5, 50
#: Seconds after which a run that is there is enough, so that a slow model is shown, too.
ENOUGH = 0.3

#: The last runs, by model and arguments.
_runs: dict[tuple[int, str], tuple[ModelReference, Sample | None]] = {}
#: Runs that are kept.
KEPT = 16


def run(model: ModelReference, arguments: Sequence[Any]) -> Sample | None:
    """Return a run of middle size among a few; None if no run has a shape, or the model lacks an argument."""
    key = id(model), repr(arguments)
    if key not in _runs:
        if len(_runs) >= KEPT:
            del _runs[next(iter(_runs))]
        # The reference is kept, so that its number is not given to another one.
        _runs[key] = model, _middle(model, arguments)
    return _runs[key][1]


def _middle(model: ModelReference, arguments: Sequence[Any]) -> Sample | None:
    samples: list[Sample] = []
    start = time.perf_counter()
    try:
        search = Search(model.model, tuple(arguments), method=Forward(), seed=0)
        for seed in range(TRIES):
            sample = replace(search, seed=seed).run().best
            if sample.cause is None and sample.primitives:
                samples.append(sample)
            if len(samples) == RUNS or (samples and time.perf_counter() - start > ENOUGH):
                break
    except NiwakiError:
        # The message comes with the search, where the user has asked for something.
        pass
    samples.sort(key=lambda sample: float(sample.scene.size.max()))
    return samples[len(samples) // 2] if samples else None
