"""Runs of a search on the engine, with their times: by any method, by chains from a sample, by growing a part again."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import replace
from math import inf

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.memory import check_room
from niwaki.errors.settings import bad
from niwaki.errors.warned import warn
from niwaki.lang.compiled import LOOSEN, translated
from niwaki.lang.models import as_model
from niwaki.methods import Emulate, Guide, Hmc, Improve, Method, Mh, Nuts, ParticleGibbs, Vi, at_least_one
from niwaki.methods.room import PARTICLE, check_method
from niwaki.result import Result, Sample
from niwaki.result.chains import MhInfo, Running
from niwaki.result.drawn import Drawn, DrawnInfo
from niwaki.result.hmc import HmcInfo
from niwaki.result.info import (
    INFOS,
    EmulateInfo,
    ImproveInfo,
    Info,
    PopulationInfo,
)
from niwaki.result.invalid import Invalid
from niwaki.result.normals import ViInfo
from niwaki.result.parts import labelled_part
from niwaki.result.progress import EngineWatch
from niwaki.result.search_like import SearchLike
from niwaki.search import emulated
from niwaki.search.checks import check_polish, check_seed, check_threads
from niwaki.search.keeper import Stage
from niwaki.search.kinds import check_number, with_addresses
from niwaki.search.ranges import translated_run
from niwaki.search.warnings import SearchWarning, check_reach


def has_start(method: Method) -> bool:
    """Whether a method starts from a run with known choices."""
    return isinstance(method, Mh | Hmc | Nuts | Vi | ParticleGibbs)


def replay_choices(search: SearchLike, seed: int | None = None) -> Result:
    """Replay the run with the choices of a search; a seed draws missing choices."""
    with translated(search.model.name, choices=search.choices):
        trace = search.task.replay(dict(search.choices or {}), seed)
    return Result(search, [Sample.of_trace(trace, search)], search.seed)


def _start(search: SearchLike, seed: int) -> _engine.Run | None:
    """The run from which chains start."""
    if search.choices is None:
        return None
    with translated(search.model.name, choices=search.choices):
        return search.task.replay(dict(search.choices), seed).run


def run_once(
    search: SearchLike, seed: int, threads: int | None, watch: EngineWatch, stage: Stage | None = None
) -> Result:
    """Make one run of a search, with one seed."""
    check_method(search.method)
    if stage is not None:
        watch = stage.watched(watch)
    start = _start(search, seed)
    if isinstance(search.method, Mh):
        return run_chains(search, search.method, seed, threads, watch, start, stage=stage)
    if isinstance(search.method, Hmc | Nuts):
        return run_trajectories(search, search.method, seed, threads, watch, start)
    if isinstance(search.method, Vi):
        return fit_normals(search, search.method, seed, threads, watch, start)
    if isinstance(search.method, Emulate):
        return run_emulator(search, search.method, seed, watch)
    return _searched(search, seed, threads, watch, start, stage)


def _searched(
    search: SearchLike,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
    stage: Stage | None = None,
    spent: tuple[float, float] = (0.0, 0.0),
) -> Result:
    """Search by a method that the engine runs from its text, after so many seconds and processor seconds."""
    method, attached = engine_form(with_addresses(search))
    counted, clock = search.task.uncounted(), Clock()
    with translated_run(search, seed):
        runs, interrupted, counters = counted.search(
            method,
            seed,
            attached=attached,
            start=start,
            threads=threads,
            watch=watch,
            checkpoint=None if stage is None else stage.engine,
        )
    info = INFOS.get(search.method.NAME, Info)(**counters)
    diverse = getattr(search.method, "diverse", None)
    if isinstance(info, ImproveInfo):
        check_number(info, len(runs), diverse, interrupted)
    elif isinstance(info, PopulationInfo) and diverse is not None:
        runs = distinct(runs, diverse, info)
    if stage is not None:
        stage.collect()
        spent = stage.before
    wall, processor = clock.read()
    seconds = wall + spent[0], processor + spent[1]
    samples = [Sample(run, search, seed, *seconds) for run in runs]
    invalid = [Invalid(*fields) for fields in counted.invalid()]
    return Result(search, samples, seed, info=info, interrupted=interrupted, invalid=invalid, seconds=seconds)


def engine_form(method: Method) -> tuple[str, list[_engine.Task | _engine.Guide]]:
    """A method as text for the engine, and the users' proposals and guides that the text names by number."""
    text, functions = method.text()
    return text, [
        function._engine if isinstance(function, Guide) else _engine.Task(as_model(function).program())
        for function in functions
    ]


