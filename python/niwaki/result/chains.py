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
from niwaki.result.hmc import SOME, divergent, fixed_choices, listed, other_structures, say, without_gradient
from niwaki.result.info import Info, S
from niwaki.result.invalid import Invalid
from niwaki.result.progress import EngineWatch
from niwaki.result.result import Result
from niwaki.result.sample import Sample
from niwaki.result.search_like import SearchLike


class Stage(Protocol):
    """Stage of a search with its part of a checkpoint (`niwaki.search.keeper`)."""

    @property
    def engine(self) -> _engine.Checkpoint:
        """The engine's part of the checkpoint."""

    def collect(self) -> float:
        """Collect the parts that the engine has stored."""

    def finish(self, interrupted: bool) -> None:
        """Write or remove the file at the end of the chains."""


@dataclass(frozen=True)
class Acceptance:
    """Proposals at one site of a model.

    Attributes
    ----------
    function, site : str
        The function, and the site as it is written in addresses.
    line : int
        The line of the site in the source.
    proposed, accepted : int
        The numbers of proposals, and of accepted proposals. A proposal of the old value counts as accepted.
    outside : int
        The number of proposals outside the support of the distribution.
    """

    function: str
    site: str
    line: int
    proposed: int
    accepted: int
    outside: int

    @property
    def rate(self) -> float:
        """The share of accepted proposals."""
        return self.accepted / self.proposed if self.proposed else math.nan


