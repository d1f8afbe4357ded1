"""Claim: a text grows, each letter near its glyph and at its place; characters that the font lacks are errors."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from niwaki import letters
from niwaki.errors import FileError, InputError
from niwaki.letters import glyphs
from niwaki.letters.glyphs import CAPITAL, PIXEL
from PIL import Image


@pytest.fixture(scope="module")
def word() -> letters.Word:
    return letters.write("I i", seed=1, particles=20, searches=4)


def test_letters_are_near_their_glyphs(word: letters.Word) -> None:
    assert [grown.letter.character for grown in word.letters] == ["I", "i"]
    assert min(grown.similarity for grown in word.letters) > 0.7
    # The dot of the i grows separately.
    assert [len(grown.samples) for grown in word.letters] == [1, 2]


def test_letters_are_at_their_places(word: letters.Word) -> None:
    low, high = word.scene.bounds
    assert low[1] == pytest.approx(0.0, abs=1.5) and high[1] == pytest.approx(CAPITAL, abs=2.5)
    first, second = (word.letters[k].letter.x for k in (0, 1))
    assert second - first > 0.3 * CAPITAL
    for number, grown in enumerate(word.letters, 1):
        parts = [part for part in word.scene if part.address.startswith(f"letter{number}/")]
        lows, highs = zip(*(shape.aabb() for part in parts for shape in part.shapes), strict=True)
        (piece, *_), letter = grown.letter.pieces, grown.letter
        left = letter.x + piece.corner[0]
        right = left + PIXEL * piece.greys.shape[1]
        assert left - 1.0 < min(x for x, _, _ in lows) and max(x for x, _, _ in highs) < right + 1.0


def test_equal_seeds_write_the_same_text_on_any_number_of_threads(word: letters.Word) -> None:
    again = letters.write("I i", seed=1, particles=20, searches=4, threads=1)
    assert again.svg() == word.svg()
    assert letters.write("I i", seed=2, particles=20, searches=4).svg() != word.svg()


def test_picture_svg_and_animation(word: letters.Word, tmp_path: Path) -> None:
    width, height = word.size(200)
    assert word.picture(200).size == (200, height)
    root = ElementTree.fromstring(word.svg())
    ids = [group.get("id", "") for group in root.iter() if group.tag.endswith("}g")]
    assert len(set(ids)) == len(ids) and any(name.startswith("letter2.piece2.") for name in ids)
    place = word.animate(tmp_path / "growth.gif", width=120, frames=6)
    with Image.open(place) as moving:
        assert moving.n_frames == 6 and moving.size == word.size(120)  # type: ignore[attr-defined]


def test_lightning_has_a_guide() -> None:
    word = letters.write("L", "lightning", seed=1, particles=20, searches=4)
    assert word.letters[0].similarity > 0.7


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("NIWAKI", ["NIWAKI"]),
        ("  a\tb \n c ", ["a b", "c"]),
        ("a long text that goes on in more lines", ["a long text", "that goes on", "in more lines"]),
        ("incomprehensibilities are long", ["incomprehensibilities", "are long"]),
        (" \n ", []),
    ],
)
def test_long_texts_are_broken_at_spaces(text: str, lines: list[str]) -> None:
    assert glyphs.lines(text) == lines


def test_each_printable_character_has_places_in_its_ink() -> None:
    face = glyphs.Font()
    for character in [*map(chr, range(33, 127)), *"äöüßéñçøÅŁž€"]:
        for piece in face.pieces(character):
            assert piece.places
            for place in piece.places:
                row, column = len(piece.greys) - 1 - int(place.y), int(place.x)
                assert piece.greys[row, column] < 255, character
                assert np.hypot(*place.ahead) == pytest.approx(1.0)


def test_texts_styles_and_fonts_that_cannot_be_used_are_refused(tmp_path: Path) -> None:
    for text, code in (
        ("", "bad-setting"),
        (" \n", "bad-setting"),
        ("木", "letter-missing"),
        ("a\x07", "letter-missing"),
    ):
        with pytest.raises(InputError) as caught:
            letters.write(text, seed=1)
        assert caught.value.code == code
    with pytest.raises(InputError, match="bad-setting"):
        letters.write("A", "circuit", seed=1)
    (tmp_path / "font.ttf").write_text("no font")
    with pytest.raises(FileError, match="file-unreadable"):
        letters.write("A", font=tmp_path / "font.ttf")
