"""The best of every kind: what tells results apart, and the archive of a search as a table and a sheet.

An archive holds the best run of each kind that a search met (Mouret & Clune 2015, "Illuminating search spaces by
mapping elites"). The engine fills it; this file names its kinds for people.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from os import PathLike
from pathlib import Path
from typing import Any

from niwaki import draw
from niwaki.errors import InputError
from niwaki.errors.settings import count
from niwaki.lang.models import Model
from niwaki.methods import Improve, Method
from niwaki.result import Result, Sample
from niwaki.result.info import ImproveInfo
from niwaki.search.entry import grow
from niwaki.search.kinds import TOO_FEW, named
from niwaki.search.warnings import SearchWarning

#: Most kinds of an archive, when no number is given.
KINDS = 200


@dataclass(frozen=True)
class Kind:
    """A kind of an archive: its values by label, and its best run."""

    values: dict[str, str]
    sample: Sample

    @property
    def log_score(self) -> float:
        """The log score of its best run, nats."""
        return self.sample.log_score

    def __str__(self) -> str:
        return ", ".join(f"{name} {value}" for name, value in self.values.items()) or "one kind"


@dataclass(frozen=True)
class Archive(Sequence[Kind]):
    """The best run of each kind that a search met, best first.

    Attributes
    ----------
    result : Result
        The result of the search, one sample for each kind.
    """

    result: Result

    @property
    def kinds(self) -> list[Kind]:
        """The kinds, best first."""
        return [
            Kind(dict(values), sample)
            for values, sample in zip(named(self.result), self.result.samples, strict=True)
        ]

    def __len__(self) -> int:
        return len(self.result)

    def __getitem__(self, number: Any) -> Any:
        return self.kinds[number]

    def __iter__(self) -> Iterator[Kind]:
        return iter(self.kinds)

    def table(self) -> list[dict[str, Any]]:
        """A row for each kind: its number from 1, its log score, its parts, and its values by label."""
        return [
            {
                "number": number,
                "log score": kind.log_score,
                "parts": kind.sample.primitives,
                **kind.values,
            }
            for number, kind in enumerate(self.kinds, 1)
        ]

    def quality(self, floor: float) -> float:
        """Sum what the best run of each kind has above a log score, nats; the QD score of Pugh et al. 2016.

        Parameters
        ----------
        floor
            The log score that counts as nothing, such as that of the empty scene.
        """
        return sum(max(0.0, kind.log_score - floor) for kind in self if isfinite(kind.log_score))

    def sheet(self, *, most: int | None = None, **settings: Any) -> Any:
        """Draw all kinds side by side, or the best so many; settings as for `Result.sheet`."""
        captions = [f"{number}  {kind.log_score:.1f}  {kind}" for number, kind in enumerate(self, 1)]
        return self.result.sheet(most=most, captions=captions, **settings)

    def save(self, path: str | PathLike[str], **settings: Any) -> Path:
        """Draw the sheet into an image file."""
        return draw.picture.save_image(lambda: self.sheet(**settings), path)

    def __str__(self) -> str:
        lines = [
            f"{number:4d}  {kind.log_score:10.2f}  {kind.sample.primitives:5d}  {kind}"
            for number, kind in enumerate(self, 1)
        ]
        return "\n".join([f"{'':4}  {'log score':>10}  {'parts':>5}  kind", *lines])


def archive(
    model: Model[..., Any] | Callable[..., Any],
    *args: Any,
    kinds: int = KINDS,
    by: str | Sequence[str] = "kind",
    method: Method | None = None,
    **settings: Any,
) -> Archive:
    """Search for the best run of every kind.

    Parameters
    ----------
    model, args
        The model, the target and the arguments, as for `grow`.
    kinds
        The most kinds in the archive.
    by
        What tells kinds apart, as for `improve`.
    method
        `improve(...)` with the settings of the search; its `diverse`, `by` and `margin` are those of the archive.
    settings
        Further arguments of `grow`.

    Returns
    -------
    Archive
        The kinds with their best runs; fewer than `kinds` where the search met no more.
    """
    count("kinds", kinds)
    if method is not None and not isinstance(method, Improve):
        raise InputError(
            "bad-setting",
            name="method",
            found=method.NAME,
            expected="`improve`, which keeps an archive",
            suggestion="`improve(...)`",
        )
    of_kinds: dict[str, Any] = {
        "diverse": kinds,
        "by": by if isinstance(by, str) else tuple(by),
        "margin": None,
    }
    settings |= of_kinds if method is None else {"method": replace(method, **of_kinds)}
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", TOO_FEW, SearchWarning)
        result = grow(model, *args, **settings)
    return Archive(_of_each_kind(result))


def _of_each_kind(result: Result) -> Result:
    """Keep the best sample of each kind."""
    info = result.info
    if isinstance(info, ImproveInfo) and len(info.kinds) == len(result):
        first = {tuple(kind.items()): place for place, kind in reversed([*enumerate(info.kinds)])}
        places = sorted(first.values())
        result.samples = [result.samples[place] for place in places]
        result.info = replace(info, kinds=tuple(info.kinds[place] for place in places))
    return result
