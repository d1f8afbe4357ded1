"""Changes of a model's file: numbers that explain a drag, defaults or literals; and arguments as defaults.

The program is recorded with each real number of the model's file as a movable number, and with fixed choices. A choice
keeps its place in its distribution (`crates/grad/src/positions.rs`), so the mean of a `gaussian` can explain a value
that has moved. Each number is tried alone, and the numbers of one tuple together.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import niwaki
from niwaki import _engine
from niwaki.errors.source import SourceFile, Span, find_function, span_of
from niwaki.inputs.changes import Edit, FileChange
from niwaki.lang.compiled import compile_core, translated
from niwaki.lang.lower import lower
from niwaki.result.search_like import SearchLike

if TYPE_CHECKING:
    from niwaki.lang.models import Model
    from niwaki.search.drag.held import Held, Vector

#: The most steps of a descent, and the most numbers that are tried, those that move the point most.
STEPS, TRIED = 12, 24
#: A part is at the goal if its distance is less than this share of the scene's size.
NEAR = 0.01
#: The digits of a number in an edit.
DIGITS = 4


@dataclass(frozen=True)
class SourceChange(FileChange):
    """Change of a model's file.

    Attributes
    ----------
    share : float
        The distance to the goal of a drag, as a share of the scene's size.
    choices : dict
        Choices that keep their places in distributions that have changed, with their values.
    arguments : dict
        Arguments whose defaults have changed, by name.
    """

    share: float
    choices: dict[str, float]
    arguments: dict[str, Any]


@dataclass
class _Number:
    """Number of the source: its key for the engine, its place and its value."""

    kind: str
    key: int
    span: Span
    value: float
    name: str = ""


def explained(held: Held, goal: Vector, most: int = 3) -> list[SourceChange]:
    """List changes of the model's file that take the held point to a goal, the least change first."""
    model = held.search.model
    source = _source(model)
    if source is None:
        return []
    file, node, text = source
    core = lower(model.function, lifts=True)
    numbers = [
        _Number("constants", key, span, core.constants[key])
        for key, span in core.lifted.items()
        if span.file == file
    ]
    args = _arguments(held.search)
    numbers += [
        _Number("arguments", place, span_of(default, file), args[place], name)
        for place, name, default in _defaults(node)
        if place < len(args) and isinstance(args[place], float) and _value(default) == args[place]
    ]
    with translated(model.name):
        task = _engine.Task(compile_core(core), args)
        if held.search.held:
            task = task.holding(held.search.held)
        placer = task.placer(held.start.trace.run)
        descent = _Descent(held, placer, goal)
        start = descent.look(numbers, [number.value for number in numbers], {})
        reach = {} if start is None else dict(enumerate(np.linalg.norm(start.slopes, axis=0).tolist()))
        moving = [numbers[k] for k in sorted(reach, key=lambda k: -reach[k]) if reach[k] > 0][:TRIED]
        groups = [[number] for number in moving] + list(_together(moving, ast.parse(text)))
        changes = [
            change for group in groups if (change := descent.change(group, file.path, text)) is not None
        ]
    # A group in which one number changes equals the group of that number.
    distinct = {change.edits: change for change in reversed(changes) if change.edits}
    return sorted(distinct.values(), key=lambda change: sum(map(_size, change.edits)))[:most]


def as_defaults(model: Model[..., Any], arguments: Mapping[str, Any]) -> SourceChange | None:
    """Make arguments the defaults of their parameters, as a change of the model's file.

    Parameters
    ----------
    model
        The model.
    arguments
        Values by parameter. A default that is not written as a number, a text or a truth value stays.

    Returns
    -------
    None if nothing changes, if the file is not the user's, or if it has changed since it was read.
    """
    source = _source(model)
    if source is None:
        return None
    file, node, text = source
    edits, changed = [], {}
    for _, name, default in _defaults(node):
        try:
            before = ast.literal_eval(default)
        except ValueError:
            continue
        value = arguments.get(name, before)
        if isinstance(before, float) and isinstance(value, int):
            value = float(value)
        if type(value) is type(before) and value != before and isinstance(value, bool | int | float | str):
            span = span_of(default, file)
            edits.append(Edit(span.line, span.column, span.end_column, span.text, repr(value)))
            changed[name] = value
    return SourceChange(file.path, tuple(edits), text, 0.0, {}, changed) if edits else None


def _source(model: Any) -> tuple[SourceFile, ast.FunctionDef | ast.Lambda, str] | None:
    """The file of a model, its function there and the text; None for a file of Niwaki, or a changed file."""
    function = getattr(model, "function", None)
    definition = None if function is None else find_function(function)
    if definition is None:
        return None
    file, node = definition
    path = Path(file.path)
    if not path.is_file() or Path(niwaki.__file__).parent in path.resolve().parents:
        return None
    text = path.read_bytes().decode()
    lines = tuple(line.rstrip("\r") for line in text.removesuffix("\n").split("\n"))
    return (file, node, text) if lines == file.lines else None


@dataclass
class _Look:
    """The point, its derivatives by numbers, and the positions, which give the choices that follow the numbers."""

    point: Vector
    slopes: Vector
    positions: _engine.Positions


