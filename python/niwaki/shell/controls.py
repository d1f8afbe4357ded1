"""Flags for targets and constraints of a shape; several of them multiply.

    --target crown.obj --avoid wall.obj --floor 0
    --match-image skyline.png --camera cam.json
    --match-image letter.png                        (models that draw in the plane)
    --match-shadow face.png --weight-image face_w.png --light -1,-0.3,0 --receiver floor.obj

The flags are the options of `niwaki.targets.asks`. Flags that contradict each other, or need a flag that is missing,
are refused before any file is read.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Annotated, Any

import typer

from niwaki.errors import InputError
from niwaki.shell.references import ModelReference
from niwaki.shell.settings import Flags
from niwaki.targets.asks import OPTIONS, flag
from niwaki.targets.sketches import Ask

#: The type on the command line of options of these kinds; any other option is a text.
_TYPES: dict[str, Any] = {"number": float, "count": int, "meshes": list[str]}

#: Kinds of options that are numbers with commas: the number of corners, of numbers in each, and an example.
_NUMBERS = {
    "direction": (1, 3, "-1,-0.3,0"),
    "box": (2, 3, "-5,0,-5,5,10,5"),
    "window": (2, 2, "-12,-2,12,22"),
}


def kind(name: str) -> Any:
    """Return the type of an option on the command line."""
    plain = _TYPES.get(OPTIONS[name].kind, str)
    return plain if OPTIONS[name].default is not None else plain | None


def flags(*names: str) -> Flags:
    """Return options as flags; a flag that is left out is None."""
    return Flags(
        tuple(
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                default=OPTIONS[name].default,
                annotation=Annotated[
                    kind(name),
                    typer.Option(flag(name), metavar=OPTIONS[name].metavar, help=OPTIONS[name].help),
                ],
            )
            for name in names
        )
    )


#: All options of targets and constraints.
Options = Annotated[dict[str, Any], flags(*OPTIONS)]


def terms(options: Mapping[str, Any], reference: ModelReference) -> list[Ask]:
    """Return the terms of a model's score for options from the command line."""
    if options.get("match_image") is not None and options.get("match_shadow") is not None:
        raise InputError(
            "flags-exclude",
            flag="--match-image",
            other="--match-shadow",
            reason="there is one --camera and one --weight-image for both",
            cure="multiply `match_image(...)` and `match_shadow(...)` in Python",
        )
    return reference.terms(read(options))


def read(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values of options from the command line."""
    return {
        name: _numbers(name, value) if OPTIONS[name].kind in _NUMBERS and value is not None else value
        for name, value in options.items()
    }


def _numbers(name: str, text: str) -> Any:
    """Read numbers with commas between them: a direction, or the low and the high corner of a box."""
    corners, size, example = _NUMBERS[OPTIONS[name].kind]
    try:
        values = tuple(float(part) for part in text.split(","))
    except ValueError:
        values = ()
    low, high = values[:size], values[size:]
    if len(values) != corners * size:
        expected, noun = f"{corners * size} numbers with commas between them", "numbers"
    elif corners == 1 or all(a < b for a, b in zip(low, high, strict=True)):
        return low if corners == 1 else (low, high)
    else:
        along = "x, y and z" if size == 3 else "x and y"
        expected, noun = f"a low corner, then a corner that is higher along {along}", "a box"
    suggestion = f"such {noun}, for instance {example}"
    raise InputError(
        "bad-setting", name=flag(name), found=repr(text), expected=expected, suggestion=suggestion
    )
