"""Results of searches: samples, each with its scene, choices and scores, and the statistics of the search."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from itertools import accumulate, pairwise
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine, draw, targets
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.lang import lookup
from niwaki.lang.compiled import LOOSEN
from niwaki.lang.models import Model
from niwaki.methods import Improve, Method, Mh, at_least_one
from niwaki.once import cached_property
from niwaki.result import diagnostics
from niwaki.result.info import EnumerationInfo, Info
from niwaki.result.invalid import Invalid
from niwaki.result.progress import Watch
from niwaki.result.sample import Sample
from niwaki.result.search_like import SearchLike
from niwaki.targets.sketches import Score, View


class Result(Sequence[Sample]):
    """Result of a search; a sequence of its samples.

    The statistics of the method are in `info`, and are also attributes of the result: `result.acceptance` and
    `result.bests` after `mh(...)`, `result.step_size` after `nuts(...)`.

    Attributes
    ----------
    search : Search
        The search.
    method : Method
        The method of the search, or of its polishing.
    samples : sequence of Sample
        Of `grow`: the best of each run. Of `smc`: the particles. Of chains: the states, chain by chain. Else: the runs.
    sizes : list of int
        The number of samples of each chain; one number for methods without chains.
    seed : int
        The seed of the (first) search.
    info : Info
        The statistics of the method: see `niwaki.result.info`.
    interrupted : bool
        Whether the search was stopped before its end.
    seconds, cpu_seconds : float
        Wall and processor time of the search alone.
    invalid : tuple of Invalid
        Invalid runs, proposals and points of trajectories, by place: their number, and the call of one of them.
    """

    def __init__(
        self,
        search: SearchLike,
        samples: Sequence[Sample],
        seed: int,
        *,
        method: Method | None = None,
        info: Info = Info(),  # noqa: B008
        sizes: Sequence[int] | None = None,
        interrupted: bool = False,
        invalid: Iterable[Invalid] = (),
        seconds: tuple[float, float] | None = None,
    ) -> None:
        self.search, self.samples, self.seed, self.info = search, samples, seed, info
        self.method: Method = method or search.method
        self.sizes = [len(samples)] if sizes is None else list(sizes)
        self.interrupted = interrupted
        self.invalid: tuple[Invalid, ...] = tuple(invalid)
        if seconds is None:
            seconds = sum(sample.seconds for sample in samples), sum(sample.cpu_seconds for sample in samples)
        self.seconds, self.cpu_seconds = seconds

    def __getattr__(self, name: str) -> Any:
        """Read an attribute of `info`."""
        if name == "info" or name.startswith("_"):
            raise AttributeError(name)
        try:
            return getattr(self.info, name)
        except AttributeError as error:
            raise AttributeError(f"a result of `{self.method.NAME}` has no `{name}`") from error

    def to_its_end(self) -> Result:
        """Return the result itself if the search was not interrupted; for code that needs a complete search.

        Raises
        ------
        KeyboardInterrupt
            Ctrl-C stopped the search.
        """
        if self.interrupted:
            raise KeyboardInterrupt
        return self

    @property
    def model(self) -> Model[..., Any]:
        """The model of the search."""
        return self.search.model

    @property
    def score(self) -> Score:
        """The sketches that score its scene."""
        return self.search.score

    @property
    def log_evidence(self) -> float | None:
        """Log of the model's total probability, nats; None for methods without an estimate.

        The evidence is a mean over runs, in which invalid runs count as zeros; `invalid` has their number.
        """
        return self.info.log_evidence

    def __len__(self) -> int:
        return len(self.samples)

    def __iter__(self) -> Iterator[Sample]:
        return iter(self.samples)

    @property
    def by_chain(self) -> list[Sequence[Sample]]:
        """The samples of each chain; one sequence for methods without chains."""
        ends = [0, *accumulate(self.sizes)]
        return [self.samples[a:b] for a, b in pairwise(ends)]

    @property
    def draws(self) -> dict[str, NDArray[Any]]:
        """Values of choices by address, (chains, draws) or (chains, draws, n) for lists of n numbers.

        The choices are those that every sample has, with values that are numbers (for chains that follow a gradient,
        the continuous choices). The number of draws is that of the shortest chain. Weights are not among the draws:
        see `weights`.
        """
        draws = self.info._draws()
        if draws is not None:
            return draws
        least = min(self.sizes, default=0)
        return diagnostics.together([_columns(chain[:least]) for chain in self.by_chain])

    def to_arviz(self) -> Any:
        """Convert the draws for ArviZ, with the samples' statistics: a `DataTree` (1.x) or an `InferenceData` (before).

        Raises
        ------
        FileError
            ArviZ is not installed.
        """
        statistics = self.info._statistics()
        if statistics is not None:
            return diagnostics.to_arviz(self.draws, statistics)
        numbers = {"lp": self._numbers("log_joint"), "log_weight": self._numbers("log_weight")}
        return diagnostics.to_arviz(self.draws, numbers)

    def summary(self) -> diagnostics.Summaries:
        """Summarise the draws: mean, deviation, standard error, effective sizes and R-hat of every number.

        After `hmc` and `nuts` the summary also has the log density over coordinates, and the divergences.

        Raises
        ------
        InputError
            The samples have different weights.
        """
        summary = self.info._summary()
        if summary is not None:
            return summary
        if len(set(self._log_weights())) > 1:
            raise bad(
                "method",
                self.method,
                "samples of equal weight",
                "`mh(...)`, or weigh `draws` by `weights`",
            )
        return diagnostics.summarise(self.draws)

    def _numbers(self, name: str) -> NDArray[np.float64]:
        """A number of each sample, (chains, samples of the shortest chain)."""
        least = min(self.sizes, default=0)
        rows = [[getattr(sample, name) for sample in chain[:least]] for chain in self.by_chain]
        return np.array(rows, dtype=np.float64)

    @property
    def trace(self) -> NDArray[np.float64]:
        """Log scores of the samples, (chains, samples of the shortest chain), nats."""
        return self._numbers("log_score")

    def __getitem__(self, index: Any) -> Any:
        return self.samples[index]

    @property
    def best(self) -> Sample:
        """The sample with the best log score; runs that ended come first. For `mh`, any state that a chain reached."""
        pool: Sequence[Sample] = self.info._pool(self.samples)
        if not len(pool):
            raise InputError("no-runs", detail=repr(self))
        possible = [s for s in pool if s.has_ended and s.log_score > -math.inf]
        return max(possible or pool, key=lambda sample: sample.log_score)

    def more(self, steps: int) -> Result:
        """Continue the chains of `mh` from their present states; the samples are added to this result.

        A checkpoint of the search is written, too.

        Parameters
        ----------
        steps
            The number of further proposals in each chain.
        """
        at_least_one("steps", steps)
        self.info._go_on(self, steps)
        return self

    def polish(
        self,
        method: Mh | Improve,
        *,
        seed: int | None = None,
        threads: int | None = None,
        progress: Watch | None = None,
    ) -> Result:
        """Continue from the best sample by Markov chains, or by rounds of `improve`; their `best` is at least as good.

        Parameters
        ----------
        method
            `niwaki.mh(...)`: the number of proposals, and the kernel. Or `niwaki.improve(...)` for one result: its
            rounds begin from the sample, in place of a population.
        seed, threads, progress
            As for `niwaki.run`; the seed of this search when left out.

        Returns
        -------
        Result
            The result of the chains or rounds. Its seconds are those of this search and of theirs together.
        """
        return self.search.polished(self, method, seed=seed, threads=threads, progress=progress)

    def held(self, *patterns: str) -> dict[str, Any]:
        """List choices of the best sample with their values, to hold them in another search; see `Sample.held`."""
        return self.best.held(*patterns)

    def regrow(
        self,
        part: str,
        particles: int = 200,
        *,
        power: float | None = None,
        seed: int | None = None,
        threads: int | None = None,
    ) -> Result:
        """Grow one part of the best sample again, in place; see `Sample.regrow`."""
        return self.best.regrow(part, particles, power=power, seed=seed, threads=threads)

    @cached_property
    def unique_models(self) -> int:
        """The number of samples of which no two share more than half of their choices, as (address, value) pairs."""
        return _engine.unique_models([sample._run for sample in self.samples])

    @property
    def value(self) -> Any:
        """The value that the best sample returned."""
        return self.best.value

    @property
    def scene(self) -> Scene:
        """The scene of the best sample."""
        return self.best.scene

    @property
    def weights(self) -> NDArray[np.float64]:
        """The samples' weights, (n,), with the sum one; an error if every sample is impossible.

        Particles of several runs have no weights: a weight compares a particle only with its own population.
        """
        if self.search.runs > 1 and self.search.method.NAME == "smc":
            raise InputError("weights-of-runs", runs=self.search.runs)
        logs = self._log_weights()
        if len(logs) == 0:
            return logs
        if logs.max() == -math.inf:
            causes = Counter(sample.cause or "weights" for sample in self.samples)
            listed = ", ".join(f"{cause} ({count})" for cause, count in causes.most_common())
            raise InputError(
                "everything-impossible", barrier="the end", count=len(logs), constraint=listed, cure=LOOSEN
            )
        raw = np.exp(logs - logs.max())
        return np.asarray(raw / raw.sum())

    def _log_weights(self) -> NDArray[np.float64]:
        """Logs of the weights, (n,)."""
        logs = self.info._log_weights()
        if logs is not None:
            return logs
        return np.array([sample.log_weight for sample in self.samples], dtype=np.float64)

    def resampled(self, n: int, seed: int | None = None) -> list[Sample]:
        """Draw samples by their weights, by systematic resampling; the drawn samples have equal weights.

        Parameters
        ----------
        n
            The number of draws; a sample of a large weight is drawn several times.
        seed
            The seed of the draws; the seed of the search when left out.
        """
        at_least_one("n", n)
        first = np.random.default_rng(self.seed if seed is None else seed).random()
        ends = np.cumsum(self.weights)
        if not len(ends):
            raise InputError("no-runs", detail=repr(self))
        places = np.searchsorted(ends, (np.arange(n) + first) / n * ends[-1], side="right")
        return [self.samples[int(place)] for place in np.minimum(places, len(ends) - 1)]

    def distribution(self, choice: str | None = None) -> dict[Any, float]:
        """The probability of each value: exact for enumeration, else weighted shares of the samples.

        Parameters
        ----------
        choice
            The address of a choice, for the values of this choice, words of `choose` as words; `None` stands for runs
            without the choice. The default is the value that the model returned.

        Raises
        ------
        InputError
            `no-address`: no sample has the choice; `no-runs`: an enumeration keeps the returned values alone.

        Notes
        -----
        The `repr` replaces values that cannot be keys of a dict, and different values that Python holds for equal:
        `True` and `1`, `0.0` and `-0.0`.
        """
        if choice is not None:
            rows = self._values_of(choice)
        elif isinstance(self.info, EnumerationInfo):
            total = self.log_evidence or 0.0
            rows = [(value, math.exp(log - total)) for value, log in self.info.table]
        else:
            # An impossible run stopped before its end and has no value.
            rows = [(s.value, float(w)) for s, w in zip(self.samples, self.weights, strict=True) if w > 0.0]
        values: dict[str, Any] = {}
        shares: dict[str, float] = {}
        for value, share in rows:
            name = repr(value)
            values.setdefault(name, value)
            shares[name] = shares.get(name, 0.0) + share
        names = Counter(value for value in values.values() if _can_be_key(value))
        return {
            (value if _can_be_key(value) and names[value] == 1 else name): shares[name]
            for name, value in values.items()
        }

    def _values_of(self, choice: str) -> list[tuple[Any, float]]:
        """The values of a choice in all possible samples, with their weights."""
        if not self.samples:
            raise InputError("no-runs", detail=repr(self))
        possible = [(s, float(w)) for s, w in zip(self.samples, self.weights, strict=True) if w > 0.0]
        if not any(choice in sample.choices for sample, _ in possible):
            known = [*dict.fromkeys(address for sample, _ in possible for address in sample.choices)]
            named = lookup.matching(self.model.labels, choice, known)
            if len(named) == 1:
                return [(sample.choices.get(named[0]), weight) for sample, weight in possible]
            if named:
                raise lookup.ambiguous(self.model.labels, choice, named, self.model.name)
            nearest = lookup.nearest(self.model.labels, choice, known, "choice")
            raise InputError("no-address", pattern=choice, name=self.model.name, nearest=nearest)
        return [(sample.choices.get(choice), weight) for sample, weight in possible]

    def export(
        self, path: str | PathLike[str], *, scale: float | None = None, fuse: float | None = None
    ) -> Path:
        """Write the best scene as .glb, .obj, .ply, .stl, .3mf, .gif or .apng."""
        return self.best.export(path, scale=scale, fuse=fuse)

    def save(self, path: str | PathLike[str], **settings: Any) -> Path:
        """Draw the best scene into an image file."""
        return self.best.save(path, **settings)

    def sheet(
        self, *, most: int | None = None, captions: Sequence[str] | None = None, **settings: Any
    ) -> Any:
        """All samples side by side, or the best so many; best first, each with its number, from 1, and its fit.

        Where an image or a shadow is matched and no volume, they are seen from its camera. `captions` has a text for
        each sample in place of its number and its fit.
        """
        ranked = sorted(enumerate(self.samples, 1), key=lambda entry: -entry[1].log_score)[:most]
        scenes = [sample.scene for _, sample in ranked]
        texts = [
            caption(sample, number) if captions is None else captions[number - 1] for number, sample in ranked
        ]
        if self.score.window is not None:
            settings = {"window": self.score.window, **settings}
        elif self.score.target is None and self.score.views:
            settings = {**_settings_of_view(self.score.views[0]), **settings}
        if self.score.window is None:
            settings = {**self.score.surroundings, **settings}
        return draw.sheet.sheet(scenes, texts, self.score.target, **settings)

    def _repr_png_(self) -> bytes | None:
        return self.best._repr_png_() if self.samples else None

    def _repr_html_(self) -> str:
        """The best sample and the numbers of the search; a small sheet where each sample is a run of its own."""
        rows: dict[str, Any] = {"method": self.method.NAME, "samples": len(self)}
        png = None
        if self.samples or self.info._pool(self.samples):
            rows |= {f"best {name}": value for name, value in self.best.numbers.items() if name != "seed"}
            png = self.best._repr_png_()
        if (
            png is not None
            and len(self) > 1
            and (self.method.NAME == "improve" or len(self) == self.search.runs)
        ):
            png = draw.picture.png(self.sheet(most=6, size=(240, 180), samples=1))
        rows |= {"log evidence": self.log_evidence, "seed": self.seed, "seconds": f"{self.seconds:.2f}"}
        rows |= {
            "invalid": sum(place.runs for place in self.invalid) or None,
            "interrupted": self.interrupted or None,
        }
        return draw.card.card(f"Result of {self.model.name}", rows, png)

    def _outside(self) -> list[str]:
        """The part of the summary about invalid runs."""
        return [f"{sum(place.runs for place in self.invalid)} invalid"] if self.invalid else []

    def __repr__(self) -> str:
        samples = f"{len(self)} sample{'' if len(self) == 1 else 's'}"
        specific = self.info._repr_parts(samples)
        parts = [samples] if specific is None else specific
        if specific is None and (self.samples or self.info._pool(self.samples)):
            parts.append(f"best log score {self.best.log_score:.2f}")
            if self.best.fit is not None:
                parts.append(str(self.best.fit))
        if self.log_evidence is not None:
            parts.append(
                f"log evidence {self.log_evidence:.4g}"
                + (" with invalid runs as zero" if self.invalid else "")
            )
        if self.info._HAS_CHAINS:
            count = len(self.sizes)
            parts.insert(0, f"{count} chain{'' if count == 1 else 's'}")
        parts.append(f"seed {self.seed}")
        parts.append(f"{self.seconds:.2f} s")
        parts += self._outside()
        if self.interrupted:
            parts.append("interrupted")
        return f"<Result of {self.model.name}: {', '.join(parts)}>"


def _columns(chain: Sequence[Sample]) -> dict[str, NDArray[Any]]:
    """The choices that all of these samples have, where their values are numbers: (draws,) or (draws, n).

    A word is the place that it has among its options.
    """
    rows = [sample.places for sample in chain]
    columns: dict[str, NDArray[Any]] = {}
    for address in rows[0] if rows else ():
        if all(address in row for row in rows):
            with suppress(ValueError, TypeError):
                array = np.array([row[address] for row in rows])
                if array.dtype.kind in "biuf":
                    columns[address] = array
    return columns


def caption(sample: Sample, number: int, with_score: bool = False) -> str:
    """Write a line about a sample; `number` is its place in its result, from 1. Without a fit it has the log score."""
    fits = f"   {sample.fit}" if sample.fit is not None else ""
    score = f"   log score {sample.log_score:.2f}" if with_score or sample.fit is None else ""
    return f"#{number}{fits}   seed {sample.seed}{score}"


def _settings_of_view(view: View) -> dict[str, Any]:
    """Settings of a picture with the camera and the proportions of an image to match."""
    rows, columns = view.image.shape
    camera = {} if view.camera is None else {"camera": targets.views.eye(view.camera)}
    return {**camera, "size": (max(1, round(360 * columns / rows)), 360)}


def _can_be_key(value: Any) -> bool:
    try:
        hash(value)
    except TypeError:
        return False
    return True
