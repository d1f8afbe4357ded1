"""Options for scores, by name: flags of the shell, keys of a batch, fields of a form.

An option asks for a sketch, and its value is the sketch's first parameter. An option without a sketch is a parameter
of that name of the sketches of other options. The options become a list of sketches with their arguments. `score`
makes the product of them, and `Score.data` writes it.

>>> sketches_of({"floor": 0.0, "target": "gallery:ship", "sigma": 0.01})
[('no_self_intersection', {}), ('floor', {'y': 0.0}), ('match_volume', {'target': 'gallery:ship', 'sigma': 0.01})]
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from niwaki.targets.sketches import FREE, SKETCHES, Ask, Score, Window, match_volume

#: Sketches of a drawing in the plane, where parts of a scene may cross.
DRAWN = tuple(name for name, make in SKETCHES.items() if "window" in inspect.signature(make).parameters)


@dataclass(frozen=True)
class Option:
    """An option.

    Attributes
    ----------
    kind : str
        The kind of its value: "mesh", "meshes", "image" or "camera", which may be files, "number", "count",
        "direction", "box", "window" or "word".
    help : str
        Its description.
    metavar : str
        The placeholder of its value.
    asks : tuple of str
        The sketches that it asks for: the first, or the second for drawings in the plane. Without sketches, it is a
        further parameter.
    alone : str
        The reason why it needs a sketch with this parameter; empty if it does not.
    needed : str
        The reason why sketches with this parameter need it.
    beside : str
        The option that it needs.
    default : Any
        Its value when it is absent.
    sets : str
        The parameter that it sets, where that has another name.
    of : tuple of str
        The sketches whose parameter it is; empty for all that have it.
    """

    kind: str
    help: str
    metavar: str
    asks: tuple[str, ...] = ()
    alone: str = ""
    needed: str = ""
    beside: str = ""
    default: Any = None
    sets: str = ""
    of: tuple[str, ...] = ()


OPTIONS: dict[str, Option] = {
    "target": Option(
        "mesh",
        "A mesh to fill: OBJ, STL, PLY, GLB, or `gallery:` and a name. Default: a gallery model's own.",
        "FILE",
        ("match_volume",),
    ),
    "avoid": Option("meshes", "A mesh to avoid; may be repeated.", "FILE", ("avoid",)),
    "floor": Option("number", "A height to stay above.", "Y", ("floor",)),
    "within": Option(
        "box",
        "Low and high corner of a box to stay in; soft: parts outside lower the score.",
        "X,Y,Z,X,Y,Z",
        ("overshoot",),
    ),
    "match_image": Option(
        "image",
        "A silhouette to match, seen by --camera; for models that draw, ink on white paper, or the name of a drawing "
        "such as `letters/E`.",
        "FILE",
        ("match_image", "match_drawing"),
    ),
    "match_shadow": Option(
        "image", "A shadow to cast; needs --light and --receiver.", "FILE", ("match_shadow",)
    ),
    "camera": Option(
        "camera",
        "The camera that sees the image or the shadow, a JSON file. Default of a shadow: along the light.",
        "FILE",
        alone="only a picture is seen by a camera",
        needed="an image is seen by a camera; this model does not draw in a window of the plane",
    ),
    "weight_image": Option(
        "image",
        "An image, white where a pixel counts more; of the same size.",
        "FILE",
        alone="it weights the pixels of a picture",
    ),
    "weight": Option(
        "number",
        "How much more a white pixel counts: 1 + NUMBER times. Default: 10.",
        "NUMBER",
        alone="it is the weight of the white pixels",
        beside="weight_image",
        of=("match_image", "match_shadow"),
    ),
    "light": Option(
        "direction",
        "The direction in which the light travels.",
        "X,Y,Z",
        alone="only a shadow has a light",
        needed="a shadow needs a light",
    ),
    "receiver": Option(
        "mesh",
        "A mesh that the shadow falls on.",
        "FILE",
        alone="only a shadow has a receiver",
        needed="a shadow needs a receiver",
    ),
    "window": Option(
        "window",
        "Low and high corner of what a drawing shows. Default: the model's.",
        "X,Y,X,Y",
        alone="it is what the image shows of the plane",
    ),
    "pixels": Option(
        "count",
        "Longer side of a drawing when it is compared. Default: 50.",
        "N",
        alone="it is the size in which a drawing is compared",
    ),
    "voxel": Option(
        "number", "Cell size. Default: depends on the model or target; half as large for a thin one.", "SIZE"
    ),
    "sigma": Option(
        "number",
        "Strictness of the match; smaller is stricter. Default: 0.02, drawings 0.014.",
        "NUMBER",
    ),
    "volume_weight": Option(
        "word",
        "Which cells count around a target: all, or those that the target or the scene fills. Default: balanced around "
        "thin targets in searches for the best, else cells.",
        "cells|balanced",
        alone="it is how the cells of a target count",
        sets="weight",
        of=("match_volume",),
    ),
    "rule": Option(
        "word",
        "Which parts count as intersecting; none: parts may overlap.",
        "solid|surface|none",
        default="solid",
    ),
}

#: Options that may name a file.
FILES = tuple(
    name for name, option in OPTIONS.items() if option.kind in ("mesh", "meshes", "image", "camera")
)


@cache
def parameters(name: str) -> dict[str, str]:
    """Return the parameter that an option sets, by sketch."""
    option = OPTIONS[name]
    if option.asks:
        return {sketch: next(iter(_parameters(sketch))) for sketch in option.asks}
    parameter = option.sets or name
    return {sketch: parameter for sketch in option.of or SKETCHES if parameter in _parameters(sketch)}


def sketches_of(
    options: Mapping[str, Any], defaults: Iterable[Ask] = (), page: Window | None = None, name: str = ""
) -> list[Ask]:
    """Return the sketches of options with their arguments, in the order of `SKETCHES`.

    Parameters
    ----------
    options
        Values of options, None for absent options. The name of a file stands for its content.
    defaults
        The sketches of a model, where no option asks for a target.
    page
        The part of the plane in which the model draws; None for models in space.
    name
        The name of the model, for messages.

    Raises
    ------
    InputError
        `flag-alone`: an option lacks another; `no-target`: there is nothing to match.
    """
    options = {key: value for key, value in options.items() if value is not None}
    is_drawn = "camera" not in options and (page is not None or "window" in options)
    asks: list[Ask] = []
    for key, value in options.items():
        option = OPTIONS[key]
        for sketch in option.asks[-1:] if is_drawn else option.asks[:1]:
            first = parameters(key)[sketch]
            asks += [(sketch, {first: mesh}) for mesh in (value if option.kind == "meshes" else [value])]
    _check(options, {sketch for sketch, _ in asks})
    if not any(sketch.startswith("match_") for sketch, _ in asks):
        asks += ((sketch, dict(arguments)) for sketch, arguments in defaults)
        if not any(sketch.startswith(("match_", "fill_")) for sketch, _ in asks):
            raise InputError("no-target", name=name)
    if not any(sketch in DRAWN for sketch, _ in asks):
        asks.append(("no_self_intersection", {}))
    if options.get("rule") == FREE:
        asks = [ask for ask in asks if ask[0] != "no_self_intersection"]
    for sketch, arguments in asks:
        arguments |= {
            parameters(key)[sketch]: options[key]
            for key in options
            if not OPTIONS[key].asks and sketch in parameters(key)
        }
        if sketch == "match_drawing":
            side = arguments.pop("pixels", drawings.SIDE)
            arguments["image"] = _drawing(arguments["image"], side)
            arguments.setdefault("window", page)
    order = list(SKETCHES)
    return sorted(asks, key=lambda ask: order.index(ask[0]))


def score(asks: Iterable[Ask], volume: Callable[..., Score] = match_volume) -> Score:
    """Return the product of sketches; `volume` makes that of a target to fill."""
    product = Score()
    for sketch, arguments in asks:
        if sketch == "match_drawing":
            product *= arguments["image"].score(
                **{key: value for key, value in arguments.items() if key != "image"}
            )
        else:
            make = volume if sketch == "match_volume" else SKETCHES[sketch]
            product *= make(**arguments)
    return product


def start(asks: Iterable[Ask]) -> dict[str, Any]:
    """Return the arguments of a model that follows a drawing: its start and direction."""
    for sketch, arguments in asks:
        if sketch == "match_drawing":
            return dict(zip(("x", "y", "ahead"), arguments["image"].place(arguments["window"]), strict=True))
    return {}


def flag(name: str) -> str:
    """Return the flag of an option."""
    return f"--{name.replace('_', '-')}"


def _check(options: Mapping[str, Any], sketches: set[str]) -> None:
    """Refuse options that need an absent option."""
    for key, option in OPTIONS.items():
        known = set(parameters(key))
        if key in options and option.alone and (not known & sketches or option.beside not in {"", *options}):
            raise _alone(key, [option.beside] if option.beside else _asking(known), option.alone)
        for sketch in known & sketches if option.needed and key not in options else ():
            if _parameters(sketch)[key].default is inspect.Parameter.empty:
                raise _alone(_asking([sketch])[0], [key], option.needed)


def _parameters(sketch: str) -> Mapping[str, inspect.Parameter]:
    return inspect.signature(SKETCHES[sketch]).parameters


def _asking(sketches: Iterable[str]) -> list[str]:
    """Return the options that ask for any of these sketches."""
    return [key for key, option in OPTIONS.items() if {*option.asks} & {*sketches}]


def _alone(name: str, keys: list[str], reason: str) -> InputError:
    other = " or ".join(f"`{flag(key)}`" for key in keys)
    return InputError("flag-alone", flag=flag(name), other=other, reason=reason)


def _drawing(image: Any, side: int) -> Drawing:
    """Return the drawing of a name, of a file, or of an array as it is."""
    if isinstance(image, Drawing):
        return image
    if isinstance(image, str | Path):
        return drawings.find(str(image), side)
    return Drawing.load(image, None)
