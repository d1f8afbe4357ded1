"""The `infer` of a plain run, which the engine computes with the program of the whole run and an added function.

A random stream depends on the place of its choice in the source and on the names of the calls around it. So the inner
model is not lowered alone, with its captures as constants. Instead, a function is added to the program of the outer
run. It makes the same closure as in the engine, from the values in the Python function's cells.

    (fn "infer" (params $0 $1 ... $seed) (return (host K (closure "m.near" $0) $1 ... $seed)))
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from types import FunctionType
from typing import Any

from niwaki import _engine
from niwaki.lang.core import Expr, Form, literal, write_tree
from niwaki.lang.deep import deep
from niwaki.lang.futures import parts_of
from niwaki.lang.lower import lower_waiting, module_head
from niwaki.lang.marks import underlying
from niwaki.lang.names import is_record_class, record_fields
from niwaki.lang.program import Program, Unit
from niwaki.lang.scope import Scope, Variable, functions
from niwaki.methods import Forward

#: Attributes of a nested function: the module's function around it, and its number in that function.
ROOT, NUMBER = "__nw_root__", "__nw_number__"

#: The name of the added function.
NAME = "infer"

#: A variable that the added function never assigns.
UNASSIGNED = "$%0"


class Around:
    """The program of a plain run, for the calls of `infer` in the run."""

    @deep
    def __init__(self, function: FunctionType) -> None:
        self.program = Program()
        self.program.unit(function)
        self.forms = lower_waiting(self.program)
        self.name = self.program.fresh(NAME)
        self.known: dict[tuple[str, tuple[str, str, str]], _engine.Program] = {}

    @deep
    def infer(self, constant: tuple[str, str, str], model: Any, args: Sequence[Any], seed: int) -> Any:
        """Return the value of an `infer`.

        Parameters
        ----------
        constant
            The method and `keep`, as `niwaki.lang.inference.constant` returns them.
        model
            The Python function of the inner model.
        args
            The inner model's arguments.
        seed
            The seed of the inner search.
        """
        arguments = _Arguments(self.program)
        forms = [arguments.value(value) for value in (model, *args)]
        self.forms += lower_waiting(self.program)
        constants = [*self.program.constants, constant]
        inference = Form("host", [str(len(constants) - 1), *forms, "$seed"])
        parameters = Form("params", [*(f"${number}" for number in range(len(arguments.values))), "$seed"])
        name = self.name
        function = Form("fn", [literal(name), Form("file", ["0"]), parameters, Form("return", [inference])])
        text = Form(
            "module", [*module_head(self.program), *self.forms, function, Form("entry", [literal(name)])]
        )
        key = write_tree(text, 0, True, True), constant
        if key not in self.known:
            self.known[key] = _engine.Program(key[0], constants, self.program.classes)
        program = self.known[key]
        samples, _, _ = _engine.Task(program, [*arguments.values, seed]).search(Forward(1).text()[0], 0)
        return samples[0].value


class _Arguments:
    """The arguments of an `infer` as forms; values without functions become arguments of the added function."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.values: list[Any] = []

    def value(self, value: Any) -> Expr:
        """Return the form of a value."""
        value = underlying(value)
        if isinstance(value, FunctionType):
            return self.function(value)
        if not _holds_function(value):
            self.values.append(value)
            return f"${len(self.values) - 1}"
        if isinstance(value, dict):
            return Form("dict", [Form("", [literal(key) for key in value]), *map(self.value, value.values())])
        if is_record_class(type(value)):
            fields = [self.value(getattr(value, name)) for name in record_fields(type(value))]
            return Form("record", [str(self.program.class_number(type(value))), *fields])
        return Form("list" if isinstance(value, list) else "tuple", [*map(self.value, value)])

    def function(self, function: FunctionType) -> Form:
        """Return the form of a function, a closure."""
        root = getattr(function, ROOT, None)
        if root is None:
            return Form("closure", [literal(self.program.unit(function).name)])
        unit = self.program.unit(root)
        scope = list(functions(unit.scopes))[getattr(function, NUMBER)]
        captured = [self.captured(_look(unit, scope, function, needed, set())) for needed in scope.needed]
        return Form("closure", [literal(unit.names[scope]), *captured])

    def captured(self, value: Any) -> Expr:
        """Return the form of a captured variable; without a value, a name that the added function does not assign."""
        return UNASSIGNED if value is _NOT_HERE else self.value(value)


def _holds_function(value: Any) -> bool:
    return any(
        isinstance(underlying(part), FunctionType) or _holds_function(part) for part in parts_of(value)
    )


_NOT_HERE = object()


def _look(unit: Unit, scope: Scope, function: FunctionType, needed: Variable, seen: set[Scope]) -> Any:
    """Return the value of a variable that a function, or a function that it calls, has captured."""
    for name, default in scope.defaults.items():
        if default is needed:
            return _default(scope, function, name)
    cells = {}
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        try:
            cells[name] = cell.cell_contents
        except ValueError:
            continue
    assert scope.parent is not None
    if needed.name in cells and unit.scopes.find(needed.name, scope.parent) is needed:
        return cells[needed.name]
    seen.add(scope)
    for used in _used(scope, scope, set()):
        inner = cells.get(used.name)
        if used not in seen and isinstance(inner, FunctionType) and used.parent is not None:
            value = _look(unit, used, inner, needed, seen)
            if value is not _NOT_HERE:
                return value
    return _NOT_HERE


def _used(within: Scope, scope: Scope, seen: set[Scope]) -> Iterator[Scope]:
    """Yield the functions that a scope uses, directly or by a function defined inside it."""
    for used in scope.uses:
        if used not in seen:
            seen.add(used)
            yield used
            if used.inside(within):
                yield from _used(within, used, seen)


def _default(scope: Scope, function: FunctionType, name: str) -> Any:
    keywords = function.__kwdefaults__ or {}
    if name in keywords:
        return keywords[name]
    code, defaults = function.__code__, function.__defaults__ or ()
    positional = code.co_varnames[: code.co_argcount]
    return defaults[positional.index(name) - len(positional) + len(defaults)]
