"""A text, grown: every piece of every letter by a population whose choices a guide draws, the best of several tries."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from os import PathLike, cpu_count
from pathlib import Path
from typing import Any

import numpy as np
from PIL.Image import Image

import niwaki as nw
from niwaki import _engine, draw, gallery, guides
from niwaki._engine import Shape
from niwaki.draw.assembly import Part
from niwaki.draw.flat.drawing import Window, drawing
from niwaki.draw.flat.svg import svg
from niwaki.draw.limits import LARGEST
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.errors.files import write_whole
from niwaki.errors.memory import check_room
from niwaki.errors.settings import bad, count
from niwaki.guides.traces import best_of
from niwaki.letters import glyphs
from niwaki.letters.glyphs import PIXEL, Letter, Piece
from niwaki.methods import at_least_one, smc
from niwaki.methods.room import SEARCH
from niwaki.once import cached_property
from niwaki.search.checks import check_threads, fresh

#: Models that write.
STYLES = ("vines", "lightning")

#: Searches for each piece of a letter, and particles of each.
SEARCHES, PARTICLES = 12, 80

#: Where the lowest ink of a piece is in the plane of the model, as in the drawings that guides have learnt from.
GROUND = -2.0 + glyphs.EDGE * PIXEL

#: Empty paper around the text, as a share of a capital's height.
MARGIN = 0.42


@dataclass(frozen=True)
class Grown:
    """A letter, and what grew into it."""

    letter: Letter
    samples: Sequence[nw.Sample]

    @property
    def similarity(self) -> float:
        """Of its pieces, by their ink."""
        weights = [int((piece.greys < 255).sum()) for piece in self.letter.pieces]
        return float(np.average([one.similarity or 0.0 for one in self.samples], weights=weights))


@dataclass(frozen=True)
class Word:
    """A grown text.

    Attributes
    ----------
    text : str
        What it says.
    style : str
        The model that wrote it.
    seed : int
        Writes it again.
    letters : sequence of Grown
        Each with its samples; spaces are none.
    """

    text: str
    style: str
    seed: int
    letters: Sequence[Grown]

    @cached_property
    def scene(self) -> Scene:
        """All shapes on one page."""
        return Scene(part for parts in self._parts for part in parts)

    @cached_property
    def _parts(self) -> list[list[Part]]:
        """The parts of each letter on the page, in the order in which they grew."""
        return [
            [
                Part(
                    f"letter{number}/piece{k}/{part.address}", tuple(moved(one, shift) for one in part.shapes)
                )
                for k, (piece, sample) in enumerate(zip(grown.letter.pieces, grown.samples, strict=True), 1)
                for shift in [_shift(grown.letter, piece)]
                for part in sample.parts
            ]
            for number, grown in enumerate(self.letters, 1)
        ]

    @cached_property
    def window(self) -> Window:
        """The page: the text with a margin."""
        ink = [
            (one.letter.x + x, one.letter.y + y, piece.greys.shape)
            for one in self.letters
            for piece in one.letter.pieces
            for x, y in [piece.corner]
        ]
        edge = PIXEL * glyphs.EDGE - MARGIN * glyphs.CAPITAL
        left, low = min(x for x, _, _ in ink) + edge, min(y for _, y, _ in ink) + edge
        right = max(x + PIXEL * shape[1] for x, _, shape in ink) - edge
        high = max(y + PIXEL * shape[0] for _, y, shape in ink) - edge
        return (left, low), (right, high)

    def size(self, width: int) -> tuple[int, int]:
        """Width and height in pixels of a picture of that width."""
        (left, low), (right, high) = self.window
        return width, max(1, round(width * (high - low) / (right - left)))

    def picture(self, width: int = 1600) -> Image:
        """The page as an image, so many pixels wide."""
        count("width", width, most=LARGEST)
        return drawing(self.scene, size=self.size(width), style=self.style, window=self.window)

    def _repr_png_(self) -> bytes:
        return draw.picture.png(self.picture(800))

    def svg(self) -> str:
        """The page as SVG, a group for each part."""
        return svg(self.scene, style=self.style, window=self.window)

    def save(self, path: str | PathLike[str], width: int = 1600) -> Path:
        """Write it as .svg, or as a picture."""
        place = Path(path)
        if place.suffix.lower() == ".svg":
            return write_whole(place, self.svg().encode())
        return draw.picture.save_image(lambda: self.picture(width), place)

    def animate(
        self, path: str | PathLike[str], *, width: int = 800, frames: int = 48, seconds: float = 5.0
    ) -> Path:
        """Write it growing, as .gif or .apng: all letters at a time, each a little after the one before."""
        count = len(self._parts)
        timed = [
            ((k + 1) / len(parts) + 0.5 * number / count, number, k)
            for number, parts in enumerate(self._parts)
            for k in range(len(parts))
        ]
        order = [self._parts[number][k] for _, number, k in sorted(timed)]
        return draw.animation.growth(
            self.scene,
            path,
            parts=order,
            frames=frames,
            seconds=seconds,
            size=self.size(width),
            style=self.style,
            window=self.window,
        )


def write(
    text: str,
    style: str = "vines",
    *,
    seed: int | None = None,
    particles: int = PARTICLES,
    searches: int = SEARCHES,
    font: str | PathLike[str] | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Word:
    """Write a text in vines or lightning.

    Parameters
    ----------
    text
        Letters, figures, signs; long texts are broken into lines at spaces.
    style
        "vines" or "lightning": the model of the gallery that writes.
    seed
        Decides everything; fresh when left out.
    particles
        Of each search.
    searches
        How many for each piece of a letter, from several places and in several directions; the best is kept.
    font
        A TrueType or OpenType file; the package's own when left out.
    threads
        How many to use; the result does not depend on it.
    progress
        Called with the searches done and in all.

    Raises
    ------
    InputError
        There is nothing to write, the font lacks a character, or there is no such style.
    """
    seed = fresh(seed)
    at_least_one("particles", particles)
    at_least_one("searches", searches)
    entry = gallery.entry(style) if style in STYLES else None
    guide = None if entry is None else guides.shipped(entry.model)
    if entry is None or guide is None:
        raise bad("style", style, f"one of {', '.join(STYLES)}", f'"{STYLES[0]}"')
    written = glyphs.page(text, glyphs.Font(font or glyphs.FONT))
    if not written:
        raise bad("text", text, "at least one character that is seen", '"NIWAKI"')
    pieces = [(letter, piece) for letter in written for piece in letter.pieces]
    check_room("searches", searches, len(pieces) * SEARCH, f"search for {len(pieces)} pieces of letters")
    seeds = np.random.default_rng(seed).integers(2**63, size=(len(pieces), searches))
    method = smc(particles, guide=guide, resampling="tempered")
    jobs = [
        _search(entry.model, piece, method, k, int(own[k]))
        for (_, piece), own in zip(pieces, seeds, strict=True)
        for k in range(searches)
    ]
    found: list[nw.Sample | None] = []
    with closing(best_of(jobs, check_threads(threads) or cpu_count() or 1)) as samples:
        for sample in samples:
            found.append(sample)
            if progress is not None:
                progress(len(found), len(jobs))
    best = iter(
        [_best(found[k * searches : (k + 1) * searches], letter) for k, (letter, _) in enumerate(pieces)]
    )
    return Word(text, style, seed, [Grown(one, [next(best) for _ in one.pieces]) for one in written])


def _best(found: Sequence[nw.Sample | None], letter: Letter) -> nw.Sample:
    alive = [one for one in found if one is not None]
    if not alive:
        raise InputError("letter-lost", name=letter.character, tries=len(found))
    return max(alive, key=lambda one: one.log_score)


def _search(
    model: nw.Model[..., Any], piece: Piece, method: nw.methods.Method, try_: int, seed: int
) -> nw.Search:
    """A search for a piece in the middle of the model's plane."""
    rows, columns = piece.greys.shape
    left = -0.5 * columns * PIXEL
    low = GROUND - glyphs.EDGE * PIXEL
    score = nw.match_drawing(piece.greys, ((left, low), (-left, low + rows * PIXEL)))
    start = piece.places[try_ % len(piece.places)]
    return nw.Search(
        model,
        (left + start.x * PIXEL, low + start.y * PIXEL, start.ahead),
        score=score,
        method=method,
        seed=seed,
    )


def _shift(letter: Letter, piece: Piece) -> tuple[float, float]:
    """From the plane of the model to the page."""
    columns = piece.greys.shape[1]
    low = GROUND - glyphs.EDGE * PIXEL
    return letter.x + piece.corner[0] + 0.5 * columns * PIXEL, letter.y + piece.corner[1] - low


def moved(shape: Shape, shift: tuple[float, float]) -> Shape:
    """A flat shape, moved in its plane."""
    flat = shape.flat()
    assert flat is not None
    u, v = shift
    if len(flat) == 2:
        (a, r), (b, s) = flat
        start, end = ((x + u, y + v, z) for x, y, z in (a, b))
        return _engine.shape("stroke", start, end, 2.0 * r, 2.0 * s, shape.color)
    (x, y, z), long, wide, angle = flat
    return _engine.shape("ellipse", (x + u, y + v, z), long, wide, angle, shape.color)