class Clock:
    """Clock of wall and processor time since its creation."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()

    def read(self) -> tuple[float, float]:
        """Seconds so far, by the wall clock and of the processor."""
        return time.perf_counter() - self._wall, time.process_time() - self._cpu


def distinct(runs: list[_engine.Run], number: int, info: PopulationInfo | EmulateInfo) -> list[_engine.Run]:
    """The best runs that differ from one another; runs that did not end or are impossible are left out."""
    ended = [run for run in runs if run.has_ended and run.cause is None]
    ranked = sorted(ended, key=lambda run: -run.log_score)
    chosen = [ranked[place] for place in _engine.different(ranked, number)]
    if len(chosen) < number:
        if isinstance(info, PopulationInfo):
            count, cure = len(info.plan), "give more `populations`"
            where = f"{count} population{'' if count == 1 else 's'}"
        else:
            where, cure = f"{info.evaluations} runs", "give more `evaluations`"
        warn(f"only {len(chosen)} of {number} results in {where} differ; {cure}", SearchWarning)
    return chosen


def run_chains(
    search: SearchLike,
    method: Mh,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
    spent: tuple[float, float] = (0.0, 0.0),
    stage: Stage | None = None,
) -> Result:
    """Start chains, or resume those of a stage, and make their proposals.

    Parameters
    ----------
    spent
        Wall and processor seconds of the search before the chains.
    """
    check_reach(search.task, method.kernel, seed)
    text, attached = engine_form(method)
    counted = search.task.uncounted()
    part = None if stage is None else stage.engine
    with translated_run(search, seed):
        chains = _engine.Chains(
            counted, text, seed, attached=attached, start=start, threads=threads, checkpoint=part
        )
    running = Running(chains, counted, watch, threads, stage)
    info = MhInfo(search=search, method=method, seed=seed, _running=running)
    if stage is not None:
        spent = spent[0] + stage.before[0], spent[1] + stage.before[1]
    result = Result(search, [], seed, method=method, info=info, seconds=spent)
    info._go_on(result, None)
    return result


def run_emulator(search: SearchLike, method: Emulate, seed: int, watch: EngineWatch) -> Result:
    """Search by an emulator; the best run, or several that differ."""
    clock = Clock()
    outcome = emulated.emulated(search, seed, watch)
    order = sorted(range(len(outcome.runs)), key=lambda number: -outcome.runs[number].log_score)
    if not order or outcome.runs[order[0]].log_score == -inf:
        raise _impossible(outcome)
    info = EmulateInfo(
        evaluations=outcome.evaluations, choices=outcome.choices, best_at=outcome.numbers[order[0]]
    )
    runs = [outcome.runs[number] for number in order]
    runs = runs[:1] if method.diverse is None else distinct(runs, method.diverse, info)
    seconds = clock.read()
    samples = [Sample(run, search, seed, *seconds) for run in runs]
    return Result(
        search,
        samples,
        seed,
        info=info,
        interrupted=outcome.interrupted,
        invalid=list(outcome.invalid),
        seconds=seconds,
    )


def _impossible(outcome: emulated.Emulated) -> InputError:
    """The error about a search without a possible run."""
    causes = Counter(run.cause or "a choice outside of its range" for run in outcome.runs)
    causes.update({f"`{entry.name}`": entry.runs for entry in outcome.invalid})
    listed = ", ".join(f"{cause} ({count})" for cause, count in causes.most_common())
    return InputError(
        "everything-impossible", barrier="the end", count=causes.total(), constraint=listed, cure=LOOSEN
    )


def run_trajectories(
    search: SearchLike,
    method: Hmc | Nuts,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
) -> Result:
    """Run chains that follow the gradient."""
    counted, clock = search.task.uncounted(), Clock()
    with translated_run(search, seed):
        chains = _engine.Trajectories(
            counted, method.text()[0], seed, start=start, threads=threads, watch=watch
        )
    info = HmcInfo.of(search, seed, chains)
    result = _result_of_draws(counted, info, chains.interrupted, clock)
    info.warn(method)
    return result


def fit_normals(
    search: SearchLike,
    method: Vi,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
) -> Result:
    """Fit normals to the model's distribution."""
    counted, clock = search.task.uncounted(), Clock()
    with translated_run(search, seed):
        normals = _engine.Normals(counted, method.text()[0], seed, start=start, threads=threads, watch=watch)
    info = ViInfo.of(search, seed, normals)
    result = _result_of_draws(counted, info, normals.interrupted, clock)
    info.warn(method, normals.interrupted)
    return result


