"""The search for few numbers whose change repairs a script.

Runs of the script are few: one as it is written, a few for derivatives (`prediction`), and then one for each plan. A
plan is a beam of changes, each of one number by as much as a predicted violation needs, rounded as a person would write
it. The plan of least cost is run, its violations correct the rules of the prediction, and the next plan follows.

The cost of a run, or of a predicted one, is

    60 * violated / violated at first + 12 * violations
        + numbers changed + 0.3 * decimals added + 200 * moved + 0.1 * sum(z^2)

where `moved` is how far the parts moved, weighted by volume, as a share of the scene, and z is the change of a number
in widths of its prior. The second line is bent so that it stays below 60: a repair is worth any change.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, zip_longest
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki.repairing.literals import Literal
from niwaki.repairing.prediction import MOST_RUNS, RUNS, TINY, Rules, changes, derivatives
from niwaki.repairing.writing import coarse, further, rounded
from niwaki.requirements import Keep, Violation
from niwaki.requirements.boxes import Array
from niwaki.requirements.form import Form

#: The cost of all that is violated at first, of each violation, of each number, of a move of all by the scene's size,
#: and of a number changed by its width.
ALL, EACH, NUMBER, FAR, WIDE = 60.0, 12.0, 1.0, 200.0, 0.1
#: The cost of each decimal more than the literal has as it is written.
DIGIT = 0.3
#: Every so many runs a plan begins at the script as it is written.
BASE = 4
#: Plans kept side by side; the most numbers that a plan changes; violations that a plan attends to at once.
BEAM, DEPTH, ATTENDED = 3, 12, 3
#: The most numbers that are tried against one violation.
TRIED = 12
#: Runs without a gain after which the search ends; runs that look for a smaller change of a script that is repaired.
PATIENCE, POLISH = 80, 4
#: A plan of a repaired script is run if it costs less by this.
GAIN = 0.3
#: The share of an unexplained violation that a move of its part is hoped to end; after each failure the half of it.
HOPE = 0.7
#: A prediction is wrong if a part is elsewhere by this share of its move; a number is then trusted for this share of
#: its change.
WRONG, NEARER = 0.25, 0.4
#: Changes that are tried without a promise, in widths; the most of them of numbers, and of words.
LADDER, NUMBERS, WORDS = (-2.0, -1.0, -0.5, -0.25, 0.25, 0.5, 1.0, 2.0), 32, 24
#: Violations whose conflicts are looked for.
SHOWN = 3
#: Numbers are as good as those of an earlier run within this share of their changes.
TOLERANCE = 0.06


@dataclass(frozen=True, eq=False)
class Trial:
    """A run of the script.

    Attributes
    ----------
    number : int
        Its place in the order of runs.
    values : dict
        The numbers that are not as written, by key.
    boxes : (parts, 2, 3) array
        The boxes of the parts; None if the run failed or makes other parts.
    violations : tuple of Violation
    failed : str
        The text of a failure.
    cost : float
        See the module; infinity for a failure.
    """

    number: int
    values: dict[str, float]
    boxes: Array | None
    violations: tuple[Violation, ...]
    failed: str = ""
    moved: float = 0.0
    cost: float = math.inf

    @property
    def broken(self) -> set[Key]:
        """The keys of the violations."""
        return {row.key for row in self.violations}

    @property
    def violated(self) -> float:
        """The sum of what is violated."""
        return sum(row.amount for row in self.violations) if not self.failed else math.inf


#: The requirement and the parts of a violation.
Key = tuple[str, tuple[str, ...]]
#: A violation that a change is hoped to end, with the share of it.
Eased = tuple[Key, float] | None
#: Runs a script with numbers: the outcomes in order.
Evaluate = Callable[[Sequence[Mapping[str, float]]], list[Trial]]


@dataclass(eq=False)
class _Node:
    """A predicted run."""

    values: dict[str, float]
    boxes: Array
    pairs: Array
    alone: Array
    rooms: Array
    rest: dict[Key, float]
    cost: float = math.inf

    @property
    def is_violated(self) -> bool:
        """Whether something is predicted to be violated."""
        return any(self.rest.values()) or bool(self.pairs.any() or self.alone.any() or self.rooms.any())


@dataclass(frozen=True)
class _Item:
    """A predicted violation: kind "pair", "room", "alone" or "rest", and its parts."""

    cost: float
    kind: str
    parts: tuple[int, ...]
    wide: Array | None = None
    key: Key | None = None


class Repairing:
    """A search under way.

    Parameters
    ----------
    rows
        The literals that may change.
    evaluate
        Runs the script.
    names
        The parts.
    up
        The axis that points up.
    exact
        Whether the script's coordinates have all their digits.
    resizes
        Whether a number that resizes parts may change.
    keep, form
        The requirements and the parts of the first run, from which the violations of predicted boxes follow; None if
        only runs tell what is violated.
    """

    def __init__(
        self,
        rows: Sequence[Literal],
        evaluate: Evaluate,
        base: Trial,
        rules: Rules,
        budget: int,
        exact: bool = True,
        resizes: Callable[[Literal], bool] = lambda row: False,
        keep: Keep | None = None,
        form: Form | None = None,
    ) -> None:
        assert base.boxes is not None
        self.rows = {row.key: row for row in rows}
        self.evaluate, self.base, self.rules, self.budget = evaluate, base, rules, budget
        self.exact, self.resizes, self.keep, self.form = exact, resizes, keep, form
        kinds = {} if keep is None else {name: row.by for name, _, row in keep.active()}
        #: The requirements whose violations follow from predicted boxes, and those that no rule of boxes explains.
        self.predicted = {name for name, by in kinds.items() if by != "pairs"}
        self.unruled = {name for name, by in kinds.items() if by in ("solids", "target")}
        self.widths = {row.key: row.width(rules.size) for row in rows}
        self.slopes: dict[str, Array] = {}
        #: Which parts each number moves, as a mask and as places.
        self.masks: dict[str, NDArray[np.bool_]] = {}
        self.moved: dict[str, NDArray[np.int64]] = {}
        self.sizes: list[Literal] = []
        self.volumes = np.prod(np.maximum(base.boxes[:, 1] - base.boxes[:, 0], 1e-9), axis=-1)
        self.first = max(base.violated, 1e-12)
        self.hopes: dict[Key, float] = {}
        #: What is still to be tried, by the number of the run that it changes.
        self.listed: dict[int, list[dict[str, float]]] = {}
        #: Where the parts of each violation were, and how far it was violated, in runs in which they were elsewhere.
        self.seen: dict[Key, list[tuple[Array, float]]] = {}
        self.base = self.priced(base)
        self.trials = [self.base]
        self._note(self.base)
        #: How far the derivatives of a number are trusted, where that is known.
        self.reach: dict[str, float] = {}
        self._idle: tuple[object, ...] = ()
        self.trends: dict[Key, tuple[Array, float, Array]] = {}
        rules.learn(base.boxes, base.violations)

    @property
    def left(self) -> int:
        """Runs that are left."""
        return self.budget - len(self.trials)

    @property
    def best(self) -> Trial:
        """The run of least cost."""
        return min(self.trials, key=lambda trial: (trial.cost, trial.number))

    @property
    def least(self) -> Trial:
        """The run in which least is violated, whatever its change costs and however many violations there are."""
        return min(self.sound, key=lambda trial: (trial.violated, trial.cost, trial.number))

    def run(self, report: Callable[[Trial], None] = lambda trial: None, patches: int = 1) -> None:
        """Search until nothing is violated and nothing cheaper is predicted, or all runs are spent."""
        self.differentiate()
        stalled, polished = 0, 0
        while self.left > 0 and stalled < PATIENCE and polished < POLISH:
            before = self.best
            values = self.proposal()
            if values is None and before.violations:
                values = self.alternatives()
            if values is None:
                break
            trial = self.tell(self.evaluate([values])[0])
            report(trial)
            if trial.cost < before.cost - 1e-9:
                stalled = 0
            else:
                stalled += 1
            polished += not before.violations
        if self.best.violations:
            self.contrast()
        failures = 0
        while self.left > 0 and failures < PATIENCE and 0 < self.answers < patches:
            values = self.proposal(distinct=True)
            if values is None:
                break
            known = self.answers
            report(self.tell(self.evaluate([values])[0]))
            failures = 0 if self.answers > known else failures + 1

    @property
    def answers(self) -> int:
        """The number of sets of literals whose change repairs the script."""
        return len(self._repairing())

    def _repairing(self) -> set[frozenset[str]]:
        return {
            frozenset(trial.values)
            for trial in self.trials
            if trial.boxes is not None and not trial.violations and trial.cost < self.base.cost
        }

    def priced(self, trial: Trial) -> Trial:
        """Return a run with its cost."""
        if trial.boxes is None or trial.failed:
            return trial
        change = self.change(trial.values, trial.boxes)
        cost = ALL * trial.violated / self.first + EACH * len(trial.violations) + change
        return replace(trial, cost=cost, moved=float(self._far(trial.boxes[None])[0]))

    def tell(self, trial: Trial) -> Trial:
        """Learn from a run."""
        trial = self.priced(trial)
        self.trials.append(trial)
        if trial.boxes is not None and not trial.failed:
            self._note(trial)
            self._trust(trial)
            still = {row.key for row in trial.violations}
            for key in self.hopes:
                if key in still and any(self._moves(name, key) for name in trial.values):
                    self.hopes[key] *= 0.5
            self.rules.learn(trial.boxes, trial.violations)
        return trial

    def _note(self, trial: Trial) -> None:
        """Note where the parts of violations of the first run are, and how far they are violated now."""
        assert trial.boxes is not None
        amounts = {row.key: row.amount for row in trial.violations}
        for row in (*self.base.violations, *trial.violations):
            place = self._place(trial.boxes, row.key)
            rows = self.seen.setdefault(row.key, [])
            if place is not None and all(np.abs(place - other).max() > self.rules.touch for other, _ in rows):
                rows.append((place, amounts.get(row.key, 0.0)))

    def _trust(self, trial: Trial) -> None:
        """Trust the derivatives of a number less far where a run shows them to be wrong, and further where right."""
        assert trial.boxes is not None and self.base.boxes is not None
        predicted = self.base.boxes.copy()
        for key, value in trial.values.items():
            if key in self.slopes:
                predicted += (value - self.rows[key].value) * self.slopes[key]
        far = np.abs(predicted - self.base.boxes).max(axis=(1, 2))
        off = np.abs(predicted - trial.boxes).max(axis=(1, 2))
        wrong = off > np.maximum(WRONG * far, 5 * self.rules.touch)
        for key, value in trial.values.items():
            if key not in self.slopes:
                continue
            step = abs(value - self.rows[key].value)
            if self.slopes[key][wrong].any():
                self.reach[key] = min(self.reach.get(key, math.inf), NEARER * step)
            elif step > 0.5 * self.reach.get(key, math.inf):
                self.reach[key] = 2.0 * step

    def _place(self, boxes: Array, key: Key) -> Array | None:
        """Return the middle of a violation's part, or how far that of the first is from that of the second."""
        places = self.rules.places(key[1])
        if not key[1] or not 1 <= len(places) <= 2:
            return None
        middles = boxes[..., places, :, :].mean(axis=-2)
        return np.asarray(middles[..., 0, :] - middles[..., 1, :] if len(places) == 2 else middles[..., 0, :])

    def _trend(self, key: Key) -> tuple[Array, float, Array] | None:
        """Return a place, its amount, and the derivative of the amount, if runs have shown it."""
        rows = [row for row in self.seen.get(key, []) if row[1] > 0.0]
        if len(rows) < 2:
            return None
        place, amount = min(rows, key=lambda row: row[1])
        rows_elsewhere = [row for row in rows if row[0] is not place][-3:]
        steps = np.array([other - place for other, _ in rows_elsewhere])
        slope = np.linalg.lstsq(steps, np.array([other - amount for _, other in rows_elsewhere]), rcond=1e-3)[
            0
        ]
        return (place, amount, slope) if np.abs(slope).max() > 0.0 else None

    def _moves(self, name: str, key: Key) -> bool:
        slope = self.slopes.get(name)
        places = self.rules.places(key[1])
        return slope is not None and bool(np.any(slope[places]))

    def differentiate(self) -> None:
        """Find how the boxes depend on the numbers, by a few runs."""
        assert self.base.boxes is not None
        rows = [row for row in self.rows.values() if row.kind not in ("word", "count")]
        if not rows:
            return
        count = len(self.base.boxes)
        keys = [row.key for row in rows]
        unit = np.array([self.widths[key] for key in keys]) * (TINY if self.exact else 0.2)
        if not self.exact or len(keys) <= RUNS:
            table = self._one_by_one(rows, unit)
        else:
            table = self._together(rows, unit)
        for key, row, slope in zip(keys, rows, table, strict=True):
            slope = slope.reshape(count, 2, 3)
            far = float(np.abs(slope).max())
            if far == 0.0:
                continue
            resized = np.abs(slope[:, 0] - slope[:, 1]).max()
            if resized > 1e-3 * far and row.kind == "length" and not self.resizes(row):
                self.sizes.append(row)
                continue
            self.slopes[key] = slope
        self.masks = {key: np.abs(slope).max(axis=(1, 2)) > 0 for key, slope in self.slopes.items()}
        self.moved = {key: np.flatnonzero(mask) for key, mask in self.masks.items()}
        fixed = {row.key for row in self.sizes}
        self.trials = [
            replace(trial, cost=math.inf) if fixed & trial.values.keys() else trial for trial in self.trials
        ]

    def _one_by_one(self, rows: Sequence[Literal], unit: Array) -> Array:
        """Change the numbers one by one."""
        assert self.base.boxes is not None
        table = np.zeros((len(rows), self.base.boxes.size))
        runs = self.evaluate(
            [{row.key: row.value + float(step)} for row, step in zip(rows, unit, strict=True)][
                : max(self.left - 1, 0)
            ]
        )
        for number, run in enumerate(runs):
            # A run whose change is large is an outcome, too.
            (self.tell if not self.exact else self.trials.append)(run)
            if run.boxes is not None:
                table[number] = (run.boxes - self.base.boxes).ravel() / unit[number]
        table[np.abs(table) < 1e-7] = 0.0
        return table

    def _together(self, rows: Sequence[Literal], unit: Array) -> Array:
        """Change all numbers at once, a few times, by tiny random amounts."""
        assert self.base.boxes is not None
        steps = changes(len(rows), MOST_RUNS)
        moved: list[Array] = []
        used: list[int] = []
        count, table = min(RUNS, self.left - 1), np.zeros((len(rows), self.base.boxes.size))
        while len(used) < MOST_RUNS and self.left > 1:
            candidates = list(
                range(max(used, default=-1) + 1, min(max(used, default=-1) + 1 + count, MOST_RUNS))
            )
            if not candidates:
                break
            runs = self.evaluate(
                [
                    {
                        row.key: row.value + float(step)
                        for row, step in zip(rows, steps[number] * unit, strict=True)
                    }
                    for number in candidates
                ]
            )
            for number, run in zip(candidates, runs, strict=True):
                self.trials.append(run)
                used.append(number)
                if run.boxes is not None:
                    moved.append(_middles(run.boxes - self.base.boxes).ravel())
            good = [
                number for number, run in zip(used, self.trials[1:], strict=True) if run.boxes is not None
            ]
            if len(good) < 3:
                return self._one_by_one(rows, unit)
            table, explained = derivatives(steps[good] * unit, np.array(moved))
            matters = np.zeros((len(self.rules.names), 6), bool)
            for row in self.base.violations:
                matters[self.rules.places(row.parts)] = True
            if explained[matters.ravel()].all():
                break
            count = 3
        else:
            if len(rows) < self.left // 2:
                return self._one_by_one(rows, unit)
        middles = table.reshape(len(rows), -1, 2, 3)
        table = np.stack([middles[:, :, 0] - middles[:, :, 1], middles[:, :, 0] + middles[:, :, 1]], axis=2)
        table[np.abs(table) < 1e-6] = 0.0
        return table.reshape(len(rows), -1)

    def proposal(self, distinct: bool = False) -> dict[str, float] | None:
        """Return the numbers of the next run; None if no plan promises a gain.

        Parameters
        ----------
        distinct
            Whether to look for repairs by sets of literals that do not repair the script yet.
        """
        best, known = self.best, self._repairing()
        state = self._state()
        if not distinct and state == self._idle:
            return None
        # Plans from the first run change fewest numbers; those from the best are more likely to be right.
        starts = [self.base] if len(self.trials) % BASE == 0 or best is self.base else []
        starts += [best] if best is not self.base else []
        least = self.least
        starts += [least] if least is not best and len(self.trials) % BASE == 2 else []
        limit = self.base.cost if distinct else best.cost - (GAIN if not best.violations else 1e-6)
        plans: list[_Node] = []
        for start in [self.base] if distinct else starts:
            plans += self.plan(start)
        for plan in sorted(plans, key=lambda plan: plan.cost):
            if plan.cost >= limit:
                break
            if distinct and (plan.is_violated or any(answer <= plan.values.keys() for answer in known)):
                continue
            if not self._is_like_earlier(plan.values):
                return plan.values
        self._idle = state
        return None

    def _state(self) -> tuple[object, ...]:
        """Return all that plans depend on, but hopes: less of them makes no plan better."""
        rules = self.rules
        return (
            self.best.number,
            *(rules.allowed.tobytes(), rules.room.tobytes(), rules.scale),
            *(tuple(sorted((key, wide.tobytes()) for key, wide in rules.zones.items())),),
            tuple(self.reach.items()),
            tuple(len(rows) for rows in self.seen.values()),
        )

    def _is_like_earlier(self, values: Mapping[str, float]) -> bool:
        """Tell whether a run with about the same numbers is known."""
        for trial in self.trials:
            if trial.values.keys() == values.keys() and all(
                abs(values[key] - value) <= TOLERANCE * abs(value - self.rows[key].value)
                for key, value in trial.values.items()
            ):
                return True
        return False

    def alternatives(self) -> dict[str, float] | None:
        """Return a good run with one literal changed, though no rule promises a gain; None if all are known.

        Numbers that move what is violated come first, those of least predicted cost if the violation ended; then words
        and counts, those near the names and lines of what is violated.
        """
        best = self.least if len(self.trials) % 3 == 2 else self.best
        if best.number not in self.listed:
            self.listed[best.number] = self._alternatives(best)
        listed = self.listed[best.number]
        while listed:
            values = listed.pop(0)
            if not self._is_like_earlier(values):
                return values
        return None

    def _alternatives(self, best: Trial) -> list[dict[str, float]]:
        """List the run with one literal changed, the most promising changes first."""
        assert best.boxes is not None
        node = self._node(best)
        options: list[tuple[float, dict[str, float]]] = []
        lines: set[int] = set()
        for row in best.violations:
            places = self.rules.places(row.parts)
            item = _Item(row.amount, "rest", tuple(places), None, row.key)
            for key, slope in self.slopes.items():
                if not slope[places].any():
                    continue
                literal = self.rows[key]
                lines.add(literal.line)
                here = best.values.get(key, literal.value)
                steps = [self.widths[key] * share for share in LADDER]
                steps += list(self._steps(node, item, slope, self.widths[key]))
                values = sorted(
                    {value for step in steps for value in rounded(here, here + step, literal.value)[:1]}
                )
                for value, cost in zip(values, self._costs(node, key, np.array(values), None), strict=True):
                    options.append(
                        (float(cost) - ALL * row.amount / self.first, self._with(best, key, value))
                    )
        about = {
            word.lower()
            for row in best.violations
            for part in row.parts
            for word in re.findall(r"[A-Za-z]{3,}", part)
        }
        replacements: list[tuple[float, dict[str, float]]] = []
        for key, literal in self.rows.items():
            here = best.values.get(key, literal.value)
            named = any(
                word in name.lower() or name.lower() in about for word in about for name in literal.names
            )
            far = min((abs(literal.line - line) for line in lines), default=0)
            if literal.kind == "word":
                replacements += [
                    (far - (1000 if named else 0), self._with(best, key, float(number)))
                    for number in range(len(literal.words))
                    if number != here
                ]
            elif literal.kind == "count":
                replacements += [(500 + far, self._with(best, key, here + step)) for step in (-1, 1)]
        numbers = [entry for _, entry in sorted(options, key=lambda option: option[0])[:NUMBERS]]
        words = [entry for _, entry in sorted(replacements, key=lambda option: option[0])[:WORDS]]
        # A word for each number.
        return [option for option in chain.from_iterable(zip_longest(words, numbers)) if option is not None]

    def contrast(self) -> None:
        """Run the script so that each violation that is left ends, whatever else is violated then."""
        best = self.best
        for row in best.violations[:SHOWN]:
            places = self.rules.places(row.parts)
            if self.left < 1 or not row.parts or not places:
                continue
            if any(row.key not in trial.broken for trial in self.sound[1:]):
                continue
            kind = "alone" if len(places) == 1 else "pair"
            item = _Item(row.amount, kind, tuple(places))
            node = self._node(best)
            for _ in range(SHOWN):
                children = [
                    self._child(node, key, node.values.get(key, self.rows[key].value) + step, None)
                    for key, slope in self.slopes.items()
                    if slope[places].any()
                    for step in self._steps(node, item, slope, self.widths[key])
                ]
                if not children or self._remainder(node, kind, places) <= 0.0:
                    break
                node = min(children, key=lambda child: (self._remainder(child, kind, places), child.cost))
            if self._remainder(node, kind, places) <= 0.0:
                self.tell(self.evaluate([node.values])[0])

    @staticmethod
    def _remainder(node: _Node, kind: str, places: Sequence[int]) -> float:
        """Return what one violation costs in a predicted run."""
        return float(node.alone[places[0]] if kind == "alone" else node.pairs[places[0], places[-1]])

    @property
    def sound(self) -> list[Trial]:
        """The runs that did not fail, and that change nothing that has to stay; not those for derivatives."""
        return [trial for trial in self.trials if trial.boxes is not None and math.isfinite(trial.cost)]

    def _with(self, trial: Trial, key: str, value: float) -> dict[str, float]:
        """Return the numbers of a run with another value of one literal."""
        values = {**trial.values, key: float(value)}
        if value == self.rows[key].value:
            del values[key]
        return values

    def _node(self, start: Trial) -> _Node:
        """Return what is predicted for a run that is known."""
        assert start.boxes is not None
        rules, every = self.rules, np.arange(len(self.rules.names))
        pairs, alone, rooms = (
            rules.pairs(start.boxes, start.boxes, every),
            rules.alone(start.boxes),
            rules.rooms(start.boxes),
        )
        rest = {}
        self.trends = {}
        zones = list(rules.zones)
        for row in start.violations:
            places = rules.places(row.parts)
            is_known = (len(places) == 1 and alone[places[0]] > 0) or (
                len(places) == 2
                and (
                    pairs[places[0], places[1]] > 0
                    or any(
                        zone == (row.requirement, places[0]) and rooms[number, places[1]] > 0
                        for number, zone in enumerate(zones)
                    )
                )
            )
            if not is_known or not row.parts or row.requirement in self.unruled:
                rest[row.key] = row.amount
                self.hopes.setdefault(row.key, HOPE)
                trend = self._trend(row.key)
                if trend is not None:
                    self.trends[row.key] = trend
        node = _Node(dict(start.values), start.boxes, pairs, alone, rooms, rest)
        node.cost = self._cost(node)
        return node

    def plan(self, start: Trial) -> list[_Node]:
        """Return predicted runs, by a beam of changes from a run."""
        node = self._node(start)
        nodes: list[_Node] = []
        beam = [node]
        known = {tuple(sorted(node.values.items()))}
        lowest, level = node.cost, 0
        for depth in range(DEPTH):
            children: list[tuple[float, _Node, str, float, Eased]] = []
            for parent in beam:
                children += self._children(parent, ATTENDED if depth == 0 else 0)
            children.sort(key=lambda child: child[0])
            beam = []
            for _, parent, key, value, eased in children:
                child = self._child(parent, key, value, eased)
                name = tuple(sorted(child.values.items()))
                if name in known:
                    continue
                known.add(name)
                beam.append(child)
                nodes.append(child)
                if len(beam) == BEAM:
                    break
            if not beam:
                break
            level = 0 if min(child.cost for child in beam) < lowest else level + 1
            lowest = min(lowest, *(child.cost for child in beam))
            if level == 2:
                break
        # What is predicted of the run that is known, and what is known, differ: so, about, do the others.
        for child in nodes:
            child.cost += start.cost - node.cost
        return nodes

    def _items(self, node: _Node, hopes: int) -> list[_Item]:
        """Return the predicted violations, the largest first, and those that nothing explains."""
        items = [
            _Item(node.pairs[a, b], "pair", (int(a), int(b))) for a, b in np.argwhere(np.triu(node.pairs) > 0)
        ]
        zones = list(self.rules.zones.items())
        items += [
            _Item(node.rooms[n, b], "room", (zones[n][0][1], int(b)), zones[n][1])
            for n, b in np.argwhere(node.rooms > 0)
        ]
        items += [_Item(node.alone[n], "alone", (int(n),)) for n in np.flatnonzero(node.alone > 0)]
        items.sort(key=lambda item: -item.cost)
        rest = [
            _Item(amount, "rest", tuple(self.rules.places(key[1])), None, key)
            for key, amount in node.rest.items()
            if amount > 0
        ]
        rest.sort(key=lambda item: -item.cost)
        known = [item for item in rest if item.key in self.trends]
        return items[:ATTENDED] + known[:2] + [item for item in rest if item.key not in self.trends][:hopes]

    def _children(self, node: _Node, hopes: int) -> list[tuple[float, _Node, str, float, Eased]]:
        out: list[tuple[float, _Node, str, float, Eased]] = []
        candidates: dict[tuple[str, Eased], set[float]] = {}
        for item in self._items(node, hopes):
            parts = list(item.parts)
            movers = sorted(
                (len(self.moved[key]), key) for key, mask in self.masks.items() if mask[parts].any()
            )
            for _, key in movers[:TRIED]:
                row, here = self.rows[key], node.values.get(key, self.rows[key].value)
                eased = None
                if item.key is not None:
                    eased = (item.key, self.hopes[item.key])
                steps = [
                    (step, eased) for step in self._steps(node, item, self.slopes[key], self.widths[key])
                ]
                if item.key is not None and item.key not in self.trends:
                    # Without a reason, there is less hope.
                    less = (item.key, 0.5 * self.hopes[item.key])
                    steps += [(-self.widths[key], less), (self.widths[key], less)]
                for step, eased in steps:
                    value = here + step
                    spelled = {*rounded(here, value, row.value), coarse(row, here, value)} - {here}
                    candidates.setdefault((key, eased), set()).update(spelled)
                if here != row.value:
                    candidates.setdefault((key, None), set()).add(row.value)
        for key in node.values:
            candidates.setdefault((key, None), set()).add(self.rows[key].value)
        for (key, eased), values in candidates.items():
            if key not in self.slopes:
                continue
            reach = self.reach.get(key, math.inf)
            options = np.array(
                sorted(value for value in values if abs(value - self.rows[key].value) <= reach)
            )
            if not len(options):
                continue
            costs = self._costs(node, key, options, eased)
            order = np.argsort(costs)[: 2 * BEAM]
            out += [(float(costs[k]), node, key, float(options[k]), eased) for k in order]
        return out

    def _steps(self, node: _Node, item: _Item, slope: Array, width: float) -> Iterator[float]:
        """Return changes of a number that are as large as an item needs."""
        reach = 1.5 * self.rules.size / float(np.abs(slope).max())
        steps: list[float] = []
        if item.kind in ("pair", "room"):
            a, b = item.parts
            wide = np.zeros(3) if item.wide is None else item.wide
            low, high = node.boxes[a, 0] - wide, node.boxes[a, 1] + wide
            for axis in range(3):
                above, below = slope[a, 0, axis] - slope[b, 1, axis], slope[b, 0, axis] - slope[a, 1, axis]
                if above:
                    steps.append((node.boxes[b, 1, axis] - low[axis]) / above)
                if below:
                    steps.append((high[axis] - node.boxes[b, 0, axis]) / below)
        elif item.kind == "alone":
            (a,) = item.parts
            for axis in range(3):
                low, high = node.boxes[a, :, axis]
                if low < self.rules.room[0, axis] and slope[a, 0, axis]:
                    steps.append((self.rules.room[0, axis] - low) / slope[a, 0, axis])
                if high > self.rules.room[1, axis] and slope[a, 1, axis]:
                    steps.append((self.rules.room[1, axis] - high) / slope[a, 1, axis])
            steps += self._standing(node, a, slope)
        else:
            for a in item.parts:
                if len(item.parts) > 2 and not slope[a].any():
                    continue
                steps += self._standing(node, a, slope)
                target = None if self.form is None else self.form.target
                for room in [self.rules.room, *([] if target is None else [target.bounds])]:
                    off = room - node.boxes[a]
                    steps += list(off[slope[a] != 0.0] / slope[a][slope[a] != 0.0])
                trend = None if item.key is None else self.trends.get(item.key)
                if trend is not None and item.key is not None:
                    here = self._place(node.boxes, item.key)
                    along = self._place(slope, item.key)
                    assert here is not None and along is not None
                    falls = float(along @ trend[2])
                    if falls:
                        steps.append(-(trend[1] + float((here - trend[0]) @ trend[2])) / falls)
                    continue
                # An amount may be a distance, in the unit of overlaps.
                far = item.cost / self.rules.scale
                for along in (*slope[a, 0], *(slope[a, 1] - slope[a, 0])):
                    if along:
                        steps += [far / along, -far / along]
        yield from (step for step in steps if 0.0 < abs(step) <= reach)

    def _standing(self, node: _Node, part: int, slope: Array) -> Iterator[float]:
        """Return changes that put a part back on what it stood on, or on the nearest part below."""
        up = self.rules.up
        support = int(self.rules.support[part])
        if support >= 0:
            # Its place on the support, as at first.
            base = self.rules.base
            for axis in range(3):
                relative = slope[part, 0, axis] - slope[support, 0, axis]
                if relative:
                    at = base[part, 0, axis] - base[support, 0, axis]
                    yield (at - (node.boxes[part, 0, axis] - node.boxes[support, 0, axis])) / relative
        bottom = node.boxes[part, 0, up]
        level = np.abs(node.boxes[:, 1, up] - bottom) <= 10 * self.rules.touch
        level[part] = False
        for other in np.flatnonzero(level)[:TRIED]:
            # Above the middle of what is as high as its lowest point, or just above its edge.
            for axis in (axis for axis in range(3) if axis != up):
                relative = slope[part].mean(axis=0)[axis] - slope[other].mean(axis=0)[axis]
                low, high = node.boxes[other, :, axis]
                at = float(node.boxes[part].mean(axis=0)[axis])
                if relative:
                    inside = min(max(at, low + 0.1 * (high - low)), high - 0.1 * (high - low))
                    yield (inside - at) / relative
        if not slope[part, 0, up]:
            return
        yield (self.rules.base[:, 0, up].min() - bottom) / slope[part, 0, up]
        flat = [axis for axis in range(3) if axis != up]
        middle = node.boxes[part].mean(axis=0)[flat]
        under = ((middle >= node.boxes[:, 0, flat]) & (middle <= node.boxes[:, 1, flat])).all(axis=1)
        under[part] = False
        for top in sorted(set(node.boxes[under, 1, up]), key=lambda top: abs(top - bottom))[:2]:
            yield (float(top) - bottom) / slope[part, 0, up]

    def _costs(
        self,
        node: _Node,
        key: str,
        values: Array,
        eased: Eased,
    ) -> Array:
        """Return the predicted costs of values of one number."""
        rules, slope = self.rules, self.slopes[key]
        here = node.values.get(key, self.rows[key].value)
        boxes = node.boxes[None] + (values - here)[:, None, None, None] * slope[None]
        touched = self.moved[key]
        rows = rules.pairs(boxes[:, touched], boxes, touched)
        among = rows[:, :, touched]
        old = node.pairs[touched]
        total = 0.5 * node.pairs.sum()
        total = (
            total
            - old.sum()
            + 0.5 * old[:, touched].sum()
            + rows.sum(axis=(1, 2))
            - 0.5 * among.sum(axis=(1, 2))
        )
        number = 0.5 * (node.pairs > 0).sum() - (old > 0).sum() + 0.5 * (old[:, touched] > 0).sum()
        number = number + (rows > 0).sum(axis=(1, 2)) - 0.5 * (among > 0).sum(axis=(1, 2))
        alone, rooms = rules.alone(boxes), rules.rooms(boxes)
        total = np.maximum(total, 0.0) + alone.sum(axis=1) + rooms.sum(axis=(1, 2))
        number = number + (alone > 0).sum(axis=1) + (rooms > 0).sum(axis=(1, 2))
        for amount in self._rest(node, boxes, eased).values():
            total, number = total + amount, number + (amount > 0)
        # Differences of sums round.
        total = np.where(total < 1e-9 * self.first, 0.0, total)
        rest = {name: value for name, value in node.values.items() if name != key}
        changed = len(rest) + (values != self.rows[key].value)
        fixed = sum(
            ((value - self.rows[name].value) / self.widths[name]) ** 2 for name, value in rest.items()
        )
        wide = fixed + ((values - self.rows[key].value) / self.widths[key]) ** 2
        before = sum(further(self.rows[name], value) for name, value in rest.items())
        digits = before + np.array([further(self.rows[key], float(value)) for value in values])
        change = NUMBER * changed + FAR * self._far(boxes) + WIDE * wide + DIGIT * digits
        return np.asarray(ALL * total / self.first + EACH * number + _limited(change))

    def _rest(
        self,
        node: _Node,
        boxes: Array,
        eased: Eased,
    ) -> dict[Key, Array]:
        """Return what is left of violations that no rule explains, by their trends, or by hope."""
        out: dict[Key, Array] = {}
        names = {name for name, _ in node.rest} & self.predicted
        judged = [self._judged(entry, names) for entry in boxes] if names else []
        for key, amount in node.rest.items():
            if key[0] in names:
                out[key] = np.array([row.get(key, 0.0) for row in judged])
                continue
            trend = self.trends.get(key)
            if trend is not None:
                place = self._place(boxes, key)
                assert place is not None
                there = trend[1] + (place - trend[0]) @ trend[2]
                # Where amounts are whole, the last of them may be 0.
                out[key] = np.where(there > 0.01 * trend[1], there, 0.0)
            else:
                out[key] = np.full(
                    len(boxes), amount * (1.0 - eased[1] if eased and eased[0] == key else 1.0)
                )
        return out

    def _judged(self, boxes: Array, names: Collection[str]) -> Mapping[Key, float]:
        """Return what predicted boxes violate of requirements."""
        assert self.keep is not None and self.form is not None
        return {row.key: row.amount for row in self.keep.violations(self.form.moved(boxes), names)}

    def _child(
        self,
        node: _Node,
        key: str,
        value: float,
        eased: Eased,
    ) -> _Node:
        rules, every = self.rules, np.arange(len(self.rules.names))
        here = node.values.get(key, self.rows[key].value)
        boxes = node.boxes + (value - here) * self.slopes[key]
        values = {**node.values, key: float(value)}
        if value == self.rows[key].value:
            del values[key]
        rest = {name: float(amount[0]) for name, amount in self._rest(node, boxes[None], eased).items()}
        child = _Node(
            values, boxes, rules.pairs(boxes, boxes, every), rules.alone(boxes), rules.rooms(boxes), rest
        )
        child.cost = self._cost(child)
        return child

    def _cost(self, node: _Node) -> float:
        total = 0.5 * node.pairs.sum() + node.alone.sum() + node.rooms.sum() + sum(node.rest.values())
        number = 0.5 * (node.pairs > 0).sum() + (node.alone > 0).sum() + (node.rooms > 0).sum()
        number += sum(amount > 0 for amount in node.rest.values())
        return float(ALL * total / self.first + EACH * number) + self.change(node.values, node.boxes)

    def change(self, values: Mapping[str, float], boxes: Array) -> float:
        """Return the cost of the change alone: numbers, moves, and widths."""
        wide = sum(((value - self.rows[key].value) / self.widths[key]) ** 2 for key, value in values.items())
        digits = sum(further(self.rows[key], value) for key, value in values.items())
        far = float(self._far(boxes[None])[0])
        return float(_limited(NUMBER * len(values) + FAR * far + WIDE * wide + DIGIT * digits))

    def _far(self, boxes: Array) -> NDArray[np.float64]:
        """Return how far the parts moved: see `prediction.moved`."""
        assert self.base.boxes is not None
        far = np.linalg.norm(boxes - self.base.boxes, axis=-1).max(axis=-1)
        return np.asarray(far @ self.volumes / max(float(self.volumes.sum()) * self.rules.size, 1e-300))


def _limited(change: Any) -> Any:
    """Return the cost of a change, below that of all that is violated at first: a repair is worth any change."""
    return ALL * -np.expm1(-np.asarray(change) / ALL)


def _middles(boxes: Array) -> Array:
    """Return the middles and the halves of boxes, in place of their corners: fewer numbers decide each of them."""
    return np.stack([boxes.mean(axis=1), 0.5 * (boxes[:, 1] - boxes[:, 0])], axis=1)
