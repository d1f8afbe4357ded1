"""What a search gives back: samples, each with its scene, choices and scores, and the numbers of the whole."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine, draw
from niwaki.draw.scene import Part, Scene
from niwaki.errors import InputError
from niwaki.lang.compiled import translated
from niwaki.lang.models import Model
from niwaki.methods import Method, Mh
from niwaki.result import diagnostics
from niwaki.result.gradient import LogDensity
from niwaki.result.info import EnumerationInfo, Info
from niwaki.result.progress import Watch
from niwaki.targets.sketches import Score
from niwaki.targets.target import Target

if TYPE_CHECKING:
    from niwaki.result.chains import ChainResult
    from niwaki.search import Search


class Sample:
    """One run of a model.

    Scores are natural logarithms (nats) and never tempered.

    Attributes
    ----------
    log_score : float
        Factors, observations and sketches.
    log_prior : float
        The log density of the choices.
    log_weight : float
        The weight in its population; 0 where all weigh the same.
    similarity : float or None
        Share of cells that are equal in the scene and its target.
    primitives : int
        How many primitives the scene has.
    has_ended : bool
        Whether the run went to its end; a search that was stopped may leave others.
    cause : str or None
        What made the run impossible.
    search : Search
        What was asked.
    seed : int or None
        Of the run of that search.
    seconds, cpu_seconds : float
        Wall and processor time of that search.
    """

    def __init__(
        self,
        outcome: _engine.Outcome | _engine.Trace,
        search: Search,
        seed: int | None = None,
        seconds: float = 0.0,
        cpu_seconds: float = 0.0,
    ) -> None:
        self._outcome = outcome
        self._is_restored = False
        self.search = search
        self.log_score: float = outcome.log_score
        self.log_prior: float = outcome.log_prior
        self.similarity: float | None = outcome.similarity
        self.primitives: int = outcome.primitives
        self.cause: str | None = outcome.cause
        self.log_weight: float = getattr(outcome, "log_weight", 0.0)
        self.has_ended: bool = getattr(outcome, "has_ended", True)
        self.seed, self.seconds, self.cpu_seconds = seed, seconds, cpu_seconds

    @classmethod
    def of_trace(cls, trace: _engine.Trace, search: Search) -> Sample:
        """A run whose choices were given."""
        sample = cls(trace, search)
        sample.__dict__["_trace"] = trace
        return sample

    def __reduce__(self) -> tuple[Any, ...]:
        outcome = self._outcome
        if isinstance(outcome, _engine.Outcome):
            data = outcome.data()
        else:
            names = ("log_prior", "log_score", "log_weight", "primitives", "similarity", "has_ended", "cause")
            data = {name: getattr(self, name) for name in names}
            data |= {"choices": [(one[1], one[3]) for one in outcome.choices], "order": [], "visit": 0}
        return _restored, (self.search, data, self.seed, self.seconds, self.cpu_seconds)

    @cached_property
    def _trace(self) -> _engine.Trace:
        """The run once more, with names."""
        with translated("model"):
            return self.search.task.trace(self._outcome)  # type: ignore[arg-type]

    def log_density(self) -> LogDensity:
        """The log density around this run over its continuous choices: see `niwaki.log_density`."""
        choices = [(address, value) for _, address, _, value, _ in self._trace.choices]
        with translated("model"):
            return LogDensity(self.search.task.density(choices))

    @property
    def log_joint(self) -> float:
        """Choices and score together, nats."""
        return self.log_prior + self.log_score

    @property
    def value(self) -> Any:
        """What the model returned; None for a run that did not end."""
        try:
            return self._trace.value if self._is_restored else self._outcome.value
        except TypeError as error:
            raise InputError("value-too-deep", found=str(error)) from None

    @property
    def target(self) -> Target | None:
        """What the scene should fill."""
        return self.search.score.target

    @property
    def choices(self) -> dict[str, Any]:
        """Every choice by its readable address; give them to `run(choices=...)` to get the same run."""
        return {choice[0]: choice[3] for choice in self._trace.choices}

    @property
    def families(self) -> dict[str, str]:
        """The distribution of every choice."""
        return {choice[0]: choice[2] for choice in self._trace.choices}

    @property
    def order(self) -> list[tuple[int, int]]:
        """Order choices: the hash of the future that ran, and its place among those that could."""
        return self._outcome.order() if hasattr(self._outcome, "order") else []

    @property
    def queries(self) -> dict[Any, Any]:
        """The model's answers by key."""
        return dict(self._trace.queries)

    @cached_property
    def scene(self) -> Scene:
        """The primitives, by the addresses of their `emit`."""
        return Scene(self._trace.parts)

    def export(
        self, path: str | PathLike[str], *, scale: float | None = None, fuse: float | None = None
    ) -> Path:
        """Write the scene as .glb, .obj, .ply, .stl, .3mf, .gif or .apng; see `niwaki.draw.files.export`."""
        if Path(path).suffix.lower() in draw.animation.FORMATS and scale is None and fuse is None:
            return self.animate(path)
        return self.scene.export(path, scale=scale, fuse=fuse)

    def animate(
        self, path: str | PathLike[str], target: Target | None | bool = True, **settings: Any
    ) -> Path:
        """Write the scene growing, in the order in which a run adds its parts, as .gif or .apng.

        Settings are those of `niwaki.draw.animation.growth`; the target is a ghost unless it is None.
        """
        parts = [Part(address, tuple(shapes)) for address, shapes in self._trace.parts]
        return self.scene.animate(path, self._ghost(target), parts=parts, **settings)

    def picture(self, target: Target | None | bool = True, **settings: Any) -> Any:
        """Draw the scene, with the target as a ghost; `target=None` leaves that out."""
        return self.scene.picture(self._ghost(target), **settings)

    def save(self, path: str | PathLike[str], target: Target | None | bool = True, **settings: Any) -> Path:
        """Draw the scene into an image file, with the target as a ghost; `target=None` leaves that out."""
        return self.scene.save(path, self._ghost(target), **settings)

    def _ghost(self, target: Target | None | bool) -> Target | None:
        if isinstance(target, bool):
            return self.target if target else None
        return target

    def _repr_png_(self) -> bytes | None:
        return draw.picture.png(self.picture(size=(800, 600))) if self.primitives else None

    def __repr__(self) -> str:
        parts = [f"log score {self.log_score:.2f}", f"log prior {self.log_prior:.2f}"]
        if self.similarity is not None:
            parts.append(f"similarity {self.similarity:.3f}")
        if self.primitives:
            parts.append(f"{self.primitives} primitives")
        if not self.has_ended:
            parts.append("not ended")
        return f"<Sample: {', '.join(parts)}>"