def _result_of_draws(counted: _engine.Task, info: DrawnInfo, interrupted: bool, clock: Clock) -> Result:
    """The result of a method that stores draws as numbers."""
    seconds = clock.read()
    return Result(
        info.search,
        Drawn(info, seconds),
        info.seed,
        info=info,
        sizes=info.sizes,
        interrupted=interrupted,
        invalid=[Invalid(*fields) for fields in counted.invalid()],
        seconds=seconds,
    )


def regrow(
    search: SearchLike,
    sample: Sample,
    part: str,
    particles: int,
    power: float | None,
    seed: int | None,
    threads: int | None,
) -> Result:
    """Grow one part of a sample again by particles; everything outside of the part stays as it is."""
    if seed is None:
        seed = search.seed if sample.seed is None else sample.seed
    check_seed(seed)
    check_threads(threads)
    check_room("particles", at_least_one("particles", particles), PARTICLE, "particle")
    if power is None:
        power = getattr(search.method, "power", 1.0)
    if not sample.has_ended:
        expected = "a run that has ended"
        raise bad("sample", sample, expected, "more time or particles")
    clock, single = Clock(), replace(search, runs=1, keep="all", polish=None)
    part = labelled_part(part, sample.choices, search.model)
    with translated_run(search, seed):
        runs = search.task.regrow(sample._run, part, particles, power, seed, threads)
    seconds = clock.read()
    return Result(single, [Sample(run, single, seed, *seconds) for run in runs], seed, seconds=seconds)


def polish(
    result: Result,
    method: Mh | Improve,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    stage: Stage | None = None,
) -> Result:
    """Run chains or rounds from the best sample of a result; their time is added to the time of the search.

    A population compares many runs, each built once. A proposal of a chain changes one choice of one run, and
    recomputes only what depends on that choice. So chains improve the best run of a population.
    """
    check_polish(method, may_improve=True)
    check_method(method)
    check_seed(seed)
    check_threads(threads)
    best = result.best
    if not best.has_ended:
        expected = "a search with a run that has ended, for the chain to start from"
        raise bad("polish", best, expected, "more time or particles")
    spent = result.seconds, result.cpu_seconds
    if isinstance(method, Improve):
        search = replace(result.search, method=method, choices=None, runs=1, keep="all", polish=None)
        return _searched(search, seed, threads, watch, best._run, spent=spent)
    watch = watch if stage is None else stage.watched(watch)
    return run_chains(result.search, method, seed, threads, watch, best._run, spent, stage)
