"""Answers of a search: its best run, a table, variants, how sure a parameter is, and which parameter moves what.

All of them come from the evaluations that were made. None calls the model.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from niwaki import fitting
from niwaki.batches import tables
from niwaki.errors import InputError
from niwaki.errors.settings import bad, count, real
from niwaki.fitting.goals import Outcome
from niwaki.once import cached_property
from niwaki.search.space import Axis
from niwaki.targets.differences import VolumeDifferences

if TYPE_CHECKING:
    from PIL.Image import Image

    from niwaki.fitting.loop import FitLoop

#: The power of the likelihood where it cannot be calibrated: it covered 90 % in an experiment with known answers.
FALLBACK = 0.3

#: Powers that are tried, the sharpest first, each with what is known beforehand: how many standard deviations of its
#: posterior are one of the truth.
POWERS = {1.0: 0.7, 0.6: 0.875, 0.3: 1.065, 0.15: 1.25}

#: Chains and their steps.
LONG = (40, 600)

#: Evaluations that serve as pseudo-targets, the fewest that calibrate, and the chains and steps for each.
PSEUDO, FEWEST, SHORT = 16, 8, (16, 160)

#: Known parameters that the knowledge beforehand counts for, and that each parameter counts for, however many
#: pseudo-targets have it: these lie together.
BEFORE, EACH = 16.0, 2.0

#: A parameter whose interval is wider than this share of an interval without any data is not identified.
VAGUE = 0.8


@dataclass(frozen=True)
class Answer:
    """One evaluation that gave a scene.

    Attributes
    ----------
    number : int
        Its place in the order of asking.
    parameters : dict
        The values of the parameters that it used, by name.
    log_score : float
        The log score, nats.
    covered, outside : float or None
        The fit to the first target.
    numbers : dict
        Measures of the sketches, and the numbers of the goal.
    """

    number: int
    parameters: dict[str, Any]
    log_score: float
    covered: float | None
    outside: float | None
    numbers: dict[str, float]

    @property
    def iou(self) -> float | None:
        """The volume that scene and target share over the volume of both together; None without a target."""
        if self.covered is None or self.outside is None:
            return None
        # With a target of volume 1 the scene shares `covered` with it, and has `covered / (1 - outside)`.
        if self.outside >= 1.0 or self.covered == 0.0:
            return 0.0
        return self.covered / (1.0 + self.covered / (1.0 - self.outside) - self.covered)


@dataclass(frozen=True)
class Interval:
    """How sure a parameter is.

    Attributes
    ----------
    name : str
        The parameter.
    share : float
        The share of the posterior that the interval holds.
    low, high : float or None
        The ends; None for a parameter with levels.
    levels : dict or None
        The probabilities of the levels, calibrated by evaluations with known levels; None for a real number, and where
        too few evaluations calibrate them.
    used : float
        The probability that the parameter is used.
    identified : bool
        Whether the goal says something about the parameter.
    power : float
        The power of the likelihood.
    covered : float or None
        The share of known parameters that such intervals cover, by which the power was chosen; None if it is the
        default power, because too few evaluations are near the best.
    """

    name: str
    share: float
    low: float | None
    high: float | None
    levels: dict[Any, float] | None
    used: float
    identified: bool
    power: float
    covered: float | None

    def __str__(self) -> str:
        if not self.identified:
            return f"{self.name}: the goal does not tell"
        if self.low is None and self.levels is None:
            return f"{self.name}: too few evaluations to tell how probable its values are"
        if self.levels is not None:
            return f"{self.name}: " + ", ".join(f"{level} {p:.0%}" for level, p in self.levels.items())
        return f"{self.name}: {self.low:.4g} to {self.high:.4g} ({self.share:.0%})"


@dataclass(frozen=True)
class Effect:
    """The effect of a parameter: what it moves.

    Attributes
    ----------
    name : str
        The parameter.
    size : float
        The length of the change of all differences, when the parameter moves by a tenth of its range or to its next
        level.
    blocks : (x, y, z) float64 or None
        The cells that each block of the target's grid gains, below 0 for those that it loses; None without a target
        volume.
    values : tuple
        The values between which the parameter moves, the lower one first.
    """

    name: str
    size: float
    blocks: NDArray[np.float64] | None
    values: tuple[Any, Any]

    def __str__(self) -> str:
        low, high = (f"{value:.3g}" if isinstance(value, float) else str(value) for value in self.values)
        return f"{self.name}: {low} to {high}"


class Answers(Sequence[Answer]):
    """The evaluations of a search that gave scenes, best first, and what they say.

    Parameters
    ----------
    loop
        The search; its evaluations so far are read when an answer is first asked for.
    """

    def __init__(self, loop: FitLoop) -> None:
        self._loop = loop
        self.space, self.goal = loop.space, loop.goal
        seen = [
            Answer(
                point.number,
                dict(point.parameters),
                outcome.score,
                outcome.covered,
                outcome.outside,
                dict(outcome.numbers),
            )
            for point, outcome in zip(loop.points, loop.outcomes, strict=False)
            if isinstance(outcome, Outcome)
        ]
        self._seen = sorted(seen, key=lambda answer: (-answer.log_score, answer.number))

    def __len__(self) -> int:
        return len(self._seen)

    def __iter__(self) -> Iterator[Answer]:
        return iter(self._seen)

    def __getitem__(self, index: Any) -> Any:
        return self._seen[index]

    @property
    def best(self) -> Answer:
        """The evaluation with the highest score; the earlier one of two equal ones."""
        if not self._seen:
            raise InputError("no-runs")
        return self._seen[0]

    def table(self, path: str | PathLike[str] | None = None) -> list[dict[str, Any]]:
        """Return a row for each evaluation, in the order of asking; None for what it lacks.

        The columns are the number, the parameters, the score, the fit, the numbers and the text of a failure.

        Parameters
        ----------
        path
            A file to write, too: .csv or .parquet.
        """
        numbers = sorted({name for answer in self._seen for name in answer.numbers})
        columns = {"number", *self.space.names, "log_score", "covered", "outside", "iou", "failure"}
        by_number = {answer.number: answer for answer in self._seen}
        rows = []
        for point, outcome in zip(self._loop.points, self._loop.outcomes, strict=False):
            answer = by_number.get(point.number)
            row: dict[str, Any] = {"number": point.number}
            row |= {name: point.parameters.get(name) for name in self.space.names}
            for name in ("log_score", "covered", "outside", "iou"):
                row[name] = None if answer is None else getattr(answer, name)
            row |= {
                name: None if answer is None else answer.numbers.get(name)
                for name in numbers
                if name not in columns
            }
            row["failure"] = None if isinstance(outcome, Outcome) else outcome.text
            rows.append(row)
        if path is not None:
            write_rows(Path(path), rows)
        return rows

    def variants(self, count_: int = 10, loss: float = 3.0) -> list[Answer]:
        """Return different good evaluations: the best of each kind, then those farthest from all chosen ones.

        A kind is a set of whole numbers, switches and choices. Distances are those of the unit cube.

        Parameters
        ----------
        count_
            The most variants.
        loss
            How much lower than the best a score may be, nats.
        """
        most, least = count("count", count_), self.best.log_score - real("loss", loss, 0, ends="[)")
        good = [answer for answer in self._seen if answer.log_score >= least]
        rows = np.array([self._loop.points[answer.number].row for answer in good])
        kinds: dict[tuple[Any, ...], int] = {}
        for place, answer in enumerate(good):
            kinds.setdefault(self._kind(answer), place)
        chosen = list(kinds.values())[:most]
        while len(chosen) < min(most, len(good)):
            far = np.min(((rows[:, None] - rows[chosen][None]) ** 2).sum(2), axis=1)
            far[chosen] = -1.0
            if far.max() <= 0.0:
                break
            chosen.append(int(np.argmax(far)))
        return [good[place] for place in chosen]

    def interval(self, name: str, share: float = 0.9) -> Interval:
        """Return how sure a parameter is, by the emulator of the search.

        The likelihood of the target is raised to a power. Evaluations near the best serve as targets whose parameters
        are known: the power is the sharpest whose intervals cover the share of these parameters.

        Parameters
        ----------
        name
            The parameter.
        share
            The share of the posterior that the interval holds.
        """
        axis, number = self.space.axis(name), self.space.names.index(name)
        real("share", share, 0, 1)
        power, covered, doubt = self._calibrated(share)
        rows, used = self._posterior(power)
        on = used[:, number]
        probability = float(on.mean())
        places = rows[on, number]
        if axis.range is not None:
            if not len(places):
                return Interval(name, share, None, None, None, 0.0, False, power, covered)
            low, high = _ends(places, share)
            return Interval(
                name,
                share,
                axis.value(low),
                axis.value(high),
                None,
                probability,
                high - low < VAGUE * share and self._tells(number),
                power,
                covered,
            )
        if doubt is None:
            # Shares of chains that nothing calibrates would only look like probabilities.
            return Interval(name, share, None, None, None, probability, self._tells(number), power, covered)
        shares = dict.fromkeys(axis.values, 0.0)
        for place in places:
            shares[axis.value(float(place))] += (1.0 - doubt) / len(places)
        for value, before in _shares_beforehand(axis).items():
            shares[value] += (doubt if len(places) else 1.0) * before
        is_certain = max(shares.values(), default=0.0) > 1.0 / max(len(shares), 1) + 0.1
        is_told = is_certain and self._tells(number)
        return Interval(name, share, None, None, shares, probability, is_told, power, covered)

    def _tells(self, number: int) -> bool:
        """Whether some value of a parameter makes the best evaluation worse by more than the emulator doubts."""
        best = list(self._loop.points[self.best.number].row)
        levels = len(self.space.axes[number].values) or 9
        places = (np.arange(levels) + 0.5) / levels
        rows = np.array(
            [self._loop.proposer.snap([*best[:number], place, *best[number + 1 :]])[0] for place in places]
        )
        means, left = self._loop.proposer.predict(rows)
        lengths = np.sqrt((means**2).sum(1))
        doubts = np.sqrt(left * sum(self._loop.proposer.variances()))
        return bool((lengths - lengths.min() > doubts).any())

    def sensitivity(self) -> list[Effect]:
        """Return what each parameter of the best evaluation moves, by the emulator, the strongest first.

        Parameters that the best evaluation does not use are left out.
        """
        self._check()
        best = self._loop.points[self.best.number]
        steps: list[tuple[Axis, list[float], list[list[float]]]] = []
        for k, axis in enumerate(self.space.axes):
            if not best.used[k]:
                continue
            if axis.range is not None:
                ends = [max(best.row[k] - 0.05, 0.0), min(best.row[k] + 0.05, 1.0)]
            else:
                levels = len(axis.values)
                level = min(int(best.row[k] * levels), levels - 1)
                if levels == 1:
                    continue
                other = level + 1 if level + 1 < levels else level - 1
                ends = [(number + 0.5) / levels for number in sorted((level, other))]
            pair = []
            for end in ends:
                row = list(best.row)
                row[k] = end
                pair.append(self._loop.proposer.snap(row)[0])
            steps.append((axis, ends, pair))
        rows = np.array([row for _, _, pair in steps for row in pair])
        means, _ = self._loop.proposer.predict(rows)
        changes = means[1::2] - means[0::2]
        blocks = self._blocks(changes)
        out = [
            Effect(
                axis.name,
                float(np.sqrt((changes[k] ** 2).sum())),
                None if blocks is None else blocks[k],
                (axis.value(ends[0]), axis.value(ends[1])),
            )
            for k, (axis, ends, _) in enumerate(steps)
        ]
        return sorted(out, key=lambda effect: -effect.size)

    def picture(self, size: int = 160) -> Image:
        """Draw the sensitivity: for each parameter a bar, and the parts that it moves, seen from the front."""
        volume = self._volume
        body = None if volume is None else volume.blocks()
        return fitting.effects.drawn(self.sensitivity(), body, size)

    @property
    def _volume(self) -> VolumeDifferences | None:
        return next((part for part in self.goal.parts if isinstance(part, VolumeDifferences)), None)

    def _kind(self, answer: Answer) -> tuple[Any, ...]:
        return tuple(answer.parameters.get(axis.name, ...) for axis in self.space.axes if axis.range is None)

    def _check(self) -> None:
        if len(self._seen) < 2:
            raise bad("the search", "asked this", "two evaluations with a scene", "more evaluations")

    @cached_property
    def _posteriors(self) -> dict[float, tuple[NDArray[np.float64], NDArray[np.bool_]]]:
        return {}

    def _posterior(self, power: float) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        self._check()
        if power not in self._posteriors:
            self._posteriors[power] = self._loop.proposer.posterior(power, self._loop.seed, *LONG)
        return self._posteriors[power]

    @cached_property
    def _calibrations(self) -> dict[float, Calibration]:
        return {}

    def _calibrated(self, share: float) -> Calibration:
        """The lesson of evaluations near the best, as targets with known parameters, about posteriors."""
        if share not in self._calibrations:
            self._calibrations[share] = self._calibrate(share)
        return self._calibrations[share]

    def _calibrate(self, share: float) -> Calibration:
        near = self._seen[: 3 * PSEUDO : 3] if len(self._seen) >= 3 * PSEUDO else self._seen[:PSEUDO]
        reals = [k for k, axis in enumerate(self.space.axes) if axis.range is not None]
        if len(near) < FEWEST or len(self._seen) < 5 * FEWEST:
            return Calibration(FALLBACK, None, None)
        bell = NormalDist()
        deviations = bell.inv_cdf(0.5 + 0.5 * share)
        last = Calibration(FALLBACK, None, None)
        for power, ratio in POWERS.items() if reals else [(FALLBACK, 1.0)]:
            inside = total = 0
            known: list[tuple[float, float]] = []
            for answer in near:
                point = self._loop.points[answer.number]
                rows, used = self._loop.proposer.posterior(
                    power, self._loop.seed + 1, SHORT[0], SHORT[1], answer.number
                )
                for k, axis in enumerate(self.space.axes):
                    if not point.used[k]:
                        continue
                    places = rows[used[:, k], k]
                    if axis.range is None:
                        share_of_truth = float((places == point.row[k]).mean()) if len(places) else 0.0
                        known.append((share_of_truth, _shares_beforehand(axis)[axis.value(point.row[k])]))
                    elif len(places):
                        low, high = _ends(places, share)
                        inside += low <= point.row[k] <= high
                        total += 1
            doubt = _doubt(known, len(near))
            if not total:
                return Calibration(FALLBACK, None, doubt)
            before = 2.0 * bell.cdf(ratio * deviations) - 1.0
            weight = EACH * len(reals)
            last = Calibration(power, inside / total, doubt)
            if weight * inside / total + BEFORE * before >= share * (weight + BEFORE):
                return last
        return last

    def _blocks(self, changes: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """The changes of the cells in blocks, from changes along the emulator's directions."""
        volume = self._volume
        if volume is None:
            return None
        start = self.goal.parts.index(volume)
        shape = tuple(len(cuts) for cuts in volume.cuts)
        # Directions are linear in the features: the map back is fitted to the best evaluations.
        near = [self._loop.points[answer.number] for answer in self._seen[:220]]
        along, _ = self._loop.proposer.predict(np.array([point.row for point in near]))
        offset = sum(self.goal.sizes[:start])
        wide = slice(offset, offset + int(np.prod(shape)))
        features = []
        for point in near:
            outcome = self._loop.outcomes[point.number]
            assert isinstance(outcome, Outcome)
            features.append(outcome.features[wide].astype(np.float64))
        back, *_ = np.linalg.lstsq(along, np.array(features), rcond=1e-6)
        scale = volume.unit * volume.weight
        return (changes @ back / scale).reshape(len(changes), *shape)


