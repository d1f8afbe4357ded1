"""Searches by an emulator (`emulate`): the choices of a model as the parameters of a space.

A few runs at random show the choices of a model, their distributions, and whether they come before its scene. The
engine's proposer then asks for points of the space, and is told what each run gets wrong. A choice that a run does not
make is unused there; one that no earlier run showed is drawn from its prior.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from json import dumps
from math import inf, isfinite
from typing import Any

import numpy as np

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.errors import InputError, NiwakiError
from niwaki.lang.compiled import translated
from niwaki.methods import Emulate
from niwaki.result.invalid import Invalid
from niwaki.result.progress import EngineWatch
from niwaki.result.sample import place
from niwaki.result.search_like import SearchLike
from niwaki.search.space import Parameter, Space
from niwaki.targets.differences import Differences, differences

#: Runs at random that show the choices of a model; they are the first of the search.
RUNS = 8

#: The most choices that an emulator learns.
MOST = 200

#: With fewer choices a population of particles is enough.
FEW = 4


class Unsuited(Exception):
    """A model that an emulator cannot learn; its text is the reason."""


@dataclass(frozen=True)
class Structure:
    """The choices of a model, as a few runs show them.

    Attributes
    ----------
    space : Space
        Its choices by address.
    traces : dict of int to Trace
        The runs by their numbers, without those that were invalid.
    is_dear : bool
        Whether a host function is called before every part.
    is_apart : bool
        Whether all choices come before the first part, factor or observation.
    """

    space: Space
    traces: Mapping[int, _engine.Trace]
    is_dear: bool
    is_apart: bool


def structure(search: SearchLike, task: _engine.Task, seed: int, runs: int = RUNS) -> Structure:
    """Return the choices of a model, from runs at random of its task.

    Raises
    ------
    Unsuited
        A distribution differs from run to run or draws rows of numbers; there are no choices, or too many.
    """
    traces: dict[int, _engine.Trace] = {}
    with translated(search.model.name, f"seed={seed}", model=search.model):
        for number in range(runs):
            try:
                traces[number] = task.replay({}, _seed(seed, number))
            except _engine.EngineFault as fault:
                # A fault in every run is a fault of the model.
                if not fault.invalid or (number == runs - 1 and not traces):
                    raise
    parameters: dict[str, Parameter] = {}
    for trace in traces.values():
        for choice in _free(search, trace):
            range_ = _range(choice)
            first = parameters.setdefault(choice.path, Parameter(range_))
            if first.range != range_:
                raise Unsuited(f"the range of its choice `{choice.path}` differs from run to run")
    if not parameters:
        raise Unsuited("it makes no choice")
    if len(parameters) > MOST:
        raise Unsuited(
            f"its first {runs} runs make {len(parameters)} different choices, and {MOST} are the most"
        )
    try:
        space = Space(parameters)
    except InputError as error:
        raise Unsuited(
            f"its choice `{error.values['name']}` draws no single number, truth value or word"
        ) from error
    emits = [trace for trace in traces.values() if trace.parts]
    return Structure(
        space,
        traces,
        bool(emits) and all(trace.hosted == len(trace.parts) for trace in emits),
        all(choice.barriers == 0 for trace in traces.values() for choice in _free(search, trace)),
    )


def suits(search: SearchLike) -> bool:
    """Whether an emulator should search a model: by its program alone.

    A host function before every part makes runs dear. Where all choices come before the scene, particles cannot be
    compared before their end.
    """
    if _text_has_factors(search) or not differences(search.score)[0]:
        return False
    try:
        shown = structure(search, search.task.uncounted(), search.seed, 4)
    except (Unsuited, NiwakiError):
        # The search itself tells what is wrong with the model.
        return False
    return (shown.is_dear or shown.is_apart) and len(shown.space.axes) >= FEW


def check(search: SearchLike) -> None:
    """Refuse a search that no emulator can do.

    Raises
    ------
    InputError
        `no-emulator`: with the reason.
    """
    _known(search, search.task.uncounted(), search.seed)


def _known(search: SearchLike, task: _engine.Task, seed: int) -> tuple[list[Differences], Structure]:
    """Return what a scene can get wrong, and the choices of the model."""
    parts, _ = differences(search.score)
    reason = "its score has nothing to learn from but one number: no volume, image, obstacle or box"
    try:
        if parts:
            return parts, structure(search, task, seed)
    except Unsuited as error:
        reason = str(error)
    raise InputError("no-emulator", name=search.model.name, reason=reason)


@dataclass
class Emulated:
    """The runs of a search by an emulator.

    Attributes
    ----------
    runs : list of Run
        The runs in the order of asking, without those that were invalid.
    numbers : list of int
        Their numbers among all runs.
    interrupted : bool
        Whether Ctrl-C ended the search.
    invalid : tuple of Invalid
        The invalid runs by place.
    choices : int
        The number of choices that it searched.
    evaluations : int
        The number of all runs.
    """

    runs: list[_engine.Run]
    numbers: list[int]
    interrupted: bool
    invalid: tuple[Invalid, ...]
    choices: int
    evaluations: int


def emulated(search: SearchLike, seed: int, watch: EngineWatch) -> Emulated:
    """Search by an emulator; the runs are in the order of asking.

    Raises
    ------
    InputError
        `no-emulator`: the emulator cannot learn the model.
    """
    assert isinstance(search.method, Emulate)
    task = search.task.uncounted()
    parts, shown = _known(search, task, seed)
    space = shown.space
    proposer = _engine.Proposer(dumps(space.data()), seed)
    known: dict[tuple[float, ...], _engine.Trace] = {}
    for first in list(shown.traces.values())[::-1]:
        row = proposer.snap(_row(space, search, first))[0]
        known[tuple(row)] = first
        proposer.suggest(row)
    out = Emulated([], [], False, (), len(space.axes), 0)
    best: _engine.Run | None = None
    try:
        for number in range(search.method.evaluations):
            point = proposer.ask()
            if point is None:
                # All points of the space are known.
                break
            row, used = point
            values = space.values(row, used)
            out.evaluations += 1
            trace = known.get(tuple(row)) or _valid(search, task, values, _seed(seed, RUNS + number))
            if trace is None:
                proposer.tell(-inf, None)
                continue
            addresses = {choice.path for choice in trace.choices}
            run, score = trace.run, trace.run.log_score
            if not isfinite(trace.run.log_prior):
                score = -inf
            proposer.tell(score, _features(parts, trace), [name in addresses for name in space.names])
            out.runs.append(run)
            out.numbers.append(number)
            if best is None or score > best.log_score:
                best = run
            watch(number + 1, number + 1, best.log_score, best)
    except KeyboardInterrupt:
        if not out.runs:
            raise
        out.interrupted = True
    out.invalid = tuple(Invalid(*fields) for fields in task.invalid())
    return out


def _features(parts: Sequence[Differences], trace: _engine.Trace) -> Any:
    """Return what the scene of a run gets wrong."""
    shapes = [shape for _, some in trace.parts for shape in some]
    scene = Scene(trace.parts)
    return np.concatenate([part(shapes, scene) for part in parts]).astype(np.float32)


def _valid(
    search: SearchLike, task: _engine.Task, values: Mapping[str, Any], seed: int
) -> _engine.Trace | None:
    """Make a run with some values, and draw what they lack by the seed; None for an invalid run."""
    with translated(search.model.name, f"seed={seed}", model=search.model):
        try:
            return task.replay(dict(values), seed)
        except _engine.EngineFault as fault:
            if not fault.invalid:
                raise
    return None


def _seed(seed: int, number: int) -> int:
    """Return the seed of a run of a search."""
    return (seed * 0x9E3779B97F4A7C15 + number) % 2**64


def _free(search: SearchLike, trace: _engine.Trace) -> list[_engine.Choice]:
    """The choices that could have another value."""
    return [choice for choice in trace.choices if choice.family != "delta" and choice.path not in search.held]


def _range(choice: _engine.Choice) -> Any:
    """Return the range of a choice: its distribution, or its words."""
    if choice.words is not None and choice.family == "discrete_uniform":
        return tuple(choice.words)
    return choice.distribution


def _place(choice: _engine.Choice) -> Any:
    """Return the value of a choice in its range: words with weights are numbered."""
    return choice.value if choice.family == "discrete_uniform" else place(choice)


def _row(space: Space, search: SearchLike, trace: _engine.Trace) -> list[float]:
    """Return the row of a run; the middle for what it does not choose."""
    values = {choice.path: _place(choice) for choice in _free(search, trace)}
    return [axis.place(values[axis.name]) if axis.name in values else 0.5 for axis in space.axes]


def _text_has_factors(search: SearchLike) -> bool:
    """Whether the model scores its own runs: an emulator sees the sum of such scores alone."""
    text = search.model.core().text
    return any(f"({word} " in text for word in ("factor", "observe", "condition"))
