"""Colours by name, looks that an `emit` gives to shapes of helpers, materials in files, and meshes of the module."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from niwaki import Target, box, cylinder, disc, emit, forward, mesh, model, run, run_python, uniform
from niwaki.errors import ModelFault
from niwaki.words import color_difference, lerp, rgb, to_hsv

RED = (200 / 255, 60 / 255, 30 / 255)
TETRAHEDRON = Target(
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], "t"
)


def roof(color: Any = None) -> Any:
    """A shape of a helper."""
    return [box((0, 1, 0), (2, 0.2, 2), color=color), cylinder((0, 2, 0), 0.1, 1)]


@model
def hut() -> None:
    """Shapes of helpers, with looks of the `emit`."""
    emit(roof(), color="#c83c1e", material="tile")
    emit(roof("Tomato"), disc((0, 0, 0), 1), color=(uniform(0, 1), 0, 0), roughness=0.25, metalness=1)
    emit(mesh(TETRAHEDRON.vertices, TETRAHEDRON.faces), color=lerp(rgb("white"), rgb("black"), 0.5))


def shapes(result: Any) -> list[Any]:
    return [shape for part in result.best.parts for shape in part.shapes]


def test_an_emit_colours_what_has_no_colour() -> None:
    result = run(hut, forward(1), seed=1)
    first, second, *rest = shapes(result)
    for shape in (first, second):
        assert shape.material == "tile" and shape.color == pytest.approx(RED)
    tomato, drawn, flat, grey = rest
    assert tomato.color == pytest.approx(rgb("tomato").parts) and tomato.metalness == 1
    assert drawn.color == flat.color and drawn.color[0] == pytest.approx(result.best.choices["uniform"])
    assert (flat.roughness, flat.material, grey.color) == (None, None, [0.5, 0.5, 0.5])
    plain = run_python(hut, choices=result.best.choices).scene
    assert [shape for _, part in plain for shape in part] == shapes(result)


def test_names_are_colours_wherever_a_colour_goes() -> None:
    assert to_hsv("red").parts == (0.0, 1.0, 1.0)
    assert color_difference("#f00", "Red") == 0.0
    assert rgb("rebeccapurple").parts == pytest.approx((0.4, 0.2, 0.6))


@model
def mistyped() -> None:
    """A colour that is no name."""
    emit(box((0, 0, 0), (1, 1, 1), color="tomatoe"))


@model
def short() -> None:
    """Digits that are no colour."""
    emit(box((0, 0, 0), (1, 1, 1)), color="#c83c1")


@model
def unnamed() -> None:
    """A material without a name."""
    emit(box((0, 0, 0), (1, 1, 1)), material="")


@pytest.mark.parametrize(
    ("wrong", "code", "message"),
    [
        (
            mistyped,
            "type-mismatch",
            '`color` of `box`: no colour is called "tomatoe"; did you mean "tomato"?',
        ),
        (short, "type-mismatch", '`color` of `emit` takes a colour of 3 or 6 digits such as "#c83c1e"'),
        (unnamed, "bad-shape", 'the material is "", expected a name of 1 to 100 characters'),
    ],
)
def test_wrong_looks_are_reported_at_the_call(wrong: Any, code: str, message: str) -> None:
    for go in (lambda: run_python(wrong, seed=1), lambda: run(wrong, forward(1), seed=1)):
        with pytest.raises(ModelFault) as fault:
            go()
        assert fault.value.code == code
        assert message in str(fault.value) and "^^^^" in str(fault.value)


def test_files_keep_materials(tmp_path: Path) -> None:
    sample = run(hut, forward(1), seed=1).best
    data = sample.export(tmp_path / "a hut.glb").read_bytes()
    (length,) = struct.unpack("<I", data[12:16])
    names = [material["name"] for material in json.loads(data[20 : 20 + length])["materials"]]
    assert names.count("tile") == 1
    text = sample.export(tmp_path / "a hut.obj").read_text()
    assert "mtllib a_hut.mtl\n" in text and text.count("usemtl tile\n") == 1 and "usemtl none\n" in text
    library = (tmp_path / "a_hut.mtl").read_text().split("\n")
    assert library[1] == "newmtl tile"
    np.testing.assert_allclose([float(part) for part in library[2].split()[1:]], RED, rtol=1e-5)
