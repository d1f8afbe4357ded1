"""Drawings that are coloured: their regions and rules, colourings that differ, and what each keeps of the rules.

A drawing is chosen as models are: `drawing:house` for one of ours, `drawing:upload:SHA256.svg` for one that was sent.
A run of `niwaki.color.coloring` is stored as any other run, with the drawing and the rules beside it.
"""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from niwaki.color import Coloring, Drawing, Rules, agree, color, coloring, lab, painted, rules_of
from niwaki.color.drawing import OWN
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
    KeptRule,
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
    RulesAsk,
    ShowRun,
    WriteFile,
)
from niwaki.studio.worker import runs

#: What the references of drawings begin with, and those that were sent.
PREFIX, SENT = "drawing:", "upload:"
#: Pixels of the longer side: where an SVG is measured; of a picture in the gallery, on the page, in a file.
MEASURED, PICTURES, FILE = 640, {"light": 512, "fine": 1400}, 2048
#: What pixels of no region have in place of a region's number.
NOWHERE = 65535


class Told(msgspec.Struct):
    """What stands beside a run of colourings in its file."""

    drawing: str
    rules: dict[str, Any]


def is_drawing(reference: str) -> bool:
    """Whether a reference names a drawing."""
    return reference.startswith(PREFIX)


def listed() -> list[ModelInfo]:
    """Our own drawings."""
    names = sorted(place.stem for place in OWN.glob("*.svg"))
    return [ModelInfo(PREFIX + name, title=f"A {name} to colour.", kind="coloring") for name in names]


def loaded(job: Load) -> Answer:
    """A drawing with its regions, and the rules that come with it."""
    read = _drawing(job.reference, job.file)
    colors = _own_colors(read)
    regions = [
        RegionInfo(name, float(share), colors[name])
        for name, share in zip(read.names, read.areas, strict=True)
    ]
    title = "Your drawing." if SENT in job.reference else f"A {job.reference.removeprefix(PREFIX)} to colour."
    found = ModelInfo(job.reference, title, kind="coloring", regions=regions, rules=_asked(job.reference))
    return Answer(models=[found])


def ghost(job: Ghost, send: Any) -> Answer:
    """The region of each pixel; whether the rules can hold."""
    question = job.question
    read = _drawing(question.model, question.file)
    height, width = read.labels.shape
    numbers = np.where(read.labels < 0, NOWHERE, read.labels).astype("<u2")
    send(Regions(width=width, height=height), numbers.tobytes() + _png(read, {}, "light"))
    rules = _rules(question)
    rules.check(read.names)
    slack, forced = agree.least_slack(rules)
    if slack <= 0.5:
        return Answer()
    return Answer(note=f"Not all rules can hold; some will be {slack:.1f} units off: {'; '.join(forced)}.")


def grow(job: Grow, send: Any, check: Callable[[], None]) -> Answer:
    """Colourings that differ, with the colours of held regions."""
    question, begun = job.question, time.perf_counter()

    def progress(now: Progress) -> None:
        send(Progressed(job.id, now.done, None, time.perf_counter() - begun))
        check()

    read, rules, settings = _drawing(question.model, question.file), _rules(question), question.settings
    found = color(
        read,
        rules,
        settings.count,
        method=default_method(max(1, round(settings.count * settings.effort))),
        strictness=_weight(question),
        seed=job.seed,
        progress=progress,
    )
    for one in found:
        one.sample.seed = job.seed
    return _stored(found, question, job.run, job.file, "run", send, job.id)


def change(job: Change, send: Any) -> Answer:
    """A colouring with other colours of some regions, or with other rules: measured, and not searched for."""
    one, question = stored(job.source, job.number), job.question
    read = _drawing(question.model, question.file)
    colors = {name: job.changes.get(name, one.colors.get(name, "#808080")) for name in read.names}
    found = painted(read, _rules(question), colors, _weight(question))
    found.sample.seed = 0
    if not job.file:
        send(Picture(job.id, "moving", Key(job.run)), _png(read, colors, "light"))
        return Answer()
    return _stored([found], question, job.run, job.file, job.origin, send, job.id)


def hold(job: Hold) -> Answer:
    """The colours of regions, to hold them."""
    colors = stored(job.source, job.number).colors
    for name in job.parts:
        if name not in colors:
            raise InputError("no-part", pattern=name, name="the drawing", parts=", ".join(colors))
    return Answer(held=[HeldPart(name, {name: colors[name]}) for name in job.parts])


def describe(job: DescribeRun, send: Any) -> Answer:
    """The colours of a result, and how well it keeps each rule that is asked."""
    one, question = stored(job.source, job.number), job.question
    rules = _rules(question)
    # Rules that contradict one another were refused when they were asked; the result's own are shown.
    if set(one.colors) == set(_drawing(question.model, question.file).names) and not agree.contradiction(
        rules
    ):
        one = painted(one.drawing, rules, one.colors, _weight(question))
    rows = [
        KeptRule(row.rule.kind, row.rule.first, row.rule.second, str(row), row.holds, abs(row.residual))
        for row in one.kept
    ]
    send(Palette(job.id, job.key, one.colors, rows))
    return Answer()


def show(job: ShowRun, send: Any) -> Answer:
    """The drawing in the colours of a result."""
    one = stored(job.source, job.number)
    send(Picture(job.id, "result", job.key, job.detail), _png(one.drawing, one.colors, job.detail))
    return Answer()


