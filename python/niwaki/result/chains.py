"""Statistics of Markov chains: best states, acceptance by site, trajectories."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Protocol

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.lang.compiled import as_fault, translated
from niwaki.methods import Mh
from niwaki.methods.kernels import Kernel
from niwaki.once import cached_property
from niwaki.result.diagnostics import Divergences
from niwaki.result.hmc import SOME, diverged, kept, listed, refused, say, without_slope
from niwaki.result.info import Info, S
from niwaki.result.invalid import Invalid
from niwaki.result.progress import EngineWatch
from niwaki.result.result import Result
from niwaki.result.sample import Sample
from niwaki.result.search_like import SearchLike


class Stage(Protocol):
    """What keeps the checkpoint of chains (`niwaki.search.keeper`)."""

    @property
    def engine(self) -> _engine.Checkpoint:
        """What the engine stores into."""

    def collect(self) -> float:
        """Take what the engine has stored."""

    def finish(self, interrupted: bool) -> None:
        """Write or remove the file of chains that have ended."""


@dataclass(frozen=True)
class Acceptance:
    """Proposals at one site of a model.

    Attributes
    ----------
    function, site : str
        The function, and the site as it is written in addresses.
    line : int
        Its line in the source.
    proposed, accepted : int
        How many proposals there were, and how many were kept. A proposal of the old value counts as kept.
    outside : int
        How many lay outside the support of the distribution.
    """

    function: str
    site: str
    line: int
    proposed: int
    accepted: int
    outside: int

    @property
    def rate(self) -> float:
        """The share that was kept."""
        return self.accepted / self.proposed if self.proposed else math.nan


@dataclass(frozen=True)
class Trajectories:
    """Statistics of the trajectories of one `hmc` or `nuts` in a kernel, all chains together.

    Attributes
    ----------
    kernel : Kernel
        The leaf, with the restrictions that hold for it.
    made, moved : int
        Transitions, those of the warm-up included, and how many of them moved the chain.
    settled : int
        Transitions after the warm-up.
    acceptance : float
        Mean acceptance of the trajectories' points after the warm-up: the step was adapted to it.
    divergences : Divergences
        Trajectories after the warm-up that broke off, by the reason; each was rejected.
    warmup_divergences : int
        Those of the warm-up.
    unwritten : int
        Ends that were refused because rounding takes the run along another branch than its recording.
    gradients : int
        Gradients taken, without those that first guesses of a step took.
    structures, recordings : int
        Structures met (sets of choices, with the values of discrete ones), and how often the model was recorded.
    step : tuple of float
        The step for one coordinate, by chain (and power).
    fault : ModelFault or None
        The fault, with its line, of the first trajectory that reached a point without a finite gradient.
    """

    kernel: Kernel
    made: int
    moved: int
    settled: int
    acceptance: float
    divergences: Divergences
    warmup_divergences: int
    unwritten: int
    gradients: int
    structures: int
    recordings: int
    step: tuple[float, ...]
    fault: ModelFault | None = None


class Running(NamedTuple):
    """Chains on the engine, what they need to continue, and what keeps their checkpoint."""

    chains: _engine.Chains
    counted: _engine.Task
    watch: EngineWatch
    threads: int | None
    stage: Stage | None = None


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class MhInfo(Info):
    """Of `mh`: statistics of its chains, computed when they are read.

    Attributes
    ----------
    search, method, seed
        The search, the method and the seed of the chains.
    seconds : tuple of float
        Wall and processor time so far.
    visits : list of list of int
        Of each chain, the numbers of proposals before its samples.
    """

    _HAS_CHAINS = True

    search: SearchLike
    method: Mh
    seed: int
    _running: Running | None
    seconds: tuple[float, float] = (0.0, 0.0)
    visits: list[list[int]] = field(default_factory=list)

    def __getstate__(self) -> dict[str, Any]:
        """All statistics, without the chains themselves."""
        for name in ("bests", "last", "acceptance", "trajectories", "counters"):
            getattr(self, name)
        return {**self.__dict__, "_running": None}

    @property
    def running(self) -> Running:
        """The chains on the engine.

        Raises
        ------
        InputError
            The result was pickled, and its chains stayed behind; or they were moving when this process was forked, or
            are moving and this is their `progress`.
        """
        if self._running is None:
            raise InputError("chains-gone", name=self.search.model.name)
        with translated(self.search.model.name):
            self._running.chains.check()
        return self._running

    def samples_of(self, runs: Iterable[_engine.Run]) -> list[Sample]:
        """Runs as samples of this search."""
        return [Sample(run, self.search, self.seed, *self.seconds) for run in runs]

    def _pool(self, samples: Sequence[S]) -> list[Sample]:
        return self.bests

    def _go_on(self, result: Result, steps: int | None) -> None:
        """Go on; without a number of proposals, with those that the method names or an earlier process left."""
        chains, counted, watch, threads, stage = self.running
        kept = None if stage is None else stage.engine
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            with translated(self.search.model.name, f"seed={result.seed}"):
                result.interrupted = chains.advance(steps, threads, watch, kept)
        finally:
            result.seconds += time.perf_counter() - wall
            result.cpu_seconds += time.process_time() - cpu
            if stage is not None:
                stage.collect()
            by_chain = chains.samples()
            visits = [[run.visit for run in runs] for runs in by_chain]
            now = replace(self, visits=visits, seconds=(result.seconds, result.cpu_seconds))
            result.info, result.samples = now, now.samples_of(run for runs in by_chain for run in runs)
            result.sizes = [len(runs) for runs in by_chain]
            result.invalid = tuple(Invalid(*one) for one in counted.invalid())
        now.warn()
        if steps is not None and stage is not None:
            stage.finish(result.interrupted)

    @cached_property
    def bests(self) -> list[Sample]:
        """The best state that each chain reached, whether it was sampled or not."""
        return self.samples_of(self.running.chains.best())

    @cached_property
    def last(self) -> list[Sample]:
        """The present state of each chain."""
        return self.samples_of(self.running.chains.now())

    @cached_property
    def acceptance(self) -> dict[str, Acceptance]:
        """Proposals by site (`function/site`), all chains together; most proposed first."""
        sites = sorted(self.running.chains.sites(), key=lambda one: -one.proposed)
        names = [f"{one.function}/{one.site}" for one in sites]
        return {
            name if names.count(name) == 1 else f"{name} line {one.line}": Acceptance(
                one.function, one.site, one.line, one.proposed, one.accepted, one.outside
            )
            for name, one in zip(names, sites, strict=True)
        }

    @cached_property
    def trajectories(self) -> list[Trajectories]:
        """What became of the trajectories of each `hmc` and `nuts` of the kernel, in its order."""
        leaves = [leaf for leaf in self._leaves if leaf.follows]
        return [self._travelled(*one) for one in zip(leaves, self.running.chains.trajectories(), strict=True)]

    def _travelled(self, leaf: Kernel, counts: dict[str, Any]) -> Trajectories:
        fault = as_fault(counts["fault"], self.search.model.name, f"seed={self.seed}")
        own = {"kernel": leaf, "divergences": Divergences(**counts["divergences"]), "fault": fault}
        return Trajectories(**{**counts, **own})

    @cached_property
    def counters(self) -> dict[str, int]:
        """Work done, and the size of the present states, all chains together.

        Proposals, activations entered, calls skipped, instructions, primitives taken out of the scene or put into it
        (`moved`); primitives, choices and bytes of the present states.
        """
        return self.running.chains.counters()

    @property
    def _leaves(self) -> list[Kernel]:
        return [] if self.method.kernel is None else self.method.kernel.leaves()

    def warn(self) -> None:
        """Warn about trajectories that affect the use of the samples."""
        name = self.search.model.name
        names = {leaf.name for leaf in self._leaves}
        if names and names <= {"block", "hmc_step", "nuts_step"}:
            # A block moves single discrete choices, and no lists of them.
            stays = tuple if "block" in names else (bool, int, tuple)
            values = [item for sample in self.last for item in sample.choices.items()]
            if held := sorted(
                {path for path, value in values if isinstance(value, stays) and is_discrete(value)}
            ):
                mover = "block" if "block" in names else "gradient"
                say(kept(held, name, mover, "write `kernels.cycle(kernels.prior(), ...)`"))
        for one in self.trajectories:
            broke = one.divergences
            if broke.structure and (unmoved := self._unmoved()):
                say(
                    f"{refused(broke.structure, one.settled, name)}; no other kernel of the chain moves "
                    f"{listed(unmoved)}, so the samples may be given the structure of its start; put `kernels.prior()` "
                    f"beside: `kernels.cycle(kernels.prior(), ...)`"
                )
            if broke.energy:
                smaller = (
                    "raise its `target`" if self.method.warmup else "give it a smaller `step`, or a `warmup`"
                )
                say(diverged(broke.energy, one.settled, name, f"{smaller} (`{one.kernel!r}`)"))
            if broke.not_finite > SOME * one.made:
                say(without_slope(broke.not_finite, name, one.fault))

    def _unmoved(self) -> list[str]:
        """The continuous choices of the present states, by site, that no kernel without a gradient has moved."""
        if any(not leaf.follows and leaf.name != "on" for leaf in self._leaves):
            return []
        proposed = {one.site for one in self.acceptance.values()}
        sites = {
            path.rsplit("/", 1)[-1]
            for sample in self.last
            for path, value in sample.choices.items()
            if not is_discrete(value)
        }
        return sorted(sites - proposed)


def is_discrete(value: Any) -> bool:
    """Whether a choice's value is a truth value, a whole number, or a list of these."""
    return isinstance(value, (bool, int)) or (isinstance(value, tuple) and all(map(is_discrete, value)))
