"""`Keep`: the requirements that a person has, and the table of all that there are.

    covered = 0.9                           # the least share of the target that a result fills
    outside = 0.1                           # the largest share of a result outside of the target
    height = [2.0, 3.0]                     # the least and the largest height
    within = [[-2, 0, -2], [2, 2.6, 2]]     # the lowest and the highest corner of the room
    thinnest = 0.002                        # the least thickness of a part
    stands = true                           # whether a result has to stand on its lowest points
    supported = true                        # whether each part has to stand on the ground or on another part
    collisions = false                      # whether parts may intersect

Lengths are in units of the scene. Results of searches and the parts of scripts are held against the same requirements.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import replace
from difflib import get_close_matches
from math import inf
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from msgspec import Meta, Struct

from niwaki.errors import InputError
from niwaki.errors.schema import Unfit, fitted
from niwaki.errors.source import SourceFile, Span
from niwaki.inputs.files import text_of
from niwaki.inputs.texts import toml_of
from niwaki.requirements import measures
from niwaki.requirements.form import Form
from niwaki.requirements.measures import Corner, Measured
from niwaki.requirements.rows import RequirementRow, Violation
from niwaki.result import Sample
from niwaki.shares import percent
from niwaki.targets.sketches import Score, limits

Share = Annotated[float, Meta(ge=0.0, le=1.0)]
Length = Annotated[float, Meta(ge=0.0)]


class Requirement(NamedTuple):
    """A requirement of the table.

    Attributes
    ----------
    words
        What a value of it requires.
    measure
        How far a form violates it.
    by
        What is measured: "target" for how the form fills a target, "solids", "boxes"; "pairs" of parts.
    """

    words: Callable[[Any], str]
    measure: Callable[[Any, Form], Measured]
    by: str


#: All requirements, by their keys in a file.
REQUIREMENTS = {
    "covered": Requirement(lambda share: f"at least {percent(share)} covered", measures.covered, "target"),
    "outside": Requirement(lambda share: f"at most {percent(share)} outside", measures.outside, "target"),
    "height": Requirement(lambda pair: "height {:g} to {:g}".format(*pair), measures.height, "boxes"),
    "within": Requirement(lambda pair: f"within {_corner(pair[0])} and {_corner(pair[1])}", measures.within, "boxes"),
    "thinnest": Requirement(lambda least: f"no part thinner than {least:g}", measures.thinnest, "solids"),
    "stands": Requirement(lambda _: "stands", measures.stands, "solids"),
    "supported": Requirement(lambda _: "every part supported", measures.supported, "boxes"),
    "collisions": Requirement(lambda _: "no parts intersect", measures.collisions, "pairs"),
}  # fmt: skip

#: The standard deviation of limits in a score: a quarter of a target's, because requirements go before the target.
STRICTNESS = 0.005

#: Values with which a requirement asks for nothing.
INERT = {"stands": False, "supported": False, "collisions": True}


class Keep(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Requirements; None for those that do not count.

    Attributes
    ----------
    covered, outside : float or None
        The least share of the target that is filled, and the largest share outside of it.
    height : pair of float or None
        The least and the largest height of all parts together.
    within : pair of corners or None
        Every part lies between the lowest and the highest corner.
    thinnest : float or None
        The least thickness of a part.
    stands : bool or None
        True: all parts together stand on their lowest points; blocks, by the forces between them.
    supported : bool or None
        True: every part stands on the ground (0 along the axis that points up) or on another part.
    collisions : bool or None
        False: no two parts intersect.
    """

    covered: Share | None = None
    outside: Share | None = None
    height: tuple[Length, Length] | None = None
    within: tuple[Corner, Corner] | None = None
    thinnest: Length | None = None
    stands: bool | None = None
    supported: bool | None = None
    collisions: bool | None = None

    @classmethod
    def load(cls, place: str | PathLike[str]) -> Keep:
        """Read a file of requirements.

        Raises
        ------
        InputError
            `bad-requirements`.
        """
        text = text_of(place, "preset", "requirements")
        return cls.of_data(toml_of(text, place), place, text)

    @classmethod
    def of_data(cls, data: Any, place: str | PathLike[str] = "nw.Keep", text: str = "") -> Keep:
        """Read requirements from plain data; the text has the lines that messages show.

        Raises
        ------
        InputError
            `bad-requirements`.
        """
        try:
            keep: Keep = fitted(data, cls)
            if keep.height is not None and not keep.height[0] <= keep.height[1]:
                raise Unfit("$.height", "the least height first", str(list(keep.height)))
            if keep.within is not None and not all(a <= b for a, b in zip(*keep.within, strict=True)):
                corners = [list(corner) for corner in keep.within]
                raise Unfit("$.within", "the lowest corner first", str(corners))
        except Unfit as error:
            raise _bad(place, text, error) from error
        return keep

    def active(self) -> Iterator[tuple[str, Any, Requirement]]:
        """Return the requirements that count: their names, what they require, and their rows of the table."""
        for name, requirement in REQUIREMENTS.items():
            value = getattr(self, name)
            if value is not None and value is not INERT.get(name):
                yield name, value, requirement

    def rows(self) -> list[RequirementRow]:
        """Return the requirements in words, without a judged run."""
        return [RequirementRow(name, requirement.words(value)) for name, value, requirement in self.active()]

    def judged(self, subject: Sample | Form) -> list[RequirementRow]:
        """Hold a run, or other parts, against the requirements."""
        form = subject if isinstance(subject, Form) else Form.of_sample(subject)
        rows = self.rows()
        for row, (_, value, requirement) in zip(rows, self.active(), strict=True):
            violations, row.value = requirement.measure(value, form)
            row.holds = not violations
        return rows

    def over(self, samples: Iterable[Sample]) -> list[RequirementRow]:
        """Count the runs that keep each requirement."""
        runs = list(samples)
        each = [self.judged(sample) for sample in runs]
        has_target = any(sample.fit is not None for sample in runs)
        rows = self.rows()
        for place, (row, (_, _, requirement)) in enumerate(zip(rows, self.active(), strict=True)):
            count = sum(bool(judged[place].holds) for judged in each)
            needs_target = requirement.by == "target" and not has_target
            row.value = "needs a target" if needs_target else f"kept by {count} of {len(each)} runs"
        return rows

    def aims(self, score: Score) -> Score:
        """Return a score with a term for those requirements that a search can see in every scene: see `nw.limits`."""
        goal = replace(score, asks=tuple(call for call in score.asks if call.function != "limits"))
        height = None if self.height is None else (self.height[0], min(self.height[1], sys.float_info.max))
        sides = () if self.within is None else tuple(zip(*self.within, strict=True))
        # A box without depth, of a drawing, and one without an end are judged alone.
        has_inside = all(-inf < low < high < inf for low, high in sides)
        within = self.within if has_inside else None
        return goal if height is None and within is None else goal * limits(height, within, STRICTNESS)

    def unmet(self, subject: Sample | Form) -> list[str]:
        """Return the requirements that a run, or other parts, do not keep, in words."""
        return [f"{row.text}: {row.value}" for row in self.judged(subject) if not row.holds]

    def violations(self, form: Form, names: Collection[str] = tuple(REQUIREMENTS)) -> list[Violation]:
        """Return what parts violate of the requirements with these names."""
        return [
            row
            for name, value, requirement in self.active()
            if name in names
            for row in requirement.measure(value, form)[0]
        ]


def _bad(place: str | PathLike[str], text: str, error: Unfit) -> InputError:
    """Return the error about a value of a file of requirements, with its line."""
    name = (re.match(r"\$\.?(\w*)", error.at) or [""] * 2)[1]
    near = get_close_matches(name, REQUIREMENTS, 1)
    reason = str(error)
    if name and name not in REQUIREMENTS:
        reason = f"there is no requirement `{name}`" + (f": did you mean `{near[0]}`?" if near else "")
    lines = text.splitlines()
    entry = re.compile(rf"\s*([\"']?{re.escape(name)}[\"']?\s*=\s*[^#]*[^#\s]|\[{re.escape(name)}\])")
    spans = [
        Span(SourceFile(str(place), tuple(lines)), number, match.start(1) + 1, number, match.end(1) + 1)
        for number, line in enumerate(lines, start=1)
        if name and (match := entry.match(line))
    ]
    label = f"expected {error.expected}" if name in REQUIREMENTS else ""
    return InputError(
        "bad-requirements", [(spans[0], label)] if spans else (), path=Path(place), reason=reason
    )


def _corner(corner: Corner) -> str:
    return "({:g}, {:g}, {:g})".format(*corner)
