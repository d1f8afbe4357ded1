"""Running a search on the engine, timed: one run after the other, each by its method."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Sequence
from dataclasses import astuple, replace
from math import exp
from typing import Any

from msgspec import Struct

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.errors.memory import check_room
from niwaki.errors.schema import Unfit, fitted
from niwaki.errors.settings import bad
from niwaki.lang.compiled import translated
from niwaki.lang.models import as_model
from niwaki.methods import Forward, Guide, Hmc, Method, Mh, Nuts, ParticleGibbs, Vi, at_least_one
from niwaki.methods.room import PARTICLE, RUN, check_method
from niwaki.result import Result, Sample
from niwaki.result.chains import MhInfo, Running
from niwaki.result.drawn import Drawn, DrawnInfo
from niwaki.result.hmc import HmcInfo
from niwaki.result.info import (
    INFOS,
    ImproveInfo,
    Info,
    PopulationInfo,
    restored_info,
    stored_info,
    without_evidence,
)
from niwaki.result.invalid import Invalid, merged
from niwaki.result.normals import ViInfo
from niwaki.result.progress import EngineWatch, Watch, watcher
from niwaki.result.search_like import SearchLike
from niwaki.search.checkpoint import Checkpoint, understood
from niwaki.search.checks import check_polish, check_seed, check_threads
from niwaki.search.keeping import Keeper, Stage
from niwaki.search.worth import SearchWarning, check_kinds, check_reach, check_worth

#: So many of the things that a guide has lost are named.
SHOWN = 6

#: Of so many samples or more, fewer effective ones than this are a collapse of their weights.
MANY, COLLAPSED = 20, 2.0


class Left(Struct):
    """What a run gave, in a checkpoint: runs as data with their seconds, and what a `Result` has beside them."""

    samples: list[tuple[str, float, float]]
    info: dict[str, Any] | None
    invalid: list[tuple[str, str, int, int, str, str]]
    seconds: tuple[float, float]


def keeper(search: SearchLike, checkpoint: Checkpoint) -> Keeper:
    """What keeps the checkpoint of a search; an error where the file is of another one."""
    return Keeper(checkpoint, "search", search.about, search.data())


def carried_out(
    search: SearchLike,
    threads: int | None,
    progress: Watch | None,
    keeper: Keeper | None = None,
    once: Callable[[SearchLike, int, int | None, EngineWatch, Stage | None], Result] | None = None,
) -> Result:
    """Run a search, run by run, each by `once`: on the engine here, when it is left out.

    With a `keeper` it goes on from its checkpoint, which has a stage for each run and each polishing, and what a run
    gave that is done.

    Runs in which every particle became impossible are left out with a warning, and are an error when there is no other.
    """
    if search.choices is not None and not starts(search.method):
        return given(search)
    once = once or searched
    if search.runs > 1:
        check_room("runs", search.runs, RUN, "run")
    guides = [one for one in search.method.text()[1] if isinstance(one, Guide)]
    for guide in guides:
        _check_guide(search, guide)
    if not isinstance(search.method, Forward):
        check_kinds(search.task, search.seed)
    if search.runs == 1 and search.keep == "all" and search.polish is None:
        result = once(search, search.seed, threads, watcher(progress, search), _stage(keeper, "0/search"))
        if guides:
            _check_weights(result)
        if keeper is not None:
            keeper.finish(result.interrupted)
        return result
    found: list[Sample] = []
    failed: list[InputError | ModelFault] = []
    invalid: tuple[Invalid, ...] = ()
    spent, interrupted = 0.0, False
    info = Info()
    for number in range(search.runs):
        watch = watcher(progress, search, number, search.runs)
        seed = (search.seed + number) % 2**64
        try:
            done = _left(keeper, f"{number}/done", search, seed)
            begun = None if done is not None else _left(keeper, f"{number}/begun", search, seed)
            one = begun if done is None else done
            if one is None:
                one = once(search, seed, threads, watch, _stage(keeper, f"{number}/search"))
        except (InputError, ModelFault) as error:
            if error.code != "everything-impossible" and not error.values.get("invalid"):
                raise
            failed.append(error)
            continue
        except KeyboardInterrupt:
            # Ctrl-C between two checks of the engine.
            if not found:
                raise
            interrupted = True
            break
        # Several runs share the statistics of the last one, without evidence; runs of chains have none.
        if not isinstance(one.info, MhInfo | DrawnInfo):
            info = without_evidence(one.info)
        interrupted = one.interrupted
        invalid = merged(invalid, one.invalid)
        if interrupted and found and not any(sample.has_ended for sample in one):
            spent += one.seconds
            break
        if search.polish is not None and not interrupted and done is None:
            if begun is None:
                begun = one
                _leave(keeper, f"{number}/begun", one, [one.best])
            stage = _stage(keeper, f"{number}/polish")
            one = polished(begun, search.polish, one.seed, threads, watch, stage)
            invalid = merged(invalid, one.invalid)
            one.invalid = merged(begun.invalid, one.invalid)
            interrupted = one.interrupted
        spent += one.seconds
        is_diverse = getattr(search.method, "diverse", None) is not None
        samples = list(one.samples) if is_diverse or search.keep == "all" else [one.best]
        found.extend(samples)
        if interrupted:
            break
        if done is None:
            _leave(keeper, f"{number}/done", one, samples, info)
    if failed and not found:
        raise failed[0]
    if failed:
        warnings.warn(
            f"{len(failed)} of {search.runs} runs became impossible and are left out{_lost(failed[0])}",
            SearchWarning,
            stacklevel=4,
        )
    if search.score.asks and search.keep == "best":
        check_worth(search.task, search.score, max(found, key=lambda sample: sample.log_score))
    seconds = spent, sum(sample.cpu_seconds for sample in found)
    if keeper is not None:
        keeper.finish(interrupted)
    return Result(
        search, found, search.seed, info=info, interrupted=interrupted, invalid=invalid, seconds=seconds
    )


def _stage(keeper: Keeper | None, name: str) -> Stage | None:
    return None if keeper is None else keeper.stage(name)


def _leave(
    keeper: Keeper | None, name: str, result: Result, samples: Sequence[Sample], info: Info | None = None
) -> None:
    """Keep what a run gave in its checkpoint, in place of what it needed to go on."""
    if keeper is None:
        return
    keeper.drop(f"{name.partition('/')[0]}/")
    keeper.put(
        name,
        {
            "samples": [(one._run.data(), one.seconds, one.cpu_seconds) for one in samples],
            "info": stored_info(result.info if info is None else info),
            "invalid": [astuple(one) for one in result.invalid],
            "seconds": (result.seconds, result.cpu_seconds),
        },
    )
    keeper.write_if_due()


def _left(keeper: Keeper | None, name: str, search: SearchLike, seed: int) -> Result | None:
    """What a run gave, in the checkpoint; None where it is not there."""
    data = None if keeper is None else keeper.get(name)
    if keeper is None or data is None:
        return None
    with understood(keeper.path):
        left = fitted(data, Left)
        runs = [Sample(search.task.run_of_data(run), search, seed, *spent) for run, *spent in left.samples]
        if not runs:
            raise Unfit("$.samples", "at least one run", "none")
        for one in runs:
            # Whether it is a run of this model.
            _ = one.choices
        info = restored_info(left.info)
        invalid = [Invalid(*one) for one in left.invalid]
    return Result(search, runs, seed, info=info, invalid=invalid, seconds=left.seconds)


def _lost(error: InputError | ModelFault) -> str:
    """What made a run impossible, where, and what helps."""
    if not isinstance(error, InputError):
        return f": {error.message}"
    said = error.values.get("often") or error.values.get("constraint", "")
    return f": {said}; {error.values.get('cure', '')}"


def _check_guide(search: SearchLike, guide: Guide) -> None:
    """Warn where a guide is of another version of the model."""
    with translated(search.model.name):
        lost = guide._engine.lost(search.task)
    if lost:
        shown = "; ".join([*lost[:SHOWN], *([f"and {len(lost) - SHOWN} more"] if len(lost) > SHOWN else [])])
        warnings.warn(
            f"the guide of `{guide.model}` was trained for another version of the model, and only what matches is "
            f"used: {shown}",
            SearchWarning,
            stacklevel=5,
        )


def _check_weights(result: Result) -> None:
    """Warn where one of many samples has all the weight.

    Each choice's weight is bounded, their product is not. Resampling brings the weights back, so this happens where a
    method does not resample, or does so seldom.
    """
    if len(result) < MANY or result.interrupted:
        return
    logs = [sample.log_weight for sample in result]
    shares = [exp(one - max(logs)) for one in logs]
    effective = sum(shares) ** 2 / sum(share**2 for share in shares)
    if effective < COLLAPSED:
        warnings.warn(
            f"{effective:.1f} of {len(result)} samples are effective: what a guide drew weighs too unevenly. Resample "
            '(`smc` with `resampling="tempered"` and without `ess`), or train the guide with a larger `share`',
            SearchWarning,
            stacklevel=5,
        )


def starts(method: Method) -> bool:
    """Whether a method starts from a run whose choices are given."""
    return isinstance(method, Mh | Hmc | Nuts | Vi | ParticleGibbs)


def given(search: SearchLike, seed: int | None = None) -> Result:
    """The one run whose choices are given; missing ones are drawn if there is a seed."""
    with translated(search.model.name, choices=search.choices):
        trace = search.task.replay(dict(search.choices or {}), seed)
    return Result(search, [Sample.of_trace(trace, search)], search.seed)


def _start(search: SearchLike, seed: int) -> _engine.Run | None:
    """The run that chains start from."""
    if search.choices is None:
        return None
    with translated(search.model.name, choices=search.choices):
        return search.task.replay(dict(search.choices), seed).run


def searched(
    search: SearchLike, seed: int, threads: int | None, watch: EngineWatch, stage: Stage | None = None
) -> Result:
    """One run of a search, with one seed."""
    check_method(search.method)
    if stage is not None:
        watch = stage.watched(watch)
    start = _start(search, seed)
    if isinstance(search.method, Mh):
        return chains_of(search, search.method, seed, threads, watch, start, stage=stage)
    if isinstance(search.method, Hmc | Nuts):
        return trajectories(search, search.method, seed, threads, watch, start)
    if isinstance(search.method, Vi):
        return normals(search, search.method, seed, threads, watch, start)
    method, attached = _written(search.method)
    counted, clock = search.task.uncounted(), Clock()
    with translated(search.model.name, f"seed={seed}"):
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
    if diverse is not None:
        runs = different(runs, diverse, info)
    seconds = clock.read()
    if stage is not None:
        stage.collect()
        seconds = seconds[0] + stage.before[0], seconds[1] + stage.before[1]
    samples = [Sample(run, search, seed, *seconds) for run in runs]
    invalid = [Invalid(*one) for one in counted.invalid()]
    return Result(search, samples, seed, info=info, interrupted=interrupted, invalid=invalid, seconds=seconds)


def _written(method: Method) -> tuple[str, list[_engine.Task | _engine.Guide]]:
    """A method as the engine reads it, and the users' proposals and guides that it names."""
    text, attached = method.text()
    return text, [
        one._engine if isinstance(one, Guide) else _engine.Task(as_model(one).program()) for one in attached
    ]