def _restored(search: Search, data: dict[str, Any], *rest: Any) -> Sample:
    """The sample of its pickled data: what the model returned comes from running it once more, when it is asked for."""
    sample = Sample(search.task.outcome(data), search, *rest)
    sample._is_restored = True
    return sample


class Result(Sequence[Sample]):
    """What a search found; a sequence of its samples.

    Attributes
    ----------
    search : Search
        What was asked.
    samples : list of Sample
        Of `grow`: one for each run. Of `smc`: the particles. Else: the runs.
    seed : int
        Of the (first) search.
    info : Info
        What the method says of its search: see `niwaki.result.info`.
    interrupted : bool
        Whether it was stopped before its end.
    seconds, cpu_seconds : float
        Wall and processor time of the search alone.
    invalid : dict of str to int
        How many runs, proposals and points of trajectories were outside of the model's support because the numbers
        given to a distribution were out of its range: by that distribution and its line, such as
        "`uniform` at line 12". A run counts where it met the first of them.
    """

    def __init__(
        self,
        search: Search,
        samples: list[Sample],
        seed: int,
        *,
        info: Info = Info(),  # noqa: B008
        interrupted: bool = False,
        invalid: Mapping[str, int] | None = None,
    ) -> None:
        self.search, self.samples, self.seed, self.info = search, samples, seed, info
        self.interrupted = interrupted
        self.invalid: dict[str, int] = dict(invalid or {})
        self.seconds = sum(sample.seconds for sample in samples)
        self.cpu_seconds = sum(sample.cpu_seconds for sample in samples)

    @property
    def model(self) -> Model[..., Any]:
        """What was run."""
        return self.search.model

    @property
    def method(self) -> Method:
        """How it was searched."""
        return self.search.method

    @property
    def score(self) -> Score:
        """What its scene should be like."""
        return self.search.score

    @property
    def log_evidence(self) -> float | None:
        """Log of the model's total probability, nats, where the method gives it."""
        return self.info.log_evidence

    def __len__(self) -> int:
        return len(self.samples)

    def __iter__(self) -> Iterator[Sample]:
        return iter(self.samples)

    @property
    def by_chain(self) -> list[Sequence[Sample]]:
        """The samples of each chain; all in one where there are no chains."""
        return [self.samples]

    @property
    def draws(self) -> dict[str, NDArray[Any]]:
        """Values of choices by address, (chains, draws) or (chains, draws, n) for lists of n numbers.

        Of the choices that every sample has, with values that are numbers; of as many samples as the shortest chain
        has. Where samples have weights, they are not among these: see `weights`.
        """
        least = min((len(chain) for chain in self.by_chain), default=0)
        rows = [[sample.choices for sample in chain[:least]] for chain in self.by_chain]
        found: dict[str, NDArray[Any]] = {}
        for address in rows[0][0] if least else ():
            if all(address in choices for row in rows for choices in row):
                values = [[choices[address] for choices in row] for row in rows]
                with suppress(ValueError, TypeError):
                    array = np.array(values)
                    if array.dtype.kind in "biuf":
                        found[address] = array
        return found

    def to_arviz(self) -> Any:
        """The draws for ArviZ, with the samples' statistics: a `DataTree` with 1.x, an `InferenceData` before.

        Raises
        ------
        InputError
            ArviZ is not installed.
        """
        return diagnostics.to_arviz(self.draws, self._statistics())

    def _statistics(self) -> dict[str, NDArray[Any]]:
        """Numbers of each draw for ArviZ, (chains, draws)."""
        least = min((len(chain) for chain in self.by_chain), default=0)
        rows = [chain[:least] for chain in self.by_chain]
        return {
            "lp": np.array([[one.log_joint for one in row] for row in rows]),
            "log_weight": np.array([[one.log_weight for one in row] for row in rows]),
        }

    def __getitem__(self, index: Any) -> Any:
        return self.samples[index]

    @property
    def best(self) -> Sample:
        """The sample of the best log score; runs that ended come first."""
        if not self.samples:
            raise InputError("no-runs", detail=repr(self))
        possible = [s for s in self.samples if s.has_ended and s.log_score > -math.inf]
        return max(possible or self.samples, key=lambda sample: sample.log_score)

    def polish(
        self,
        method: Mh,
        *,
        seed: int | None = None,
        threads: int | None = None,
        progress: Watch | None = None,
    ) -> ChainResult:
        """Go on from the best sample by Markov chains; their `best` is at least as good.

        Parameters
        ----------
        method
            `niwaki.mh(...)`: how many proposals, and by which kernel.
        seed, threads, progress
            As for `niwaki.run`; the seed of this search when left out.

        Returns
        -------
        ChainResult
            The chains, whose seconds are those of this search and their own.
        """
        return self.search.polished(self, method, seed=seed, threads=threads, progress=progress)

    @cached_property
    def unique_models(self) -> int:
        """Of how many samples no other shares more than half of its choices, as (address, value) pairs."""
        outcomes = [s._outcome for s in self.samples]
        return _engine.unique_models([one for one in outcomes if isinstance(one, _engine.Outcome)])

    @property
    def value(self) -> Any:
        """What the best sample returned."""
        return self.best.value

    @property
    def scene(self) -> Scene:
        """The scene of the best sample."""
        return self.best.scene

    @property
    def weights(self) -> NDArray[np.float64]:
        """The samples' weights, (n,), summing to one; an error where every sample is impossible.

        Particles of several runs have none: a weight says what a particle is beside those of its own population.
        """
        if self.search.runs > 1 and self.search.method.NAME == "smc":
            raise InputError("weights-of-runs", runs=self.search.runs)
        logs = np.array([sample.log_weight for sample in self.samples], dtype=np.float64)
        if len(logs) == 0:
            return logs
        if logs.max() == -math.inf:
            causes = Counter(sample.cause or "weights" for sample in self.samples)
            listed = ", ".join(f"{cause} ({count})" for cause, count in causes.most_common())
            raise InputError("everything-impossible", barrier="the end", count=len(logs), constraint=listed)
        raw = np.exp(logs - logs.max())
        return np.asarray(raw / raw.sum())

    def distribution(self) -> dict[Any, float]:
        """The probability of each value: exact for enumeration, weighted shares of the samples else.

        Values that cannot be keys of a dict stand under their `repr`.
        """
        if isinstance(self.info, EnumerationInfo):
            total = self.log_evidence or 0.0
            rows = [(value, math.exp(log - total)) for value, log in self.info.table]
        else:
            # A run that is impossible stopped on its way and has no value.
            rows = [(s.value, float(w)) for s, w in zip(self.samples, self.weights, strict=True) if w > 0.0]
        found: dict[Any, float] = {}
        for value, share in rows:
            key = value if _can_be_key(value) else repr(value)
            found[key] = found.get(key, 0.0) + share
        return found

    def export(
        self, path: str | PathLike[str], *, scale: float | None = None, fuse: float | None = None
    ) -> Path:
        """Write the best scene as .glb, .obj, .ply, .stl, .3mf, .gif or .apng."""
        return self.best.export(path, scale=scale, fuse=fuse)

    def save(self, path: str | PathLike[str], **settings: Any) -> Path:
        """Draw the best scene into an image file."""
        return self.best.save(path, **settings)

    def sheet(self, **settings: Any) -> Any:
        """All samples side by side, best first, with their numbers."""
        ranked = sorted(self.samples, key=lambda sample: -sample.log_score)
        scenes = [sample.scene for sample in ranked]
        return draw.sheet.sheet(scenes, [caption(sample) for sample in ranked], self.score.target, **settings)

    def _repr_png_(self) -> bytes | None:
        return self.best._repr_png_() if self.samples else None

    def _outside(self) -> list[str]:
        """What is said of runs in which a distribution was invalid."""
        return [f"{sum(self.invalid.values())} invalid"] if self.invalid else []

    def __repr__(self) -> str:
        parts = [f"{len(self)} sample{'' if len(self) == 1 else 's'}"]
        if isinstance(self.info, EnumerationInfo):
            parts = [f"{len(self.info.table)} values, {self.info.runs} runs"]
        elif self.samples:
            parts.append(f"best log score {self.best.log_score:.2f}")
            if self.best.similarity is not None:
                parts.append(f"similarity {self.best.similarity:.3f}")
        if self.log_evidence is not None:
            parts.append(f"log evidence {self.log_evidence:.4g}")
        parts.append(f"seed {self.seed}")
        parts.append(f"{self.seconds:.2f} s")
        parts += self._outside()
        if self.interrupted:
            parts.append("interrupted")
        return f"<Result of {self.model.name}: {', '.join(parts)}>"


def caption(sample: Sample) -> str:
    """A line for a contact sheet."""
    close = f"   {100 * sample.similarity:.1f} %" if sample.similarity is not None else ""
    return f"seed {sample.seed}   {sample.log_score:.2f}{close}"


def _can_be_key(value: Any) -> bool:
    try:
        hash(value)
    except TypeError:
        return False
    return True


def log_density(sample: Sample) -> LogDensity:
    """The log density of a model around one of its runs: priors, factors and observations, with the Jacobians.

    Parameters
    ----------
    sample : Sample
        Of any result: `nw.run(model, seed=1).best`, for example.

    Raises
    ------
    InputError
        The scene is scored by a sketch, which has no gradient, or there are no continuous choices.
    ModelFault
        An operation on the way to the score has no derivative, or the run is impossible; with the line.
    """
    return sample.log_density()
