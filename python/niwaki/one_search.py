"""One search with one seed on the engine, by any method, timed."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from niwaki import _engine
from niwaki.compiled import translated
from niwaki.errors import InputError
from niwaki.methods import (
    EnumerateAll,
    Forward,
    Hmc,
    Importance,
    Method,
    Mh,
    Nuts,
    ParticleGibbs,
    Pimh,
    Rejection,
    Smc,
)
from niwaki.result import Result, Sample

if TYPE_CHECKING:
    from niwaki.mh_result import ChainResult
    from niwaki.sketches import Score
    from niwaki.words.models import Model


class SearchWarning(UserWarning):
    """A search gave a result, but less than was asked for."""


@dataclass(frozen=True)
class Progress:
    """How far a search is; given to `progress` now and then.

    Attributes
    ----------
    run, runs : int
        Which of how many runs, from 0.
    done : int
        Barriers of a population, runs of the other methods.
    ended : int
        Particles that have ended.
    best : float
        Best log score of the population so far, nats.
    """

    run: int
    runs: int
    done: int
    ended: int
    best: float


Watch = Callable[[Progress], None]


def _diverse(outcomes: list[_engine.Outcome], wanted: int, populations: int) -> list[_engine.Outcome]:
    """The best of those that differ; runs that did not end or are impossible are none."""
    ended = [one for one in outcomes if one.has_ended and one.cause is None]
    ranked = sorted(ended, key=lambda one: -one.log_score)
    chosen = [ranked[place] for place in _engine.different(ranked, wanted)]
    if len(chosen) < wanted:
        warnings.warn(
            f"{len(chosen)} of {wanted} results that differ were found in {populations} "
            f"population{'' if populations == 1 else 's'}; give more `populations`",
            SearchWarning,
            stacklevel=4,
        )
    return chosen


def once(
    model: Model[..., Any],
    made: _engine.Task,
    method: Method,
    score: Score,
    seed: int,
    threads: int | None,
    progress: Watch | None,
    number: int,
    runs: int,
) -> Result:
    """One search with one seed, timed."""
    watch = told(progress, number, runs)
    if isinstance(method, Mh):
        return chains_of(model, made, method, score, seed, threads, watch)
    if isinstance(method, Hmc | Nuts):
        return trajectories(model, made, method, score, seed, threads, watch)
    made, facts = made.uncounted(), {}
    wall, cpu = time.perf_counter(), time.process_time()
    with translated(model.name, f"seed={seed}"):
        match method:
            case Smc():
                facts = made.smc(
                    method.plan,
                    seed,
                    order=method.order,
                    weights=method.weights,
                    temper=method.temper,
                    anneal=method.anneal,
                    resampling=method.resampling,
                    ess=method.ess,
                    rejuvenate=None if method.rejuvenate is None else method.rejuvenate.form(),
                    moves=method.moves,
                    at=method.at,
                    walks=None if method.draws is None else (method.chains, method.draws),
                    seconds=method.seconds,
                    threads=threads,
                    watch=watch,
                )
                outcomes = facts.pop("particles")
                if method.diverse is not None:
                    outcomes = _diverse(outcomes, method.diverse, len(facts["plan"]))
            case ParticleGibbs():
                facts = made.particle_gibbs(
                    method.particles,
                    method.sweeps,
                    seed,
                    order=method.order,
                    temper=method.temper,
                    anneal=method.anneal,
                    ess=method.ess,
                    ancestors=method.ancestors,
                    start=None if method.start is None else method.start._outcome,
                    threads=threads,
                    watch=watch,
                )
                outcomes = facts.pop("particles")
            case Pimh():
                facts = made.pimh(
                    method.particles,
                    method.sweeps,
                    seed,
                    order=method.order,
                    temper=method.temper,
                    anneal=method.anneal,
                    resampling=method.resampling,
                    ess=method.ess,
                    threads=threads,
                    watch=watch,
                )
                outcomes = facts.pop("particles")
            case EnumerateAll():
                table, log_evidence, count = made.enumerate(method.max_runs, watch)
                outcomes, facts = [], {"log_evidence": log_evidence, "table": table, "tries": count}
            case Rejection():
                outcomes, tries, stopped = made.rejection(
                    method.n, method.bound, method.max_tries, seed, watch
                )
                facts = {"tries": tries, "interrupted": stopped}
            case Importance():
                outcomes, log_evidence = made.importance(method.n, seed, threads, watch)
                facts = {"log_evidence": log_evidence, "interrupted": len(outcomes) < method.n}
            case Forward():
                outcomes = made.forward(seed, method.n, watch)
                facts = {"interrupted": len(outcomes) < method.n}
            case _:
                raise InputError(
                    "bad-setting",
                    name="method",
                    found=repr(method),
                    expected="smc, particle_gibbs, pimh, mh, hmc, nuts, enumerate_all, rejection, importance, forward",
                    suggestion="such a method, for instance `smc(particles=300)`",
                )
    seconds, cpu_seconds = time.perf_counter() - wall, time.process_time() - cpu
    samples = [Sample(outcome, made, score, seed, seconds, cpu_seconds) for outcome in outcomes]
    result = Result(model, samples, seed, method, score, invalid=made.invalid(), **facts)
    result.seconds, result.cpu_seconds = seconds, cpu_seconds
    return result


def told(progress: Watch | None, number: int, runs: int) -> Callable[[int, int, float], None]:
    """What the engine tells, as a `Progress`."""

    def watch(done: int, ended: int, best: float) -> None:
        if progress is not None:
            progress(Progress(number, runs, done, ended, best))

    return watch


def chains_of(
    model: Model[..., Any],
    made: _engine.Task,
    method: Mh,
    score: Score,
    seed: int,
    threads: int | None,
    watch: Callable[[int, int, float], None],
    known: Mapping[int, Any] | None = None,
) -> ChainResult:
    """Chains in their first states, and their first proposals."""
    from niwaki.mh_result import ChainResult

    made = made.uncounted()
    kernel, temperatures, every = method.kernel, None, 1
    if kernel is not None and kernel.name == "temper":
        (temperatures, every), (kernel,) = kernel.settings, kernel.parts
    with translated(model.name, f"seed={seed}"):
        chains = _engine.Chains(
            made,
            seed,
            kernel=None if kernel is None else kernel.form(),
            temperatures=temperatures,
            every=every,
            chains=method.chains,
            strategy=method.strategy,
            warmup=method.warmup,
            thin=method.spacing,
            tries=method.tries,
            known=known,
            threads=threads,
        )
    return ChainResult(model, made, chains, seed, method, score, watch, threads).more(method.steps)


def trajectories(
    model: Model[..., Any],
    made: _engine.Task,
    method: Hmc | Nuts,
    score: Score,
    seed: int,
    threads: int | None,
    watch: Callable[[int, int, float], None],
    known: Mapping[int, Any] | None = None,
) -> Result:
    """Chains that follow the gradient, timed."""
    from niwaki.hmc_result import HmcResult

    length: dict[str, Any] = (
        {"max_depth": method.max_depth}
        if isinstance(method, Nuts)
        else {"steps": method.steps, "jitter": method.jitter}
    )
    made = made.uncounted()
    wall, cpu = time.perf_counter(), time.process_time()
    with translated(model.name, f"seed={seed}"):
        found = _engine.Trajectories(
            made,
            seed,
            chains=method.chains,
            draws=method.draws,
            warmup=method.warmup,
            thin=method.thin,
            target_accept=method.target_accept,
            metric=method.metric,
            step_size=method.step_size,
            climb=method.climb,
            tries=method.tries,
            known=known,
            threads=threads,
            watch=watch,
            **length,
        )
    seconds, cpu_seconds = time.perf_counter() - wall, time.process_time() - cpu
    result = HmcResult(model, made, found, seed, method, score, seconds, cpu_seconds)
    result.warn()
    return result
