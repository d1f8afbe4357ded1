"""How well a colouring keeps each of its rules, in units and in words."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from niwaki.color.rule import LEAST, STEP, Rule
from niwaki.lang.constraints import Constraint

# The functions of the model that score a rule, and what makes their residuals units of CIELAB.
SCORED = {
    "lightness_relation": ("lightness", 100.0),
    "at_least_lighter": ("lighter", 100.0),
    "one_chroma": ("same-chroma", 282.9),
    "one_hue": ("same-hue", 57.3),
    "near_grey": ("muted", 100.0),
}

#: A rule that is missed by no more holds for the eye: CIELAB units, and degrees of hue.
UNSEEN, UNSEEN_DEGREES = 1.0, 3.0


@dataclass(frozen=True)
class Kept:
    """How well a colouring keeps one rule.

    Attributes
    ----------
    rule : Rule
        Which.
    wanted, found : float
        The difference in lightness, the distance in a and b, or the distance from grey, CIELAB units; for a hue the
        angle between, degrees.
    residual : float
        How far it is from holding, in the same units; 0 where it holds.
    """

    rule: Rule
    wanted: float
    found: float
    residual: float

    @property
    def holds(self) -> bool:
        """Whether nobody sees that it is missed."""
        return abs(self.residual) <= (UNSEEN_DEGREES if self.rule.kind == "same-hue" else UNSEEN)

    def __str__(self) -> str:
        one, other, much = f"`{self.rule.first}`", f"`{self.rule.second}`", abs(self.found)
        match self.rule.kind:
            case "lightness" | "lighter":
                way = "lighter" if self.found >= 0.0 else "darker"
                short = (STEP if self.rule.kind == "lightness" else LEAST) - self.found
                miss = f"{abs(short):.0f} too {'little' if short > 0.0 else 'much'}"
                said = f"{one} is {_units(much)} {way} than {other}"
            case "same-chroma":
                said, miss = f"{one} and {other}, shades of one colour", f"{_units(much)} apart"
            case "same-hue":
                said, miss = f"{one} and {other}, one hue", f"{much:.0f}° apart"
            case _:
                said, miss = f"{one} is {_units(much)} from grey", f"{abs(self.residual):.0f} too much"
        return f"{said}: {'holds' if self.holds else miss}"


def _units(much: float) -> str:
    shown = f"{much:.0f}"
    return f"{shown} unit{'' if shown == '1' else 's'}"


def kept(rules: Iterable[Rule], residuals: Iterable[Constraint]) -> list[Kept]:
    """How well each rule is kept, in the order of the rules.

    Parameters
    ----------
    rules
        On the drawing's regions, in the order in which the model was given them.
    residuals
        The soft constraints of the model's run.
    """
    found: dict[tuple[str, int], Constraint] = {}
    for one in residuals:
        place = re.search(r"\[(\d+)\][^/]*/(\w+)/", one.address)
        if place is not None and place[2] in SCORED:
            found[place[2], int(place[1])] = one
    rows, count = [], dict.fromkeys(SCORED, 0)
    function_of = {kind: name for name, (kind, _) in SCORED.items()}
    for rule in rules:
        name = function_of[rule.kind]
        one, units = found[name, count[name]], SCORED[name][1]
        count[name] += 1
        rows.append(Kept(rule, units * one.goal, units * one.value, units * one.residual))
    return rows