@dataclass(frozen=True)
class Trajectories:
    """Statistics of the trajectories of one `hmc` or `nuts` in a kernel, all chains together.

    Attributes
    ----------
    kernel : Kernel
        The leaf, with the restrictions that hold for it.
    made, moved : int
        The numbers of transitions, with the warm-up, and of those that moved the chain.
    settled : int
        The number of transitions after the warm-up.
    acceptance : float
        Mean acceptance of the trajectories' points after the warm-up: the step was adapted to it.
    divergences : Divergences
        Trajectories after the warm-up that broke off, by the reason; each was rejected.
    warmup_divergences : int
        The number of trajectories that broke off in the warm-up.
    unwritten : int
        The number of ends that were rejected, because rounding takes the run along another branch than its recording.
    gradients : int
        The number of gradients, without those for first guesses of a step.
    structures, recordings : int
        The numbers of structures (choices, with the values of discrete choices), and of recordings of the model.
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
    """Chains on the engine, with the arguments of their continuation and the stage of their checkpoint."""

    chains: _engine.Chains
    counted: _engine.Task
    watch: EngineWatch
    threads: int | None
    stage: Stage | None = None


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class MhInfo(Info):
    """Statistics of `mh`, computed when they are read.

    Attributes
    ----------
    search, method, seed
        The search, the method and the seed of the chains.
    seconds : tuple of float
        Wall and processor time so far.
    visits : list of list of int
        The numbers of proposals before each sample, by chain.
    """

    _HAS_CHAINS = True

    search: SearchLike
    method: Mh
    seed: int
    _running: Running | None
    seconds: tuple[float, float] = (0.0, 0.0)
    visits: list[list[int]] = field(default_factory=list)

    def __getstate__(self) -> dict[str, Any]:
        """The statistics for pickling, without the chains themselves."""
        for name in ("bests", "last", "acceptance", "trajectories", "counters"):
            getattr(self, name)
        return {**self.__dict__, "_running": None}

    @property
    def running(self) -> Running:
        """The chains on the engine.

        Raises
        ------
        InputError
            The chains are gone, because the result was pickled, or because they were moving when this process was
            forked. Or they are moving, and the caller is their `progress`.
        """
        if self._running is None:
            raise InputError("chains-gone", name=self.search.model.name)
        with translated(self.search.model.name):
            self._running.chains.check()
        return self._running

    def samples_of(self, runs: Iterable[_engine.Run]) -> list[Sample]:
        """Make samples of runs of this search."""
        return [Sample(run, self.search, self.seed, *self.seconds) for run in runs]

    def _pool(self, samples: Sequence[S]) -> list[Sample]:
        return self.bests

    def _go_on(self, result: Result, steps: int | None) -> None:
        """Continue the chains; by default with the proposals of the method that are not made yet."""
        chains, counted, watch, threads, stage = self.running
        part = None if stage is None else stage.engine
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            with translated(self.search.model.name, f"seed={result.seed}"):
                result.interrupted = chains.advance(steps, threads, watch, part)
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
            result.invalid = tuple(Invalid(*fields) for fields in counted.invalid())
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
        """Proposals of all chains by site (`function/site`); the site with most proposals is the first."""
        sites = sorted(self.running.chains.sites(), key=lambda site: -site.proposed)
        names = [f"{site.function}/{site.site}" for site in sites]
        return {
            name if names.count(name) == 1 else f"{name} line {site.line}": Acceptance(
                site.function, site.site, site.line, site.proposed, site.accepted, site.outside
            )
            for name, site in zip(names, sites, strict=True)
        }

    @cached_property
    def trajectories(self) -> list[Trajectories]:
        """Statistics of the trajectories of each `hmc` and `nuts` in the kernel, in the order of the kernel."""
        leaves = [leaf for leaf in self._leaves if leaf.follows]
        counts = self.running.chains.trajectories()
        return [self._trajectories_of(*pair) for pair in zip(leaves, counts, strict=True)]

    def _trajectories_of(self, leaf: Kernel, counts: dict[str, Any]) -> Trajectories:
        fault = as_fault(counts["fault"], self.search.model.name, f"seed={self.seed}")
        divergences = Divergences(**counts["divergences"])
        return Trajectories(**{**counts, "kernel": leaf, "divergences": divergences, "fault": fault})

    @cached_property
    def counters(self) -> dict[str, int]:
        """Counters of the work of all chains, and of the size of their present states.

        They are proposals, activations entered, calls skipped, instructions, primitives removed from the scene or added
        to it (`moved`), and primitives, choices and bytes of the present states.
        """
        return self.running.chains.counters()

    @property
    def _leaves(self) -> list[Kernel]:
        return [] if self.method.kernel is None else self.method.kernel.leaves()

    def warn(self) -> None:
        """Warn about choices that no kernel moves, and about trajectories that broke off."""
        name = self.search.model.name
        names = {leaf.name for leaf in self._leaves}
        if names and names <= {"block", "hmc_step", "nuts_step"}:
            # A block moves single discrete choices, and no lists of them.
            stays = tuple if "block" in names else (bool, int, str, tuple)
            values = [item for sample in self.last for item in sample.choices.items()]
            if held := sorted(
                {path for path, value in values if isinstance(value, stays) and is_discrete(value)}
            ):
                mover = "block" if "block" in names else "gradient"
                say(fixed_choices(held, name, mover, "write `kernels.cycle(kernels.prior(), ...)`"))
        for trajectories in self.trajectories:
            broke = trajectories.divergences
            if broke.structure and (unmoved := self._unmoved()):
                say(
                    f"{other_structures(broke.structure, trajectories.settled, name)}; no other kernel of the chain "
                    f"moves {listed(unmoved)}, so the samples may be given the structure of the start; add "
                    f"`kernels.prior()`: `kernels.cycle(kernels.prior(), ...)`"
                )
            if broke.energy:
                smaller = (
                    "raise its `target`" if self.method.warmup else "give it a smaller `step`, or a `warmup`"
                )
                say(
                    divergent(
                        broke.energy, trajectories.settled, name, f"{smaller} (`{trajectories.kernel!r}`)"
                    )
                )
            if broke.not_finite > SOME * trajectories.made:
                say(without_gradient(broke.not_finite, name, trajectories.fault))

    def _unmoved(self) -> list[str]:
        """The sites of continuous choices in the present states that no kernel without a gradient has moved."""
        if any(not leaf.follows and leaf.name != "on" for leaf in self._leaves):
            return []
        proposed = {site.site for site in self.acceptance.values()}
        sites = {
            path.rsplit("/", 1)[-1]
            for sample in self.last
            for path, value in sample.choices.items()
            if not is_discrete(value)
        }
        return sorted(sites - proposed)


def is_discrete(value: Any) -> bool:
    """Whether a choice's value is a truth value, a whole number, a word, or a list of these."""
    return isinstance(value, (bool, int, str)) or (isinstance(value, tuple) and all(map(is_discrete, value)))
