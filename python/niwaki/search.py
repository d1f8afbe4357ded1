"""Running models on the engine: `run` with any method, and `grow` into a target.

Seeds are 64-bit numbers; where none is given a fresh one is drawn and kept in the result. The same seed gives the same
result on any number of threads. Ctrl-C stops a search, which then gives what it has (`Result.interrupted`).
"""

from __future__ import annotations

import secrets
import warnings
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any

from niwaki import _engine
from niwaki.compiled import as_model, task, translated
from niwaki.errors import InputError, ModelFault
from niwaki.methods import Forward, Hmc, Method, Mh, Nuts, Smc, smc
from niwaki.one_search import Progress, SearchWarning, Watch, chains_of, once, told, trajectories
from niwaki.polish import polished
from niwaki.result import Result, Sample
from niwaki.sketches import Score, no_self_intersection, volume_match
from niwaki.words.models import Model

if TYPE_CHECKING:
    from niwaki.kernels import Kernel
    from niwaki.target import Target

__all__ = ["Progress", "SearchWarning", "Watch", "explain", "grow", "run"]


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
        `smc(...)`, `particle_gibbs(...)`, `pimh(...)`, `mh(...)`, `enumerate_all(...)`, `rejection(...)`,
        `importance(...)`, `hmc(...)`, `nuts(...)` or `forward(...)`, which is also what happens when it is left out.
        It may also stand right after the model.
    score
        What its scene should be like.
    seed
        Decides every random choice; fresh when left out.
    choices
        Values of choices by address, for one run with those: others are drawn from `seed` where it is given, and
        missing ones are an error where it is not. With `mh`, `hmc` and `nuts`, the chains start from them.
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
    score = _asked(score)
    given_seed = check_seed(seed)
    made = task(model, args, kwargs, score.specs, max_steps, max_memory)
    if choices is not None and not isinstance(method, Mh | Hmc | Nuts):
        with translated(model.name, choices=choices):
            trace = made.replay(dict(choices), given_seed if seed is not None else None)
        return Result(model, [Sample.of_trace(trace, made, score)], given_seed, "choices", score)
    if choices is not None and isinstance(method, Mh | Hmc | Nuts):
        with translated(model.name, choices=choices):
            first = made.replay(dict(choices), given_seed)
        known = {choice[1]: choice[3] for choice in first.choices}
        start = chains_of if isinstance(method, Mh) else trajectories
        watch = told(progress, 0, 1)
        return start(model, made, method, score, given_seed, check_threads(threads), watch, known)  # type: ignore[arg-type]
    return once(model, made, method or Forward(), score, given_seed, check_threads(threads), progress, 0, 1)


def grow(
    model: Model[..., Any] | Callable[..., Any],
    target: Target | str | PathLike[str] | None = None,
    *args: Any,
    score: Score | None = None,
    method: Method | None = None,
    particles: int | Sequence[int] = 300,
    voxel: float | None = None,
    sigma: float = 0.02,
    order: str = "stochastic",
    weights: str = "ratio",
    temper: float | None = None,
    resampling: str = "systematic",
    ess: float | None = None,
    anneal: float | Sequence[float] | None = None,
    populations: int | None = None,
    diverse: int | None = None,
    seconds: float | None = None,
    rejuvenate: Kernel | None = None,
    moves: int = 1,
    at: int | str = 1,
    draws: int | None = None,
    chains: int = 1,
    polish: Mh | None = None,
    rule: str = "solid",
    runs: int = 1,
    seed: int | None = None,
    max_steps: int = 20_000_000,
    max_memory: int = 1 << 30,
    threads: int | None = None,
    progress: Watch | None = None,
    **kwargs: Any,
) -> Result:
    """Grow a model into a target, or into anything else that can be asked for: the best of a population, `runs` times.

    Parameters
    ----------
    model
        A model that emits shapes.
    target
        What to fill: a `Target`, or a file; may be left out where `score` says what to match.
    args, kwargs
        The model's arguments.
    score
        What else is asked for, such as `floor(0) * match_image("skyline.png", "cam.json")`; it multiplies
        `no_self_intersection(rule)` and, where there is a target, `volume_match(target, voxel, sigma)`.
    method
        Another search than `smc` with the settings below, which are then left out.
    particles, order, weights, resampling, ess, anneal, populations, seconds, rejuvenate, moves, at, draws, chains
        As for `smc`.
    diverse
        As for `smc`: so many results that differ, for each run.
    polish
        How to go on from the best of each run, `mh(...)`: the best state of its chains takes its place
        (`Result.polish`).
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
        One sample for each run, the best of its population, or as many as are `diverse`; runs in which every particle
        became impossible are left out with a warning, and are an error when there is no other.
    """
    from niwaki.target import Target

    model = as_model(model)
    chosen = method or smc(
        particles,
        order,
        weights,
        default_temper(weights) if temper is None else temper,
        resampling,
        ess,
        anneal=anneal,
        populations=populations,
        diverse=diverse,
        seconds=seconds,
        rejuvenate=rejuvenate,
        moves=moves,
        at=at,
        draws=draws,
        chains=chains,
    )
    if not isinstance(runs, int) or runs < 1:
        raise InputError(
            "bad-setting",
            name="runs",
            found=repr(runs),
            expected="a whole number above 0",
            suggestion="1 or more",
        )
    if polish is not None and _is_diverse(chosen):
        raise InputError(
            "bad-setting",
            name="polish",
            found="mh(...)",
            expected="nothing beside `diverse`, as chains may meet",
            suggestion="None, and `Result.polish` for one of the results",
        )
    first, threads = check_seed(seed), check_threads(threads)
    score = no_self_intersection(rule) * _asked(score)
    if target is not None:
        aim = target if isinstance(target, Target) else Target.load(target)
        score *= volume_match(aim, voxel, sigma)
    elif len(score.specs) == 1:
        raise InputError("no-target", name=model.name)
    made = task(model, args, kwargs, score.specs, max_steps, max_memory)
    found: list[Sample] = []
    failed: list[InputError | ModelFault] = []
    invalid: Counter[str] = Counter()
    spent, interrupted = 0.0, False
    plan: tuple[int, ...] = ()
    for number in range(runs):
        try:
            one = once(model, made, chosen, score, (first + number) % 2**64, threads, progress, number, runs)
        except (InputError, ModelFault) as error:
            if error.code != "everything-impossible" and not error.values.get("invalid"):
                raise
            failed.append(error)
            continue
        except KeyboardInterrupt:
            # Pressed between two looks of the engine.
            if not found:
                raise
            interrupted = True
            break
        plan, interrupted = one.plan, one.interrupted
        invalid.update(one.invalid)
        if interrupted and found and not any(sample.has_ended for sample in one):
            spent += one.seconds
            break
        if polish is not None and not interrupted:
            one = polished(one, polish, None, threads, told(progress, number, runs))
            invalid.update(one.invalid)
            interrupted = one.interrupted
        spent += one.seconds
        found.extend(one.samples if _is_diverse(chosen) else [one.best])
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
    result = Result(model, found, first, chosen, score, interrupted=interrupted, plan=plan, invalid=invalid)
    result.seconds = spent
    return result


def _is_diverse(method: Method) -> bool:
    """Whether a search gives several results that differ."""
    return isinstance(method, Smc) and method.diverse is not None


def _asked(score: Score | None) -> Score:
    """What was asked for; nothing where nothing was."""
    if score is not None and not isinstance(score, Score):
        raise InputError(
            "bad-setting",
            name="score",
            found=repr(score),
            expected="a product of sketches",
            suggestion="`no_self_intersection() * volume_match(target)`",
        )
    return score or Score()


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
