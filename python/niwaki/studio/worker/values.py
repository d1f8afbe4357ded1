"""Searches that another program asks for by values, and stored ones that are carried out again.

A program with meshes of its own sends what it asks as plain data. What comes back is a run.json, which has the whole
search: the same program keeps it, and sends it again for the same results, or for others with held choices.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import niwaki as nw
from niwaki import targets
from niwaki.result import Result
from niwaki.search import Search
from niwaki.search.data import Reader
from niwaki.shell import run_files
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import Answer, GrowAgain, GrowValues
from niwaki.studio.worker import allowed, jobs, models, runs


def grow(job: GrowValues, send: Any, check: Callable[[], None]) -> Answer:
    """Search for results that differ."""
    found = models.reference(job.model)
    asked = found.asked(Reader().table(job.asked))
    result = nw.grow(
        found.model,
        score=targets.asks.score(asked),
        rounds=max(1, round(jobs.ROUNDS * job.settings.effort)),
        diverse=job.settings.count if job.settings.count > 1 else None,
        seed=job.seed,
        progress=jobs.watching(job.id, job.run, send, check),
        **job.arguments,
    )
    return _stored(result, found, job.run, job.file)


def again(job: GrowAgain, send: Any, check: Callable[[], None]) -> Answer:
    """Carry out a stored search as it was, or with what the job says."""
    data = run_files.load(job.source)
    search = run_files.searched(data, allowed.modules(data), job.source)
    if job.seed is not None:
        search = search.with_seed(job.seed)
    if job.hold is not None:
        search = replace(search, hold=runs.given(job.hold) or None)
    if job.count is not None:
        search = _counted(search, job.count)
    result = search.run(progress=jobs.watching(job.id, job.run, send, check))
    reference = ModelReference(str(data["model"]), search.model, file_hash=data.get("file_hash"))
    return _stored(result, reference, job.run, job.file)


def _counted(search: Search, count: int) -> Search:
    """The search with another number of results that differ, where its method can tell them apart."""
    if not hasattr(search.method, "diverse"):
        return search
    return replace(search, method=replace(search.method, diverse=count if count > 1 else None))  # type: ignore[call-arg]


def _stored(result: Result, found: ModelReference, run: int, file: str) -> Answer:
    """Store the results that ended, the best first."""
    result.samples = sorted(jobs.ended(result), key=lambda one: -one.log_score)
    return Answer(outcomes=runs.store(result, found, run, file, "run"), interrupted=result.interrupted)
