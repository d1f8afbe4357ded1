"""State while a program is lowered: waiting functions, constants, record classes, files.

A *unit* is a top-level function with all functions nested in it. A unit is added when a call of it is lowered, and
lowered later. Functions are compared as objects, so two closures of the same `def` are two functions.
"""

from __future__ import annotations

import dataclasses
from types import FunctionType
from typing import Any

from niwaki.errors import InputError, ModelError
from niwaki.errors.source import SourceFile, Span, find_function, span_of
from niwaki.inputs.modules import public
from niwaki.lang.constants import is_data, plain
from niwaki.lang.core import Expr, Form, is_literal, literal
from niwaki.lang.deep import too_deep
from niwaki.lang.marks import Host, underlying
from niwaki.lang.names import Namespace, is_library, is_named_tuple, is_record_class, record_fields
from niwaki.lang.scope import FunctionNode, Scope, Scopes, analyse, functions
from niwaki.lang.sites import components_of
from niwaki.words.distributions import Distribution
from niwaki.words.memo import Memoised


@dataclasses.dataclass(eq=False)
class Unit:
    """A top-level function: its source, the meanings of its names, and the names of its parts."""

    function: FunctionType
    file: SourceFile
    node: FunctionNode
    scopes: Scopes
    namespace: Namespace
    names: dict[Scope, str]
    components: dict[Any, str]

    @property
    def name(self) -> str:
        """The function's qualified name."""
        return self.names[self.scopes.root]


