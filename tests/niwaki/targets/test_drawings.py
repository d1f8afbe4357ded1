"""Claim: drawings are read as ink on paper, start in their ink, and those that are held out never change."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import FileError, InputError
from niwaki.targets import drawings, images
from niwaki.targets.drawing import Drawing, lowest
from PIL import Image, ImageDraw, ImageFilter

#: Of the pixels and the starts of every drawing that is held out, in the order of the table.
HELD_OUT = "4b888199089e83d82847a7bb9e1f4d423090651ae2f245dd933121268467f178"

WINDOW = ((-12.0, -2.0), (12.0, 22.0))


def test_what_is_held_out_is_frozen() -> None:
    names = drawings.names(use="held-out")
    whole = hashlib.sha256()
    for name in names:
        drawing = drawings.drawing(name)
        whole.update(f"{name} {drawing.start} {drawing.ahead}".encode())
        whole.update(drawing.greys.tobytes())
    assert whole.hexdigest() == HELD_OUT
    assert {name.partition("/")[0] for name in names} == set(drawings.COLLECTIONS)
    assert {name.partition("/")[0] for name in drawings.names(use="training")} == {"scribbles"}


def test_every_drawing_has_ink_at_its_start_and_clean_paper() -> None:
    names = drawings.names()
    assert len(names) == len(set(names)) == 220 + 197 + 36 + 35
    seen = set()
    for name in names:
        drawing = drawings.drawing(name)
        assert drawing.greys.shape == (50, 50)
        x, y = drawing.start
        assert drawing.greys[int((1.0 - y) * 50), int(x * 50)] < 255, name
        fill = float((drawing.greys < 255).mean())
        assert 0.04 < fill < 0.9, name
        seen.add(drawing.greys.tobytes())
    assert len(seen) == len(names)


def test_ink_is_what_is_not_white() -> None:
    page = np.array([[0, 249], [250, 255]], dtype=np.uint8)
    assert images.ink(page).tolist() == [[0, 249], [255, 255]]
    assert images.ink(page > 0).tolist() == [[255, 0], [0, 0]]
    clear = np.zeros((1, 2, 4), dtype=np.uint8)
    clear[0, 0, 3] = 255
    assert images.ink(clear).tolist() == [[0, 255]]
    large = np.full((40, 100), 255, dtype=np.uint8)
    large[:, :30] = 0
    small = images.ink(large, 50)
    assert small.shape == (20, 50) and (small[:, :15] == 0).all() and (small[:, 15:] == 255).all()
    assert images.ink(large, 200).shape == (40, 100)


def test_ripples_of_a_jpeg_are_paper_and_small_pictures_keep_their_bits(tmp_path: Path) -> None:
    page = Image.new("L", (800, 800), 255)
    ImageDraw.Draw(page).line((100, 120, 700, 650), fill=0, width=5)
    page.save(tmp_path / "line.png")
    for quality in (20, 75):
        page.save(tmp_path / "line.jpg", quality=quality)
        assert ((images.ink(tmp_path / "line.jpg") < 255) == (np.asarray(page) < 128)).mean() > 0.999
        # Nothing but its ink is darker than its lightest half: no ripple is left.
        assert (
            images.ink(tmp_path / "line.jpg")[np.asarray(page.filter(ImageFilter.MinFilter(3))) == 255] == 255
        ).all()
        whole = np.asarray(Image.open(tmp_path / "line.jpg").resize((50, 50), Image.Resampling.BOX)).copy()
        whole[whole >= images.PAPER] = 255
        assert (images.ink(tmp_path / "line.jpg", 50) == whole).all()


def test_a_page_of_two_colours_is_dark_ink_too(tmp_path: Path) -> None:
    page = Image.new("1", (30, 20), 1)
    page.paste(0, (5, 5, 15, 10))
    for name in ("page.png", "page.tif", "page.bmp"):
        page.save(tmp_path / name)
        assert (images.ink(tmp_path / name) == np.asarray(page.convert("L"))).all()


@pytest.mark.parametrize("value", [0, 255, 252])
def test_a_page_of_one_colour_is_refused(value: int) -> None:
    with pytest.raises(InputError, match="has only one colour") as error:
        images.ink(np.full((5, 5), value, dtype=np.uint8))
    assert error.value.code == "drawing-one-color"


def test_the_lowest_point_lies_inside_of_the_ink() -> None:
    page = np.zeros((100, 100), dtype=bool)
    page[20:90, 40:61] = True
    page[89:95, 10] = True
    assert lowest(page) == (0.505, pytest.approx(1.0 - 86.5 / 100))
    thin = np.zeros((100, 100), dtype=bool)
    thin[50:80, 70] = True
    assert lowest(thin) == (0.705, pytest.approx(0.205))


def test_a_window_keeps_pixels_square() -> None:
    wide = Drawing("wide", np.zeros((20, 40), dtype=np.uint8), (0.5, 0.25))
    assert wide.window(WINDOW) == ((-24.0, -2.0), (24.0, 22.0))
    assert wide.place(WINDOW) == (0.0, 4.0, (0.0, 1.0))
    tall = Drawing("tall", np.zeros((40, 20), dtype=np.uint8), (0.25, 0.5), (1.0, 0.0))
    assert tall.window(WINDOW) == ((-12.0, -2.0), (12.0, 46.0))
    mirrored = tall.mirrored()
    assert mirrored.start == (0.75, 0.5) and mirrored.ahead == (-1.0, 0.0)


def test_files_and_names_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert drawings.find("letters/E").name == "letters/E"
    with pytest.raises(InputError, match="letters/E"):
        drawings.find("letters/e")
    with pytest.raises(FileError):
        drawings.find("nothing.png")
    page = Image.new("L", (300, 200), 255)
    page.paste(0, (100, 50, 200, 150))
    page.save("square.png")
    read = drawings.find("square.png")
    assert read.greys.shape == (33, 50) and read.start[0] == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize(
    "words",
    [
        {"window": ((0, 0), (0, 1))},
        {"window": 3},
        {"window": ((0, 0), (1, float("nan")))},
        {"sigma": 0.0},
        {"pixels": 0},
        {"pixels": 2.5},
    ],
)
def test_impossible_settings_are_refused(words: dict[str, Any]) -> None:
    page = np.eye(5, dtype=np.uint8) * 255
    with pytest.raises(InputError):
        nw.match_drawing(page, **{"window": WINDOW, **words})


@pytest.mark.parametrize("words", [{"share": 0.0}, {"share": 1.5}, {"size": (0, 5)}, {"sigma": -1.0}])
def test_impossible_textures_are_refused(words: dict[str, Any]) -> None:
    with pytest.raises(InputError):
        nw.fill_drawing(WINDOW, **words)
