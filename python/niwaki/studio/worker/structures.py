"""Structures of blocks: searched for balance, checked, and cut.

The searches of scenes do not find a balance. Chains that follow the slope of the model's log density do
(`niwaki.explore`).
"""

from __future__ import annotations

import math
import time
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

import niwaki as nw
from niwaki import stacks
from niwaki.draw.scene import Scene
from niwaki.errors import FileError, NiwakiError
from niwaki.errors.files import ensure_folder
from niwaki.methods import explore
from niwaki.result import Progress, Result, Sample
from niwaki.shares import percent
from niwaki.shell import requirements
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import (
    Answer,
    Arrow,
    Change,
    Grow,
    Judged,
    JudgeRun,
    Key,
    Progressed,
    Regrow,
    WriteFile,
)
from niwaki.studio.problems import CommandError
from niwaki.studio.worker import jobs, models, runs, shapes, variety

#: Chains for each result; the most stable structures are kept.
CHAINS = 2
#: The call whose choices are the forces between blocks (`niwaki.stacks`).
FORCES = "balance"
#: A force below this share of a block's mean weight is not shown.
SMALL = 1e-3


def grow(job: Grow, send: Any, check: Callable[[], None]) -> Answer:
    """Search for structures with independent chains; the structure whose ground can be tilted most comes first."""
    question, start = job.question, time.perf_counter()
    model, settings = models.reference(question.model), question.settings
    shown = [-math.inf]

    def progress(now: Progress) -> None:
        if now.sample is not None and now.sample.log_score > shown[0]:
            shown[0] = now.sample.log_score
            send(*shapes.shape(now.sample.scene, "light", role="best", id=job.id, key=Key(job.run)))
        best = shown[0] if math.isfinite(shown[0]) else None
        send(Progressed(job.id, now.done, best, time.perf_counter() - start))
        check()

    def attempt(seed: int, candidates: int) -> Result:
        draws = nw.run(
            model.model,
            explore(draws=1, chains=max(1, round(CHAINS * candidates * settings.effort))),
            seed=seed,
            hold=runs.values(question.hold) or None,
            progress=progress,
            **question.arguments,
        )
        tilts = sorted(((_tilt_of(draw), -number) for number, draw in enumerate(draws)), reverse=True)
        best = [draws[-number] for _, number in tilts[:candidates]]
        result = Result(draws.search, best, seed)
        result.interrupted = draws.interrupted
        return result

    result, conflicts = requirements.keeping(requirements.beside(model), attempt, job.seed, settings.count)
    answer = _answer(result, model, job, "run", send, result.interrupted)
    return replace(answer, note="; ".join(conflicts))


def _answer(
    result: Result,
    model: ModelReference,
    job: Grow | Regrow,
    origin: str,
    send: Any,
    interrupted: bool = False,
) -> Answer:
    """Store results, send their shapes, and note for each whether it stands."""
    if not result.samples:
        return Answer(interrupted=interrupted)
    outcomes = runs.store(result, model, job.run, job.file, origin)
    for sample, outcome in zip(result.samples, outcomes, strict=True):
        send(*shapes.shape(sample.scene, "light", role="result", id=job.id, key=outcome.key))
    noted = [
        replace(outcome, note=_note(_tilt_of(sample)))
        for sample, outcome in zip(result.samples, outcomes, strict=True)
    ]
    return Answer(outcomes=noted, interrupted=interrupted)


def change(job: Change, send: Any) -> Answer:
    """Run with the choices of a result, some of them changed, and note whether the structure stands."""
    answer = jobs.change(job, send)
    return replace(
        answer,
        outcomes=[
            replace(outcome, note=_note(_tilt_of(runs.sample(job.file, outcome.key.number))))
            for outcome in answer.outcomes
        ],
    )


ghost = jobs.ghost


def regrow(job: Regrow, send: Any) -> Answer:
    """Grow a part again so that the structure balances: chains over its choices and the forces, other choices held."""
    model, original = models.reference(job.question.model), runs.sample(job.source, job.number)
    choices = original.held()
    part_choices = {
        address for address in choices if address == job.part or address.startswith(f"{job.part}/")
    }
    held = {
        address: value
        for address, value in choices.items()
        if address not in part_choices and FORCES not in address.split("/")
    }
    hold = {**held, **runs.values(job.question.hold)}
    if part_choices <= set(hold):
        raise CommandError("no-other-form", f"`{job.part}` has no free choices of its own")
    count = job.count if job.strength is None else 2 * job.count
    try:
        draws = nw.run(
            model.model,
            explore(draws=1, chains=CHAINS * count),
            seed=job.seed,
            hold=hold,
            **job.question.arguments,
        )
    except NiwakiError as error:
        text = (
            f"`{job.part}` has no other form with which the structure balances while the rest stays unchanged"
        )
        raise CommandError("no-other-form", text) from error
    standing = sorted(
        ((tilt, -number) for number, draw in enumerate(draws) if (tilt := _tilt_of(draw)) >= 0.0),
        reverse=True,
    )
    samples = [draws[-number] for _, number in standing[:count]]
    if not samples:
        raise CommandError(
            "no-other-form",
            f"the structure balances with none of the other forms of `{job.part}` that were tried",
        )
    if job.strength is not None:
        samples = variety.ordered(original, samples, job.count, job.strength)
    return _answer(Result(draws.search, samples, job.seed), model, job, "regrow", send)


