"""Drawings to colour: their regions and rules, colourings that differ, and reports on the rules.

A drawing has a reference, as a model has: `drawing:house` for a drawing of the package, `drawing:upload:SHA256.svg` for
an uploaded file. A run of `niwaki.color.coloring` is stored as any other run, with the drawing and the rules beside it.
"""

from __future__ import annotations

import io
import re
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from niwaki.color import Coloring, Drawing, Rules, color, coloring, consistency, lab, painted, rules_of
from niwaki.color.drawing import EXAMPLES
from niwaki.color.rules import CHAINS
from niwaki.color.search import default_method
from niwaki.errors import InputError
from niwaki.errors.files import ensure_folder, write_whole
from niwaki.errors.schema import Unfit, fitted, inside
from niwaki.result import Progress, Result
from niwaki.shell import run_files
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import (
    Answer,
    Change,
    DescribeRun,
    Ghost,
    Grow,
    HeldPart,
    Hold,
    Key,
    Load,
    ModelInfo,
    Outcome,
    Palette,
    Picture,
    Progressed,
    Question,
    RegionInfo,
    Regions,
    RuleAsk,
    RuleResult,
    RulesAsk,
    ShowRun,
    WriteFile,
)
from niwaki.studio.problems import CommandError
from niwaki.studio.worker import pictures, runs

#: The prefix of references of drawings, and the prefix of uploaded files after it.
PREFIX, UPLOAD = "drawing:", "upload:"
#: Pixels of the longer side: of a measured SVG; of a picture in the gallery and on the page; of a file.
MEASURED, PICTURES, FILE = 640, {"light": 512, "fine": 1400}, 2048
#: The number of pixels without a region.
NOWHERE = 65535


class Source(msgspec.Struct):
    """The drawing and the rules of a run, stored in its file."""

    drawing: str
    rules: dict[str, Any]


def is_drawing(reference: str) -> bool:
    """Whether a reference names a drawing."""
    return reference.startswith(PREFIX)


def listed() -> list[ModelInfo]:
    """List the drawings of the package."""
    names = sorted(place.stem for place in EXAMPLES.glob("*.svg"))
    return [ModelInfo(PREFIX + name, title=f"A {name} to colour.", kind="coloring") for name in names]


def loaded(job: Load) -> Answer:
    """Load a drawing: its regions and its usual rules."""
    drawing = _drawing(job.reference, job.file)
    colors = _original_colors(drawing)
    regions = [
        RegionInfo(name, float(share), colors[name])
        for name, share in zip(drawing.names, drawing.areas, strict=True)
    ]
    title = (
        "Your drawing." if UPLOAD in job.reference else f"A {job.reference.removeprefix(PREFIX)} to colour."
    )
    model = ModelInfo(
        job.reference, title, kind="coloring", regions=regions, rules=_usual_rules(job.reference)
    )
    return Answer(models=[model])


def ghost(job: Ghost, send: Any) -> Answer:
    """Send the region of each pixel, and warn of rules that cannot all hold."""
    question = job.question
    drawing = _drawing(question.model, question.file)
    height, width = drawing.labels.shape
    numbers = np.where(drawing.labels < 0, NOWHERE, drawing.labels).astype("<u2")
    send(Regions(width=width, height=height), numbers.tobytes() + _png(drawing, {}, "light"))
    rules = _rules(question)
    rules.check(drawing.names)
    slack, forced = consistency.least_slack(rules)
    if slack <= 0.5:
        return Answer()
    return Answer(note=f"Not all rules can hold; some rules miss by {slack:.1f} units: {'; '.join(forced)}.")


def grow(job: Grow, send: Any, check: Callable[[], None]) -> Answer:
    """Search for colourings that differ, with the colours of held regions."""
    question, start = job.question, time.perf_counter()

    def progress(now: Progress) -> None:
        send(Progressed(job.id, now.done, None, time.perf_counter() - start))
        check()

    drawing, rules, settings = _drawing(question.model, question.file), _rules(question), question.settings
    colorings = color(
        drawing,
        rules,
        settings.count,
        method=default_method(max(1, round(settings.count * settings.effort))),
        strictness=_weight(question),
        seed=job.seed,
        progress=progress,
    )
    for each in colorings:
        each.sample.seed = job.seed
    return _stored(colorings, question, job.run, job.file, "run", send, job.id)


