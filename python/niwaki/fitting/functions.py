"""Python functions as generators: ranges from their signature, or draws while they run.

    def bracket(width=nw.Uniform(20, 80), holes=nw.DiscreteUniform(2, 6), slot=False): ...     # ranges
    def bracket(width: float = 40, finish: Literal["raw", "round"] = "raw"): ...               # hints and defaults
    def bracket(d): ...                                                                        # draws (`Draws`)

A parameter without a range gets one by its hint and its default:

| hint or default | range |
| --- | --- |
| `bool` | False or True |
| `Literal[...]`, an `Enum` | its values |
| a real number but 0 | from half of it to twice it |
| a whole number but 0 | from half of it, rounded up, to twice it |
| anything else with a default | none: it keeps its default |

A function of one parameter, with neither a range nor a default, is called with `Draws`.
"""

from __future__ import annotations

import hashlib
import inspect
import sys
from collections.abc import Callable, Mapping
from enum import EnumMeta
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Annotated, Any, Literal, get_args, get_origin

from niwaki.errors import InputError
from niwaki.fitting.draws import Drawn, Draws
from niwaki.fitting.generator import Called, Generator, Numbers
from niwaki.inputs.modules import public, run_file
from niwaki.search.space import Parameter, Space
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Distribution, Uniform


class FunctionGenerator(Generator):
    """A function that returns a mesh.

    Parameters
    ----------
    function
        The function.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self.function = function
        self.name = getattr(function, "__name__", type(function).__name__)
        parameters = _parameters(function)
        self.is_by_run = len(parameters) == 1 and _has_nothing(parameters[0])
        self.space = None if self.is_by_run else Space(_ranges(self.name, parameters))
        self._positional = [row.name for row in parameters if row.kind is row.POSITIONAL_ONLY]

    def call(self, numbers: Numbers) -> Called:
        """Call the function."""
        if self.is_by_run:
            draws = Draws(numbers)
            try:
                return Called(self.function(draws), draws.drawn)
            except Exception as error:
                # Also a run that fails shows which draws there are.
                raise FailedRun(draws.drawn) from error
        values = self.values(numbers)
        positional = [values.pop(name) for name in self._positional if name in values]
        return Called(self.function(*positional, **values))

    def identity(self) -> dict[str, str]:
        """Return the hash of the function's file, or of its code."""
        place = _file(self.function)
        if place is not None:
            return {"the model": self.name, "the model's file": _sha256(place.read_bytes())}
        code = getattr(self.function, "__code__", None)
        return {
            "the model": self.name,
            "the model's code": "" if code is None else _sha256(code.co_code + repr(code.co_consts).encode()),
        }

    @property
    def reason(self) -> str:
        """The reason why it must stay in this process."""
        name = getattr(self.function, "__qualname__", "")
        if not isinstance(self.function, FunctionType):
            return f"`{self.name}` is no function of a file"
        if "<lambda>" in name:
            return "it is a lambda, which has no name that another process can look up"
        if "<locals>" in name:
            return f"`{self.name}` is defined inside of another function"
        if _file(self.function) is None:
            return f"`{self.name}` is defined in a notebook or typed in, and not in a file"
        return ""

    def recipe(self) -> dict[str, Any] | None:
        """Return the module or the file of the function, and its name there."""
        place = _file(self.function)
        if self.reason or place is None:
            return None
        module = self.function.__module__
        # A file that was run as a program or by a command has no module that another process can import.
        is_program = module == "__main__" or public(module) != module
        return {
            "kind": "function",
            "module": "" if is_program else module,
            "file": str(place),
            "name": self.function.__qualname__,
        }

    @classmethod
    def of_recipe(cls, recipe: Mapping[str, Any]) -> FunctionGenerator:
        """Load the function, and make the generator again."""
        return cls(cls.loaded(recipe))

    @staticmethod
    def loaded(recipe: Mapping[str, Any]) -> Callable[..., Any]:
        """Load the function by its module, or run its file up to the call of `fit`."""
        holder: Any = None
        if recipe["module"]:
            try:
                holder = import_module(recipe["module"])
            except ImportError:
                holder = None
        if holder is None or not _has(holder, recipe["name"]):
            holder = _of_file(Path(recipe["file"]))
        for part in str(recipe["name"]).split("."):
            holder = getattr(holder, part)
        function: Callable[..., Any] = holder
        return function


