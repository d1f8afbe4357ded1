"""Populations of one search on many workers, with the same result to the bit wherever each population runs.

Populations share only the seed of their search, from which each gets a seed of its own. So each population is a search
by itself, and a batch runs them. Their results are combined as the engine combines its own populations
(crates/particles/src/many.rs): by their estimates of the normalising constant, zero for a population that died.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, cast

from niwaki import _engine
from niwaki.batches import pools
from niwaki.batches.body import Outcome
from niwaki.batches.entry import batch
from niwaki.batches.execution import Watch
from niwaki.errors.settings import bad
from niwaki.methods import Smc
from niwaki.result import Result, Sample
from niwaki.result.info import Count, Losses, PopulationInfo
from niwaki.result.invalid import merged
from niwaki.result.search_like import SearchLike
from niwaki.search import Search
from niwaki.search.engine_runs import Clock, distinct
from niwaki.search.execution import execute

#: The fault of a population that died, because all its particles became impossible; its estimate is zero.
DIED = "everything-impossible"


def spread(
    search: Search,
    *,
    folder: str | PathLike[str] | None = None,
    processes: int | None = None,
    executor: Executor | None = None,
    chunk: float = pools.TARGET,
    progress: Watch | None = None,
) -> Result:
    """Run a search by `smc` with its populations on many workers.

    The result equals the result of `search.run()`, except for seconds, and for `invalid`, which does not count
    populations that died. One population with all particles is better than many small populations: fill the memory of a
    worker before you add populations.

    Parameters
    ----------
    search
        A search by `smc` with `populations=`, `diverse=` or several numbers of particles.
    folder
        A folder for the results of populations, from which a stopped search resumes; it has a folder for each size.
    processes, executor, chunk, progress
        See `batch`.

    Raises
    ------
    InputError
        The search is not by `smc`, or is limited by seconds; see also `batch`.
    ModelFault
        The model has a fault, or all populations died: the fault of the first of them.
    """
    method = search.method
    if not isinstance(method, Smc) or method.seconds is not None:
        raise bad("method", method, "`smc` with a number of particles", "smc(particles=1000, populations=16)")
    workers = {"processes": processes, "executor": executor, "chunk": chunk, "progress": progress}

    def run_once(_: SearchLike, seed: int, *rest: Any) -> Result:
        return _populations(search, method, seed, folder, workers)

    return execute(search, None, None, runner=run_once)


def _populations(
    search: Search, method: Smc, seed: int, folder: str | PathLike[str] | None, workers: Mapping[str, Any]
) -> Result:
    """Return one run of a search, with a batch for the populations of each size."""
    sizes, clock = method.sizes, Clock()
    count = len(sizes)
    shares = [_engine.population(seed, number, count, search.max_memory) for number in range(count)]
    outcomes: dict[int, Outcome] = {}
    for size in sorted(set(sizes)):
        numbers = {shares[number][0]: number for number in range(count) if sizes[number] == size}
        method_of_part = replace(method, particles=size, populations=1, diverse=None)
        part = replace(
            search, method=method_of_part, runs=1, keep="all", polish=None, max_memory=shares[0][1]
        )
        place = None if folder is None else Path(folder) / str(size)
        for outcome in batch(part, seeds=numbers, folder=place, **workers):
            if outcome.fault not in (None, DIED):
                outcome.search.run(threads=1)  # Raises the fault, with its places.
            outcomes[numbers[outcome.seed]] = outcome
    alive = {number: outcome for number, outcome in sorted(outcomes.items()) if outcome.fault is None}
    if not alive:
        outcomes[0].search.run(threads=1)
    invalid = merged(*(outcome.result.invalid for outcome in alive.values()))
    runs, info = _united(search, method, alive)
    if method.diverse is not None:
        runs = distinct(runs, method.diverse, info)
    seconds = clock.read()
    return Result(
        search,
        [Sample(run, search, seed, *seconds) for run in runs],
        seed,
        info=info,
        invalid=invalid,
        seconds=seconds,
    )


def _united(
    search: Search, method: Smc, alive: Mapping[int, Outcome]
) -> tuple[list[_engine.Run], PopulationInfo]:
    """Return the runs and statistics of all populations that did not die."""
    sizes = method.sizes
    infos = [cast(PopulationInfo, outcome.result.info) for outcome in alive.values()]
    info, shifts = infos[0], [0.0]
    if len(sizes) > 1:
        logs = [[sample.log_weight for sample in outcome.result] for outcome in alive.values()]
        parts = zip(
            (sizes[number] for number in alive), (each.log_normaliser for each in infos), logs, strict=True
        )
        log_normaliser, shifts = _engine.united(list(parts), sum(sizes))
        info = _summed(infos, sizes, log_normaliser)
    task = search.task
    pairs = zip(alive.values(), shifts, strict=True)
    return [task.run_of_data(data, shift) for outcome, shift in pairs for data in outcome.runs], info


def _summed(
    infos: Sequence[PopulationInfo], sizes: tuple[int, ...], log_normaliser: float | None
) -> PopulationInfo:
    has_evidence = all(info.log_evidence is not None for info in infos)

    def moves(name: str) -> Count:
        return Count(*map(sum, zip(*(getattr(info, name) for info in infos), strict=True)))

    return PopulationInfo(
        log_evidence=log_normaliser if has_evidence else None,
        log_normaliser=log_normaliser,
        plan=sizes,
        barriers=max(info.barriers for info in infos),
        steps=sum(info.steps for info in infos),
        resampled=sum(info.resampled for info in infos),
        ancestors=sum(info.ancestors for info in infos),
        died=len(sizes) - len(infos),
        powers=infos[0].powers,
        moved_running=moves("moved_running"),
        moved_ended=moves("moved_ended"),
        losses=Losses.of_several(info.losses for info in infos),
    )