def change(job: Change, send: Any) -> Answer:
    """Measure a colouring with other colours of some regions or with other rules, without a search."""
    original, question = stored(job.source, job.number), job.question
    drawing = _drawing(question.model, question.file)
    for value in job.changes.values():
        if not isinstance(value, str) or re.fullmatch("#[0-9a-fA-F]{6}", value) is None:
            raise CommandError("bad-color", f"{value!r} is not a colour: write `#rrggbb`")
    colors = {name: job.changes.get(name, original.colors.get(name, "#808080")) for name in drawing.names}
    coloring_ = painted(drawing, _rules(question), colors, _weight(question))
    coloring_.sample.seed = 0
    if not job.file:
        send(Picture(job.id, "moving", Key(job.run)), _png(drawing, colors, "light"))
        return Answer()
    return _stored([coloring_], question, job.run, job.file, job.origin, send, job.id)


def hold(job: Hold) -> Answer:
    """Return the colours of regions, to hold them."""
    colors = stored(job.source, job.number).colors
    for name in job.parts:
        if name not in colors:
            raise InputError(
                "no-part", pattern=name, name="the drawing", parts=f"its regions are {', '.join(colors)}"
            )
    return Answer(held=[HeldPart(name, {name: colors[name]}) for name in job.parts])


def describe(job: DescribeRun, send: Any) -> Answer:
    """Send the colours of a result, and how well it keeps each of the present rules."""
    result, question = stored(job.source, job.number), job.question
    rules = _rules(question)
    names = _drawing(question.model, question.file).names
    # Contradictory rules have given an error before; then the report is on the result's own rules.
    if set(result.colors) == set(names) and not consistency.contradiction(rules):
        result = painted(result.drawing, rules, result.colors, _weight(question))
    rows = [
        RuleResult(row.rule.kind, row.rule.first, row.rule.second, str(row), row.holds, abs(row.residual))
        for row in result.report
    ]
    send(Palette(job.id, job.key, result.colors, rows))
    return Answer()


def show(job: ShowRun, send: Any) -> Answer:
    """Send the drawing in the colours of a result."""
    result = stored(job.source, job.number)
    if job.detail == "picture":
        send(Picture(job.id, key=job.key), pictures.small(lambda size: result.image(max(size))))
    else:
        send(Picture(job.id, "result", job.key, job.detail), _png(result.drawing, result.colors, job.detail))
    return Answer()


def write(job: WriteFile) -> Answer:
    """Write a file: a colouring as a picture or an SVG, its run, or its rules with the held colours."""
    result = stored(job.source, job.number)
    folder = ensure_folder(Path(job.folder))
    if job.format == "png":
        path, data = folder / "colouring.png", _bytes(result.image(FILE))
    elif job.format == "toml":
        path, data = folder / "rules.toml", result.rules.toml().encode()
    elif job.format == "json":
        path, data = folder / "run.json", Path(job.source).read_bytes()
    elif job.format == "svg" and result.drawing.artwork is not None:
        path, data = folder / "colouring.svg", result.drawing.artwork.painted(result.colors).encode()
    else:
        formats = "png, toml, json" if result.drawing.artwork is None else "png, svg, toml, json"
        raise InputError(
            "bad-setting", name="format", found=job.format, expected=f"one of {formats}", suggestion="png"
        )
    write_whole(path, data)
    return Answer(path=str(path))


def is_coloring(source: str) -> bool:
    """Whether the run of a file has colourings."""
    return "coloring" in run_files.load(source)


