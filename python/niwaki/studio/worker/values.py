"""Searches of other programs: goals as values, and stored searches that are repeated.

A program with its own meshes sends its goals as plain data and gets a run.json with the whole search. The program keeps
this file and sends it again for the same results, or for new results with held choices.
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
from niwaki.studio.worker import jobs, models, permissions, runs


def grow(job: GrowValues, send: Any, check: Callable[[], None]) -> Answer:
    """Search for results that differ."""
    model = models.reference(job.model)
    goals = model.terms(Reader().table(job.options))
    result = nw.grow(
        model.model,
        score=targets.asks.score(goals, targets.sketches.volume_score),
        **jobs.spending(job.settings.effort),
        diverse=job.settings.count if job.settings.count > 1 else None,
        by=job.settings.by,
        seed=job.seed,
        progress=jobs.watching(job.id, job.run, send, check),
        **job.arguments,
    )
    return _store(result, model, job.run, job.file)


def repeat(job: GrowAgain, send: Any, check: Callable[[], None]) -> Answer:
    """Repeat a stored search, with the changes of the job."""
    data = run_files.load(job.source)
    search = run_files.searched(data, permissions.modules(data), job.source)
    if job.seed is not None:
        search = search.with_seed(job.seed)
    if job.hold is not None:
        search = replace(search, hold=runs.values(job.hold) or None)
    if job.count is not None:
        search = _with_count(search, job.count)
    result = search.run(progress=jobs.watching(job.id, job.run, send, check))
    reference = ModelReference(str(data["model"]), search.model, file_hash=data.get("file_hash"))
    return _store(result, reference, job.run, job.file)


def _with_count(search: Search, count: int) -> Search:
    """Return the search with another number of results that differ, if its method can distinguish them."""
    if not hasattr(search.method, "diverse"):
        return search
    return replace(search, method=replace(search.method, diverse=count if count > 1 else None))  # type: ignore[call-arg]


def _store(result: Result, model: ModelReference, run: int, file: str) -> Answer:
    """Store the results that ended, the best first."""
    result.samples = sorted(jobs.ended(result), key=lambda sample: -sample.log_score)
    return Answer(outcomes=runs.store(result, model, run, file, "run"), interrupted=result.interrupted)