class _Descent:
    """Descent of numbers until the held point is at a goal."""

    def __init__(self, held: Held, placer: _engine.Placer, goal: Vector) -> None:
        self.held, self.placer, self.goal = held, placer, goal
        self.names = {choice.address: choice.path for choice in held.start.trace.choices}

    def look(
        self, numbers: Sequence[_Number], values: Sequence[float], choices: Mapping[int, float]
    ) -> _Look | None:
        """The point with these numbers; None if the run fails or has no such part."""
        kinds: dict[str, dict[int, float]] = {"arguments": {}, "constants": {}}
        for number, value in zip(numbers, values, strict=True):
            kinds[number.kind][number.key] = value
        try:
            positions = self.placer.positions(choices, set(), **kinds)
        except _engine.EngineFault:
            return None
        grip, part = self.held.grip, self.held.start.part
        index = next((n for n, (address, _) in enumerate(positions.parts) if address == part), None)
        frame = None if index is None else positions.frame(index, grip.shape)
        if index is None or frame is None:
            return None
        slopes = positions.slopes(index, grip.shape, grip.shares)
        assert slopes is not None
        # The engine's order: arguments, then constants, each by their numbers.
        order = sorted(range(len(numbers)), key=lambda k: (numbers[k].kind, numbers[k].key))
        place = {k: n for n, k in enumerate(order)}
        return _Look(grip.at(frame), slopes[:, [place[k] for k in range(len(numbers))]], positions)

    def change(self, numbers: list[_Number], path: str, text: str) -> SourceChange | None:
        """Change these numbers so that the point is at the goal; None if that is impossible."""
        numbers = sorted(numbers, key=lambda number: (number.kind, number.key))
        across, size = self.held.across, self.held.size
        values, choices = [number.value for number in numbers], dict[int, float]()
        scale = np.maximum(np.abs(values), 0.01 * size)
        here = self.look(numbers, values, choices)
        for _ in range(STEPS):
            if here is None:
                return None
            rows, left = across @ here.slopes * scale, across @ (self.goal - here.point)
            if np.linalg.norm(left) < 1e-4 * size:
                break
            step = (
                rows.T @ np.linalg.lstsq(rows @ rows.T + 1e-9 * np.trace(rows @ rows.T) * np.eye(3), left)[0]
            )
            values = [float(x + by) for x, by in zip(values, np.clip(step, -2.0, 2.0) * scale, strict=True)]
            choices = {**choices, **here.positions.followed(values)}
            here = self.look(numbers, values, choices)
        rounded = [float(f"{x:.{DIGITS}g}") for x in values]
        if here is None:
            return None
        choices = {**choices, **here.positions.followed(rounded)}
        here = self.look(numbers, rounded, choices)
        share = np.inf if here is None else float(np.linalg.norm(across @ (self.goal - here.point))) / size
        if share > NEAR or any(abs(x) > 1e6 for x in rounded):
            return None
        edits = tuple(
            Edit(number.span.line, number.span.column, number.span.end_column, number.span.text, repr(x))
            for number, x in zip(numbers, rounded, strict=True)
            if x != number.value
        )
        return SourceChange(
            path,
            edits,
            text,
            share,
            {self.names[address]: x for address, x in choices.items() if address in self.names},
            {number.name: x for number, x in zip(numbers, rounded, strict=True) if number.name},
        )


def _arguments(search: SearchLike) -> list[Any]:
    """All arguments of a search by position, with defaults."""
    bound = inspect.signature(search.model.function).bind(*search.args)
    bound.apply_defaults()
    return [bound.arguments[name] for name in search.model.core().parameters]


def _defaults(node: ast.FunctionDef | ast.Lambda) -> Iterator[tuple[int, str, ast.expr]]:
    """The parameters with defaults: place, name, and the default's expression."""
    every = [*node.args.posonlyargs, *node.args.args]
    first = len(every) - len(node.args.defaults)
    for k, default in enumerate(node.args.defaults):
        yield first + k, every[first + k].arg, default


def _value(node: ast.expr) -> float | None:
    """Read the number of an expression."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        inner = _value(node.operand)
        return None if inner is None else -inner
    return node.value if isinstance(node, ast.Constant) and isinstance(node.value, float) else None


def _together(numbers: Sequence[_Number], tree: ast.Module) -> Iterator[list[_Number]]:
    """Group the numbers of one tuple or `vec`, two or more."""
    for node in ast.walk(tree):
        is_vec = (
            isinstance(node, ast.Call) and getattr(node.func, "id", getattr(node.func, "attr", "")) == "vec"
        )
        inside = node.args if isinstance(node, ast.Call) and is_vec else getattr(node, "elts", [])
        places = {(entry.lineno, entry.col_offset + 1) for entry in inside if _value(entry) is not None}
        group = [number for number in numbers if (number.span.line, number.span.column) in places]
        if len(group) > 1:
            yield group


def _size(edit: Edit) -> float:
    """The size of an edit, as a share of its number."""
    before, after = float(edit.before.replace(" ", "")), float(edit.after)
    return abs(after - before) / max(abs(before), 0.1)