def judge(job: JudgeRun, send: Any) -> Answer:
    """Check whether a structure stands: its forces and, on request, a simulated fall."""
    sample = runs.sample(job.source, job.number)
    if not is_structure(job.source, job.number):
        raise CommandError("no-structure", "this result is not a structure of blocks")
    structure = stacks.Structure.of(sample)
    parts = _parts(structure, sample.scene)
    balance, carried = stacks.balanced(structure), stacks.carried(structure)
    verdict = Judged(
        job.id,
        job.key,
        holds=balance.holds,
        tilt=_tilt(balance),
        loose=[parts[number] for number in carried.loose if number in parts],
        arrows=_arrows(carried),
        board=_board(structure),
    )
    if job.simulate:
        fall = stacks.simulated(structure)
        verdict.stands, verdict.moved = fall.stands, min(fall.moved, 1e9)
        verdict.fallen = [parts[number] for number in fall.fallen if number in parts]
    verdict.text = _text(verdict, len(structure))
    send(verdict)
    return Answer()


def write(job: WriteFile) -> Answer:
    """Write boards with the pieces to cut (DXF, SVG) or a drawing of the assembly; other formats as for any scene."""
    if job.format not in ("dxf", "svg", "assembly"):
        return runs.write(job)
    folder = ensure_folder(Path(job.folder))
    structure = stacks.Structure.of(runs.sample(job.source, job.number))
    if job.format == "assembly":
        return Answer(path=str(stacks.assembly(structure).save(folder / "assembly.svg")[0]))
    sheet = stacks.cut_sheet(structure, board=job.board, kerf=job.kerf)
    paths = sheet.save(folder / f"boards.{job.format}")
    if len(paths) == 1:
        return Answer(path=str(paths[0]))
    place = folder / f"boards-{job.format}.zip"
    with zipfile.ZipFile(place, "w") as archive:
        for path in paths:
            archive.write(path, path.name)
    return Answer(path=str(place))


def is_structure(source: str, number: int) -> bool:
    """Whether a result is a structure: its model returns blocks and contacts."""
    value = runs.sample(source, number).value
    return hasattr(value, "blocks") and hasattr(value, "contacts")


def _tilt(balance: stacks.Balance) -> float:
    """Degrees by which the ground can be tilted; below 0 without a balance."""
    return math.degrees(math.atan(balance.margin)) if balance.holds else -1.0


def _tilt_of(sample: Sample) -> float:
    """Tilt of a result; lowest for a broken structure: a contact has vanished, or a block is inside out."""
    try:
        return _tilt(stacks.balanced(stacks.Structure.of(sample)))
    except FileError:
        return -2.0


def _note(tilt: float) -> str:
    return f"stands to {tilt:.1f}°" if tilt >= 0.0 else "falls"


def _text(verdict: Judged, count: int) -> str:
    """Describe the check in words."""
    if verdict.holds:
        text = f"Forces hold all {count} blocks until the ground is tilted by {verdict.tilt:.1f}°."
    else:
        text = f"No forces hold {len(verdict.loose) or 'all'} of its {count} blocks."
    if verdict.stands is None:
        return text
    if verdict.stands:
        much = percent(verdict.moved or 0.0)
        return f"{text} In five simulated seconds the farthest move of a block was {much} of its size."
    return f"{text} In five simulated seconds {len(verdict.fallen)} of its blocks fell."


def _upright(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn points from the axes of blocks (z up) to those of the scene (y up)."""
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([x, z, -y], axis=-1)


def _parts(structure: stacks.Structure, scene: Scene) -> dict[int, str]:
    """Find the part of the scene that shows each block, by its bounds."""
    boxes = []
    for part in scene.parts:
        corners = np.concatenate([shape.vertices() for shape in part.shapes])
        boxes.append((corners.min(axis=0), corners.max(axis=0), part.address))
    parts = {}
    for number, corners in enumerate(_upright(structure.corners)):
        low, high = corners.min(axis=0), corners.max(axis=0)
        near = 0.02 * float((high - low).max())
        for part_low, part_high, address in boxes:
            if np.abs(part_low - low).max() < near and np.abs(part_high - high).max() < near:
                parts[number] = address
                break
    return parts


def _arrows(carried: stacks.Carried) -> list[Arrow]:
    """Return the force of each contact on the body above."""
    arrows = []
    for at, force in zip(_upright(carried.points), _upright(carried.forces), strict=True):
        if np.linalg.norm(force) > SMALL:
            up = force if force[1] >= 0.0 else -force
            arrows.append(Arrow(tuple(at.tolist()), tuple(up.tolist())))
    return arrows


def _board(structure: stacks.Structure) -> float | None:
    """Thickness of a board from which all blocks can be cut, millimetres."""
    try:
        return stacks.cut_sheet(structure, (1e5, 1e5)).thickness
    except FileError:
        return None
