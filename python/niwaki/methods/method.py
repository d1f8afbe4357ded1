"""Methods as values and as data: the class of a method is the one description of its settings.

The fields of the class are the settings with their defaults, and its docstring describes them. The shell's flags, the
engine's reader and the record of a search follow from the fields.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cache
from typing import Any, ClassVar, Self, get_type_hints

from msgspec import defstruct

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.schema import fitted, inside
from niwaki.methods.kernels import Kernel
from niwaki.methods.order import FutureOrder
from niwaki.methods.refusals import check_settings


@dataclass(frozen=True)
class Method:
    """Method by which a model is searched.

    Attributes
    ----------
    NAME : str
        The name of the method in data.
    """

    NAME: ClassVar[str] = ""
    #: The classes of all methods, by name.
    KNOWN: ClassVar[dict[str, type[Method]]] = {}

    def __init_subclass__(cls, **kwargs: Any) -> None:
        """Register a method by its name."""
        super().__init_subclass__(**kwargs)
        if cls.NAME:
            Method.KNOWN[cls.NAME] = cls

    def data(self, function: Callable[[Any], Any]) -> dict[str, Any]:
        """The method as plain data.

        Parameters
        ----------
        function
            A function that writes a user's proposal or a guide, the only settings that are not plain values.
        """
        data: dict[str, Any] = {"method": self.NAME}
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, Kernel):
                value = value.data(function)
            elif isinstance(value, FutureOrder):
                value = value.data()
            data[field.name] = list(value) if isinstance(value, tuple) else value
        return data

    def text(self) -> tuple[str, list[Any]]:
        """The method as text for the engine, and the users' proposals and guides that the text names by number."""
        functions: list[Any] = []

        def number(function: Any) -> int:
            functions.append(function)
            return len(functions) - 1

        return json.dumps(self.data(number), allow_nan=False), functions

    @classmethod
    def of_data(cls, data: dict[str, Any], function: Callable[[Any], Any]) -> Self:
        """Read a method from its data; `function` reads a user's proposal or a guide.

        Raises
        ------
        InputError
            The method or a setting is unknown.
        Unfit
            A setting has another type.
        """
        settings = dict(data)
        name = settings.pop("method", "")
        kind = Method.KNOWN.get(name) if isinstance(name, str) else None
        if kind is None or not issubclass(kind, cls):
            raise InputError(
                "bad-setting",
                name="method",
                found=repr(data.get("method")),
                expected=f"one of {', '.join(Method.KNOWN)}",
                suggestion='"smc"',
            )
        fitted(settings, _schema(kind.NAME))
        for name, value in settings.items():
            if isinstance(value, dict):
                with inside(f".{name}"):
                    is_order = name == "order"
                    settings[name] = (
                        FutureOrder.of_data(value) if is_order else Kernel.of_data(value, function)
                    )
            elif isinstance(value, list):
                settings[name] = tuple(value)
        try:
            return kind(**kind._of_older(settings))
        except TypeError as error:
            raise InputError(
                "bad-setting",
                name=kind.NAME,
                found=str(error).partition(") ")[2] or str(error),
                expected=f"the settings {', '.join(field.name for field in fields(kind))}",
                suggestion="these settings only",
            ) from None

    @classmethod
    def _of_older(cls, settings: dict[str, Any]) -> dict[str, Any]:
        """Return settings with those that an older version had without naming them."""
        return settings

    def _set(self, name: str, value: Any) -> None:
        """Set a field to a converted value: a real for a whole number, a tuple for a list."""
        object.__setattr__(self, name, value)

    def _check(self) -> None:
        """Let the engine check the settings.

        Raises
        ------
        InputError
            The first setting that has a value it cannot have.
        """
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        defaults = {field.name: field.default for field in fields(self)}
        data = {
            name: [] if isinstance(values.get(name), dict) else value
            for name, value in self.data(lambda _: 0).items()
        }
        check_settings(_engine.check_method, data, values, defaults)


@cache
def _schema(name: str) -> type:
    """The types of a method's settings as data, where a kernel or a learned order is a table."""
    method = Method.KNOWN[name]
    hints = get_type_hints(method)
    types = {field.name: hints[field.name] for field in fields(method)}
    tables = {name: _table(kind) for name, kind in types.items()}
    return defstruct(method.__name__, [(name, kind | None, None) for name, kind in tables.items()])


def _table(kind: Any) -> Any:
    """The type of a setting as data."""
    if FutureOrder in _choices(kind):
        return str | dict[str, Any]
    return dict[str, Any] | None if Kernel in _choices(kind) else kind


def _choices(kind: Any) -> tuple[Any, ...]:
    return getattr(kind, "__args__", (kind,))