class Clock:
    """Wall and processor time since its creation."""

    def __init__(self) -> None:
        self._wall, self._cpu = time.perf_counter(), time.process_time()

    def read(self) -> tuple[float, float]:
        """Seconds so far, of the wall and of the processor."""
        return time.perf_counter() - self._wall, time.process_time() - self._cpu


def different(runs: list[_engine.Run], wanted: int, info: Info) -> list[_engine.Run]:
    """The best of those that differ; runs that did not end or are impossible are none."""
    ended = [one for one in runs if one.has_ended and one.cause is None]
    ranked = sorted(ended, key=lambda one: -one.log_score)
    chosen = [ranked[place] for place in _engine.different(ranked, wanted)]
    if len(chosen) < wanted:
        if isinstance(info, PopulationInfo):
            count, cure = len(info.plan), "give more `populations`"
            where = f"{count} population{'' if count == 1 else 's'}"
        else:
            count = info.searches if isinstance(info, ImproveInfo) else 1
            cure = "give another `seed`, or accept that the model has few"
            where = f"{count} search{'' if count == 1 else 'es'}"
        warnings.warn(
            f"{len(chosen)} of {wanted} results that differ are in {where}; {cure}",
            SearchWarning,
            stacklevel=6,
        )
    return chosen


def chains_of(
    search: SearchLike,
    method: Mh,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
    spent: tuple[float, float] = (0.0, 0.0),
    stage: Stage | None = None,
) -> Result:
    """Chains in their first states, and their first proposals; `spent` are the seconds of the search before.

    Chains of a stage that was begun go on from where they were.
    """
    check_reach(search.task, method.kernel, seed)
    text, attached = _written(method)
    counted = search.task.uncounted()
    kept = None if stage is None else stage.engine
    with translated(search.model.name, f"seed={seed}"):
        chains = _engine.Chains(
            counted, text, seed, attached=attached, start=start, threads=threads, checkpoint=kept
        )
    running = Running(chains, counted, watch, threads, stage)
    info = MhInfo(search=search, method=method, seed=seed, _running=running)
    if stage is not None:
        spent = spent[0] + stage.before[0], spent[1] + stage.before[1]
    result = Result(search, [], seed, method=method, info=info, seconds=spent)
    info._go_on(result, None)
    return result


