"""The populations of one search on many workers: the same result, to the bit, wherever each of them ran.

A population shares nothing with the others but its search's seed, which gives each a seed of its own. So it is a search
by itself, and a batch does it. What comes back is combined as the engine combines populations that it ran itself
(crates/particles/src/many.rs): by their estimates of the normalising constant, those that died as zero.
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
from niwaki.batches.running import Watch
from niwaki.errors.settings import bad
from niwaki.methods import Smc
from niwaki.result import Result, Sample
from niwaki.result.info import Count, Losses, PopulationInfo
from niwaki.result.invalid import merged
from niwaki.result.search_like import SearchLike
from niwaki.search import Search
from niwaki.search.engine_runs import Clock, distinct
from niwaki.search.execution import execute

#: The fault of a population whose particles have all become impossible: it counts, with an estimate of zero.
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
    """Carry out a search by `smc` whose populations run on many workers.

    The result is that of `search.run()`, but for its seconds, and `invalid` does not count populations that died. One
    population that has all particles is better than many small ones: fill the memory of a worker before you add
    populations.

    Parameters
    ----------
    search
        A search by `smc` with `populations=`, `diverse=` or several numbers of particles.
    folder
        Where populations are stored, so that a search that was stopped goes on; in a folder of their own for each size.
    processes, executor, chunk, progress
        As for `batch`.

    Raises
    ------
    InputError
        The search is not by `smc`, or is told by seconds; or as for `batch`.
    ModelFault
        The fault of the model, or of the first population where all have died.
    """
    method = search.method
    if not isinstance(method, Smc) or method.seconds is not None:
        raise bad("method", method, "`smc` with a number of particles", "smc(particles=1000, populations=16)")
    workers = {"processes": processes, "executor": executor, "chunk": chunk, "progress": progress}

    def one(_: SearchLike, seed: int, *rest: Any) -> Result:
        return _populations(search, method, seed, folder, workers)

    return execute(search, None, None, runner=one)


def _populations(
    search: Search, method: Smc, seed: int, folder: str | PathLike[str] | None, workers: Mapping[str, Any]
) -> Result:
    """One run of a search, its populations as batches of those of one size."""
    sizes, clock = method.sizes, Clock()
    count = len(sizes)
    each = [_engine.population(seed, number, count, search.max_memory) for number in range(count)]
    found: dict[int, Outcome] = {}
    for size in sorted(set(sizes)):
        numbers = {each[number][0]: number for number in range(count) if sizes[number] == size}
        alone = replace(method, particles=size, populations=1, diverse=None)
        own = replace(search, method=alone, runs=1, keep="all", polish=None, max_memory=each[0][1])
        place = None if folder is None else Path(folder) / str(size)
        for one in batch(own, seeds=numbers, folder=place, **workers):
            if one.fault not in (None, DIED):
                one.search.run(threads=1)  # It raises the fault, with its places.
            found[numbers[one.seed]] = one
    lived = {number: one for number, one in sorted(found.items()) if one.fault is None}
    if not lived:
        found[0].search.run(threads=1)
    invalid = merged(*(outcome.result.invalid for outcome in lived.values()))
    runs, info = _united(search, method, lived)
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
    search: Search, method: Smc, lived: Mapping[int, Outcome]
) -> tuple[list[_engine.Run], PopulationInfo]:
    """The populations that lived, by number, as one."""
    sizes = method.sizes
    infos = [cast(PopulationInfo, one.result.info) for one in lived.values()]
    info, shifts = infos[0], [0.0]
    if len(sizes) > 1:
        logs = [[sample.log_weight for sample in one.result] for one in lived.values()]
        parts = zip(
            (sizes[number] for number in lived), (one.log_normaliser for one in infos), logs, strict=True
        )
        log_normaliser, shifts = _engine.united(list(parts), sum(sizes))
        info = _summed(infos, sizes, log_normaliser)
    task = search.task
    pairs = zip(lived.values(), shifts, strict=True)
    return [task.run_of_data(data, shift) for one, shift in pairs for data in one.runs], info


def _summed(
    infos: Sequence[PopulationInfo], sizes: tuple[int, ...], log_normaliser: float | None
) -> PopulationInfo:
    has_evidence = all(one.log_evidence is not None for one in infos)

    def moved(name: str) -> Count:
        return Count(*map(sum, zip(*(getattr(one, name) for one in infos), strict=True)))

    return PopulationInfo(
        log_evidence=log_normaliser if has_evidence else None,
        log_normaliser=log_normaliser,
        plan=sizes,
        barriers=max(one.barriers for one in infos),
        steps=sum(one.steps for one in infos),
        resampled=sum(one.resampled for one in infos),
        ancestors=sum(one.ancestors for one in infos),
        died=len(sizes) - len(infos),
        powers=infos[0].powers,
        moved_running=moved("moved_running"),
        moved_ended=moved("moved_ended"),
        losses=Losses.of_several(one.losses for one in infos),
    )
