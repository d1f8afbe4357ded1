"""Structures of blocks: found so that they balance, judged, and cut.

No search of scenes finds a balance: chains do that follow the slope of the model's log density (`niwaki.explore`).
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
from niwaki.studio.refused import Refused
from niwaki.studio.worker import jobs, models, runs, shapes, variety

#: Chains for each result: those are kept that stand most surely.
CHAINS = 2
#: The call whose choices are the forces between blocks (`niwaki.stacks`).
FORCES = "balance"
#: A force below this share of a block's mean weight is not shown.
SMALL = 1e-3


def grow(job: Grow, send: Any, check: Callable[[], None]) -> Answer:
    """Structures by chains from places of their own, those first whose ground can be tilted most."""
    question, begun = job.question, time.perf_counter()
    found, settings = models.reference(question.model), question.settings
    shown = [-math.inf]

    def progress(now: Progress) -> None:
        if now.sample is not None and now.sample.log_score > shown[0]:
            shown[0] = now.sample.log_score
            send(*shapes.shape(now.sample.scene, "light", what="best", id=job.id, key=Key(job.run)))
        best = shown[0] if math.isfinite(shown[0]) else None
        send(Progressed(job.id, now.done, best, time.perf_counter() - begun))
        check()

    drawn = nw.run(
        found.model,
        explore(draws=1, chains=max(1, round(CHAINS * settings.count * settings.effort))),
        seed=job.seed,
        hold=runs.given(question.hold) or None,
        progress=progress,
        **question.arguments,
    )
    tilts = sorted(((_tilt_of(one), -number) for number, one in enumerate(drawn)), reverse=True)
    kept = [drawn[-number] for _, number in tilts[: settings.count]]
    return _answered(Result(drawn.search, kept, job.seed), found, job, "run", send, drawn.interrupted)


def _answered(
    result: Result,
    found: ModelReference,
    job: Grow | Regrow,
    origin: str,
    send: Any,
    interrupted: bool = False,
) -> Answer:
    """Store results, show them, and say of each whether it stands."""
    if not result.samples:
        return Answer(interrupted=interrupted)
    outcomes = runs.store(result, found, job.run, job.file, origin)
    for one, outcome in zip(result.samples, outcomes, strict=True):
        send(*shapes.shape(one.scene, "light", what="result", id=job.id, key=outcome.key))
    noted = [
        replace(outcome, note=_said(_tilt_of(one)))
        for one, outcome in zip(result.samples, outcomes, strict=True)
    ]
    return Answer(outcomes=noted, interrupted=interrupted)


def change(job: Change, send: Any) -> Answer:
    """Run with the choices of a result, some of them changed, whether it then stands or not."""
    answer = jobs.change(job, send)
    return replace(
        answer,
        outcomes=[
            replace(one, note=_said(_tilt_of(runs.sample(job.file, one.key.number))))
            for one in answer.outcomes
        ],
    )


ghost = jobs.ghost


def regrow(job: Regrow, send: Any) -> Answer:
    """Grow a part again so that the whole balances: chains over its choices and the forces, with all others held."""
    found, one = models.reference(job.question.model), runs.sample(job.source, job.number)
    choices = one.held()
    own = {address for address in choices if address == job.part or address.startswith(f"{job.part}/")}
    held = {
        address: value
        for address, value in choices.items()
        if address not in own and FORCES not in address.split("/")
    }
    hold = {**held, **runs.given(job.question.hold)}
    if own <= set(hold):
        raise Refused("no-other-form", f"`{job.part}` has no choices of its own that are free")
    wanted = job.count if job.strength is None else 2 * job.count
    try:
        drawn = nw.run(
            found.model,
            explore(draws=1, chains=CHAINS * wanted),
            seed=job.seed,
            hold=hold,
            **job.question.arguments,
        )
    except NiwakiError as error:
        text = (
            f"`{job.part}` has no other form in which the structure balances, while the rest stays as it is"
        )
        raise Refused("no-other-form", text) from error
    standing = sorted(
        ((tilt, -number) for number, other in enumerate(drawn) if (tilt := _tilt_of(other)) >= 0.0),
        reverse=True,
    )
    samples = [drawn[-number] for _, number in standing[:wanted]]
    if not samples:
        raise Refused("no-other-form", f"in no other form that was tried of `{job.part}` does it balance")
    if job.strength is not None:
        samples = variety.ordered(one, samples, job.count, job.strength)
    return _answered(Result(drawn.search, samples, job.seed), found, job, "regrow", send)


def judge(job: JudgeRun, send: Any) -> Answer:
    """Whether a structure stands: what holds each block, and where it is let go, what falls."""
    one = runs.sample(job.source, job.number)
    if not is_structure(job.source, job.number):
        raise Refused("no-structure", "this result is no structure of blocks")
    structure = stacks.Structure.of(one)
    parts = _parts(structure, one.scene)
    balance, carried = stacks.balanced(structure), stacks.carried(structure)
    told = Judged(
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
        told.stands, told.moved = fall.stands, min(fall.moved, 1e9)
        told.fallen = [parts[number] for number in fall.fallen if number in parts]
    told.text = _text(told, len(structure))
    send(told)
    return Answer()


def write(job: WriteFile) -> Answer:
    """Boards with the pieces to cut (DXF, SVG), or a drawing of how they are put together; else as any scene."""
    if job.format not in ("dxf", "svg", "assembly"):
        return runs.write(job)
    folder = ensure_folder(Path(job.folder))
    structure = stacks.Structure.of(runs.sample(job.source, job.number))
    if job.format == "assembly":
        return Answer(path=str(stacks.assembly(structure).save(folder / "assembly.svg")[0]))
    sheet = stacks.cut_sheet(structure, board=job.board, kerf=job.kerf)
    written = sheet.save(folder / f"boards.{job.format}")
    if len(written) == 1:
        return Answer(path=str(written[0]))
    place = folder / f"boards-{job.format}.zip"
    with zipfile.ZipFile(place, "w") as together:
        for one in written:
            together.write(one, one.name)
    return Answer(path=str(place))


def is_structure(source: str, number: int) -> bool:
    """Whether a result is a structure: its model returns blocks and contacts."""
    value = runs.sample(source, number).value
    return hasattr(value, "blocks") and hasattr(value, "contacts")


def _tilt(balance: stacks.Balance) -> float:
    """Degrees by which the ground can be tilted; below 0 where there is no balance."""
    return math.degrees(math.atan(balance.margin)) if balance.holds else -1.0


def _tilt_of(one: Sample) -> float:
    """The same of a result; lowest where it is no structure any more: a contact has vanished, a block is inside out."""
    try:
        return _tilt(stacks.balanced(stacks.Structure.of(one)))
    except FileError:
        return -2.0


def _said(tilt: float) -> str:
    return f"stands to {tilt:.1f}°" if tilt >= 0.0 else "falls"


def _text(told: Judged, count: int) -> str:
    """What was found, in words."""
    if told.holds:
        text = f"Forces hold all {count} blocks until the ground is tilted by {told.tilt:.1f}°."
    else:
        text = f"No forces hold {len(told.loose) or 'all'} of its {count} blocks."
    if told.stands is None:
        return text
    if told.stands:
        much = 100.0 * (told.moved or 0.0)
        return f"{text} Let go for five seconds, no block moved by more than {much:.1f} % of its size."
    return f"{text} Let go for five seconds, {len(told.fallen)} of its blocks fell."


def _upright(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points as the scene has them: y up where blocks have z."""
    x, y, z = np.moveaxis(points, -1, 0)
    return np.stack([x, z, -y], axis=-1)


