"""Contradictions between rules: which rules cannot hold together, and how near they come.

Every rule about lightness bounds a difference of two lightnesses, and black, white and held colours bound them from
the ground: `L(a) - L(b) <= c`. All bounds can hold unless a cycle of them adds up to less than 0 (Bellman 1958); the
rules of that cycle contradict one another. When each bound is loosened by `slack`, the least slack without such a
cycle tells how near all rules can come to holding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from niwaki.color.lab import of_hex
from niwaki.color.rule import LEAST, STEP, Rule

#: The least difference in lightness, in units, at which an order is visible.
LEAST_VISIBLE = 0.1
#: The largest distance in a and b between held shades of one colour.
CHROMA_APART = 15.0
#: The name of lightness 0 among the regions.
GROUND = ""


class Rules(Protocol):
    """A set of rules, with the colours that do not change."""

    @property
    def held(self) -> dict[str, str]:
        """Colours that do not change, `#rrggbb` by region."""
        ...

    def __iter__(self) -> Iterator[Rule]:
        """Go through the rules."""
        ...


@dataclass(frozen=True)
class _Bound:
    """`L(high) - L(low) <= most`; `give` is the slack at which the rule loses its order, 0 for facts."""

    high: str
    low: str
    most: float
    give: float
    reason: str

    def loose(self, slack: float | None) -> float:
        """Loosen the bound of a rule by `slack`, or by `give` if `slack` is None."""
        if slack is None:
            return self.most + self.give
        return self.most + (slack if self.give else 0.0)


def least_slack(rules: Rules) -> tuple[float, list[str]]:
    """Find the largest miss that the best lightnesses leave, in CIELAB units, and the rules that force it.

    A `lightness` rule misses by its distance from 15, a `lighter` rule by its shortfall. The miss is 0 where all rules
    can hold.
    """
    bounds = list(_bounds(rules))
    if not _cycle(bounds, 0.0):
        return 0.0, []
    low, high = 0.0, 200.0
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _cycle(bounds, middle) else (low, middle)
    return high, list(dict.fromkeys(_cycle(bounds, low)))


def contradiction(rules: Rules) -> list[str]:
    """List rules that cannot hold together even roughly; the list is empty if there are none."""
    for rule in rules:
        if rule.first == rule.second:
            return [f"{rule}"]
    return list(dict.fromkeys(_cycle(list(_bounds(rules)), None))) or _chroma(rules)


def _bounds(rules: Rules) -> Iterator[_Bound]:
    seen = {name for rule in rules for name in (rule.first, rule.second) if name} | set(rules.held)
    for name in sorted(seen):
        if name in rules.held:
            light = of_hex(rules.held[name])[0]
            reason = f"`{name}` is held at {rules.held[name]} (lightness {light:.0f})"
            yield _Bound(name, GROUND, light, 0.0, reason)
            yield _Bound(GROUND, name, -light, 0.0, reason)
        else:
            yield _Bound(name, GROUND, 100.0, 0.0, f"`{name}` is no lighter than white")
            yield _Bound(GROUND, name, 0.0, 0.0, f"`{name}` is no darker than black")
    for rule in rules:
        if rule.kind == "lightness":
            yield _Bound(rule.first, rule.second, STEP, STEP - LEAST_VISIBLE, str(rule))
            yield _Bound(rule.second, rule.first, -STEP, STEP - LEAST_VISIBLE, str(rule))
        elif rule.kind == "lighter":
            yield _Bound(rule.second, rule.first, -LEAST, LEAST - LEAST_VISIBLE, str(rule))


def _cycle(bounds: list[_Bound], slack: float | None) -> list[str]:
    """List the reasons of a cycle of bounds that adds up to less than 0; empty without such a cycle."""
    names = {GROUND} | {name for bound in bounds for name in (bound.high, bound.low)}
    best = dict.fromkeys(names, 0.0)
    previous: dict[str, _Bound] = {}
    last = None
    for _ in range(len(names) + 1):
        last = None
        for bound in bounds:
            reached = best[bound.low] + bound.loose(slack)
            if reached < best[bound.high] - 1e-12:
                best[bound.high], previous[bound.high], last = reached, bound, bound.high
        if last is None:
            return []
    assert last is not None
    for _ in range(len(names)):
        last = previous[last].low
    reasons, region = [], last
    while True:
        reasons.append(previous[region].reason)
        region = previous[region].low
        if region == last:
            return list(dict.fromkeys(reversed(reasons)))


def _chroma(rules: Rules) -> list[str]:
    """List the rules that tie a held colour to another held colour or to a muted region which it does not match."""
    muted = {rule.first: rule for rule in rules if rule.kind == "muted"}
    ties = [rule for rule in rules if rule.kind == "same-chroma"]
    for start in rules.held:
        reached: dict[str, tuple[str, ...]] = {start: ()}  # the rules that lead from `start` to each region
        todo = [start]
        while todo:
            here = todo.pop(0)
            for rule in ties:
                for a, b in ((rule.first, rule.second), (rule.second, rule.first)):
                    if a == here and b not in reached:
                        reached[b] = (*reached[a], str(rule))
                        todo.append(b)
        _, a1, b1 = of_hex(rules.held[start])
        for other, path in reached.items():
            if other in muted and (a1 * a1 + b1 * b1) ** 0.5 > muted[other].most + CHROMA_APART:
                return [*path, str(muted[other]), f"`{start}` is held at {rules.held[start]}"]
            if other == start or other not in rules.held:
                continue
            _, a2, b2 = of_hex(rules.held[other])
            if ((a1 - a2) ** 2 + (b1 - b2) ** 2) ** 0.5 > CHROMA_APART:
                both = [f"`{name}` is held at {rules.held[name]}" for name in (start, other)]
                return [*path, *both]
    return []
