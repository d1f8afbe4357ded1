"""Claim: a cut sheet can be cut: nothing overlaps, all lies on the board, and each piece comes out at its size."""

from __future__ import annotations

import io
import sys
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki import stacks
from niwaki.stacks import Sheet, Structure, assembly, cut_sheet

ezdxf = pytest.importorskip("ezdxf")
geometry = pytest.importorskip("shapely.geometry")
MODELS = (stacks.cut_stack, stacks.cut_lean, stacks.cut_arch, stacks.tilt_stack)


def structure(model: object = stacks.cut_arch, seed: int = 1) -> Structure:
    """A draw of the prior that has convex blocks: nothing here needs balance."""
    for k in range(seed, 100_000, 10):
        try:
            return Structure.of(nw.run_python(model, seed=k))  # type: ignore[arg-type]
        except nw.NiwakiError:
            continue
    raise AssertionError("no convex draw")


def faults(sheet: Sheet) -> list[str]:
    """Return the faults of a sheet that cannot be cut."""
    texts = []
    width, height = sheet.board
    inside = geometry.box(0, 0, width, height).buffer(-sheet.gap + 1e-6)
    cuts = {piece.number: geometry.Polygon(piece.cut) for piece in sheet.pieces}
    for piece in sheet.pieces:
        if not inside.contains(cuts[piece.number]):
            texts.append(f"{piece.number} leaves the board")
        left = cuts[piece.number].buffer(-0.5 * sheet.kerf, join_style="mitre")
        if left.hausdorff_distance(geometry.Polygon(piece.outline)) > 1e-6:
            texts.append(f"{piece.number} has another size")
    for first, second in combinations(sheet.pieces, 2):
        if (
            first.board == second.board
            and cuts[first.number].distance(cuts[second.number]) < sheet.gap - 1e-6
        ):
            texts.append(f"{first.number} meets {second.number}")
    return texts


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
@pytest.mark.parametrize("board", [(600.0, 400.0), (200.0, 120.0)], ids=["large", "small"])
def test_pieces_lie_apart_on_their_boards(model: object, board: tuple[float, float]) -> None:
    for seed in range(5):
        tower = structure(model, seed)
        sheet = cut_sheet(tower, board, kerf=0.3, gap=1.5)
        assert faults(sheet) == []
        assert [piece.number for piece in sheet.pieces] == list(range(1, len(tower) + 1))
        areas = [geometry.Polygon(piece.outline).area * sheet.thickness for piece in sheet.pieces]
        np.testing.assert_allclose(areas, 1e9 * tower.solids()[0], rtol=1e-6)


def test_a_piece_that_is_pushed_is_found_out() -> None:
    sheet = cut_sheet(structure(), (600.0, 400.0))
    first, second, *rest = sheet.pieces
    there = second.cut.min(axis=0) - first.cut.min(axis=0)
    assert faults(
        replace(
            sheet,
            pieces=(replace(first, cut=first.cut + there, outline=first.outline + there), second, *rest),
        )
    )
    assert faults(
        replace(sheet, pieces=(replace(first, cut=first.cut - 10, outline=first.outline - 10), second, *rest))
    )
    assert faults(replace(sheet, pieces=(replace(first, cut=first.outline), second, *rest)))


def test_a_small_board_takes_several() -> None:
    sheet = cut_sheet(structure(), (160.0, 110.0))
    assert sheet.boards > 1
    assert all(sheet.on(board) for board in range(sheet.boards))


def test_dxf_is_in_millimetres_with_numbers_and_closed_cuts() -> None:
    sheet = cut_sheet(structure(), (600.0, 400.0))
    document = ezdxf.read(io.StringIO(sheet.dxf()))
    assert document.units == 4
    cuts = document.modelspace().query('LWPOLYLINE[layer=="CUT"]')
    assert len(cuts) == len(sheet.pieces) and all(cut.closed for cut in cuts)
    for cut, piece in zip(cuts, sheet.pieces, strict=True):
        np.testing.assert_allclose(np.array(cut.get_points("xy")), piece.cut, atol=1e-9)
    numbers = [text.dxf.text for text in document.modelspace().query("TEXT")]
    assert numbers == [str(piece.number) for piece in sheet.pieces]
    assert not document.audit().has_errors


