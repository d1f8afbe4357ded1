"""An `infer` of a plain run, as the engine does it: the program of the whole run, with one function more.

A random stream depends on where a choice is written, and on what is called under which name. So an inner model is not
lowered by itself, where what it captures would be constants: the function that is added to the program of the run
around makes the same closure as the engine has, from the values of the Python function's cells.

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

#: Attributes of a nested function: the function of the module that it is nested in, and its number there.
ROOT, NUMBER = "__nw_root__", "__nw_number__"

#: The function that is added.
NAME = "infer"

#: A variable that it never assigns.
UNASSIGNED = "$%0"


class Around:
    """The program of a plain run, for the inferences inside of it."""

    @deep
    def __init__(self, function: FunctionType) -> None:
        self.program = Program()
        self.program.unit(function)
        self.forms = lower_waiting(self.program)
        self.name = self.program.fresh(NAME)
        self.known: dict[tuple[str, tuple[str, str, str]], _engine.Program] = {}

    @deep
    def infer(self, constant: tuple[str, str, str], model: Any, args: Sequence[Any], seed: int) -> Any:
        """The value of an `infer`.

        Parameters
        ----------
        constant
            The method and what to keep, as `niwaki.lang.inference.constant` has them.
        model
            The Python function of the inner model.
        args
            Its arguments.
        seed
            Decides the inner search.
        """
        given = _Given(self.program)
        called = [given.value(value) for value in (model, *args)]
        self.forms += lower_waiting(self.program)
        constants = [*self.program.constants, constant]
        searched = Form("host", [str(len(constants) - 1), *called, "$seed"])
        parameters = Form("params", [*(f"${number}" for number in range(len(given.values))), "$seed"])
        name = self.name
        added = Form("fn", [literal(name), Form("file", ["0"]), parameters, Form("return", [searched])])
        text = Form(
            "module", [*module_head(self.program), *self.forms, added, Form("entry", [literal(name)])]
        )
        key = write_tree(text, 0, True, True), constant
        if key not in self.known:
            self.known[key] = _engine.Program(key[0], constants, self.program.classes)
        program = self.known[key]
        ran, _, _ = _engine.Task(program, [*given.values, seed]).search(Forward(1).text()[0], 0)
        return ran[0].value


class _Given:
    """The values of a call as forms; what holds no function is an argument of the added function."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.values: list[Any] = []

    def value(self, value: Any) -> Expr:
        """Any value."""
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
        """A closure."""
        root = getattr(function, ROOT, None)
        if root is None:
            return Form("closure", [literal(self.program.unit(function).name)])
        unit = self.program.unit(root)
        scope = list(functions(unit.scopes))[getattr(function, NUMBER)]
        captured = [self.captured(_look(unit, scope, function, needed, set())) for needed in scope.needed]
        return Form("closure", [literal(unit.names[scope]), *captured])

    def captured(self, value: Any) -> Expr:
        """What a closure has of a variable; one without a value is a name that the added function does not assign."""
        return UNASSIGNED if value is _NOT_HERE else self.value(value)


def _holds_function(value: Any) -> bool:
    return any(
        isinstance(underlying(part), FunctionType) or _holds_function(part) for part in parts_of(value)
    )


_NOT_HERE = object()


def _look(unit: Unit, scope: Scope, function: FunctionType, needed: Variable, seen: set[Scope]) -> Any:
    """The value of a variable that a function, or one that it calls, has captured."""
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
            found = _look(unit, used, inner, needed, seen)
            if found is not _NOT_HERE:
                return found
    return _NOT_HERE


def _used(within: Scope, scope: Scope, seen: set[Scope]) -> Iterator[Scope]:
    """The functions that a scope uses, and those that functions which are defined inside of it use."""
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
    code, given = function.__code__, function.__defaults__ or ()
    positional = code.co_varnames[: code.co_argcount]
    return given[positional.index(name) - len(positional) + len(given)]