class Calibration(NamedTuple):
    """The lesson of known parameters about posteriors.

    Attributes
    ----------
    power : float
        The power of the likelihood.
    covered : float or None
        The share of the known real numbers that intervals cover with it.
    doubt : float or None
        The share of what is known beforehand in the probabilities of levels; None for too few known levels.
    """

    power: float
    covered: float | None
    doubt: float | None


def _shares_beforehand(axis: Axis) -> dict[Any, float]:
    """The probabilities of the levels of a parameter by its range."""
    weights = axis.weights or (1.0,) * len(axis.values)
    return {value: weight / sum(weights) for value, weight in zip(axis.values, weights, strict=True)}


def _doubt(known: Sequence[tuple[float, float]], count: int) -> float | None:
    """The share of what is known beforehand that makes probabilities of levels true: its mean, by known levels.

    Chains change their levels seldom, so that their shares are too sure. The known levels of one target are not
    independent: together they count as often as there are targets. Without any the probabilities are withheld.

    Parameters
    ----------
    known
        For each known level, its share of the chains, and its probability beforehand.
    count
        The number of targets.
    """
    if len(known) < FEWEST:
        return None
    shares, before = np.array(known).T
    doubts = np.linspace(0.005, 0.995, 100)
    logs = np.log(doubts[:, None] * before + (1.0 - doubts[:, None]) * shares).sum(1) * count / len(known)
    weights = np.exp(logs - logs.max())
    return float((doubts * weights).sum() / weights.sum())


def _ends(places: NDArray[np.float64], share: float) -> tuple[float, float]:
    low, high = np.quantile(places, [0.5 - 0.5 * share, 0.5 + 0.5 * share])
    return float(low), float(high)


def write_rows(place: Path, rows: list[dict[str, Any]]) -> None:
    """Write the rows of a table, which have the same names, as .csv or .parquet."""
    names = list(rows[0]) if rows else ["number"]
    tables.write(place, {name: tables.kind(row[name] for row in rows) for name in names}, rows)
