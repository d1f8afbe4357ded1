"""Arguments of a model, as words of a shell: `niwaki grow tower.py:tower width=3.0 --preset wide.toml`.

Names, defaults and types are those of the model's signature. A word is read as the type says; where there is none, as
the type of the default; else as a Python literal. `--preset` is a TOML file with a value for each name; words win.
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
    typer.Argument(metavar="[NAME=VALUE]...", help="Arguments of the model; its defaults where left out."),
]
Preset = Annotated[
    Path | None,
    typer.Option("--preset", metavar="FILE", help="A TOML file with arguments of the model, NAME = VALUE."),
]

#: What a word of each type looks like, and an example.
_SHAPES: dict[type, tuple[str, str]] = {
    bool: ("true or false", "true"),
    int: ("a whole number", "3"),
    float: ("a number", "3.0"),
    str: ("a text", "oak"),
}
_TRUTH = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}


def read(model: Model[..., Any], words: Iterable[str] | None, preset: Path | None = None) -> dict[str, Any]:
    """The arguments by name.

    Parameters
    ----------
    model
        The model.
    words
        As `NAME=VALUE`.
    preset
        A TOML file.

    Raises
    ------
    InputError
        `unknown-argument`: the model has no such argument; `bad-setting`: a value is of another type.
    FileError
        The preset cannot be read, or is no TOML.
    """
    table = {} if preset is None else toml_of(text_of(preset, "preset", "a preset"), preset)
    found = fitting(model, table)
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
        found[name] = _fitting(name, _value(text, kinds.get(name)), kinds.get(name), repr(text))
    return found


def fitting(model: Model[..., Any], table: Mapping[str, Any]) -> dict[str, Any]:
    """Values by name as the model's signature has them.

    Raises
    ------
    InputError
        As for `read`.
    """
    signature = inspect.signature(model.function)
    kinds = _kinds(model, signature)
    for name in table:
        _check_name(model, signature, name)
    return {name: _fitting(name, value, kinds.get(name), repr(value)) for name, value in table.items()}


def bound(model: Model[..., Any], given: dict[str, Any]) -> list[Any]:
    """The arguments by position.

    Raises
    ------
    InputError
        `model-arguments`: one is missing.
    """
    return arguments(model, (), given)


def described(model: Model[..., Any]) -> str:
    """The arguments of a model with their defaults: `y=0.0, width=4.0`."""
    parts = inspect.signature(model.function).parameters.values()
    return ", ".join(one.name if one.default is one.empty else f"{one.name}={one.default!r}" for one in parts)


def _check_name(model: Model[..., Any], signature: inspect.Signature, name: str) -> None:
    if name in signature.parameters:
        return
    near = get_close_matches(name, signature.parameters, n=1)
    reason = f"did you mean `{near[0]}`?" if near else "the arguments are those of the function's first line"
    raise InputError(
        "unknown-argument", name=name, model=model.name, reason=reason, has=described(model) or "none"
    )


def _kinds(model: Model[..., Any], signature: inspect.Signature) -> dict[str, type]:
    """The type of each argument, where it is known."""
    try:
        hints = get_type_hints(model.function)
    except (NameError, TypeError):
        hints = {}
    found: dict[str, type] = {}
    for one in signature.parameters.values():
        kind = hints.get(one.name, type(one.default))
        if kind in _SHAPES:
            found[one.name] = kind
    return found


def _value(text: str, kind: type | None) -> Any:
    """What a word says; the word itself where it says nothing else."""
    if kind is str:
        return text
    if kind is bool:
        return _TRUTH.get(text.lower(), text)
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError, RecursionError, MemoryError):
        return text


def _fitting(name: str, value: Any, kind: type | None, found: str) -> Any:
    """The value as its type has it."""
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
        found=found,
        expected=expected,
        suggestion=f"{expected}, for instance {name}={example}",
    )
