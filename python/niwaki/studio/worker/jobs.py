"""Jobs that make results: a search, a part grown again, a changed choice."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from math import isfinite
from typing import Any, Literal

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

import niwaki as nw
from niwaki import kernels
from niwaki.errors import NiwakiError
from niwaki.lang.compiled import translated
from niwaki.methods.chains import Mh
from niwaki.methods.improve import Improve, usual_rounds
from niwaki.result import Progress, Result, Sample
from niwaki.result.progress import Watch
from niwaki.result.search_like import SearchLike
from niwaki.search import named
from niwaki.search.entry import grow_search
from niwaki.shell import requirements
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import (
    Answer,
    Ask,
    Change,
    Ghost,
    Glimpse,
    Grow,
    Key,
    Mask,
    Progressed,
    Question,
    Regrow,
    Settings,
    TargetAsk,
)
from niwaki.studio.problems import CommandError
from niwaki.studio.worker import asks, fitting, models, prior, runs, shapes, variety
from niwaki.studio.worker.places import as_drawn
from niwaki.studio.worker.thinning import GHOST_TRIANGLES

#: Particles for growing a part again.
REGROWTH_PARTICLES = 100
#: Proposals of a chain over the choices of a part, where particles find no possible form.
REGROWTH_STEPS = 200
#: The most primitives of a run of the model that is drawn with smooth normals.
SMOOTH = 300


def ghost(job: Ghost, send: Any) -> Answer:
    """Send the meshes of the target and of the obstacles, the mask of a sketch, and a run of the model."""
    model = models.reference(job.question.model)
    ask = job.question.ask
    aim = None if ask.sketch is not None else ask.target or asks.usual(model)
    bounds = None if aim is None else _solid(aim, job.id, send, role="ghost")
    for number, obstacle in enumerate(ask.obstacles):
        _solid(obstacle, job.id, send, role="obstacle", number=number)
    if ask.sketch is not None:
        mask = asks.mask(ask.sketch)
        rows, columns = mask.shape
        send(Mask(job.id, columns, rows), mask.tobytes())
    run = prior.run(model, asks.arguments(job.question))
    if run is not None:
        _prior(run, model, "prior", job.id, send)
    return Answer(sizes=fitting.sizes(run, aim, bounds))


def glimpse(job: Glimpse, send: Any) -> Answer:
    """Send a run of a model of the list."""
    model = models.reference(job.reference)
    run = prior.run(model, asks.arguments(Question(job.reference, {}, Ask(), Settings())))
    if run is not None:
        _prior(run, model, "glimpse", job.id, send, job.reference)
    return Answer()


def _prior(
    run: Sample, model: ModelReference, role: str, job: int, send: Any, source: str | None = None
) -> None:
    """Send the shape of a run of the model without a target, with smooth normals unless it is large."""
    detail: Literal["light", "fine"] = "fine" if role == "prior" and run.primitives <= SMOOTH else "light"
    send(*shapes.shape(run.scene, detail, role=role, source=source, id=job, is_flat=model.style is not None))


def _solid(ask: TargetAsk, job: int, send: Any, **header: Any) -> NDArray[np.float64]:
    """Send the mesh of a solid at its place; return its bounds."""
    ghost, foot = asks.shown(ask)
    many = ghost.triangles > GHOST_TRIANGLES
    note = f"shown with fewer triangles than its {ghost.triangles:,}" if many else ""
    shape, payload = shapes.ghost(
        ghost.vertices, ghost.faces, ghost.bounds, foot, note=note, source=ask.source, **header
    )
    shape.id = job
    send(shape, payload)
    return ghost.bounds


def grow(job: Grow, send: Any, check: Callable[[], None]) -> Answer:
    """Search for results that differ, or for a better result from a known one, and send the best so far."""
    model, goals = asks.search(job.question)
    settings = job.question.settings
    progress, hold = watching(job.id, job.run, send, check), runs.values(job.question.hold) or None
    count = variety.candidates(settings.count, settings.strength) if settings.count > 1 else 1

    rules = requirements.beside(model)
    if rules is not None:
        goals["score"] = rules.aims(goals["score"])
    if job.source:
        search = grow_search(model.model, **goals, **spending(settings.effort), seed=job.seed, hold=hold)
        start = _replayed(search, runs.sample(job.source, job.number).choices, job.seed)
        if isinstance(search.method, Improve) and start.cause is None:
            result = Result(search, [start], job.seed).polish(search.method, progress=progress)
            return _answer(result, model, job.run, job.file, "run", send, job.id)

    def attempt(seed: int, candidates: int) -> Result:
        return nw.grow(
            model.model,
            **goals,
            **spending(settings.effort),
            diverse=candidates if candidates > 1 else None,
            by=settings.by,
            seed=seed,
            hold=hold,
            progress=progress,
        )

    result, conflicts = requirements.keeping(rules, attempt, job.seed, count)
    kinds = dict(zip(map(id, result.samples), named(result), strict=True))
    result.samples = variety.spread(ended(result), settings.count, settings.strength)
    answer = _answer(result, model, job.run, job.file, "run", send, job.id)
    words = [", ".join(f"{name}: {value}" for name, value in kinds[id(sample)]) for sample in result.samples]
    outcomes = [structs.replace(each, kind=text) for each, text in zip(answer.outcomes, words, strict=True)]
    return structs.replace(answer, outcomes=outcomes, note="; ".join(filter(None, [answer.note, *conflicts])))


def _replayed(search: SearchLike, choices: dict[str, Any], seed: int) -> Sample:
    """Return the run of a search with the choices of a result."""
    with translated(search.model.name, choices=choices):
        return Sample.of_trace(search.task.replay(choices, None), search, seed)


def spending(effort: float) -> dict[str, Any]:
    """Return the settings of a search with an effort: as many rounds, where all searches have a number of rounds."""
    rounds = usual_rounds()
    return {"effort": effort} if rounds is None else {"rounds": max(1, round(rounds * effort))}


def watching(job: int, run: int, send: Any, check: Callable[[], None]) -> Watch:
    """Return the `progress` of a search: it sends the best so far, and `check` can end the search."""
    start, shown, fit = time.perf_counter(), [-float("inf")], [""]

    def progress(now: Progress) -> None:
        sample = now.sample
        if sample is not None and sample.log_score > shown[0]:
            shown[0] = sample.log_score
            fit[0] = str(sample.fit or "")
            send(*shape(sample, "best", job, Key(run)))
        best = shown[0] if isfinite(shown[0]) else None
        send(Progressed(job, now.done, best, time.perf_counter() - start, fit[0]))
        check()

    return progress


def regrow(job: Regrow, send: Any) -> Answer:
    """Grow a part of a result again, in place, with consecutive seeds; equal outcomes appear once."""
    search, choices = search_again(
        job.question, runs.sample(job.source, job.number), runs.values(job.question.hold)
    )
    whole = _replayed(search, choices, job.seed)
    forms: list[Sample] = []
    for number in range(job.count if job.strength is None else 2 * job.count):
        form = form_of_part(whole, job.part, (job.seed + number) % 2**53)
        if form.choices not in [choices, *(other.choices for other in forms)]:
            forms.append(form)
    if not forms:
        raise CommandError("no-other-form", f"{search.model.labels.label(job.part)} has no other form here")
    if job.strength is not None:
        forms = variety.ordered(whole, forms, job.count, job.strength)
    result = Result(search, forms, job.seed)
    return _answer(result, models.reference(job.question.model), job.run, job.file, "regrow", send, job.id)


def form_of_part(whole: Sample, part: str, seed: int) -> Sample:
    """Grow a part again by particles; by small steps from its form where what follows the part fits no particle."""
    try:
        return whole.regrow(part, REGROWTH_PARTICLES, seed=seed).best
    except NiwakiError as error:
        if error.code != "everything-impossible":
            raise
    steps = kernels.mixture(kernels.prior(), kernels.drift(0.3), kernels.drift(0.03))
    moves = kernels.on(f"{part}/**", steps)
    chain = Result(whole.search, [whole], seed).polish(Mh(REGROWTH_STEPS, kernel=moves, keep=1))
    return chain.samples[-1]


def change(job: Change, send: Any) -> Answer:
    """Run with the choices of a result, some of them changed; new choices are drawn from the seed."""
    original = runs.sample(job.source, job.number)
    search, choices = search_again(job.question, original, None)
    for address in job.changes:
        if address not in choices:
            raise CommandError("no-choice", f"the result has no choice `{address}`")
    families = original.families
    for address, value in runs.values(job.changes).items():
        choices[address] = as_drawn(families.get(address, ""), value, choices[address])
    with translated(search.model.name, choices=choices):
        trace = search.task.replay(choices, search.seed)
    sample = Sample.of_trace(trace, search, original.seed)
    if not job.file:
        send(*shape(sample, "moving", job.id, Key(job.run)))
        return Answer()
    result = Result(search, [sample], search.seed)
    model = models.reference(job.question.model)
    return _answer(result, model, job.run, job.file, job.origin, send, job.id)


def ended(result: Result) -> list[Sample]:
    """Return the samples that ended; all samples if none ended."""
    return [sample for sample in result.samples if sample.has_ended] or list(result.samples)


def search_again(
    question: Question, sample: Sample, hold: dict[str, Any] | None
) -> tuple[SearchLike, dict[str, Any]]:
    """Return the search of a result with the present model and arguments, and the result's choices."""
    model, args = models.reference(question.model).model, asks.arguments(question)
    search = replace(sample.search, model=model, args=args, choices=None, hold=hold or None, polish=None)
    return search, dict(sample.choices)


def shape(sample: Sample, role: str, job: int, key: Key) -> Any:
    """Return the header and the payload of a result's scene."""
    return shapes.shape(sample.scene, "light", role=role, id=job, key=key, is_flat=runs.is_flat(sample))


def _answer(
    result: Result, model: ModelReference, run: int, file: str, origin: str, send: Any, job: int
) -> Answer:
    """Store the results that ended, the best first, and send their shapes."""
    result.samples = sorted(ended(result), key=lambda sample: -sample.log_score)
    outcomes = runs.store(result, model, run, file, origin)
    for sample, outcome in zip(result.samples, outcomes, strict=True):
        send(*shape(sample, "result", job, outcome.key))
    losses = getattr(result.info, "losses", None)
    note = "" if losses is None else losses.text(result.model.labels)
    return Answer(outcomes=outcomes, interrupted=result.interrupted, note=note)