def trajectories(
    search: SearchLike,
    method: Hmc | Nuts,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
) -> Result:
    """Chains that follow the gradient."""
    counted, clock = search.task.uncounted(), Clock()
    with translated(search.model.name, f"seed={seed}"):
        found = _engine.Trajectories(
            counted, method.text()[0], seed, start=start, threads=threads, watch=watch
        )
    info = HmcInfo.of(search, seed, found)
    result = _drawn(counted, info, found.interrupted, clock)
    info.warn(method)
    return result


def normals(
    search: SearchLike,
    method: Vi,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    start: _engine.Run | None,
) -> Result:
    """Normals near the model's distribution."""
    counted, clock = search.task.uncounted(), Clock()
    with translated(search.model.name, f"seed={seed}"):
        found = _engine.Normals(counted, method.text()[0], seed, start=start, threads=threads, watch=watch)
    info = ViInfo.of(search, seed, found)
    result = _drawn(counted, info, found.interrupted, clock)
    info.warn(method, found.interrupted)
    return result


def _drawn(counted: _engine.Task, info: DrawnInfo, interrupted: bool, clock: Clock) -> Result:
    """The result of a method whose draws are kept as numbers."""
    seconds = clock.read()
    return Result(
        info.search,
        Drawn(info, seconds),
        info.seed,
        info=info,
        sizes=info.sizes,
        interrupted=interrupted,
        invalid=[Invalid(*one) for one in counted.invalid()],
        seconds=seconds,
    )


