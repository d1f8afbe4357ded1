"""Arguments of a model on the command line: `niwaki grow tower.py:tower width=3.0 --preset wide.toml`.

The model's signature has their names, defaults and types. A word is read by the annotated type, else by the type of the
default, else as a Python literal. `--preset` names a TOML file with values by name; words override its values.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import typer

from niwaki.errors import InputError
from niwaki.inputs import text_of
from niwaki.inputs.texts import toml_of
from niwaki.lang.compiled import arguments
from niwaki.lang.models import Model

Arguments = Annotated[
    list[str] | None,
    typer.Argument(metavar="[NAME=VALUE]...", help="Arguments of the model. Default: the model's."),
]
Preset = Annotated[
    Path | None,
    typer.Option("--preset", metavar="FILE", help="A TOML file with arguments of the model: NAME = VALUE."),
]

#: The form of a value of each type, and an example.
_SHAPES: dict[type, tuple[str, str]] = {
    bool: ("true or false", "true"),
    int: ("a whole number", "3"),
    float: ("a number", "3.0"),
    str: ("a text", "oak"),
}
_TRUTH = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}


def read(model: Model[..., Any], words: Iterable[str] | None, preset: Path | None = None) -> dict[str, Any]:
    """Read the arguments by name.

    Parameters
    ----------
    model
        The model.
    words
        Words of the form `NAME=VALUE`.
    preset
        A TOML file.

    Raises
    ------
    InputError
        `unknown-argument`: the model has no such argument; `bad-setting`: a value is of another type.
    FileError
        The preset cannot be read, or is not TOML.
    """
    table = {} if preset is None else toml_of(text_of(preset, "preset", "a preset"), preset)
    values = fitting(model, table)
    signature = inspect.signature(model.function)
    kinds = _kinds(model, signature)
    for word in words or ():
        name, equals, text = word.partition("=")
        if not equals:
            raise InputError(
                "unknown-argument",
                name=word,
                model=model.name,
                reason="a word after the model is NAME=VALUE",
                has=described(model) or "none",
            )
        _check_name(model, signature, name)
        values[name] = _fitting(name, _value(text, kinds.get(name)), kinds.get(name), repr(text))
    return values


def fitting(model: Model[..., Any], table: Mapping[str, Any]) -> dict[str, Any]:
    """Convert values by name to the types of the model's signature.

    Raises
    ------
    InputError
        See `read`.
    """
    signature = inspect.signature(model.function)
    kinds = _kinds(model, signature)
    for name in table:
        _check_name(model, signature, name)
    return {name: _fitting(name, value, kinds.get(name), repr(value)) for name, value in table.items()}


def bound(model: Model[..., Any], values: dict[str, Any]) -> list[Any]:
    """Return the arguments by position.

    Raises
    ------
    InputError
        `model-arguments`: an argument is missing.
    """
    return arguments(model, (), values)


def described(model: Model[..., Any]) -> str:
    """Return the arguments of a model with their defaults as text: `y=0.0, width=4.0`."""
    parts = inspect.signature(model.function).parameters.values()
    return ", ".join(
        part.name if part.default is part.empty else f"{part.name}={part.default!r}" for part in parts
    )


def _check_name(model: Model[..., Any], signature: inspect.Signature, name: str) -> None:
    if name in signature.parameters:
        return
    near = get_close_matches(name, signature.parameters, n=1)
    reason = f"did you mean `{near[0]}`?" if near else "the first line of the function has its arguments"
    raise InputError(
        "unknown-argument", name=name, model=model.name, reason=reason, has=described(model) or "none"
    )


def _kinds(model: Model[..., Any], signature: inspect.Signature) -> dict[str, type]:
    """Return the type of each argument whose type is known."""
    try:
        hints = get_type_hints(model.function)
    except (NameError, TypeError):
        hints = {}
    kinds: dict[str, type] = {}
    for parameter in signature.parameters.values():
        kind = hints.get(parameter.name, type(parameter.default))
        if kind in _SHAPES:
            kinds[parameter.name] = kind
    return kinds


def _value(text: str, kind: type | None) -> Any:
    """Read a word as a value of a type; a word that cannot be read stays a text."""
    if kind is str:
        return text
    if kind is bool:
        return _TRUTH.get(text.lower(), text)
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError, RecursionError, MemoryError):
        return text


def _fitting(name: str, value: Any, kind: type | None, text: str) -> Any:
    """Return the value converted to its type; `text` is the value in messages."""
    if kind is None:
        return value
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if kind is float and is_number:
        return float(value)
    if type(value) is kind:
        return value
    expected, example = _SHAPES[kind]
    raise InputError(
        "bad-setting",
        name=name,
        found=text,
        expected=expected,
        suggestion=f"{expected}, for instance {name}={example}",
    )
