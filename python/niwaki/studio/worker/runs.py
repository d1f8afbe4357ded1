"""Results that are stored: replayed from the file of their run, and described, held, shown or written."""

from __future__ import annotations

import json
from collections import OrderedDict
from pathlib import Path
from typing import Any

import niwaki as nw
from niwaki.errors.files import ensure_folder, write_whole
from niwaki.result import Result, Sample
from niwaki.search.data import Reader, Writer
from niwaki.shell import run_files
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import (
    Answer,
    ChoiceInfo,
    Choices,
    Described,
    DescribeRun,
    HeldPart,
    Hold,
    Key,
    Outcome,
    PartInfo,
    Place,
    ShowRun,
    WriteFile,
)
from niwaki.studio.refused import Refused
from niwaki.studio.worker import allowed, asks, models, shapes
from niwaki.studio.worker.places import Noting, noted, slider

#: Results that are kept ready.
KEPT = 64

_samples: OrderedDict[tuple[str, int], Sample] = OrderedDict()


def sample(source: str, number: int) -> Sample:
    """A result of a stored run."""
    key = source, number
    if key not in _samples:
        data = run_files.load(source)
        _samples[key] = run_files.replayed(data, number, allowed.modules(data))
        _samples[key].seed = data["runs"][number].get("seed", 0)
        if len(_samples) > KEPT:
            _samples.popitem(last=False)
    _samples.move_to_end(key)
    return _samples[key]


def store(
    result: Result,
    found: ModelReference,
    run: int,
    file: str,
    origin: str,
    beside: dict[str, Any] | None = None,
) -> list[Outcome]:
    """Write a run, with what else belongs to it, and name its results."""
    data = {**run_files.written(result, found), **(beside or {})}
    for number, one in enumerate(result.samples):
        _samples[file, number] = one
    _saved(Path(file), data)
    return [outcome(one, Key(run, number), origin) for number, one in enumerate(result.samples)]


def outcome(one: Sample, key: Key, origin: str) -> Outcome:
    """The numbers of a result."""
    numbers = run_files.numbers(one)
    shares = {name: numbers[name] for name in ("similarity", "covered", "outside")}
    return Outcome(
        key, numbers["log_score"], primitives=one.primitives, seed=one.seed, origin=origin, **shares
    )


def given(choices: Choices) -> dict[str, Any]:
    """Values of choices from plain data."""
    read = Reader()
    return {address: read(value) for address, value in choices.items()}


def hold(job: Hold) -> Answer:
    """The choices that hold parts of a result."""
    one, write = sample(job.source, job.number), Writer()
    held = [
        HeldPart(part, {address: write(value) for address, value in one.held(part).items()})
        for part in job.parts
    ]
    return Answer(held=held)


def describe(job: DescribeRun, send: Any) -> Answer:
    """The choices and parts of a result, with places in the source."""
    one = sample(job.source, job.number)
    choices, families = one.choices, one.families
    try:
        model = models.reference(job.question.model).model
        seen = noted(model, asks.arguments(job.question), choices)
    except Refused:
        # The file of the model may not be run: without lines and sliders.
        seen = Noting({})
    infos = []
    for address, value in choices.items():
        if families[address] == "delta":
            continue
        reach = slider(seen.distributions.get(address), value)
        low, high, whole = reach or (None, None, False)
        infos.append(
            ChoiceInfo(
                address, families[address], shown(value), low, high, whole, _place(seen.places.get(address))
            )
        )
    parts = [PartInfo(part.address, _place(seen.places.get(part.address))) for part in one.parts]
    send(Described(job.id, job.key, infos, parts))
    return Answer()


def shown(value: Any) -> Any:
    """A value as a page shows it."""
    return value if isinstance(value, bool | int | float) else str(value)


def _place(span: Any) -> Place | None:
    return (
        None
        if span is None
        else Place(span.file.path, span.line, span.column, span.end_line, span.end_column)
    )


def show(job: ShowRun, send: Any) -> Answer:
    """The shape of a result."""
    one = sample(job.source, job.number)
    header, payload = shapes.shape(
        one.scene, job.detail, what="result", key=job.key, id=job.id, is_flat=is_flat(one)
    )
    send(header, payload)
    return Answer()


def is_flat(one: Sample) -> bool:
    """Whether it is a drawing in the plane."""
    return one.search.score.window is not None


def write(job: WriteFile) -> Answer:
    """Write a result as a file; its recipe is the file of its run, with this result as the best."""
    folder = ensure_folder(Path(job.folder))
    data: dict[str, Any] = run_files.load(job.source)
    data["best"] = job.number
    if job.format == "json":
        return Answer(path=str(_saved(folder / "run.json", data)))
    one: nw.Sample = sample(job.source, job.number)
    style = run_files.style(data, one)
    path = folder / f"best.{job.format}"
    if job.format == "png":
        styled: dict[str, Any] = {} if style is None else {"style": style, "size": (800, 800)}
        one.save(path, **styled)
    else:
        one.export(path, scale=job.scale, style=style if job.format == "svg" else None)
    # The recipe lies beside it, so that the folder explains itself.
    _saved(folder / "run.json", data)
    return Answer(path=str(path))


def _saved(path: Path, data: dict[str, Any]) -> Path:
    """Write a run, completely or not at all."""
    return write_whole(path, (json.dumps(data, indent=1, allow_nan=False) + "\n").encode())
