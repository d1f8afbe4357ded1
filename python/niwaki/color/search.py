"""Colourings of a drawing that keep its rules and differ from one another.

The compatibility model is sampled by many short chains that follow its gradient, each from its own run. Their samples
are moved uphill until the rules hold. From the better half the colourings are chosen one by one, each as far as
possible in CIELAB from those already chosen (farthest-point choice, Gonzalez 1985).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import draw
from niwaki.color import lab
from niwaki.color.drawing import OWN, Drawing
from niwaki.color.kept import SCORED, Kept, kept
from niwaki.color.model import coloring
from niwaki.color.rules import Rules
from niwaki.color.settle import settled
from niwaki.errors import FileError, InputError
from niwaki.errors.settings import real
from niwaki.lang.residuals import Residuals, residuals
from niwaki.methods import Method, at_least_one, explore
from niwaki.once import cached_property
from niwaki.result import Progress, Sample
from niwaki.search import run

if TYPE_CHECKING:
    from PIL import Image


@dataclass(frozen=True)
class Coloring:
    """One colouring of a drawing.

    Attributes
    ----------
    drawing, rules
        What was coloured, and how it should be.
    colors : dict of str to str
        `#rrggbb` by region.
    sample : Sample
        The run of the model, with choices and log score.
    arguments : tuple
        The model's arguments.
    """

    drawing: Drawing
    rules: Rules
    colors: dict[str, str]
    sample: Sample
    arguments: tuple[Any, ...]

    @property
    def log_score(self) -> float:
        """The model's log score, nats."""
        return self.sample.log_score

    def image(self, size: int = 512) -> Image.Image:
        """The coloured drawing; the longer side of an SVG has `size` pixels."""
        return self.drawing.picture(self.colors, size)

    def _repr_html_(self) -> str:
        rules = {str(k): one for k, one in enumerate(self.kept, 1)}
        return draw.card.card(
            "Coloring", {"log score": self.log_score, **rules}, draw.picture.png(self.image(360))
        )

    @cached_property
    def residuals(self) -> Residuals:
        """Every soft constraint of the model, worst first."""
        return residuals(coloring, *self.arguments, choices=self.sample.choices)

    @property
    def kept(self) -> list[Kept]:
        """How well each rule is kept, in the order of the rules."""
        return kept(self.rules.on(self.drawing.names), self.residuals)


def arguments(drawing: Drawing, rules: Rules, strictness: float = 100.0) -> tuple[Any, ...]:
    """What `coloring` takes, for these rules on this drawing; refuses rules that do not fit.

    Raises
    ------
    FileError
        As `Rules.check`.
    """
    rules.check(drawing.names)
    number = {name: k for k, name in enumerate(drawing.names)}
    by_kind: dict[str, list[tuple[int, float]]] = {kind: [] for kind, _ in SCORED.values()}
    for rule in rules.on(drawing.names):
        other = rule.most if rule.kind == "muted" else number[rule.second]
        by_kind[rule.kind].append((number[rule.first], other))
    background = number[rules.background] if rules.background is not None else drawing.background
    held = [lab.parts(rules.held[name]) if name in rules.held else None for name in drawing.names]
    return (
        drawing.areas.tolist(),
        drawing.pairs,
        by_kind["lightness"],
        by_kind["lighter"],
        by_kind["same-chroma"],
        by_kind["same-hue"],
        by_kind["muted"],
        -1 if background is None else background,
        held,
        strictness,
    )


#: Which argument of the model has the colours that do not change.
HELD = 8


def default_method(count: int) -> Method:
    """How colourings are searched for by default."""
    return explore(draws=1, chains=3 * count)