def stored(source: str, number: int) -> Coloring:
    """Read a colouring of a stored run."""
    try:
        with inside(".coloring"):
            origin: Source = fitted(run_files.load(source)["coloring"], Source)
    except Unfit as error:
        raise InputError("bad-run-file", path=source, reason=str(error)) from error
    upload = Path(source).parents[1] / "uploads" / Path(origin.drawing.removeprefix(PREFIX + UPLOAD)).name
    drawing = _drawing(origin.drawing, str(upload) if UPLOAD in origin.drawing else "")
    sample = runs.sample(source, number)
    try:
        values = np.array([list(value) for value in sample.value], dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != (len(drawing.names), 3) or not np.isfinite(values).all():
        reason = "its model returns no colours of the drawing's regions"
        raise InputError("bad-run-file", path=source, reason=reason)
    colors = {name: lab.hexed(value) for name, value in zip(drawing.names, values, strict=True)}
    return Coloring(drawing, Rules.of(origin.rules), colors, sample, sample.search.args)


def _stored(
    colorings: list[Coloring], question: Question, run: int, file: str, origin: str, send: Any, job: int
) -> Answer:
    """Store colourings, and send their pictures."""
    first = colorings[0]
    search = replace(first.sample.search, choices=None)
    samples = [each.sample for each in colorings]
    extra = {"coloring": {"drawing": question.model, "rules": _tables(question)}}
    reference = ModelReference(question.model, coloring)
    outcomes = runs.store(Result(search, samples, search.seed), reference, run, file, origin, extra)
    for each, outcome in zip(colorings, outcomes, strict=True):
        send(Picture(job, "result", outcome.key), _png(first.drawing, each.colors, "light"))
    return Answer(outcomes=[_noted(each, outcome) for each, outcome in zip(colorings, outcomes, strict=True)])


def _noted(result: Coloring, outcome: Outcome) -> Outcome:
    """Add a note to an outcome: how many rules the colouring keeps."""
    missed = sum(not row.holds for row in result.report)
    count = len(result.report)
    note = f"{count - missed} of {count} rules" if count else "no rules"
    return msgspec.structs.replace(outcome, note=note)


@lru_cache(maxsize=4)
def _drawing(reference: str, file: str = "") -> Drawing:
    """Load the drawing of a reference."""
    name = reference.removeprefix(PREFIX)
    if not file and not (EXAMPLES / f"{name}.svg").is_file():
        raise InputError("unknown-model", name=reference, reason="there is no such drawing")
    return Drawing.load(file or EXAMPLES / f"{name}.svg", MEASURED)


def _original_colors(drawing: Drawing) -> dict[str, str]:
    """Measure the colour of each region in the file: the median of its pixels."""
    height, width = drawing.labels.shape
    pixels = np.asarray(drawing.picture({}, max(width, height)).convert("RGB"))[:height, :width]
    colors = {}
    for number, name in enumerate(drawing.names):
        region = pixels[drawing.labels == number]
        colors[name] = lab.hexed(np.median(region, axis=0) / 255.0) if len(region) else "#808080"
    return colors


def _usual_rules(reference: str) -> RulesAsk:
    """Return the rules that come with a drawing."""
    usual = rules_of(reference.removeprefix(PREFIX))
    kinds: dict[Any, str] = CHAINS
    rules = [RuleAsk(kind, list(chain)) for kind, name in kinds.items() for chain in getattr(usual, name)] + [
        RuleAsk("muted", [name], most) for name, most in usual.muted.items()
    ]
    return RulesAsk(rules, usual.background)


def _tables(question: Question) -> dict[str, Any]:
    """Write the present rules as the tables of a TOML file, with the held colours."""
    ask = question.ask.rules or _usual_rules(question.model)
    tables: dict[str, Any] = {} if ask.background is None else {"background": ask.background}
    for rule in ask.rules:
        if rule.kind == "muted":
            tables.setdefault("muted", {}).update(dict.fromkeys(rule.regions, rule.most))
        else:
            tables.setdefault(rule.kind, []).append(list(rule.regions))
    return {**tables, "held": dict(question.hold)}


def _rules(question: Question) -> Rules:
    return Rules.of(_tables(question))


def _weight(question: Question) -> float:
    return 100.0 if question.ask.rules is None else question.ask.rules.weight


def _png(drawing: Drawing, colors: Mapping[str, str], detail: str) -> bytes:
    return _bytes(drawing.picture(colors, PICTURES[detail]))


def _bytes(image: Any) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG", compress_level=1)
    return out.getvalue()
