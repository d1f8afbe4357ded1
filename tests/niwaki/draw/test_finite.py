"""Claim: no file has a number that is not finite; a message names the part, and no file is written."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import _engine
from niwaki.draw import finite, parts, plan
from niwaki.draw.scene import Scene
from niwaki.errors import FileError, NiwakiError
from niwaki.shell import sample as sampling
from niwaki.stacks.cut_sheet import Piece, Sheet

GOLDEN = Path(__file__).parents[2] / "golden"


def scene(size: float) -> Scene:
    return Scene(
        [
            ("ship/body", [_engine.shape("box", (0, 0, 0), (2, 1, 4), bevel=0.0)]),
            ("ship/mast", [_engine.shape("box", (0, 0, 0), (size, size, size), bevel=0.0)]),
        ]
    )


def failing(folder: Path) -> dict[str, Callable[[], Any]]:
    """Calls that must fail, by their names."""
    return {
        "a scale that 32 bits cannot hold, stl": lambda: scene(1.0).export(folder / "big.stl", scale=1e300),
        "a scale that 32 bits cannot hold, 3mf": lambda: scene(1.0).export(folder / "big.3mf", scale=1e39),
        "an infinite scale": lambda: scene(1.0).export(folder / "big.stl", scale=math.inf),
        "a camera that looks nowhere": lambda: scene(1.0).save(folder / "big.png", azimuth=math.nan),
        "a picture of no size": lambda: scene(1.0).save(folder / "big.png", size=(math.nan, 10)),
        "a picture of half a pixel": lambda: scene(1.0).save(folder / "big.png", size=(10.5, 10)),
        "a page without an edge": lambda: plan.save(
            folder / "plan.svg", scene(1.0), [(0, 0), (math.inf, 1), (0, 1)]
        ),
        "a cut to nowhere": lambda: sheet(math.nan).save(folder / "cut.dxf"),
        "a cut without end": lambda: sheet(math.inf).save(folder / "cut.svg"),
        "JSON": lambda: finite.json_text({"size": math.nan}, "the colours"),
    }


def sheet(number: float) -> Sheet:
    outline = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, number]])
    return Sheet((Piece(number=1, outline=outline, cut=outline, board=0),), (100.0, 100.0), 1, 3.0, 0.2, 2.0)


def test_messages_name_the_part(tmp_path: Path, golden: Any) -> None:
    texts = []
    for name, fails in failing(tmp_path).items():
        with pytest.raises(NiwakiError) as caught:
            fails()
        texts.append(f"## {name}\n\n{caught.value}\n".replace(str(tmp_path), "FOLDER"))
    golden(GOLDEN / "finite.txt", "\n".join(texts))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("suffix", ["glb", "obj", "ply", "stl", "3mf"])
@pytest.mark.parametrize("size", [1e-300, 1e-30, 1e-9, 1e6, 9e11])
def test_extreme_sizes_give_a_message_or_finite_numbers(tmp_path: Path, suffix: str, size: float) -> None:
    try:
        extreme = scene(size)
    except ValueError:  # the engine refuses a box without a volume
        return
    try:
        path = extreme.export(tmp_path / f"ship.{suffix}")
    except NiwakiError as error:
        assert str(error)
        return
    data = path.read_bytes()
    if suffix == "obj":
        assert b"nan" not in data and b"inf" not in data
    if suffix == "stl":
        record = np.dtype([("corners", "<f4", (4, 3)), ("attribute", "<u2")])
        assert np.isfinite(np.frombuffer(data, record, offset=84)["corners"]).all()
    if suffix == "glb":
        size_ = int.from_bytes(data[12:16], "little")
        document = json.loads(data[20 : 20 + size_], parse_constant=lambda text: pytest.fail(text))
        assert document["nodes"]


@pytest.mark.parametrize("suffix", ["glb", "obj", "ply"])
@pytest.mark.parametrize("bad", [0, 2])
def test_a_mesh_that_is_not_finite_gives_no_file(
    tmp_path: Path, suffix: str, bad: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The engine keeps shapes within 1e12 of the origin, so the test simulates a fault of the engine.
    meshes = parts._engine.meshes([part.shapes for part in scene(1.0).parts])
    meshes[0][bad][0] = math.inf, math.nan, 0.0
    monkeypatch.setattr(parts, "_engine", SimpleNamespace(meshes=lambda _: meshes))
    with pytest.raises(FileError, match="ship/body has numbers"):
        scene(1.0).export(tmp_path / f"ship.{suffix}")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("size", [1e-300, 1e-9, 9e11])
def test_extreme_drawings_give_a_message_or_finite_numbers(tmp_path: Path, size: float) -> None:
    try:
        flat = Scene([("line", [_engine.shape("stroke", (0, 0, 0), (size, size, 0), 0.1, 0.1)])])
        text = flat.export(tmp_path / "line.svg").read_text()
    except (NiwakiError, ValueError):  # no length
        return
    assert "nan" not in text and "inf" not in text


@nw.model
def endless():
    x = nw.uniform(0.0, 1.0)
    return (x * math.inf, [x, -math.inf], {"a": math.nan})


def test_a_table_has_no_number_that_is_not_finite() -> None:
    result = nw.run(endless, method=nw.mh(20, kernel=nw.kernels.prior()), seed=1)
    text = sampling._table(result)
    assert "inf" not in text and "nan" not in text and "None" in text and "0.0" in text


def test_finite_numbers_stay_unchanged() -> None:
    values = np.array([[1e38, -1e38], [0.0, 5e-324]])
    assert (finite.finite(values, "a") == values).all()
    assert finite.floats(values, "a").dtype == np.float32
    with pytest.raises(FileError, match="a has numbers"):
        finite.floats([1e39], "a")