def write(job: WriteFile) -> Answer:
    """Write a colouring as a picture, as an SVG, or its rules with the held colours."""
    one = stored(job.source, job.number)
    folder = ensure_folder(Path(job.folder))
    if job.format == "png":
        path, data = folder / "colouring.png", _bytes(one.image(FILE))
    elif job.format == "toml":
        path, data = folder / "rules.toml", one.rules.toml().encode()
    elif job.format == "json":
        path, data = folder / "run.json", Path(job.source).read_bytes()
    elif job.format == "svg" and one.drawing.artwork is not None:
        path, data = folder / "colouring.svg", one.drawing.artwork.painted(one.colors).encode()
    else:
        formats = "png, toml, json" if one.drawing.artwork is None else "png, svg, toml, json"
        raise InputError(
            "bad-setting", name="format", found=job.format, expected=f"one of {formats}", suggestion="png"
        )
    write_whole(path, data)
    return Answer(path=str(path))


def is_coloring(source: str) -> bool:
    """Whether the file of a run has colourings."""
    return "coloring" in run_files.load(source)


def stored(source: str, number: int) -> Coloring:
    """A colouring of a stored run."""
    try:
        with inside(".coloring"):
            told: Told = fitted(run_files.load(source)["coloring"], Told)
    except Unfit as error:
        raise InputError("bad-run-file", path=source, reason=str(error)) from error
    sent = Path(source).parents[1] / "uploads" / Path(told.drawing.removeprefix(PREFIX + SENT)).name
    read = _drawing(told.drawing, str(sent) if SENT in told.drawing else "")
    sample = runs.sample(source, number)
    try:
        values = np.array([list(value) for value in sample.value], dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != (len(read.names), 3) or not np.isfinite(values).all():
        reason = "its model returns no colours of the drawing's regions"
        raise InputError("bad-run-file", path=source, reason=reason)
    colors = {name: lab.hexed(value) for name, value in zip(read.names, values, strict=True)}
    return Coloring(read, Rules.of(told.rules), colors, sample, sample.search.args)


def _stored(
    found: list[Coloring], question: Question, run: int, file: str, origin: str, send: Any, job: int
) -> Answer:
    """Store colourings, and show them."""
    first = found[0]
    search = replace(first.sample.search, choices=None)
    samples = [one.sample for one in found]
    extra = {"coloring": {"drawing": question.model, "rules": _tables(question)}}
    reference = ModelReference(question.model, coloring)
    outcomes = runs.store(Result(search, samples, search.seed), reference, run, file, origin, extra)
    for one, outcome in zip(found, outcomes, strict=True):
        send(Picture(job, "result", outcome.key), _png(first.drawing, one.colors, "light"))
    return Answer(outcomes=[_noted(one, outcome) for one, outcome in zip(found, outcomes, strict=True)])


def _noted(one: Coloring, outcome: Outcome) -> Outcome:
    """The numbers of a colouring with how well it keeps its rules."""
    missed = sum(not row.holds for row in one.kept)
    count = len(one.kept)
    said = f"{count - missed} of {count} rules" if count else "no rules"
    return msgspec.structs.replace(outcome, note=said)


@lru_cache(maxsize=4)
def _drawing(reference: str, file: str = "") -> Drawing:
    """The drawing of a reference."""
    name = reference.removeprefix(PREFIX)
    if not file and not (OWN / f"{name}.svg").is_file():
        raise InputError("unknown-model", name=reference, reason="there is no such drawing")
    return Drawing.load(file or OWN / f"{name}.svg", MEASURED)


def _own_colors(read: Drawing) -> dict[str, str]:
    """The colour in which each region comes: the middle of its pixels."""
    height, width = read.labels.shape
    pixels = np.asarray(read.picture({}, max(width, height)).convert("RGB"))[:height, :width]
    found = {}
    for number, name in enumerate(read.names):
        own = pixels[read.labels == number]
        found[name] = lab.hexed(np.median(own, axis=0) / 255.0) if len(own) else "#808080"
    return found


def _asked(reference: str) -> RulesAsk:
    """The rules that come with a drawing."""
    usual = rules_of(reference.removeprefix(PREFIX))
    kinds: dict[Any, str] = CHAINS
    rules = [RuleAsk(kind, list(chain)) for kind, name in kinds.items() for chain in getattr(usual, name)] + [
        RuleAsk("muted", [name], most) for name, most in usual.muted.items()
    ]
    return RulesAsk(rules, usual.background)


def _tables(question: Question) -> dict[str, Any]:
    """The rules that are asked, as the tables of a TOML file, with the held colours."""
    asked = question.ask.rules or _asked(question.model)
    tables: dict[str, Any] = {} if asked.background is None else {"background": asked.background}
    for one in asked.rules:
        if one.kind == "muted":
            tables.setdefault("muted", {}).update(dict.fromkeys(one.regions, one.most))
        else:
            tables.setdefault(one.kind, []).append(list(one.regions))
    return {**tables, "held": dict(question.hold)}


def _rules(question: Question) -> Rules:
    return Rules.of(_tables(question))


def _weight(question: Question) -> float:
    return 100.0 if question.ask.rules is None else question.ask.rules.weight


def _png(read: Drawing, colors: Mapping[str, str], detail: str) -> bytes:
    return _bytes(read.picture(colors, PICTURES[detail]))


def _bytes(image: Any) -> bytes:
    out = io.BytesIO()
    image.save(out, "PNG", compress_level=1)
    return out.getvalue()