def color(
    drawing: Drawing | str | PathLike[str],
    rules: Rules | str | PathLike[str] | None = None,
    count: int = 12,
    *,
    method: Method | None = None,
    settle: int = 200,
    strictness: float = 100.0,
    seed: int | None = None,
    threads: int | None = None,
    progress: Callable[[Progress], None] | None = None,
) -> list[Coloring]:
    """Color a drawing, several times.

    Parameters
    ----------
    drawing
        A `Drawing`, a file, or the name of one of ours: robot, house, bug, rocket.
    rules
        `Rules` or a file; when left out, ours for a drawing of ours, none for others.
    count
        How many colourings.
    method
        A sampler; it gives the colourings to choose among. By default `explore`, three chains for each colouring.
    settle
        Steps uphill from each of them, until the rules are kept as well as they can be nearby (`niwaki.color.settle`);
        0 for none, where the sampler's own draws are wanted.
    strictness
        What the model's log score is multiplied with: the larger, the stricter.
    seed, threads, progress
        As for `niwaki.run`.

    Returns
    -------
    list of Coloring
        The best first, then each as different as can be from those before it.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C: what is not settled keeps no rule.

    Examples
    --------
    >>> from niwaki import mh
    >>> one, two = color("bug", count=2, method=mh(steps=400, chains=2, warmup=200, keep=4), seed=1)
    >>> sorted(one.colors) == sorted(two.colors), one.colors["wing"] != two.colors["wing"]
    (True, True)
    """
    count = at_least_one("count", count)
    if rules is None:
        rules = Rules() if isinstance(drawing, Drawing) else rules_of(drawing)
    if not isinstance(drawing, Drawing):
        drawing = Drawing.load(drawing)
    if not isinstance(rules, Rules):
        rules = Rules.load(rules)
    real("strictness", strictness, 0, usual="100")
    given = arguments(drawing, rules, strictness)
    if all(name in rules.held for name in drawing.names):
        raise FileError("rules-hold-all", rules.place, count=len(drawing.names))
    result = run(
        coloring,
        method or default_method(count),
        *given,
        seed=seed,
        threads=threads,
        progress=progress,
    ).to_its_end()
    drawn = [sample for sample in result if sample.has_ended and np.isfinite(sample.log_score)]
    pool = [run(coloring, *given, choices=settled(one, settle))[0] for one in drawn] if settle else drawn
    if len(pool) < count:
        raise InputError(
            "bad-setting",
            name="count",
            found=count,
            expected=f"no more than the sampler gives, which is {len(pool)}",
            suggestion="fewer, or give `method` more draws",
        )
    rgb = np.array([sample.value for sample in pool], dtype=np.float64)
    scores = np.array([sample.log_score for sample in pool])
    chosen = farthest(lab.of_rgb(rgb), scores, drawing.areas, count)
    return [
        Coloring(
            drawing,
            rules,
            {name: lab.hexed(rgb[k, i]) for i, name in enumerate(drawing.names)},
            pool[k],
            given,
        )
        for k in chosen
    ]


def painted(drawing: Drawing, rules: Rules, colors: Mapping[str, str], strictness: float = 100.0) -> Coloring:
    """A colouring in colours that are given: nothing is searched for, and its rules are measured.

    Parameters
    ----------
    drawing, rules, strictness
        As for `color`.
    colors
        `#rrggbb` of every region.

    Examples
    --------
    >>> drawing = Drawing.load("bug")
    >>> grey = painted(drawing, rules_of("bug"), dict.fromkeys(drawing.names, "#808080"))
    >>> str(grey.kept[0])
    '`background` is 0 units lighter than `leaf`: 15 too little'
    """
    given = list(arguments(drawing, rules, strictness))
    given[HELD] = [lab.parts(colors[name]) for name in drawing.names]
    sample = run(coloring, *given, choices={}).best
    return Coloring(drawing, rules, dict(colors), sample, tuple(given))


def farthest(
    labs: NDArray[np.float64],
    scores: NDArray[np.float64],
    areas: Sequence[float] | NDArray[np.float64],
    count: int,
) -> list[int]:
    """Choose colourings that differ, the best first.

    Parameters
    ----------
    labs
        (colourings, regions, 3) CIELAB.
    scores
        (colourings,) log scores; only the better half is chosen from, more where that is fewer than `count`.
    areas
        (regions,); a region counts by the root of its area, so that small ones are seen too.
    count
        How many.
    """
    best = np.argsort(-scores, kind="stable")[: max(count, -(-len(scores) // 2))]
    weights = np.sqrt(np.asarray(areas, dtype=np.float64))
    weights = weights / weights.sum()
    points = labs[best]
    chosen = [0]
    nearest = np.full(len(best), np.inf)
    while len(chosen) < count:
        apart = np.linalg.norm(points - points[chosen[-1]], axis=2) @ weights
        nearest = np.minimum(nearest, apart)
        nearest[chosen] = -1.0
        chosen.append(int(nearest.argmax()))
    return [int(best[k]) for k in chosen]


def rules_of(drawing: str | PathLike[str]) -> Rules:
    """The rules of one of our own drawings, by its name; none for any other."""
    named = not Path(drawing).exists() and (OWN / f"{drawing}.toml").is_file()
    return Rules.load(OWN / f"{drawing}.toml") if named else Rules()