def regrown(
    search: SearchLike,
    sample: Sample,
    part: str,
    particles: int,
    power: float | None,
    seed: int | None,
    threads: int | None,
) -> Result:
    """One part of a sample grown again by particles, with everything outside of it as it is."""
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
    clock, own = Clock(), replace(search, runs=1, keep="all", polish=None)
    with translated(search.model.name, f"seed={seed}"):
        runs = search.task.regrow(sample._run, part, particles, power, seed, threads)
    seconds = clock.read()
    return Result(own, [Sample(run, own, seed, *seconds) for run in runs], seed, seconds=seconds)


def polished(
    result: Result,
    method: Mh,
    seed: int,
    threads: int | None,
    watch: EngineWatch,
    stage: Stage | None = None,
) -> Result:
    """Chains from the best sample of a result; their time is added to that of the search.

    A population compares many runs, each built once. A proposal of a chain changes one choice of one run, and costs
    only what depends on it. So chains improve the best of a population.
    """
    check_polish(method)
    check_method(method)
    check_seed(seed)
    check_threads(threads)
    best = result.best
    if not best.has_ended:
        expected = "a search with a run that has ended, for the chain to start from"
        raise bad("polish", best, expected, "more time or particles")
    spent = result.seconds, result.cpu_seconds
    watch = watch if stage is None else stage.watched(watch)
    return chains_of(result.search, method, seed, threads, watch, best._run, spent, stage)
