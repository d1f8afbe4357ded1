"""Reports on rules: how well a colouring keeps each of its rules, in units and in words."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from niwaki.color.rule import LEAST, STEP, Rule
from niwaki.lang.constraints import Constraint

# The functions of the model that score a rule: the kind, and the factor from residuals to units of CIELAB.
SCORED = {
    "lightness_relation": ("lightness", 100.0),
    "at_least_lighter": ("lighter", 100.0),
    "one_chroma": ("same-chroma", 282.9),
    "one_hue": ("same-hue", 57.3),
    "near_grey": ("muted", 100.0),
}

#: The largest miss that the eye does not see: CIELAB units, and degrees of hue.
UNSEEN, UNSEEN_DEGREES = 1.0, 3.0


@dataclass(frozen=True)
class RuleReport:
    """Report on one rule: how well a colouring keeps it.

    Attributes
    ----------
    rule : Rule
        The rule.
    goal, value : float
        The difference in lightness, the distance in a and b, or the distance from grey, CIELAB units; for a hue the
        angle between, degrees. `goal` is what the rule asks for, `value` what the colouring has.
    residual : float
        The distance from holding, in the units of `value`; 0 where the rule holds.
    """

    rule: Rule
    goal: float
    value: float
    residual: float

    @property
    def holds(self) -> bool:
        """Whether the miss is too small to see."""
        return abs(self.residual) <= (UNSEEN_DEGREES if self.rule.kind == "same-hue" else UNSEEN)

    def __str__(self) -> str:
        first, second, much = f"`{self.rule.first}`", f"`{self.rule.second}`", abs(self.value)
        match self.rule.kind:
            case "lightness" | "lighter":
                way = "lighter" if self.value >= 0.0 else "darker"
                short = (STEP if self.rule.kind == "lightness" else LEAST) - self.value
                miss = f"{abs(short):.0f} too {'little' if short > 0.0 else 'much'}"
                text = f"{first} is {_units(much)} {way} than {second}"
            case "same-chroma":
                text, miss = f"{first} and {second}, shades of one colour", f"{_units(much)} apart"
            case "same-hue":
                text, miss = f"{first} and {second}, one hue", f"{much:.0f}° apart"
            case _:
                text, miss = f"{first} is {_units(much)} from grey", f"{abs(self.residual):.0f} too much"
        return f"{text}: {'holds' if self.holds else miss}"


def _units(much: float) -> str:
    shown = f"{much:.0f}"
    return f"{shown} unit{'' if shown == '1' else 's'}"


def report(rules: Iterable[Rule], residuals: Iterable[Constraint]) -> list[RuleReport]:
    """Report how well each rule is kept, in the order of the rules.

    Parameters
    ----------
    rules
        Rules on the drawing's regions, in the order of the model's arguments.
    residuals
        The soft constraints of the model's run.
    """
    constraints: dict[tuple[str, int], Constraint] = {}
    for constraint in residuals:
        place = re.search(r"\[(\d+)\][^/]*/(\w+)/", constraint.address)
        if place is not None and place[2] in SCORED:
            constraints[place[2], int(place[1])] = constraint
    rows, count = [], dict.fromkeys(SCORED, 0)
    function_of = {kind: name for name, (kind, _) in SCORED.items()}
    for rule in rules:
        name = function_of[rule.kind]
        constraint, units = constraints[name, count[name]], SCORED[name][1]
        count[name] += 1
        rows.append(
            RuleReport(rule, units * constraint.goal, units * constraint.value, units * constraint.residual)
        )
    return rows
