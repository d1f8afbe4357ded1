"""Whether rules can hold together, and, where they cannot, which ones contradict one another.

Every rule about lightness bounds a difference of two lightnesses, and black, white and held colours bound them from
the ground: `L(a) - L(b) <= c`. Such bounds can be met together unless some cycle of them adds up to less than 0
(Bellman 1958); that cycle is the list of rules to show. With each bound loosened by `slack`, the least slack for which
no such cycle is left measures how near all rules can come to holding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

from niwaki.color.lab import of_hex
from niwaki.color.rule import LEAST, STEP, Rule

#: The least difference of a rule about lightness, in units, for its order to be visible.
LEFT = 0.1
#: Held shades of one colour may differ by this much in a and b.
CHROMA_APART = 15.0
GROUND = ""


class Rules(Protocol):
    """Rules, and the colours that do not change, `#rrggbb` by region."""

    @property
    def held(self) -> dict[str, str]:
        """The colours by region."""
        ...

    def __iter__(self) -> Iterator[Rule]:
        """Go through the rules."""
        ...


@dataclass(frozen=True)
class _Bound:
    """`L(high) - L(low) <= most`, which may be loosened by `give` before the rule's order is gone; 0 for facts."""

    high: str
    low: str
    most: float
    give: float
    why: str

    def loose(self, slack: float | None) -> float:
        """The bound, looser by `slack` if it is a rule's; by all that it can give where that is None."""
        if slack is None:
            return self.most + self.give
        return self.most + (slack if self.give else 0.0)


def least_slack(rules: Rules) -> tuple[float, list[str]]:
    """The largest miss that the best lightnesses leave, in CIELAB units, and the rules that force it.

    A `lightness` rule misses by its distance from 15, a `lighter` one by its shortfall. 0 where all can hold.
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
    """Rules that cannot hold together even roughly; none where they can."""
    for rule in rules:
        if rule.first == rule.second:
            return [f"{rule}"]
    return list(dict.fromkeys(_cycle(list(_bounds(rules)), None))) or _chroma(rules)


def _bounds(rules: Rules) -> Iterator[_Bound]:
    seen = {name for rule in rules for name in (rule.first, rule.second) if name} | set(rules.held)
    for name in sorted(seen):
        if name in rules.held:
            light = of_hex(rules.held[name])[0]
            why = f"`{name}` is held at {rules.held[name]} (lightness {light:.0f})"
            yield _Bound(name, GROUND, light, 0.0, why)
            yield _Bound(GROUND, name, -light, 0.0, why)
        else:
            yield _Bound(name, GROUND, 100.0, 0.0, f"`{name}` is no lighter than white")
            yield _Bound(GROUND, name, 0.0, 0.0, f"`{name}` is no darker than black")
    for rule in rules:
        if rule.kind == "lightness":
            yield _Bound(rule.first, rule.second, STEP, STEP - LEFT, str(rule))
            yield _Bound(rule.second, rule.first, -STEP, STEP - LEFT, str(rule))
        elif rule.kind == "lighter":
            yield _Bound(rule.second, rule.first, -LEAST, LEAST - LEFT, str(rule))


def _cycle(bounds: list[_Bound], slack: float | None) -> list[str]:
    """The reasons of a cycle of bounds that adds up to less than 0; none if there is no such cycle."""
    names = {GROUND} | {name for one in bounds for name in (one.high, one.low)}
    best = dict.fromkeys(names, 0.0)
    came: dict[str, _Bound] = {}
    last = None
    for _ in range(len(names) + 1):
        last = None
        for one in bounds:
            reached = best[one.low] + one.loose(slack)
            if reached < best[one.high] - 1e-12:
                best[one.high], came[one.high], last = reached, one, one.high
        if last is None:
            return []
    assert last is not None
    for _ in range(len(names)):
        last = came[last].low
    found, at = [], last
    while True:
        found.append(came[at].why)
        at = came[at].low
        if at == last:
            return list(dict.fromkeys(reversed(found)))


def _chroma(rules: Rules) -> list[str]:
    """A held colour that is tied as a shade to another held one, or to a muted region, and is not like it."""
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
