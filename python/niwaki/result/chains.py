"""What Markov chains give back: the best state, samples, acceptance by site, and the chains, to go on with."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.lang.compiled import as_fault, translated
from niwaki.methods import Mh, at_least_one
from niwaki.methods.kernels import Kernel
from niwaki.result.diagnostics import Divergences
from niwaki.result.hmc import SOME, diverged, kept, listed, refused, say, without_slope
from niwaki.result.progress import EngineWatch
from niwaki.result.result import Result, Sample

if TYPE_CHECKING:
    from niwaki.search import Search


@dataclass(frozen=True)
class Acceptance:
    """Proposals at one site of a model.

    Attributes
    ----------
    function, site : str
        Where it stands: the function, and the site as it is written in addresses.
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
    """What became of the trajectories of one `hmc` or `nuts` in a kernel, all chains together.

    Attributes
    ----------
    kernel : Kernel
        The leaf, with the restrictions that hold for it.
    made, moved : int
        Transitions, those of the warm-up included, and how many of them moved the chain.
    settled : int
        Transitions after the warm-up.
    acceptance : float
        Mean acceptance of the trajectories' points after the warm-up: what the step was adapted to.
    divergences : Divergences
        Trajectories after the warm-up that broke off, by the reason; each was rejected.
    warmup_divergences : int
        Those of the warm-up.
    unwritten : int
        Ends that the run itself did not take: it goes another way there than its recording, which is a matter of
        rounding.
    gradients : int
        Gradients taken, without those that first guesses of a step took.
    structures, recordings : int
        Structures met (sets of choices, with the values of discrete ones), and how often the model was recorded.
    step : tuple of float
        The step for one coordinate, by chain (and temperature).
    fault : ModelFault or None
        With its line: what the first trajectory met that came to a point without a finite gradient.
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


class ChainResult(Result):
    """What Markov chains found; a sequence of its samples, chain after chain.

    Attributes
    ----------
    samples : list of Sample
        Thinned states after the warm-up, those of the first chain first. All weigh the same.
    visits : list of list of int
        The numbers of proposals before them.
    counters : dict of str to int
        Proposals, activations entered, calls skipped, instructions, primitives taken out of the scene or put into it
        (`moved`); primitives, choices and bytes of the present states.
    """

    def __init__(
        self,
        search: Search,
        method: Mh,
        counted: _engine.Task,
        chains: _engine.Chains,
        seed: int,
        watch: EngineWatch,
        threads: int | None,
    ) -> None:
        super().__init__(search, [], seed)
        self._method, self._counted = method, counted
        self._chains: _engine.Chains | None = chains
        self._looks: dict[str, Any] = {}
        self._watch, self._threads = watch, threads
        self._by_chain: list[list[Sample]] = []
        self.visits: list[list[int]] = []

    @property
    def method(self) -> Mh:
        """How its chains move: the method of the search, or that of its polishing."""
        return self._method

    @property
    def by_chain(self) -> list[Sequence[Sample]]:
        """The samples of each chain."""
        return list(self._by_chain)

    def more(self, steps: int) -> ChainResult:
        """Go on for `steps` proposals in each chain, from where they are; the result itself, with more in it."""
        at_least_one("steps", steps)
        chains = self._engine
        self._looks = {}
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            with translated(self.model.name, f"seed={self.seed}"):
                self.interrupted = chains.advance(steps, self._threads, self._watch)
            self._warn()
        finally:
            self.seconds += time.perf_counter() - wall
            self.cpu_seconds += time.process_time() - cpu
            self._gather()
        return self

    def _gather(self) -> None:
        self._looks = {}
        self.invalid = self._counted.invalid()
        kept = [self._engine.samples(chain) for chain in range(self.method.chains)]
        self.visits = [[outcome.visit for outcome in outcomes] for outcomes in kept]
        self._by_chain = [[self._sample(outcome) for outcome in outcomes] for outcomes in kept]
        self.samples = [sample for chain in self._by_chain for sample in chain]

    def _sample(self, outcome: _engine.Outcome) -> Sample:
        return Sample(outcome, self.search, self.seed, self.seconds, self.cpu_seconds)

    def _seen(self, name: str, look: Callable[[], Any]) -> Any:
        """What the chains say of themselves, looked at once between two calls of `more`."""
        if name not in self._looks:
            self._looks[name] = look()
        return self._looks[name]

    def __getstate__(self) -> dict[str, Any]:
        """All that can be asked of the result; the chains themselves stay where they are."""
        for name in ("bests", "last", "acceptance", "trajectories", "counters"):
            getattr(self, name)
        return {**self.__dict__, "_chains": None, "_counted": None, "_watch": None}

    @property
    def best(self) -> Sample:
        """The state of the best log score that any chain came through, whether it was sampled or not."""
        return max(self.bests, key=lambda sample: sample.log_score)

    @property
    def bests(self) -> list[Sample]:
        """The best state of each chain."""
        return list(self._seen("bests", lambda: [self._sample(one) for one in self._engine.best()]))

    @property
    def last(self) -> list[Sample]:
        """The present state of each chain."""
        return list(self._seen("last", lambda: [self._sample(one) for one in self._engine.now()]))

    @property
    def _engine(self) -> _engine.Chains:
        """The chains on the engine.

        Raises
        ------
        InputError
            The result was pickled, and its chains stayed behind.
        """
        if self._chains is None:
            raise InputError("chains-gone", name=self.model.name)
        return self._chains

    @property
    def acceptance(self) -> dict[str, Acceptance]:
        """Proposals by site (`function/site`), all chains together; most proposed first."""
        return dict(self._seen("acceptance", self._acceptance))

    def _acceptance(self) -> dict[str, Acceptance]:
        rows = [Acceptance(*row) for row in self._engine.sites()]
        rows.sort(key=lambda row: -row.proposed)
        names = [f"{row.function}/{row.site}" for row in rows]
        return {
            name if names.count(name) == 1 else f"{name} line {row.line}": row
            for name, row in zip(names, rows, strict=True)
        }

    @property
    def trajectories(self) -> list[Trajectories]:
        """What became of the trajectories of each `hmc` and `nuts` of the kernel, in its order."""
        return list(self._seen("trajectories", self._trajectories))

    def _trajectories(self) -> list[Trajectories]:
        leaves = [] if self.method.kernel is None else self.method.kernel.leaves()
        found = []
        rows = iter(self._engine.trajectories())
        for leaf in leaves:
            if not leaf.follows:
                continue
            row = next(rows)
            broke = Divergences(row["energy"], row["guard"], row["impossible"], row["not_finite"])
            found.append(
                Trajectories(
                    kernel=leaf,
                    made=row["made"],
                    moved=row["moved"],
                    settled=row["settled"],
                    acceptance=row["accept"] / row["settled"] if row["settled"] else math.nan,
                    divergences=broke,
                    warmup_divergences=row["warmup_divergences"],
                    unwritten=row["unwritten"],
                    gradients=row["gradients"],
                    structures=row["structures"],
                    recordings=row["recordings"],
                    step=tuple(row["steps"]),
                    fault=as_fault(row["fault"], self.model.name, f"seed={self.seed}"),
                )
            )
        return found

    def _warn(self) -> None:
        """Say what a person must know of the trajectories before using the samples."""
        name = self.model.name
        leaves = [] if self.method.kernel is None else self.method.kernel.leaves()
        if leaves and all(leaf.name in ("hmc", "nuts") for leaf in leaves):
            values = (item for sample in self.last for item in sample.choices.items())
            if held := sorted({path for path, value in values if isinstance(value, (bool, int))}):
                say(kept(held, name))
        for one in self.trajectories:
            broke = one.divergences
            if broke.structure and (unmoved := self._unmoved()):
                say(
                    f"{refused(broke.structure, one.settled, name)}; no other kernel of the chain moves "
                    f"{listed(unmoved)}, so the samples may be given the structure of its start; put `kernels.mh()` "
                    f"beside: `kernels.cycle(kernels.mh(), ...)`"
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
        leaves = [] if self.method.kernel is None else self.method.kernel.leaves()
        if any(not leaf.follows and leaf.name != "on" for leaf in leaves):
            return []
        proposed = {row.site for row in self.acceptance.values()}
        sites = {
            path.rsplit("/", 1)[-1]
            for sample in self.last
            for path, value in sample.choices.items()
            if not isinstance(value, (bool, int))
        }
        return sorted(sites - proposed)

    @property
    def counters(self) -> dict[str, int]:
        """Work done, and the size of the present states, all chains together."""
        return dict(self._seen("counters", lambda: self._engine.counters()))

    @property
    def trace(self) -> NDArray[np.float64]:
        """Log scores of the samples, (chains, samples of the shortest chain), nats."""
        least = min((len(chain) for chain in self.by_chain), default=0)
        return np.array(
            [[one.log_score for one in chain[:least]] for chain in self.by_chain], dtype=np.float64
        )

    def __repr__(self) -> str:
        proposals = self.counters["proposals"]
        return (
            f"<ChainResult: {self.method.chains} chain{'s' if self.method.chains > 1 else ''}, "
            f"{proposals} proposals, {len(self.samples)} samples, best log score {self.best.log_score:.2f}>"
        )
