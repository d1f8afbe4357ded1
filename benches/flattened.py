"""A model as a function of a row of numbers, and CMA-ME on it.

*Flattened:* each address has a number of its own in the row, in the order in which runs of the prior make the choices.
A number x stands for the quantile Phi(x) of the choice's distribution, given the choices before it, so a row of
independent standard normals is a run of the prior. Numbers of choices that a run does not make are ignored. Choices at
addresses that `SHOWN` runs of the prior did not make are drawn by a seed. A run goes through the model as plain Python,
which finds the distributions one after the other; the engine then scores the run with these choices.

*CMA-ME* (Fontaine, Togelius, Nikolaidis & Hoover 2020) is that of `ribs`: an archive with a cell for each combination
of values, and five emitters with improvement ranking and the batch size of CMA-ES. They begin as the prior.
"""

import math
import time
from collections.abc import Iterator, Sequence
from statistics import NormalDist
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import _engine
from niwaki.errors import NiwakiError
from niwaki.lang import densities, plain
from niwaki.words.distributions import Distribution, Gaussian, Uniform

#: Runs of the prior that show the addresses.
SHOWN = 200
#: The probability in either tail that no number reaches.
TAIL = 1e-9
#: The score of an impossible run, which the library needs finite.
IMPOSSIBLE = -1e6
#: Emitters, as in the tutorials of the library.
EMITTERS = 5

#: A run that was evaluated: its choices, its log score, and the steps and CPU seconds so far.
Evaluated = tuple[dict[str, Any], float, float, float]


class Row(plain.PlainRun):
    """A run in plain Python with its choices from a row of numbers."""

    def __init__(self, row: Sequence[float], places: dict[str, int], seed: int) -> None:
        super().__init__(seed, {})
        self.row, self.places = row, places

    def sample(self, dist: Any, words: Sequence[str] | None = None) -> Any:
        """Make a choice by the number of its address."""
        pending = self.pending
        place = self.places.get(address := self.address("sample"))
        if place is not None:
            self.values[address] = quantile(dist, NormalDist().cdf(self.row[place]))
        self.pending = pending
        return super().sample(dist, words)

    def emit(self, shapes: Sequence[Any]) -> None:
        """Add nothing: the engine makes the scene."""
        self.address("emit")


def quantile(dist: Distribution, share: float) -> Any:
    """Return the quantile of a distribution of the gallery's models."""
    share = min(max(share, TAIL), 1.0 - TAIL)
    match dist:
        case Uniform(lo, hi):
            return lo + share * (hi - lo)
        case Gaussian(mean, sd):
            return NormalDist(mean, sd).inv_cdf(share)
    values = _engine.enumerate_support(dist.family, densities.parameters(dist))
    if values is None:
        raise TypeError(f"no quantiles of {dist}")
    for value in values:
        share -= math.exp(densities.log_density(dist, value))
        if share < 0.0:
            break
    return value


def choices(model: Any, row: Sequence[float], places: dict[str, int], seed: int) -> dict[str, Any]:
    """Return the choices of the run of a row."""
    state = Row(row, places, seed)
    token = plain.current.set(state)
    try:
        state.enter(model.function, (), {})
    finally:
        plain.current.reset(token)
    return state.choices_made


def cma_me(search: Any, grid: dict[str, tuple[Any, ...]], seed: int) -> Iterator[Evaluated]:
    """Search by CMA-ME without an end. Its CPU seconds are those of the library and of the engine's scores alone."""
    places: dict[str, int] = {}
    for number in range(SHOWN):
        for address in nw.run_python(search.model, seed=number).choices:
            places.setdefault(address, len(places))
    # The last cell of each dimension is for all values that the grid lacks.
    sizes = [len(values) + 1 for values in grid.values()]
    # The library compiles its functions at the first use.
    rehearsal = scheduler(sizes, len(places), seed)
    number = len(rehearsal.ask())
    rehearsal.tell(np.zeros(number), np.zeros((number, len(sizes))))
    emitters, count, seconds = scheduler(sizes, len(places), seed), 0, 0.0
    while True:
        start = time.process_time()
        rows = emitters.ask()
        seconds += time.process_time() - start
        results = []
        for row in rows:
            values = choices(search.model, row.tolist(), places, seed + count)
            start = time.process_time()
            score, steps = scored(search, values)
            seconds, count = seconds + time.process_time() - start, count + steps
            cell = [_place(levels, values.get(address)) for address, levels in grid.items()]
            results.append((max(score, IMPOSSIBLE), cell))
            yield values, score, count, seconds
        start = time.process_time()
        emitters.tell([score for score, _ in results], np.array([cell for _, cell in results]))
        seconds += time.process_time() - start


def scheduler(sizes: Sequence[int], width: int, seed: int) -> Any:
    """Return emitters with their archive: cells of these sizes, and rows of this width."""
    from ribs.archives import GridArchive
    from ribs.emitters import EvolutionStrategyEmitter
    from ribs.schedulers import Scheduler

    ranges = [(-0.5, size - 0.5) for size in sizes]
    archive = GridArchive(solution_dim=width, dims=sizes, ranges=ranges, seed=seed)
    emitters = [
        EvolutionStrategyEmitter(archive, x0=[0.0] * width, sigma0=1.0, ranker="2imp", seed=seed + number)
        for number in range(EMITTERS)
    ]
    return Scheduler(archive, emitters)


def scored(search: Any, values: dict[str, Any]) -> tuple[float, int]:
    """Return the log score of a run in a search, and its steps; a run that fails is impossible."""
    try:
        run = search.task.replay(values).run
    except (NiwakiError, _engine.EngineFault):
        return -math.inf, 1
    return run.log_score, run.primitives + 1


def _place(levels: tuple[Any, ...], value: Any) -> int:
    return levels.index(value) if value in levels else len(levels)
