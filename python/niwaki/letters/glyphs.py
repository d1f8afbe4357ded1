"""Characters of a font as drawings, and their places on the page.

Lengths are in units of the plane in which the models draw; a capital has the height `CAPITAL`. The font is Quicksand
Bold (NOTICE): its strokes have one width, about that of the scribbles with which the guides were trained.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from niwaki.errors import InputError
from niwaki.inputs import bytes_of, library
from niwaki.inputs.limits import check
from niwaki.letters.places import Place, places
from niwaki.targets.images import PAPER

FONT = Path(__file__).parent / "Quicksand-Bold.ttf"

#: Height of a capital, and side of a pixel, as in drawings of 50 pixels in 24 units.
CAPITAL, PIXEL = 22.0, 0.48
#: Empty pixels around a piece; fine pixels along the side of a pixel.
EDGE, FINE = 4, 8
#: Additional distance between letters, and distance between lines, in heights of a capital.
TRACKING, LEADING = 0.08, 0.55
#: The largest size of a font, in pixels; usual fonts need about 500.
LARGEST = 5000
#: About the number of letters in a line.
ACROSS = 14
#: A character that no font has.
NONE = "\U000fffff"


@dataclass(frozen=True, eq=False)
class Piece:
    """A connected piece of a character's ink, such as the dot of an i.

    Attributes
    ----------
    greys : (rows, columns) uint8
        The image; 255 is paper.
    corner : (x, y)
        The lower left corner of the image, relative to the character's place on the base line.
    places : sequence of Place
        The places from which the piece can be grown.
    """

    greys: NDArray[np.uint8]
    corner: tuple[float, float]
    places: Sequence[Place]


@dataclass(frozen=True)
class Letter:
    """A character on the page: its pieces, and its place on the base line of its line."""

    character: str
    x: float
    y: float
    pieces: Sequence[Piece]


class Font:
    """A font, in the size at which its capitals have the height `CAPITAL`.

    Parameters
    ----------
    file
        A TrueType or OpenType file.
    """

    def __init__(self, file: str | PathLike[str] = FONT) -> None:
        self.name = Path(file).name
        self._place, data = file, bytes_of(file, "font")
        with library(file, "a font"):
            trial = ImageFont.truetype(io.BytesIO(data), 1000)
            left, top, right, low = trial.getbbox("H", anchor="ls")
            size = max(1, round(1000 * FINE * CAPITAL / PIXEL / max(low - top, 1.0)))
            self._face = ImageFont.truetype(io.BytesIO(data), min(size, LARGEST))
        self._missing = self._ink(NONE)

    def pieces(self, character: str) -> list[Piece]:
        """Return the pieces of a character; none for a space.

        Raises
        ------
        InputError
            The font does not have the character.
        """
        if character.isspace():
            return []
        ink, corner = self._ink(character)
        if ink.size == 0 or np.array_equal(ink, self._missing[0]):
            code = f"U+{ord(character[0]):04X}"
            raise InputError("letter-missing", name=character, point=code, font=self.name)
        return [_piece(ink, part, corner) for part in _parts(ink < 255)]

    def along(self, line: str) -> list[float]:
        """Return the place of each character of a line, and of the line's end."""
        scale = PIXEL / FINE
        ends = [self._face.getlength(line[: k + 1]) - self._face.getlength(line[k]) for k in range(len(line))]
        wide = TRACKING * CAPITAL
        return [scale * end + wide * k for k, end in enumerate([*ends, self._face.getlength(line)])]

    def _ink(self, character: str) -> tuple[NDArray[np.uint8], tuple[float, float]]:
        """Return a character in greys with an empty border, and its lower left corner."""
        with library(self._place, "a font"):
            box = self._face.getbbox(character, anchor="ls")
            left, top, right, low = (round(side) for side in box)
        check("pixels", (right - left) * (low - top), self._place)
        if right <= left or low <= top:
            return np.empty((0, 0), np.uint8), (0.0, 0.0)
        edge = EDGE * FINE
        columns, rows = (-(-(side + 2 * edge) // FINE) for side in (right - left, low - top))
        page = Image.new("L", (columns * FINE, rows * FINE))
        # The lowest row of pixels ends at the lower edge of the ink.
        above = rows * FINE - edge - low
        with library(self._place, "a font"):
            ImageDraw.Draw(page).text((edge - left, above), character, fill=255, font=self._face, anchor="ls")
        greys = 255 - np.asarray(page.resize((columns, rows), Image.Resampling.BOX))
        greys[greys >= PAPER] = 255
        scale = PIXEL / FINE
        return np.ascontiguousarray(greys), (scale * (left - edge), scale * (-low - edge))


def _piece(ink: NDArray[np.uint8], part: NDArray[np.bool_], corner: tuple[float, float]) -> Piece:
    """Crop a part of a character's ink to a piece."""
    rows, columns = np.flatnonzero(part.any(axis=1)), np.flatnonzero(part.any(axis=0))
    top, low = max(rows[0] - EDGE, 0), min(rows[-1] + 1 + EDGE, len(ink))
    left, right = max(columns[0] - EDGE, 0), min(columns[-1] + 1 + EDGE, ink.shape[1])
    greys = np.where(part, ink, np.uint8(255))[top:low, left:right]
    at = corner[0] + PIXEL * float(left), corner[1] + PIXEL * float(len(ink) - low)
    return Piece(np.ascontiguousarray(greys), at, places(greys < 255))


def _parts(filled: NDArray[np.bool_]) -> list[NDArray[np.bool_]]:
    """Return the pieces of a shape, connected by sides or corners of pixels, the largest first."""
    left, pieces = filled.copy(), []
    while left.any():
        part = np.zeros_like(left)
        part[np.unravel_index(int(left.argmax()), left.shape)] = True
        size = 0
        while part.sum() > size:
            size = int(part.sum())
            part = _grown(part) & filled
        pieces.append(part)
        left &= ~part
    return sorted(pieces, key=lambda piece: -int(piece.sum()))


def _grown(part: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Add all neighbours of a part's pixels."""
    wide = np.pad(part, 1)
    tall = wide[:-2] | wide[1:-1] | wide[2:]
    return np.asarray(tall[:, :-2] | tall[:, 1:-1] | tall[:, 2:])


def lines(text: str, across: int = ACROSS) -> list[str]:
    """Break a text at spaces into lines of about the same length, near `across` letters."""
    texts = []
    for paragraph in text.strip().splitlines():
        words = paragraph.split()
        total = len(" ".join(words))
        length = total / max(1, -(-total // across))
        line = ""
        for word in words:
            longer = f"{line} {word}".strip()
            if line and len(longer) > max(length + 0.5 * len(word), len(word)):
                texts.append(line)
                line = word
            else:
                line = longer
        texts.append(line)
    return [line for line in texts if line]


def page(text: str, face: Font) -> list[Letter]:
    """Return the letters of a text on the page, with centred lines."""
    written: list[Letter] = []
    for row, line in enumerate(lines(text)):
        *places_, end = face.along(line)
        end -= TRACKING * CAPITAL
        y = -row * (1.0 + LEADING) * CAPITAL
        for character, x in zip(line, places_, strict=True):
            pieces = face.pieces(character)
            if pieces:
                written.append(Letter(character, x - 0.5 * end, y, pieces))
    return written
