"""Stored results: replayed from the file of their run, then described, held, shown or written."""

from __future__ import annotations

import json
from collections import OrderedDict
from pathlib import Path
from typing import Any

import niwaki as nw
from niwaki.errors.files import ensure_folder, write_whole
from niwaki.requirements import Keep
from niwaki.result import Result, Sample
from niwaki.search.data import Reader, Writer
from niwaki.shell import requirements, run_files
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
    Picture,
    Place,
    ShowRun,
    WriteFile,
)
from niwaki.studio.problems import CommandError
from niwaki.studio.worker import asks, models, permissions, pictures, shapes
from niwaki.studio.worker.places import PlaceRecorder, record, slider

#: Results that are kept in memory.
CACHE = 64

_samples: OrderedDict[tuple[str, int], Sample] = OrderedDict()


def sample(source: str, number: int) -> Sample:
    """Replay a result of a stored run."""
    key = source, number
    if key not in _samples:
        data = run_files.load(source)
        _samples[key] = run_files.replayed(data, number, permissions.modules(data))
        _samples[key].seed = data["runs"][number].get("seed", 0)
        if len(_samples) > CACHE:
            _samples.popitem(last=False)
    _samples.move_to_end(key)
    return _samples[key]


def store(
    result: Result,
    model: ModelReference,
    run: int,
    file: str,
    origin: str,
    beside: dict[str, Any] | None = None,
) -> list[Outcome]:
    """Write a run, with further tables beside it, and describe its results."""
    data = {**run_files.written(result, model), **(beside or {})}
    for number, result_sample in enumerate(result.samples):
        _samples[file, number] = result_sample
    _save(Path(file), data)
    rules = requirements.beside(model)
    return [outcome(each, Key(run, number), origin, rules) for number, each in enumerate(result.samples)]


def outcome(result: Sample, key: Key, origin: str, rules: Keep | None = None) -> Outcome:
    """Describe a result for the gallery, with the requirements beside its model that it does not keep."""
    numbers = run_files.numbers(result)
    shares = {name: numbers[name] for name in ("similarity", "covered", "outside")}
    return Outcome(
        key,
        numbers["log_score"],
        primitives=result.primitives,
        seed=result.seed,
        origin=origin,
        unmet=[] if rules is None else rules.unmet(result),
        **shares,
    )


def values(choices: Choices) -> dict[str, Any]:
    """Read values of choices from plain data."""
    read = Reader()
    return {address: read(value) for address, value in choices.items()}


def hold(job: Hold) -> Answer:
    """Return the choices that hold parts of a result."""
    result, write = sample(job.source, job.number), Writer()
    held = [
        HeldPart(part, {address: write(value) for address, value in result.held(part).items()})
        for part in job.parts
    ]
    return Answer(held=held)


def describe(job: DescribeRun, send: Any) -> Answer:
    """Send the choices and parts of a result, with their places in the source."""
    result = sample(job.source, job.number)
    choices, families, options = result.choices, result.families, result.options
    try:
        model = models.reference(job.question.model).model
        recorder, labels = record(model, asks.arguments(job.question), choices), model.labels
    except CommandError:
        # Without permission to run the model's file there are no lines and sliders.
        recorder, labels = PlaceRecorder({}), result.search.model.labels
    infos = []
    for address, value in choices.items():
        if families[address] == "delta":
            continue
        named = list(options.get(address, ()))
        reach = None if named else slider(recorder.distributions.get(address), value)
        low, high, whole = reach or (None, None, False)
        infos.append(
            ChoiceInfo(
                address,
                families[address],
                shown(value),
                named,
                low,
                high,
                whole,
                _place(recorder.places.get(address)),
            )
        )
    parts = [PartInfo(part.address, _place(recorder.places.get(part.address))) for part in result.parts]
    addresses = [*choices, *(part.address for part in parts)]
    send(Described(job.id, job.key, infos, parts, labels.tree(addresses)))
    return Answer()


def shown(value: Any) -> Any:
    """Return a value as the page shows it."""
    return value if isinstance(value, bool | int | float) else str(value)


def _place(span: Any) -> Place | None:
    return (
        None
        if span is None
        else Place(span.file.path, span.line, span.column, span.end_line, span.end_column)
    )


def show(job: ShowRun, send: Any) -> Answer:
    """Send the shape of a result."""
    result = sample(job.source, job.number)
    if job.detail == "picture":
        style = run_files.style(run_files.load(job.source), result)
        send(Picture(job.id, key=job.key), pictures.result(result, style))
        return Answer()
    header, payload = shapes.shape(
        result.scene, job.detail, role="result", key=job.key, id=job.id, is_flat=is_flat(result)
    )
    send(header, payload)
    return Answer()


def is_flat(result: Sample) -> bool:
    """Whether a result is a drawing in the plane."""
    return result.search.score.window is not None


def write(job: WriteFile) -> Answer:
    """Write a result as a file. Its recipe is the file of its run, with this result as the best."""
    folder = ensure_folder(Path(job.folder))
    data: dict[str, Any] = run_files.load(job.source)
    data["best"] = job.number
    if job.format == "json":
        return Answer(path=str(_save(folder / "run.json", data)))
    result: nw.Sample = sample(job.source, job.number)
    style = run_files.style(data, result)
    path = folder / f"best.{job.format}"
    if job.format == "png":
        styled: dict[str, Any] = {} if style is None else {"style": style, "size": (800, 800)}
        result.save(path, **styled)
    else:
        result.export(path, scale=job.scale, style=style if job.format == "svg" else None)
    # The recipe beside the file tells how the file was made.
    _save(folder / "run.json", data)
    return Answer(path=str(path))


def _save(path: Path, data: dict[str, Any]) -> Path:
    """Write a run, completely or not at all."""
    return write_whole(path, (json.dumps(data, indent=1, allow_nan=False) + "\n").encode())
