"""Running models on the engine: `run` with any method, and `grow` into a target.

Seeds are 64-bit numbers; where none is given a fresh one is drawn and kept in the result. The same seed gives the same
result on any number of threads. Ctrl-C stops a search, which then gives what it has (`Result.interrupted`).
"""

from __future__ import annotations

import secrets
import time
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

from niwaki import _engine
from niwaki.compiled import as_model, task, translated
from niwaki.errors import InputError
from niwaki.methods import EnumerateAll, Forward, Importance, Method, Mh, Rejection, Smc, smc
from niwaki.result import Result, Sample
from niwaki.sketches import Score, no_self_intersection, volume_match
from niwaki.words.models import Model

if TYPE_CHECKING:
    from niwaki.target import Target


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


def run(
    model: Model[..., Any] | Callable[..., Any],
    *args: Any,
    method: Method | None = None,
    score: Score | None = None,
    seed: int | None = None,
    choices: Mapping[str, Any] | None = None,
    max_steps: int = 20_000_000,
    max_memory: int = 1 << 30,
    threads: int | None = None,
    progress: Watch | None = None,
    **kwargs: Any,
) -> Result:
    """Run a model on the engine.

    Parameters
    ----------
    model
        A model, or a function of the modelling language.
    args, kwargs
        Its arguments.
    method
        `smc(...)`, `mh(...)`, `enumerate_all(...)`, `rejection(...)`, `importance(...)` or `forward(...)`, which is also
        what happens when it is left out. It may also stand right after the model.
    score
        What its scene should be like.
    seed
        Decides every random choice; fresh when left out.
    choices
        Values of choices by address, for one run with those: others are drawn from `seed` where it is given, and
        missing ones are an error where it is not. With `mh`, the chains start from them.
    max_steps
        Most calls and loop steps of one run.
    max_memory
        Most bytes of a run or a population.
    threads
        How many to use; all of the machine's when left out. The result does not depend on it.
    progress
        Called now and then with a `Progress`; what it raises ends the search.

    Returns
    -------
    Result
        The samples, with weights; for enumeration the exact distribution.
    """
    model = as_model(model)
    if method is None and args and isinstance(args[0], Method):
        method, args = args[0], args[1:]
    if seed is None and isinstance(method, Mh):
        seed = method.seed
    score = score if score is not None else Score()
    if not isinstance(score, Score):
        raise InputError(
            "bad-setting",
            name="score",
            found=repr(score),
            expected="a product of sketches",
            suggestion="`no_self_intersection() * volume_match(target)`",
        )
    given_seed = check_seed(seed)
    made = task(model, args, kwargs, score.specs, max_steps, max_memory)
    if choices is not None and not isinstance(method, Mh):
        with translated(model.name, choices=choices):
            trace = made.replay(dict(choices), given_seed if seed is not None else None)
        return Result(model, [Sample.of_trace(trace, made, score)], given_seed, "choices", score)
    if choices is not None and isinstance(method, Mh):
        with translated(model.name, choices=choices):
            first = made.replay(dict(choices), given_seed)
        known = {choice[1]: choice[3] for choice in first.choices}
        return _chains(model, made, method, score, given_seed, check_threads(threads), _told(progress, 0, 1), known)
    return _search(
        model, made, method or Forward(), score, given_seed, check_threads(threads), progress, 0, 1
    )


def grow(
    model: Model[..., Any] | Callable[..., Any],
    target: Target | str | PathLike[str],
    *args: Any,
    particles: int = 300,
    voxel: float | None = None,
    sigma: float = 0.02,
    order: str = "stochastic",
    weights: str = "ratio",
    temper: float | None = None,
    resampling: str = "systematic",
    ess: float | None = None,
    rule: str = "solid",
    runs: int = 1,
    seed: int | None = None,
    max_steps: int = 20_000_000,
    max_memory: int = 1 << 30,
    threads: int | None = None,
    progress: Watch | None = None,
    **kwargs: Any,
) -> Result:
    """Grow a model into a target: the best of a population, `runs` times.

    Parameters
    ----------
    model
        A model that emits shapes.
    target
        What to fill: a `Target`, or a file.
    args, kwargs
        The model's arguments.
    particles, order, weights, resampling, ess
        As for `smc`.
    temper
        As for `smc`; when left out 16 with ratio weights, 1 with absolute ones.
    voxel, sigma
        As for `volume_match`.
    rule
        As for `no_self_intersection`.
    runs
        How many results, with seeds `seed`, `seed + 1`, ...
    seed, max_steps, max_memory, threads, progress
        As for `run`.

    Returns
    -------
    Result
        One sample for each run, the best of its population; runs in which every particle became impossible are left
        out with a warning, and are an error when there is no other.
    """
    from niwaki.target import Target

    model = as_model(model)
    chosen = smc(
        particles, order, weights, default_temper(weights) if temper is None else temper, resampling, ess
    )
    if not isinstance(runs, int) or runs < 1:
        raise InputError(
            "bad-setting",
            name="runs",
            found=repr(runs),
            expected="a whole number above 0",
            suggestion="1 or more",
        )
    first, threads = check_seed(seed), check_threads(threads)
    aim = target if isinstance(target, Target) else Target.load(target)
    score = no_self_intersection(rule) * volume_match(aim, voxel, sigma)
    made = task(model, args, kwargs, score.specs, max_steps, max_memory)
    found: list[Sample] = []
    failed: list[InputError] = []
    seconds, interrupted = 0.0, False
    for number in range(runs):
        try:
            one = _search(
                model, made, chosen, score, (first + number) % 2**64, threads, progress, number, runs
            )
        except InputError as error:
            if error.code != "everything-impossible":
                raise
            failed.append(error)
            continue
        except KeyboardInterrupt:
            # Pressed between two looks of the engine.
            if not found:
                raise
            interrupted = True
            break
        seconds += one.seconds
        interrupted = one.interrupted
        if one.interrupted and found and not any(sample.has_ended for sample in one):
            break
        found.append(one.best)
        if interrupted:
            break
    if failed and not found:
        raise failed[0]
    if failed:
        warnings.warn(
            f"{len(failed)} of {runs} runs became impossible and are left out; use more particles",
            SearchWarning,
            stacklevel=2,
        )
    result = Result(model, found, first, chosen, score, interrupted=interrupted)
    result.seconds = seconds
    return result


