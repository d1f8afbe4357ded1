"""What a person can ask of a scene, by name: flags of the shell, keys of a batch, fields of a form.

An option asks for a sketch, whose first parameter it is, or is the parameter of that name of the sketches that are
asked for. What is asked is one value, a list of sketches with what each is given: `score` makes the product of them,
and `Score.data` writes it.

>>> asked({"floor": 0.0, "target": "gallery:ship", "sigma": 0.01})
[('no_self_intersection', {}), ('floor', {'y': 0.0}), ('match_volume', {'target': 'gallery:ship', 'sigma': 0.01})]
"""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.targets import drawings
from niwaki.targets.drawing import Drawing
from niwaki.targets.sketches import SKETCHES, Ask, Score, Window

#: Sketches of what is drawn in the plane, where parts of a scene may cross.
DRAWN = ("match_drawing", "fill_drawing")


@dataclass(frozen=True)
class Option:
    """Something that can be asked.

    Attributes
    ----------
    kind : str
        Of its value: "mesh", "meshes", "image", "camera" (each of which may be a file), "number", "count", "direction",
        "box", "window" or "word".
    help : str
        What it is.
    metavar : str
        What stands for its value.
    asks : tuple of str
        The sketches that it asks for: the first one, or the second for what is drawn in the plane. With none it is a
        further parameter.
    alone : str
        Why it is nothing without a sketch that has it; empty where it may be left over.
    needed : str
        Why the sketches that have it are nothing without it.
    beside : str
        The option that it is nothing without.
    usual : Any
        Its value when left out.
    """

    kind: str
    help: str
    metavar: str
    asks: tuple[str, ...] = ()
    alone: str = ""
    needed: str = ""
    beside: str = ""
    usual: Any = None


