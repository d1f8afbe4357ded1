"""Dragging a part: the shape while the pointer moves, and the answers at the end."""

from __future__ import annotations

from typing import Any

from niwaki.result import Result
from niwaki.search.data import Writer
from niwaki.search.drag import Dragging
from niwaki.studio.messages import Answer, Dragged, DragPart, HeldPart, Key, Shifted
from niwaki.studio.worker import jobs, models, rewriting, runs, shapes

#: The present drag with its key: only the first command of a pointer that moves prepares it.
_current: list[tuple[Any, Dragging]] = []


def drag(job: DragPart, send: Any) -> Answer:
    """Follow the pointer to a point."""
    dragging = _dragging(job)
    if not job.file:
        moved = dragging.move(job.to)
        header, payload = shapes.shape(
            moved.scene,
            "light",
            role="moving",
            id=job.id,
            key=Key(job.run),
            is_flat=runs.is_flat(dragging.sample),
            held=moved.point,
            left=moved.share,
            note=moved.reason,
        )
        send(header, payload)
        return Answer()
    outcome = dragging.to(job.to)
    best = outcome.best
    _current.clear()
    offers = rewriting.offer(dragging.source(job.to))
    if best is None or best.sample.cause is not None:
        share = 1.0 if best is None else best.share
        send(Dragged(job.id, job.part, share, outcome.reason, offers=offers))
        return Answer()
    changes = [Shifted(name, runs.shown(a), runs.shown(b)) for name, (a, b) in best.changed.items()]
    send(Dragged(job.id, best.part, best.share, outcome.reason, changes, offers))
    samples = [answer.sample for answer in outcome.answers] or [best.sample]
    result = Result(dragging.search, samples, dragging.search.seed)
    outcomes = runs.store(result, models.reference(job.question.model), job.run, job.file, "drag")
    for sample, stored in zip(samples, outcomes, strict=True):
        send(*jobs.shape(sample, "result", job.id, stored.key))
    write = Writer()
    return Answer(
        outcomes=outcomes,
        held=[HeldPart(best.part, {name: write(value) for name, value in best.holds.items()})],
    )


def _dragging(job: DragPart) -> Dragging:
    """Return the present drag, or a fresh drag for another part, result or question."""
    key = (job.source, job.number, job.part, job.grab, job.along, job.question)
    if not _current or _current[0][0] != key:
        sample = runs.sample(job.source, job.number)
        choices = sample.choices
        held = {name: choices[name] for name in runs.values(job.question.hold) if name in choices}
        search, _ = jobs.search_again(job.question, sample, held)
        # Without a grabbed point, the middle of the part's box is dragged.
        _current[:] = [(key, Dragging(search, sample, job.part, grab=job.grab, along=job.along, to=job.to))]
    return _current[0][1]
