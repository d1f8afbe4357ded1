"""Names from outside of a model: the module's globals, the cells of a closure, Python's built-ins.

Only this file and `constants` inspect Python objects.
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
    """The names that a top-level function can use besides its local names."""

    def __init__(self, function: FunctionType) -> None:
        self.globals = function.__globals__
        cells = function.__closure__ or ()
        self.cells = dict(zip(function.__code__.co_freevars, cells, strict=True))

    def find(self, name: str) -> Any:
        """Return the object of a name, or MISSING."""
        if name in self.cells:
            try:
                return self.cells[name].cell_contents
            except ValueError:
                return MISSING
        if name in self.globals:
            return self.globals[name]
        return getattr(builtins, name, MISSING)

    def names(self) -> list[str]:
        """Return all names, for suggestions."""
        return [*self.cells, *self.globals, *(name for name in dir(builtins) if name.islower())]

    def has_field(self, name: str) -> bool:
        """Return whether a record class of the module has a field of this name."""
        return any(is_record_class(value) and name in record_fields(value) for value in self.globals.values())


def nearest(name: str, among: Iterable[str], count: int = 1) -> list[str]:
    """Return the names that are most similar to `name`."""
    known = sorted({other for other in among if not other.startswith("__")})
    return difflib.get_close_matches(name, known, n=count, cutoff=0.6)


def is_named_tuple(value: Any) -> bool:
    """Return whether a value is a class made by NamedTuple."""
    return isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields")


def is_record_class(value: Any) -> bool:
    """Return whether a value is a class of records; vectors and distributions are not records."""
    if not isinstance(value, type):
        return False
    is_word = value.__module__.startswith("niwaki.words.")
    return is_named_tuple(value) or (dataclasses.is_dataclass(value) and not is_word)


def record_fields(value: Any) -> tuple[str, ...]:
    """Return the names of a record class's fields, in order."""
    if is_named_tuple(value):
        return tuple(value._fields)
    return tuple(field.name for field in dataclasses.fields(value))


def hashable(value: Any) -> bool:
    """Return whether an object can be a key of a table; a tuple with a list in it cannot."""
    try:
        hash(value)
    except TypeError:
        return False
    return True


def is_library(function: FunctionType) -> bool:
    """Return whether a function belongs to Python's library or to an installed package.

    Niwaki's functions count as the user's, because the gallery's models are among them; only its words do not.
    """
    module = function.__module__ or ""
    if module.partition(".")[0] == "niwaki":
        return module.startswith(("niwaki.words", "niwaki.lang"))
    return function.__code__.co_filename.startswith(_library_folders())


@functools.cache
def _library_folders() -> tuple[str, ...]:
    """Return the folders of Python's library and of installed packages."""
    return tuple(sysconfig.get_path(kind) for kind in ("stdlib", "platstdlib", "purelib", "platlib"))


RANDOM = ("random", "numpy.random", "secrets")


def is_random(value: Any) -> bool:
    """Return whether a value is, or belongs to, a random number generator of Python or NumPy."""
    modules = (getattr(value, "__module__", None) or "", type(getattr(value, "__self__", None)).__module__)
    return any(module == name or module.startswith(f"{name}.") for module in modules for name in RANDOM)