class Program:
    """A program while it is lowered."""

    def __init__(self, lifts: bool = False) -> None:
        #: The places of real numbers that are constants of the table instead of literals; None without lifting.
        self.lifted: dict[int, Span] | None = {} if lifts else None
        self.units: dict[FunctionType, Unit] = {}
        self.waiting: list[Unit] = []
        self.constants: list[Any] = []
        self.classes: list[type] = []
        self.files: list[SourceFile] = []
        self.used_names: set[str] = set()
        self._constant_numbers: dict[int, int] = {}

    def unit(self, function: FunctionType, used_at: Span | None = None) -> Unit:
        """Return the unit of a function object, created at its first use."""
        if function not in self.units:
            source = find_function(function)
            if source is None:
                if used_at is not None:
                    raise ModelError("no-source", used_at, name=function.__name__)
                raise InputError("no-source-file", name=function.__name__)
            file, node = source
            if (below := too_deep(node)) is not None:
                raise ModelError("nested-too-deeply", span_of(below, file))
            check_signature(file, node)
            namespace = Namespace(function)
            scopes = analyse(node)
            unit = Unit(function, file, node, scopes, namespace, {}, {})
            self._name(unit)
            unit.components = components_of(unit.scopes, unit.namespace, file)
            self.units[function] = unit
            self.waiting.append(unit)
        return self.units[function]

    def file_number(self, file: SourceFile) -> int:
        """Return K of `(file K)`."""
        if file not in self.files:
            self.files.append(file)
        return self.files.index(file)

    def class_number(self, record: type) -> int:
        """Return K of `(record K ...)`."""
        if record not in self.classes:
            self.classes.append(record)
        return self.classes.index(record)

    def _name(self, unit: Unit) -> None:
        qualified = unit.function.__qualname__.replace(".<locals>", "").replace("<lambda>", "lambda")
        if qualified in self.used_names:
            qualified = f"{public(unit.function.__module__)}.{qualified}"
        unit.names[unit.scopes.root] = self.fresh(qualified)
        for scope in functions(unit.scopes):
            if scope.parent is not None:
                unit.names[scope] = self.fresh(f"{unit.names[scope.parent.function]}.{scope.name}")

    def fresh(self, name: str) -> str:
        """Return the name, changed if another function has it."""
        outer, _, last = name.rpartition(".")
        number = 2
        unique = name
        while unique in self.used_names:
            unique = f"{outer}.#{number}.{last}" if outer else f"#{number}.{last}"
            number += 1
        self.used_names.add(unique)
        return unique

    def real(self, value: float, place: Span) -> Expr:
        """Return a real number of the source as a literal, or as a new constant of the table."""
        if self.lifted is None:
            return literal(value)
        self.constants.append(value)
        self.lifted[len(self.constants) - 1] = place
        return Form("data", [str(len(self.constants) - 1)])

    def constant(self, value: Any, used_at: Span, name: str) -> Expr:
        """Return a Python object as an expression: a literal, data of the table, or a form of both."""
        value = underlying(value)
        if isinstance(value, Memoised):
            function = underlying(value.function)
            inner = self.constant(function, used_at, name)
            return Form("mem", [inner, literal(self.unit(function).name)], used_at)
        if isinstance(value, FunctionType):
            if is_library(value):
                code = "word-as-value" if value.__module__.startswith("niwaki.words") else "library-function"
                text = name if name.isidentifier() else value.__name__
                raise ModelError(code, used_at, name=text, cure=f"lambda x: {text}(x)")
            return Form("closure", [literal(self.unit(value, used_at).name)])
        if isinstance(value, Distribution):
            parts = [self.constant(part, used_at, name) for part in value.parameters]
            return Form("dist", [value.family, *parts])
        if is_record_class(type(value)) and not is_data(value):
            self.check_record(type(value), used_at)
            parts = [
                self.constant(getattr(value, part), used_at, name) for part in record_fields(type(value))
            ]
            return Form("record", [str(self.class_number(type(value))), *parts])
        value = plain(value)
        if is_literal(value):
            if isinstance(value, int) and not -(2**63) <= value < 2**63:
                raise ModelError("integer-too-large", used_at, found=str(value))
            return literal(value)
        if is_data(value):
            return Form("data", [str(self.number(value))])
        if isinstance(value, (list, tuple)):
            head = "list" if isinstance(value, list) else "tuple"
            return Form(head, [self.constant(part, used_at, name) for part in value])
        if isinstance(value, dict) and all(map(is_literal, value)):
            keys = Form("", [literal(key) for key in value])
            return Form("dict", [keys, *(self.constant(part, used_at, name) for part in value.values())])
        raise ModelError("unknown-constant", used_at, name=name, found=_kind(value))

    def number(self, value: Any) -> int:
        """Return K of `(data K)` or `(host K)`."""
        if id(value) not in self._constant_numbers:
            self._constant_numbers[id(value)] = len(self.constants)
            self.constants.append(value)
        return self._constant_numbers[id(value)]

    def host(self, host: Host[Any, Any]) -> str:
        """Return K of `(host K ...)`, as an atom."""
        return str(self.number(host))

    def check_record(self, record: type, used_at: Span) -> None:
        """Refuse record classes whose objects can change, or run code when they are created."""
        if is_named_tuple(record):
            return
        parameters = getattr(record, "__dataclass_params__", None)
        if parameters is None or not parameters.frozen:
            raise ModelError("record-not-frozen", used_at, name=record.__name__)
        if hasattr(record, "__post_init__"):
            raise ModelError("record-runs-code", used_at, name=record.__name__)


def _kind(value: Any) -> str:
    kind = type(value).__name__
    return f"{'an' if kind[:1].lower() in 'aeiou' else 'a'} {kind}"


def check_signature(file: SourceFile, node: FunctionNode) -> None:
    """Refuse `*args`, `**kwargs`, and required parameters after optional ones."""
    extra = node.args.vararg or node.args.kwarg
    if extra is not None:
        raise ModelError("star-parameters", span_of(extra, file), name=extra.arg)
    required = {
        arg.arg
        for arg, value in zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True)
        if value is None
    }
    if required and (node.args.defaults):
        late = next(arg for arg in node.args.kwonlyargs if arg.arg in required)
        raise ModelError("required-after-optional", span_of(late, file), name=late.arg)