def default_temper(weights: str) -> float:
    """The temperature of a search whose user gave none."""
    return 16.0 if weights == "ratio" else 1.0


def explain(
    model: Model[..., Any] | Callable[..., Any],
    choice: str,
    *args: Any,
    seed: int = 0,
    max_steps: int = 20_000_000,
    **kwargs: Any,
) -> dict[str, Any]:
    """What each strategy does for one proposal from the prior, in the first state of a seed.

    Parameters
    ----------
    model
        A model.
    choice
        The address of the choice that is changed, or a pattern: the first that matches.
    args, kwargs
        The model's arguments.
    seed, max_steps
        As for `run`.

    Returns
    -------
    dict
        `activations`: the calls and loop iterations, each before those it makes, as (label, function, depth, number of
        the caller); `home`: which of them holds the choice; `path`, `old` and `new`; `runs`: by strategy what happened
        ("invoked", "unwound", "skipped", "made" or "removed", and the number of the activation), and whether the run
        came to its end. `niwaki.draw.reuse.draw` draws it.
    """
    model = as_model(model)
    made = task(model, args, kwargs, (), max_steps)
    with translated(model.name, f"seed={seed}"):
        return _engine.explain(made, check_seed(seed), choice)


def check_seed(seed: int | None) -> int:
    """The seed, or a fresh one."""
    if seed is None:
        return secrets.randbits(32)
    if not isinstance(seed, int) or isinstance(seed, bool) or not 0 <= seed < 2**64:
        raise InputError(
            "bad-setting",
            name="seed",
            found=repr(seed),
            expected="a whole number from 0 to 2**64 - 1",
            suggestion="such a number, or leave it out",
        )
    return seed


def check_threads(threads: int | None) -> int | None:
    """The number of threads, where it makes sense."""
    if threads is not None and (not isinstance(threads, int) or not 1 <= threads <= 1024):
        raise InputError(
            "bad-setting",
            name="threads",
            found=repr(threads),
            expected="a whole number from 1 to 1024",
            suggestion="such a number, or leave it out for all cores",
        )
    return threads


def _search(
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

    watch = _told(progress, number, runs)
    if isinstance(method, Mh):
        return _chains(model, made, method, score, seed, threads, watch)
    facts: dict[str, Any] = {}
    wall, cpu = time.perf_counter(), time.process_time()
    with translated(model.name, f"seed={seed}"):
        match method:
            case Smc():
                found = made.smc(
                    method.particles,
                    seed,
                    order=method.order,
                    weights=method.weights,
                    temper=method.temper,
                    resampling=method.resampling,
                    ess=method.ess,
                    threads=threads,
                    watch=watch,
                )
                outcomes = found.pop("particles")
                facts = found
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
                    expected="smc, mh, enumerate_all, rejection, importance or forward",
                    suggestion="such a method, for instance `smc(particles=300)`",
                )
    seconds, cpu_seconds = time.perf_counter() - wall, time.process_time() - cpu
    samples = [Sample(outcome, made, score, seed, seconds, cpu_seconds) for outcome in outcomes]
    result = Result(model, samples, seed, method, score, **facts)
    result.seconds, result.cpu_seconds = seconds, cpu_seconds
    return result


def _told(progress: Watch | None, number: int, runs: int) -> Callable[[int, int, float], None]:
    """What the engine tells, as a `Progress`."""

    def watch(done: int, ended: int, best: float) -> None:
        if progress is not None:
            progress(Progress(number, runs, done, ended, best))

    return watch


def _chains(
    model: Model[..., Any],
    made: _engine.Task,
    method: Mh,
    score: Score,
    seed: int,
    threads: int | None,
    watch: Callable[[int, int, float], None],
    known: Mapping[int, Any] | None = None,
) -> Result:
    """Chains in their first states, and their first proposals."""
    from niwaki.mh_result import ChainResult

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
