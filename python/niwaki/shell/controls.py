"""What the shape should be like, as flags: each is one control, and controls multiply.

    --target crown.obj --avoid wall.obj --floor 0
    --match-image skyline.png --camera cam.json
    --match-image letter.png                        (models that draw in the plane)
    --match-shadow face.png --weight-image face_w.png --light -1,-0.3,0 --receiver floor.obj

The flags are the options of `niwaki.targets.asks`. Flags that contradict one another, or need another flag, are refused
before any file is read.
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

#: What is typed for options of these kinds; for others a text.
_TYPES: dict[str, Any] = {"number": float, "count": int, "meshes": list[str]}

#: Options that are typed as numbers with commas: how many corners, of how many numbers, and an example.
_NUMBERS = {
    "direction": (1, 3, "-1,-0.3,0"),
    "box": (2, 3, "-5,0,-5,5,10,5"),
    "window": (2, 2, "-12,-2,12,22"),
}


def kind(name: str) -> Any:
    """The type of an option, as it is typed."""
    found = _TYPES.get(OPTIONS[name].kind, str)
    return found if OPTIONS[name].default is not None else found | None


def flags(*names: str) -> Flags:
    """Options as flags; one that was not given is None."""
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


#: All options that were given.
Wish = Annotated[dict[str, Any], flags(*OPTIONS)]


def asked(wish: Mapping[str, Any], found: ModelReference) -> list[Ask]:
    """What is asked of a model by options as they were typed."""
    if wish.get("match_image") is not None and wish.get("match_shadow") is not None:
        raise InputError(
            "flags-exclude",
            flag="--match-image",
            other="--match-shadow",
            reason="both are seen by the one --camera and weighed by the one --weight-image",
            cure="multiply `match_image(...)` and `match_shadow(...)` in Python",
        )
    return found.asked(read(wish))


def read(wish: Mapping[str, Any]) -> dict[str, Any]:
    """The values of options that were typed."""
    return {
        name: _numbers(name, value) if OPTIONS[name].kind in _NUMBERS and value is not None else value
        for name, value in wish.items()
    }


def _numbers(name: str, text: str) -> Any:
    """A direction, or the low and the high corner of a box: numbers with commas between them."""
    corners, size, example = _NUMBERS[OPTIONS[name].kind]
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    low, high = found[:size], found[size:]
    if len(found) != corners * size:
        expected, such = f"{corners * size} numbers with commas between them", "numbers"
    elif corners == 1 or all(a < b for a, b in zip(low, high, strict=True)):
        return low if corners == 1 else (low, high)
    else:
        along = "x, y and z" if size == 3 else "x and y"
        expected, such = f"a low corner, then one that is higher along {along}", "a box"
    suggestion = f"such {such}, for instance {example}"
    raise InputError(
        "bad-setting", name=flag(name), found=repr(text), expected=expected, suggestion=suggestion
    )
