"""The work that changes results: a search, a part grown again, a choice that is set."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from math import isfinite
from typing import Any

import niwaki as nw
from niwaki.lang.compiled import translated
from niwaki.result import Progress, Result, Sample
from niwaki.result.progress import Watch
from niwaki.result.search_like import SearchLike
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import Answer, Change, Ghost, Grow, Key, Progressed, Question, Regrow, TargetAsk
from niwaki.studio.refused import Refused
from niwaki.studio.worker import asks, models, runs, shapes, variety
from niwaki.studio.worker.thinning import GHOST_TRIANGLES

#: Rounds of `improve` at effort 1: its own usual number.
ROUNDS = 15
#: Particles that grow a part again.
REGROWN = 100


def ghost(job: Ghost, send: Any) -> Answer:
    """The meshes of the target and of the obstacles."""
    found = models.reference(job.question.model)
    ask = job.question.ask
    aim = None if ask.sketch is not None else ask.target or asks.usual(found)
    if aim is not None:
        _solid(aim, job.id, send, what="ghost")
    for number, obstacle in enumerate(ask.obstacles):
        _solid(obstacle, job.id, send, what="obstacle", number=number)
    return Answer()


def _solid(ask: TargetAsk, job: int, send: Any, **header: Any) -> None:
    ghost, foot = asks.shown(ask)
    many = ghost.triangles > GHOST_TRIANGLES
    note = f"shown with fewer than its {ghost.triangles:,} triangles" if many else ""
    described, payload = shapes.ghost(
        ghost.vertices, ghost.faces, ghost.bounds, foot, note=note, source=ask.source, **header
    )
    described.id = job
    send(described, payload)


def grow(job: Grow, send: Any, check: Callable[[], None]) -> Answer:
    """Search for results that differ; the best so far is shown while it runs."""
    found, asked = asks.search(job.question)
    settings = job.question.settings
    result = nw.grow(
        found.model,
        **asked,
        rounds=max(1, round(ROUNDS * settings.effort)),
        diverse=variety.candidates(settings.count, settings.strength) if settings.count > 1 else None,
        seed=job.seed,
        hold=runs.given(job.question.hold) or None,
        progress=watching(job.id, job.run, send, check),
    )
    result.samples = variety.spread(ended(result), settings.count, settings.strength)
    return _answered(result, found, job.run, job.file, "run", send, job.id)


def watching(job: int, run: int, send: Any, check: Callable[[], None]) -> Watch:
    """The `progress` of a search: it sends the best so far, and ends the search when `check` says so."""
    begun, shown = time.perf_counter(), [-float("inf")]

    def progress(now: Progress) -> None:
        sample = now.sample
        if sample is not None and sample.log_score > shown[0]:
            shown[0] = sample.log_score
            send(*shape(sample, "best", job, Key(run)))
        best = shown[0] if isfinite(shown[0]) else None
        send(Progressed(job, now.done, best, time.perf_counter() - begun))
        check()

    return progress


def regrow(job: Regrow, send: Any) -> Answer:
    """Grow a part of a result again, in place, by seeds that follow one another; equal outcomes are given once."""
    search, choices = searched(
        job.question, runs.sample(job.source, job.number), runs.given(job.question.hold)
    )
    with translated(search.model.name, choices=choices):
        whole = Sample.of_trace(search.task.replay(choices, None), search, job.seed)
    found: list[Sample] = []
    for number in range(job.count if job.strength is None else 2 * job.count):
        one = whole.regrow(job.part, REGROWN, seed=(job.seed + number) % 2**53).best
        if one.choices not in [choices, *(other.choices for other in found)]:
            found.append(one)
    if not found:
        raise Refused("no-other-form", f"`{job.part}` has no other form here")
    if job.strength is not None:
        found = variety.ordered(whole, found, job.count, job.strength)
    result = Result(search, found, job.seed)
    return _answered(result, models.reference(job.question.model), job.run, job.file, "regrow", send, job.id)


def change(job: Change, send: Any) -> Answer:
    """Run with the choices of a result, some of them changed; choices that it newly makes are drawn from the seed."""
    one = runs.sample(job.source, job.number)
    search, choices = searched(job.question, one, None)
    for address in job.changes:
        if address not in choices:
            raise Refused("no-choice", f"the result has no choice `{address}`")
    choices |= runs.given(job.changes)
    with translated(search.model.name, choices=choices):
        trace = search.task.replay(choices, search.seed)
    sample = Sample.of_trace(trace, search, one.seed)
    if not job.file:
        send(*shape(sample, "moving", job.id, Key(job.run)))
        return Answer()
    result = Result(search, [sample], search.seed)
    found = models.reference(job.question.model)
    return _answered(result, found, job.run, job.file, job.origin, send, job.id)


def ended(result: Result) -> list[Sample]:
    """The samples that ended; all where none did."""
    return [one for one in result.samples if one.has_ended] or list(result.samples)


def searched(
    question: Question, one: Sample, hold: dict[str, Any] | None
) -> tuple[SearchLike, dict[str, Any]]:
    """The search of a result with the present model and arguments, and the result's choices."""
    model, args = models.reference(question.model).model, asks.arguments(question)
    search = replace(one.search, model=model, args=args, choices=None, hold=hold or None, polish=None)
    return search, dict(one.choices)


def shape(sample: Sample, what: str, job: int, key: Key) -> Any:
    """The header and the payload of a result's scene."""
    return shapes.shape(sample.scene, "light", what=what, id=job, key=key, is_flat=runs.is_flat(sample))


def _answered(
    result: Result, found: ModelReference, run: int, file: str, origin: str, send: Any, job: int
) -> Answer:
    """Store the results that ended, the best first, and show them."""
    result.samples = sorted(ended(result), key=lambda one: -one.log_score)
    outcomes = runs.store(result, found, run, file, origin)
    for one, outcome in zip(result.samples, outcomes, strict=True):
        send(*shape(one, "result", job, outcome.key))
    losses = str(getattr(result.info, "losses", ""))
    return Answer(outcomes=outcomes, interrupted=result.interrupted, note=losses)