class FailedRun(Exception):
    """A run that is defined by its draws has failed; the cause is the function's error.

    Attributes
    ----------
    drawn : list of Drawn
        Its draws until then.
    """

    def __init__(self, drawn: list[Drawn]) -> None:
        super().__init__()
        self.drawn = drawn


class Loaded(InputError):
    """A worker process has run a file up to its call of `fit`: its functions are defined."""


def _of_file(place: Path) -> Any:
    """Run a file, as far as a call of `fit` at its top level."""
    try:
        return run_file(place)[0]
    except Loaded:
        latest = [
            module for module in sys.modules.values() if getattr(module, "__file__", None) == str(place)
        ]
        return latest[-1]


def _has(holder: Any, name: str) -> bool:
    return hasattr(holder, name.partition(".")[0])


def _file(function: Any) -> Path | None:
    code = getattr(function, "__code__", None)
    if code is None:
        return None
    place = Path(code.co_filename)
    return place.resolve() if place.suffix == ".py" and place.is_file() else None


def _sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _parameters(function: Callable[..., Any]) -> list[inspect.Parameter]:
    """Return the parameters of a function that a search could set."""
    try:
        signature = inspect.signature(function, eval_str=True)
    except (TypeError, ValueError, NameError):
        try:
            signature = inspect.signature(function)
        except (TypeError, ValueError):
            return []
    several = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    return [row for row in signature.parameters.values() if row.kind not in several]


def _has_nothing(row: inspect.Parameter) -> bool:
    """Tell whether a parameter has neither a default nor a hint with a range."""
    return row.default is row.empty and (row.annotation is row.empty or _hinted(row.annotation) is None)


def _ranges(name: str, parameters: list[inspect.Parameter]) -> dict[str, Any]:
    ranges = {}
    for row in parameters:
        range_ = _range(name, row)
        if range_ is not None:
            ranges[row.name] = range_
    if not ranges:
        raise InputError(
            "no-ranges",
            name=name,
            reason="no parameter of the function has a range, or a default from which one follows",
            cure=f"write ranges as defaults: `def {name}(width=nw.Uniform(20, 80), holes=nw.DiscreteUniform(0, 4))`",
        )
    return ranges


def _range(name: str, row: inspect.Parameter) -> Any:
    """Return the range of a parameter, None for one that keeps its default."""
    if isinstance(row.default, Distribution | Parameter):
        return row.default
    hinted = None if row.annotation is row.empty else _hinted(row.annotation)
    if hinted is not None:
        return hinted
    if row.default is row.empty:
        raise InputError(
            "no-ranges",
            name=name,
            reason=f"its parameter `{row.name}` has neither a range nor a default",
            cure=f"write `{row.name}=nw.Uniform(20, 80)`, or a default that it keeps",
        )
    return usual_range(name, row.name, row.default)


def usual_range(name: str, parameter: str, default: Any) -> Any:
    """Return the range of a parameter from its default alone: from half of it to twice it.

    Raises
    ------
    InputError
        `no-ranges`: the default is 0, from which no range follows.
    """
    if isinstance(default, bool):
        return Bernoulli(0.5)
    if not isinstance(default, int | float):
        return None
    if default == 0:
        raise InputError(
            "no-ranges",
            name=name,
            reason=f"its parameter `{parameter}` has the default 0, and a range from half of it to twice it is empty",
            cure=f"write its range: `{parameter}=nw.Uniform(-1, 1)`",
        )
    ends = sorted((default / 2, default * 2))
    if isinstance(default, int):
        return (
            DiscreteUniform(-(-default // 2), 2 * default)
            if default > 0
            else DiscreteUniform(2 * default, default // 2)
        )
    return Uniform(*ends)


def _hinted(hint: Any) -> Any:
    """Return the range of a hint: values of `Literal`, members of an `Enum`, `bool`, a range in `Annotated`."""
    if get_origin(hint) is Annotated:
        ranges = [entry for entry in get_args(hint) if isinstance(entry, Distribution | Parameter)]
        return ranges[0] if ranges else _hinted(get_args(hint)[0])
    if get_origin(hint) is Literal:
        return list(get_args(hint))
    if isinstance(hint, EnumMeta):
        return list(hint)
    return Bernoulli(0.5) if hint is bool else None
