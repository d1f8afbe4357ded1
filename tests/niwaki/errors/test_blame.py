"""Claim: a message about an argument names the argument, and its help suits the value.

Every parameter of every shape gets a value of another kind, in the engine and as plain Python: about 90 calls.
"""

from __future__ import annotations

import inspect
from typing import Any

import niwaki as nw
import pytest
from niwaki import _engine
from niwaki.words.shapes import SHAPES

FRAME = ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), 0.5)
UPPER = ((0.0, 2.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), 0.4)
TOP = ((0.0, 4.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), 0.3)

#: An argument of each type.
FITS: dict[str, Any] = {
    "VecLike": (1, 1, 1),
    "float": 0.5,
    "Rotation": None,
    "Axis": (0, 1, 0),
    "str": "z",
    "Pairs": [(1, 0), (2, 1), (1, 2)],
    "Points": [(0, 0, 0), (9, 1, 0), (20, 0, 1), (20, 30, 1)],
    "Color": (1, 0, 0),
    "Bark": ((0, 0, 0), 1, (0, 1, 0), 1),
}
#: Required arguments of words for which `FITS` has none.
REQUIRED: dict[str, dict[str, Any]] = {
    "torus": {"radius": 1.0},
    "arch": {"thickness": 0.2},
    "limb": {"start": (0, 0, 0), "end": (0, 1, 0)},
    "segment": {"start": FRAME, "split": UPPER, "end": TOP},
    "mesh": {
        "vertices": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
        "faces": [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)],
    },
}
#: Letters have another message, and in plain Python NumPy reads meshes.
EXCEPTIONS = {
    ("box", "taper_axis"),
    ("cylinder", "axis"),
    ("cone", "axis"),
    ("torus", "axis"),
    ("extrude", "axis"),
    ("revolve", "axis"),
    ("mesh", "vertices"),
    ("mesh", "faces"),
}


def cases() -> list[tuple[Any, str]]:
    return [
        (word, name)
        for word in SHAPES
        for name in inspect.signature(word).parameters
        if (word.__name__, name) not in EXCEPTIONS
    ]


@pytest.mark.parametrize(("word", "name"), cases(), ids=lambda value: getattr(value, "__name__", value))
def test_the_error_about_a_wrong_type_names_its_parameter(word: Any, name: str) -> None:
    rows = _engine.SHAPES[word.__name__][1]
    names = [row[0] for row in rows]
    arguments = {row[0]: FITS.get(row[1]) for row in rows} | REQUIRED.get(word.__name__, {})
    assert word(**arguments) is not None
    with pytest.raises(Exception, match=f"`{name}` of `{word.__name__}` takes") as caught:
        word(**{**arguments, name: "#ff0000"})
    assert not any(f"`{other}`" in str(caught.value) for other in names if other != name)


def _limb(end: tuple[float, float, float], normal: Any = None) -> Any:
    @nw.model
    def model() -> None:
        nw.emit(nw.limb((0, 0, 0), end, 1, 1, normal, normal))

    return model


@nw.model
def colored() -> None:
    nw.emit(nw.box((0, 0, 0), (1, 1, 1), color="#ff0000"))


@nw.model
def deep() -> None:
    nw.emit(nw.extrude([(0, 0, 0), (1, 0, 0), (0, 0, 1)], 1.0))


@nw.model
def crossed() -> None:
    nw.emit(nw.extrude([(0, 0), (1, 1), (1, 0), (0, 1)], 1.0))


@nw.model
def frequent() -> int:
    return nw.poisson(1e18)


@pytest.mark.parametrize(
    ("model", "there", "not_there"),
    [
        (_limb((0, 0, 0)), ["the start and the end of a limb are the same point"], ["normal"]),
        (
            _limb((0, float("nan"), 0)),
            ["the end of a limb is [0.0, NaN, 0.0], expected finite numbers"],
            ["normal"],
        ),
        (_limb((0, 1, 0), (0, 0, 0)), ["the start normal is [0.0, 0.0, 0.0]"], []),
        (colored, ["`color` of `box`", "red, green and blue from 0 to 1", "`hsv`"], ["`center`", "`size`"]),
        (
            deep,
            [
                "`polygon` of `extrude` takes vectors of 2 components, found 3",
                "is a list of pairs of numbers",
            ],
            ["three"],
        ),
        (
            crossed,
            ["the side from point 0 to point 1 meets the side from point 2 to point 3"],
            ["argument"],
        ),
        (frequent, ["`rate` of poisson is 1e18, expected a number from 0 to 1e15", "`min`"], []),
    ],
    ids=[
        "a limb of length 0",
        "a limb to nowhere",
        "a normal of length 0",
        "a color as text",
        "a polygon of points of space",
        "a polygon that crosses itself",
        "a rate of 1e18",
    ],
)
@pytest.mark.parametrize("run", [nw.run, nw.run_python])
def test_the_error_names_the_wrong_argument(
    model: Any, there: list[str], not_there: list[str], run: Any
) -> None:
    with pytest.raises(nw.ModelFault) as caught:
        run(model, seed=1)
    text = str(caught.value).split("-->")[0] + str(caught.value).split("= ", 1)[1]
    assert all(part in text for part in there), text
    assert not any(part in text for part in not_there), text


def item() -> dict[str, int]:
    p = {"h": 1}
    p["h"] = 2
    return p


def added() -> dict[str, int]:
    p = {"h": 1}
    p["h"] += 2
    return p


def popped() -> dict[str, int]:
    p = {"h": 1}
    p.pop("h")
    return p


def listed() -> list[int]:
    xs = [1, 2]
    xs[1] = 2
    return xs


@pytest.mark.parametrize(
    ("function", "there", "not_there"),
    [
        (item, 'write a dict with all of its keys: `p = {"h": value, ...}`', "list"),
        (added, 'write a dict with all of its keys: `p = {"h": value, ...}`', "list"),
        (popped, "a dict with all its keys", "[:-1]"),
        (listed, "for a list write `xs = xs[:1] + [value] + xs[1 + 1:]`", "popitem"),
    ],
)
def test_the_help_suits_the_changed_value(function: Any, there: str, not_there: str) -> None:
    with pytest.raises(nw.ModelError) as caught:
        nw.model(function).core()
    help = str(caught.value).split("= help: ")[1]
    assert there in help and not_there not in help