def _parts(structure: stacks.Structure, scene: Scene) -> dict[int, str]:
    """The part of the scene that shows each block: the one with its bounds."""
    boxes = []
    for part in scene.parts:
        corners = np.concatenate([shape.vertices() for shape in part.shapes])
        boxes.append((corners.min(axis=0), corners.max(axis=0), part.address))
    found = {}
    for number, corners in enumerate(_upright(structure.corners)):
        low, high = corners.min(axis=0), corners.max(axis=0)
        near = 0.02 * float((high - low).max())
        for part_low, part_high, address in boxes:
            if np.abs(part_low - low).max() < near and np.abs(part_high - high).max() < near:
                found[number] = address
                break
    return found


def _arrows(carried: stacks.Carried) -> list[Arrow]:
    """What each contact carries, on the body above."""
    arrows = []
    for at, force in zip(_upright(carried.points), _upright(carried.forces), strict=True):
        if np.linalg.norm(force) > SMALL:
            up = force if force[1] >= 0.0 else -force
            arrows.append(Arrow(tuple(at.tolist()), tuple(up.tolist())))
    return arrows


def _board(structure: stacks.Structure) -> float | None:
    """Thickness of the board of which all blocks can be cut, millimetres."""
    try:
        return stacks.cut_sheet(structure, (1e5, 1e5)).thickness
    except FileError:
        return None