def test_svg_is_in_millimetres() -> None:
    sheet = cut_sheet(structure(), (600.0, 400.0))
    root = ET.fromstring(sheet.svg())
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("600mm", "400mm", "0 0 600 400")
    space = "{http://www.w3.org/2000/svg}"
    assert len(root.findall(f"{space}polygon")) == 7
    assert [text.text for text in root.findall(f"{space}text")] == [str(k) for k in range(1, 8)]


def test_the_assembly_drawing_numbers_every_piece_that_is_seen() -> None:
    tower = structure()
    root = ET.fromstring(assembly(tower).svg())
    space = "{http://www.w3.org/2000/svg}"
    assert len(root.findall(f"{space}polygon")) == 2 * len(tower)
    texts = [text.text for text in root.iter(f"{space}text")]
    front = texts[: texts.index("front")]
    assert sorted(front, key=str) == [str(k) for k in range(1, len(tower) + 1)]
    # From the right the pieces of an arch hide one another.
    assert len(texts) - len(front) - 2 < len(tower)


def test_the_recipe_of_the_manual_gives_a_tower_that_stands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("mujoco")
    page = (Path(__file__).parents[3] / "docs" / "guide" / "structures.md").read_text()
    recipe = page.partition("## Cutting")[2].partition("```python\n")[2].partition("```")[0]
    monkeypatch.chdir(tmp_path)
    known: dict[str, object] = {"nw": nw, "stacks": stacks}
    exec(recipe, known)  # noqa: S102
    pieces = known["pieces"]
    assert isinstance(pieces, Structure)
    assert stacks.balanced(pieces).holds and stacks.simulated(pieces).stands
    assert {path.name for path in tmp_path.iterdir()} == {"tower.dxf", "tower.svg", "assembly.svg"}


def test_boards_are_saved_one_to_a_file(tmp_path: Path) -> None:
    sheet = cut_sheet(structure(), (160.0, 110.0))
    files = sheet.save(tmp_path / "arch.dxf")
    assert [path.name for path in files] == [
        "arch.dxf",
        *(f"arch-{k + 1}.dxf" for k in range(1, sheet.boards)),
    ]
    assert all(path.stat().st_size for path in files)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: cut_sheet(structure(stacks.stack)), "cannot be cut from a board"),
        (lambda: cut_sheet(structure(), (50.0, 50.0)), "the board is too small"),
        (lambda: cut_sheet(structure(), kerf=-1.0), "`kerf` cannot be -1.0"),
        (lambda: cut_sheet(structure()).save("arch.pdf"), "not a format that can be cut"),
    ],
    ids=["solid", "board", "kerf", "format"],
)
def test_pieces_that_cannot_be_cut_are_reported(make: object, words: str) -> None:
    with pytest.raises(nw.NiwakiError, match=words):
        make()  # type: ignore[operator]


@pytest.mark.parametrize(
    ("library", "make"),
    [
        ("rectpack", lambda tower: cut_sheet(tower)),
        ("shapely.geometry", lambda tower: assembly(tower)),
        ("ezdxf", lambda tower: cut_sheet(tower).dxf()),
        ("scipy.sparse", lambda tower: stacks.balanced(tower)),
        ("mujoco", lambda tower: stacks.simulated(tower)),
    ],
    ids=["rectpack", "shapely", "ezdxf", "scipy", "mujoco"],
)
def test_a_missing_library_is_named_by_its_extra(
    library: str, make: Callable[[Structure], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    tower = structure()
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(
        nw.NiwakiError, match=r"needs the extra `stacks`[\s\S]*pip install 'niwaki\[stacks\]'"
    ):
        make(tower)
