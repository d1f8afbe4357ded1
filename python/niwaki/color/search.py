"""Search for colourings of a drawing that keep its rules and differ from one another.

Many short chains that follow the gradient sample the compatibility model, each from its own run. Their samples are
moved uphill until the rules hold. From the better half, colourings are chosen in turn, each as far as possible in
CIELAB from the colourings already chosen (farthest-point choice, Gonzalez 1985).
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
from niwaki.color.drawing import EXAMPLES, Drawing
from niwaki.color.model import coloring
from niwaki.color.report import SCORED, RuleReport, report
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
        The drawing and its rules.
    colors : dict of str to str
        `#rrggbb` by region.
    sample : Sample
        The run of the model: choices and log score.
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
        """Draw the coloured drawing; the longer side of an SVG has `size` pixels."""
        return self.drawing.picture(self.colors, size)

    def _repr_html_(self) -> str:
        rules = {str(k): row for k, row in enumerate(self.report, 1)}
        return draw.card.card(
            "Coloring", {"log score": self.log_score, **rules}, draw.picture.png(self.image(360))
        )

    @cached_property
    def residuals(self) -> Residuals:
        """Soft constraints of the model, worst first."""
        return residuals(coloring, *self.arguments, choices=self.sample.choices)

    @property
    def report(self) -> list[RuleReport]:
        """Report on each rule, in the order of the rules."""
        return report(self.rules.on(self.drawing.names), self.residuals)


def arguments(drawing: Drawing, rules: Rules, strictness: float = 100.0) -> tuple[Any, ...]:
    """Make the arguments of the model `coloring` for these rules on this drawing.

    Raises
    ------
    FileError
        As for `Rules.check`.
    """
    rules.check(drawing.names)
    number = {name: k for k, name in enumerate(drawing.names)}
    by_kind: dict[str, list[tuple[int, float]]] = {kind: [] for kind, _ in SCORED.values()}
    for rule in rules.on(drawing.names):
        partner = rule.most if rule.kind == "muted" else number[rule.second]
        by_kind[rule.kind].append((number[rule.first], partner))
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


#: The number of the model's argument with the colours that do not change.
HELD = 8


def default_method(count: int) -> Method:
    """The method that `color` uses by default."""
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
    """Search for several colourings of a drawing.

    Parameters
    ----------
    drawing
        A `Drawing`, a file, or the name of a drawing of the package: robot, house, bug, rocket.
    rules
        `Rules` or a file; when left out, the package's rules for a drawing of the package, no rules for others.
    count
        The number of colourings.
    method
        The sampler that draws the colourings to choose among. By default `explore`, three chains for each colouring.
    settle
        Steps uphill from each draw, until the rules hold as well as they can nearby (`niwaki.color.settle`); 0 keeps
        the sampler's own draws.
    strictness
        The factor of the model's log score: the larger, the stricter.
    seed, threads, progress
        As for `niwaki.run`.

    Returns
    -------
    list of Coloring
        The best first, then each as different as possible from all before it.

    Raises
    ------
    KeyboardInterrupt
        Ctrl-C: a colouring that has not settled keeps no rule, so no part of the result is returned.

    Examples
    --------
    >>> from niwaki import mh
    >>> first, second = color("bug", count=2, method=mh(steps=400, chains=2, warmup=200, keep=4), seed=1)
    >>> sorted(first.colors) == sorted(second.colors), first.colors["wing"] != second.colors["wing"]
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
    values = arguments(drawing, rules, strictness)
    if all(name in rules.held for name in drawing.names):
        raise FileError("rules-hold-all", rules.place, count=len(drawing.names))
    result = run(
        coloring,
        method or default_method(count),
        *values,
        seed=seed,
        threads=threads,
        progress=progress,
    ).to_its_end()
    draws = [sample for sample in result if sample.has_ended and np.isfinite(sample.log_score)]
    pool = [run(coloring, *values, choices=settled(draw, settle))[0] for draw in draws] if settle else draws
    if len(pool) < count:
        raise InputError(
            "bad-setting",
            name="count",
            found=count,
            expected=f"at most {len(pool)}, the number of colourings that the sampler draws",
            suggestion="ask for fewer, or give `method` more draws",
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
            values,
        )
        for k in chosen
    ]


def painted(drawing: Drawing, rules: Rules, colors: Mapping[str, str], strictness: float = 100.0) -> Coloring:
    """Measure the rules of a colouring in the given colours, without a search.

    Parameters
    ----------
    drawing, rules, strictness
        As for `color`.
    colors
        The colour of every region, `#rrggbb`.

    Examples
    --------
    >>> drawing = Drawing.load("bug")
    >>> grey = painted(drawing, rules_of("bug"), dict.fromkeys(drawing.names, "#808080"))
    >>> str(grey.report[0])
    '`background` is 0 units lighter than `leaf`: 15 too little'
    """
    values = list(arguments(drawing, rules, strictness))
    values[HELD] = [lab.parts(colors[name]) for name in drawing.names]
    sample = run(coloring, *values, choices={}).best
    return Coloring(drawing, rules, dict(colors), sample, tuple(values))


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
        (colourings,) log scores. Only the better half is considered, or the best `count` if these are more.
    areas
        (regions,); a region counts by the root of its area, so that small regions matter, too.
    count
        The number of colourings.
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
    """Load the rules of a drawing of the package, by its name; no rules for any other drawing."""
    is_example = not Path(drawing).exists() and (EXAMPLES / f"{drawing}.toml").is_file()
    return Rules.load(EXAMPLES / f"{drawing}.toml") if is_example else Rules()