OPTIONS: dict[str, Option] = {
    "target": Option(
        "mesh", "A mesh to fill: OBJ, STL, PLY, GLB, or `gallery:` and a name.", "FILE", ("match_volume",)
    ),
    "avoid": Option("meshes", "A mesh to avoid; may be repeated.", "FILE", ("avoid",)),
    "floor": Option("number", "A height to stay above.", "Y", ("floor",)),
    "within": Option("box", "Low and high corner of a box to stay in; soft.", "X,Y,Z,X,Y,Z", ("overshoot",)),
    "match_image": Option(
        "image",
        "A silhouette to match, seen by --camera; for models that draw, ink on white paper, or a drawing's name.",
        "FILE",
        ("match_image", "match_drawing"),
    ),
    "match_shadow": Option(
        "image", "A shadow to cast; needs --light and --receiver.", "FILE", ("match_shadow",)
    ),
    "camera": Option(
        "camera",
        "The camera that sees the image or the shadow, a JSON file.",
        "FILE",
        alone="only a picture is seen by a camera",
        needed="an image is seen by a camera; this model does not draw in a window of the plane",
    ),
    "weight_image": Option(
        "image",
        "An image, white where a pixel counts more.",
        "FILE",
        alone="it weights the pixels of a picture",
    ),
    "weight": Option(
        "number",
        "How much more a white pixel counts. Default: 10.",
        "NUMBER",
        alone="it is the weight of the white pixels",
        beside="weight_image",
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
    "voxel": Option("number", "Cell size. Default: depends on the model or target.", "SIZE"),
    "sigma": Option(
        "number",
        "Strictness of the match; smaller is stricter. Default: 0.02, drawings 0.014.",
        "NUMBER",
    ),
    "rule": Option("word", "Which parts count as intersecting.", "solid|surface", usual="solid"),
}

#: Options that may name a file.
FILES = tuple(name for name, one in OPTIONS.items() if one.kind in ("mesh", "meshes", "image", "camera"))


@cache
def parameters(name: str) -> dict[str, str]:
    """The parameter of each sketch that an option is."""
    found = OPTIONS[name].asks
    if found:
        return {sketch: next(iter(_parameters(sketch))) for sketch in found}
    return {sketch: name for sketch in SKETCHES if name in _parameters(sketch)}


def asked(
    given: Mapping[str, Any], usual: Iterable[Ask] = (), page: Window | None = None, name: str = ""
) -> list[Ask]:
    """What is asked by these options: sketches with what they are given, in the order of `SKETCHES`.

    Parameters
    ----------
    given
        Values of options, None for those that are not given; what can be a file may be its name.
    usual
        What a scene should match where no option says it.
    page
        The part of the plane in which the model draws; None for models in space.
    name
        The model, for messages.

    Raises
    ------
    InputError
        `flag-alone`: an option lacks another; `no-target`: there is nothing to match.
    """
    given = {key: value for key, value in given.items() if value is not None}
    is_drawn = "camera" not in given and (page is not None or "window" in given)
    chosen: list[Ask] = []
    for key, value in given.items():
        option = OPTIONS[key]
        for sketch in option.asks[-1:] if is_drawn else option.asks[:1]:
            first = parameters(key)[sketch]
            chosen += [(sketch, {first: one}) for one in (value if option.kind == "meshes" else [value])]
    _check(given, {sketch for sketch, _ in chosen})
    if not any(sketch.startswith("match_") for sketch, _ in chosen):
        chosen += ((sketch, dict(own)) for sketch, own in usual)
        if not any(sketch.startswith(("match_", "fill_")) for sketch, _ in chosen):
            raise InputError("no-target", name=name)
    if not any(sketch in DRAWN for sketch, _ in chosen):
        chosen.append(("no_self_intersection", {}))
    for sketch, own in chosen:
        own |= {key: given[key] for key in given if not OPTIONS[key].asks and sketch in parameters(key)}
        if sketch == "match_drawing":
            side = own.pop("pixels", drawings.SIDE)
            own["image"] = _drawing(own["image"], side)
            own.setdefault("window", page)
    order = list(SKETCHES)
    return sorted(chosen, key=lambda one: order.index(one[0]))


def score(asks: Iterable[Ask]) -> Score:
    """The score of what is asked."""
    product = Score()
    for sketch, own in asks:
        if sketch == "match_drawing":
            product *= own["image"].score(**{key: value for key, value in own.items() if key != "image"})
        else:
            product *= SKETCHES[sketch](**own)
    return product


def start(asks: Iterable[Ask]) -> dict[str, Any]:
    """The arguments of a model that follows a drawing: where it starts, and the direction."""
    for sketch, own in asks:
        if sketch == "match_drawing":
            return dict(zip(("x", "y", "ahead"), own["image"].place(own["window"]), strict=True))
    return {}


def flag(name: str) -> str:
    """An option as it is typed."""
    return f"--{name.replace('_', '-')}"


def _check(given: Mapping[str, Any], sketches: set[str]) -> None:
    """Refuse options that lack another."""
    for key, option in OPTIONS.items():
        own = set(parameters(key))
        if key in given and option.alone and (not own & sketches or option.beside not in {"", *given}):
            raise _alone(key, [option.beside] if option.beside else _asking(own), option.alone)
        for sketch in own & sketches if option.needed and key not in given else ():
            if _parameters(sketch)[key].default is inspect.Parameter.empty:
                raise _alone(_asking([sketch])[0], [key], option.needed)


def _parameters(sketch: str) -> Mapping[str, inspect.Parameter]:
    return inspect.signature(SKETCHES[sketch]).parameters


def _asking(sketches: Iterable[str]) -> list[str]:
    """The options that ask for one of these sketches."""
    return [key for key, option in OPTIONS.items() if {*option.asks} & {*sketches}]


def _alone(name: str, others: list[str], reason: str) -> InputError:
    other = " or ".join(f"`{flag(one)}`" for one in others)
    return InputError("flag-alone", flag=flag(name), other=other, reason=reason)


def _drawing(image: Any, side: int) -> Drawing:
    """The drawing of an image: of a name or a file, or of an array as it is."""
    if isinstance(image, Drawing):
        return image
    if isinstance(image, str | Path):
        return drawings.find(str(image), side)
    return Drawing.load(image, None)
