"""A part that is dragged: the run as it is while the pointer moves, and the answers at its end."""

from __future__ import annotations

from typing import Any

from niwaki.result import Result
from niwaki.search.data import Writer
from niwaki.search.drag import Dragging
from niwaki.studio.messages import Answer, Dragged, DragPart, HeldPart, Key, Shifted
from niwaki.studio.worker import jobs, models, rewriting, runs, shapes

#: The drag that goes on, with what it began with: of a pointer that moves only the first command prepares it.
_going: list[tuple[Any, Dragging]] = []


def drag(job: DragPart, send: Any) -> Answer:
    """One point of a pointer."""
    dragging = _dragging(job)
    if not job.file:
        moved = dragging.move(job.to)
        header, payload = shapes.shape(
            moved.scene,
            "light",
            what="moving",
            id=job.id,
            key=Key(job.run),
            is_flat=runs.is_flat(dragging.sample),
            held=moved.point,
            left=moved.share,
            note=moved.reason,
        )
        send(header, payload)
        return Answer()
    found = dragging.to(job.to)
    best = found.best
    _going.clear()
    offers = rewriting.offered(dragging.source(job.to))
    if best is None or best.sample.cause is not None:
        share = 1.0 if best is None else best.share
        send(Dragged(job.id, job.part, share, found.reason, offers=offers))
        return Answer()
    changes = [Shifted(name, runs.shown(a), runs.shown(b)) for name, (a, b) in best.changed.items()]
    send(Dragged(job.id, best.part, best.share, found.reason, changes, offers))
    samples = [one.sample for one in found.answers] or [best.sample]
    result = Result(dragging.search, samples, dragging.search.seed)
    outcomes = runs.store(result, models.reference(job.question.model), job.run, job.file, "drag")
    for one, outcome in zip(samples, outcomes, strict=True):
        send(*jobs.shape(one, "result", job.id, outcome.key))
    write = Writer()
    return Answer(
        outcomes=outcomes,
        held=[HeldPart(best.part, {name: write(value) for name, value in best.holds.items()})],
    )


def _dragging(job: DragPart) -> Dragging:
    """The drag that goes on; a fresh one for another part, result or question."""
    key = (job.source, job.number, job.part, job.grab, job.along, job.question)
    if not _going or _going[0][0] != key:
        one = runs.sample(job.source, job.number)
        choices = one.choices
        held = {name: choices[name] for name in runs.given(job.question.hold) if name in choices}
        search, _ = jobs.searched(job.question, one, held)
        # A part is taken by the middle of its box where no point of it is.
        _going[:] = [(key, Dragging(search, one, job.part, grab=job.grab, along=job.along, to=job.to))]
    return _going[0][1]
