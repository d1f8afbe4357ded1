"""Grown texts: each piece of each letter is the best of several searches by particles with a guide."""

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

#: The models that can write.
STYLES = ("vines", "lightning")

#: Searches for each piece of a letter, and particles of each search.
SEARCHES, PARTICLES = 12, 80

#: Height of a piece's lowest ink in the model's plane, as in the drawings with which the guides were trained.
GROUND = -2.0 + glyphs.EDGE * PIXEL

#: Margin around the text, in heights of a capital.
MARGIN = 0.42


@dataclass(frozen=True)
class Grown:
    """A letter, and the samples that grew into its pieces."""

    letter: Letter
    samples: Sequence[nw.Sample]

    @property
    def similarity(self) -> float:
        """The mean similarity of the pieces, weighted by their ink."""
        weights = [int((piece.greys < 255).sum()) for piece in self.letter.pieces]
        return float(np.average([sample.similarity or 0.0 for sample in self.samples], weights=weights))


@dataclass(frozen=True)
class Word:
    """A grown text.

    Attributes
    ----------
    text : str
        The text.
    style : str
        The name of the model that wrote the text.
    seed : int
        The seed that writes the same text again.
    letters : sequence of Grown
        The letters with their samples, without spaces.
    """

    text: str
    style: str
    seed: int
    letters: Sequence[Grown]

    @cached_property
    def scene(self) -> Scene:
        """The scene of the page, with all shapes."""
        return Scene(part for parts in self._parts for part in parts)

    @cached_property
    def _parts(self) -> list[list[Part]]:
        """The parts of each letter on the page, in the order of growth."""
        return [
            [
                Part(
                    f"letter{number}/piece{k}/{part.address}",
                    tuple(moved(shape, shift) for shape in part.shapes),
                )
                for k, (piece, sample) in enumerate(zip(grown.letter.pieces, grown.samples, strict=True), 1)
                for shift in [_shift(grown.letter, piece)]
                for part in sample.parts
            ]
            for number, grown in enumerate(self.letters, 1)
        ]

    @cached_property
    def window(self) -> Window:
        """The corners of the page, the text with a margin."""
        ink = [
            (grown.letter.x + x, grown.letter.y + y, piece.greys.shape)
            for grown in self.letters
            for piece in grown.letter.pieces
            for x, y in [piece.corner]
        ]
        edge = PIXEL * glyphs.EDGE - MARGIN * glyphs.CAPITAL
        left, low = min(x for x, _, _ in ink) + edge, min(y for _, y, _ in ink) + edge
        right = max(x + PIXEL * shape[1] for x, _, shape in ink) - edge
        high = max(y + PIXEL * shape[0] for _, y, shape in ink) - edge
        return (left, low), (right, high)

    def size(self, width: int) -> tuple[int, int]:
        """Return the width and height, in pixels, of a picture of a given width."""
        (left, low), (right, high) = self.window
        return width, max(1, round(width * (high - low) / (right - left)))

    def picture(self, width: int = 1600) -> Image:
        """Draw the page as an image of a width in pixels."""
        count("width", width, most=LARGEST)
        return drawing(self.scene, size=self.size(width), style=self.style, window=self.window)

    def _repr_png_(self) -> bytes:
        return draw.picture.png(self.picture(800))

    def svg(self) -> str:
        """Return the page as SVG, with a group for each part."""
        return svg(self.scene, style=self.style, window=self.window)

    def save(self, path: str | PathLike[str], width: int = 1600) -> Path:
        """Write the page as .svg or as a picture."""
        place = Path(path)
        if place.suffix.lower() == ".svg":
            return write_whole(place, self.svg().encode())
        return draw.picture.save_image(lambda: self.picture(width), place)

    def animate(
        self, path: str | PathLike[str], *, width: int = 800, frames: int = 48, seconds: float = 5.0
    ) -> Path:
        """Write an animation of the growth as .gif or .apng, in which the letters start one after the other."""
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
        The text; a long text is broken into lines at spaces.
    style
        The model of the gallery that writes, "vines" or "lightning".
    seed
        The seed of all searches; by default a new seed.
    particles
        The number of particles of each search.
    searches
        The number of searches for each piece of a letter, from several places and in several directions; the best
        result is kept.
    font
        A TrueType or OpenType file; by default the font of the package.
    threads
        The number of threads; the result does not depend on it.
    progress
        A function that is called with the number of finished searches and the number of all searches.

    Raises
    ------
    InputError
        The text is empty, the font does not have a character, or the style is unknown.
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
        raise bad("text", text, "at least one visible character", '"NIWAKI"')
    pieces = [(letter, piece) for letter in written for piece in letter.pieces]
    check_room("searches", searches, len(pieces) * SEARCH, f"search for {len(pieces)} pieces of letters")
    seeds = np.random.default_rng(seed).integers(2**63, size=(len(pieces), searches))
    method = smc(particles, guide=guide, resampling="tempered")
    jobs = [
        _search(entry.model, piece, method, k, int(row[k]))
        for (_, piece), row in zip(pieces, seeds, strict=True)
        for k in range(searches)
    ]
    results: list[nw.Sample | None] = []
    with closing(best_of(jobs, check_threads(threads) or cpu_count() or 1)) as samples:
        for sample in samples:
            results.append(sample)
            if progress is not None:
                progress(len(results), len(jobs))
    best = iter(
        [_best(results[k * searches : (k + 1) * searches], letter) for k, (letter, _) in enumerate(pieces)]
    )
    return Word(text, style, seed, [Grown(letter, [next(best) for _ in letter.pieces]) for letter in written])


def _best(results: Sequence[nw.Sample | None], letter: Letter) -> nw.Sample:
    alive = [sample for sample in results if sample is not None]
    if not alive:
        raise InputError("letter-lost", name=letter.character, tries=len(results))
    return max(alive, key=lambda sample: sample.log_score)


def _search(
    model: nw.Model[..., Any], piece: Piece, method: nw.methods.Method, try_: int, seed: int
) -> nw.Search:
    """Return the search for a piece, placed in the middle of the model's plane."""
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
    """Return the shift from the model's plane to the page."""
    columns = piece.greys.shape[1]
    low = GROUND - glyphs.EDGE * PIXEL
    return letter.x + piece.corner[0] + 0.5 * columns * PIXEL, letter.y + piece.corner[1] - low


def moved(shape: Shape, shift: tuple[float, float]) -> Shape:
    """Return a flat shape, moved in its plane."""
    flat = shape.flat()
    assert flat is not None
    u, v = shift
    if len(flat) == 2:
        (a, r), (b, s) = flat
        start, end = ((x + u, y + v, z) for x, y, z in (a, b))
        return _engine.shape("stroke", start, end, 2.0 * r, 2.0 * s, shape.color)
    (x, y, z), long, wide, angle = flat
    return _engine.shape("ellipse", (x + u, y + v, z), long, wide, angle, shape.color)
