"""The state of one lowering: functions to do, constants, record classes, files.

A *unit* is a top-level function with everything nested in it; units are found as they are called and lowered one after
the other. Functions are compared as objects, so two closures of one `def` are two functions.
"""

from __future__ import annotations

import dataclasses
from types import FunctionType
from typing import Any

from niwaki.errors import InputError, ModelError
from niwaki.errors.source import SourceFile, Span, find_function, span_of
from niwaki.inputs.modules import public
from niwaki.lang.constants import is_data, owned
from niwaki.lang.core import Expr, Form, is_literal, literal
from niwaki.lang.deep import too_deep
from niwaki.lang.marks import Host, underlying
from niwaki.lang.names import Namespace, is_library, is_named_tuple, is_record_class, record_fields
from niwaki.lang.scope import FunctionNode, Scope, Scopes, analyse, functions
from niwaki.lang.sites import labels_of
from niwaki.words.distributions import Distribution
from niwaki.words.memo import Memoised


@dataclasses.dataclass(eq=False)
class Unit:
    """A top-level function: where it is written, what its names mean, what its parts are called."""

    function: FunctionType
    file: SourceFile
    node: FunctionNode
    scopes: Scopes
    namespace: Namespace
    names: dict[Scope, str]
    labels: dict[Any, str]

    @property
    def name(self) -> str:
        """The function's qualified name."""
        return self.names[self.scopes.root]


class Program:
    """What is known of the program so far."""

    def __init__(self, lifts: bool = False) -> None:
        #: The places of real numbers that are constants of the table instead of literals, where they are wanted.
        self.lifted: dict[int, Span] | None = {} if lifts else None
        self.units: dict[FunctionType, Unit] = {}
        self.waiting: list[Unit] = []
        self.constants: list[Any] = []
        self.classes: list[type] = []
        self.files: list[SourceFile] = []
        self.taken: set[str] = set()
        self._constant_numbers: dict[int, int] = {}

    def unit(self, function: FunctionType, used_at: Span | None = None) -> Unit:
        """The unit of a function object, created at its first use."""
        if function not in self.units:
            found = find_function(function)
            if found is None:
                if used_at is not None:
                    raise ModelError("no-source", used_at, name=function.__name__)
                raise InputError("no-source-file", name=function.__name__)
            file, node = found
            if (below := too_deep(node)) is not None:
                raise ModelError("nested-too-deeply", span_of(below, file))
            check_signature(file, node)
            namespace = Namespace(function)
            scopes = analyse(node)
            unit = Unit(function, file, node, scopes, namespace, {}, {})
            self._name(unit)
            unit.labels = labels_of(unit.scopes, unit.namespace)
            self.units[function] = unit
            self.waiting.append(unit)
        return self.units[function]

    def file_number(self, file: SourceFile) -> int:
        """K of `(file K)`."""
        if file not in self.files:
            self.files.append(file)
        return self.files.index(file)

    def class_number(self, record: type) -> int:
        """K of `(record K ...)`."""
        if record not in self.classes:
            self.classes.append(record)
        return self.classes.index(record)

    def _name(self, unit: Unit) -> None:
        qualified = unit.function.__qualname__.replace(".<locals>", "").replace("<lambda>", "lambda")
        if qualified in self.taken:
            qualified = f"{public(unit.function.__module__)}.{qualified}"
        unit.names[unit.scopes.root] = self.fresh(qualified)
        for scope in functions(unit.scopes):
            if scope.parent is not None:
                unit.names[scope] = self.fresh(f"{unit.names[scope.parent.function]}.{scope.name}")

    def fresh(self, name: str) -> str:
        """The name, or one made from it that no function has."""
        outer, _, last = name.rpartition(".")
        number = 2
        unique = name
        while unique in self.taken:
            unique = f"{outer}.#{number}.{last}" if outer else f"#{number}.{last}"
            number += 1
        self.taken.add(unique)
        return unique

    def real(self, value: float, place: Span) -> Expr:
        """A real number of the source: a literal, or a constant of its own."""
        if self.lifted is None:
            return literal(value)
        self.constants.append(value)
        self.lifted[len(self.constants) - 1] = place
        return Form("data", [str(len(self.constants) - 1)])

    def constant(self, value: Any, used_at: Span, name: str) -> Expr:
        """A Python object as an expression: a literal, data of the table, or built from both."""
        value = underlying(value)
        if isinstance(value, Memoised):
            function = underlying(value.function)
            inner = self.constant(function, used_at, name)
            return Form("mem", [inner, literal(self.unit(function).name)], used_at)
        if isinstance(value, FunctionType):
            if is_library(value):
                code = "word-as-value" if value.__module__.startswith("niwaki.words") else "library-function"
                raise ModelError(code, used_at, name=name if name.isidentifier() else value.__name__)
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
        value = owned(value)
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
        """K of `(data K)` or `(host K)`."""
        if id(value) not in self._constant_numbers:
            self._constant_numbers[id(value)] = len(self.constants)
            self.constants.append(value)
        return self._constant_numbers[id(value)]

    def host(self, host: Host[Any, Any]) -> str:
        """K of `(host K ...)`, as an atom."""
        return str(self.number(host))

    def check_record(self, record: type, used_at: Span) -> None:
        """Refuse record classes that can change or that run code when they are made."""
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
