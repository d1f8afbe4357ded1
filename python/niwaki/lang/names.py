"""What a name means outside of a model: the module's globals, the cells of a closure, Python's built-ins.

Only this file and `constants` look at Python objects.
"""

from __future__ import annotations

import builtins
import dataclasses
import difflib
import functools
import sysconfig
from collections.abc import Iterable
from types import FunctionType
from typing import Any

MISSING: Any = type("Missing", (), {"__repr__": lambda self: "missing"})()


class Namespace:
    """The names that a top-level function sees besides its own."""

    def __init__(self, function: FunctionType) -> None:
        self.globals = function.__globals__
        cells = function.__closure__ or ()
        self.cells = dict(zip(function.__code__.co_freevars, cells, strict=True))

    def find(self, name: str) -> Any:
        """The object, or MISSING."""
        if name in self.cells:
            try:
                return self.cells[name].cell_contents
            except ValueError:
                return MISSING
        if name in self.globals:
            return self.globals[name]
        return getattr(builtins, name, MISSING)

    def names(self) -> list[str]:
        """Every name that could have been meant."""
        return [*self.cells, *self.globals, *(name for name in dir(builtins) if name.islower())]

    def has_field(self, name: str) -> bool:
        """Whether some record class in sight has a field of this name."""
        return any(is_record_class(value) and name in record_fields(value) for value in self.globals.values())


def nearest(name: str, among: Iterable[str], count: int = 1) -> list[str]:
    """The names that look most like `name`."""
    known = sorted({other for other in among if not other.startswith("__")})
    return difflib.get_close_matches(name, known, n=count, cutoff=0.6)


def is_named_tuple(value: Any) -> bool:
    """Whether it is a class made by NamedTuple."""
    return isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields")


def is_record_class(value: Any) -> bool:
    """Whether it is a class whose instances are records; vectors and distributions are other kinds of values."""
    if not isinstance(value, type):
        return False
    own = value.__module__.startswith("niwaki.words.")
    return is_named_tuple(value) or (dataclasses.is_dataclass(value) and not own)


def record_fields(value: Any) -> tuple[str, ...]:
    """The names of a record class's fields, in order."""
    if is_named_tuple(value):
        return tuple(value._fields)
    return tuple(field.name for field in dataclasses.fields(value))


def hashable(value: Any) -> bool:
    """Whether an object can be looked up in a table; a tuple that holds a list cannot."""
    try:
        hash(value)
    except TypeError:
        return False
    return True


def is_library(function: FunctionType) -> bool:
    """Whether a function belongs to Python's library or to an installed package rather than to the user.

    Our own package counts as the user's, except for the words themselves: the gallery's models are in it.
    """
    module = function.__module__ or ""
    if module.partition(".")[0] == "niwaki":
        return module.startswith(("niwaki.words", "niwaki.lang"))
    return function.__code__.co_filename.startswith(_library_folders())


@functools.cache
def _library_folders() -> tuple[str, ...]:
    """Where Python's library and installed packages are."""
    return tuple(sysconfig.get_path(kind) for kind in ("stdlib", "platstdlib", "purelib", "platlib"))


RANDOM = ("random", "numpy.random", "secrets")


def is_random(value: Any) -> bool:
    """Whether it is, or belongs to, one of the random number generators of Python or NumPy."""
    modules = (getattr(value, "__module__", None) or "", type(getattr(value, "__self__", None)).__module__)
    return any(module == name or module.startswith(f"{name}.") for module in modules for name in RANDOM)
