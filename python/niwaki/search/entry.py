"""`run` a model by any method, and `grow` one into a target: both create a `Search` and run it.

Seeds are 64-bit numbers; where none is given a fresh one is drawn and kept in the result. The same seed gives the same
result on any number of threads. Ctrl-C stops a search, which then returns what it has (`Result.interrupted`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from os import PathLike
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS
from niwaki.lang.compiled import arguments, task, translated
from niwaki.lang.models import Model, as_model
from niwaki.methods import Forward, Improve, Method, Mh, Smc
from niwaki.result import Result
from niwaki.result.parts import Hold
from niwaki.result.progress import Watch
from niwaki.search.checkpoint import Checkpoint, begun_seed
from niwaki.search.checks import check_seed, fresh
from niwaki.search.request import Search
from niwaki.search.searching import given, starts
from niwaki.targets.sketches import Score, match_volume, no_self_intersection
from niwaki.targets.target import Target

#: The settings of `improve`, the usual search, which `grow` takes by name.
OF_IMPROVE = ("rounds", "seconds", "diverse", "guide")
#: The settings of `smc`, which are one population instead.
OF_SMC = (*(field.name for field in fields(Smc)), "guide")

#: One population with a guide: few particles do it, and tempered resampling keeps those that look bad for a moment.
GUIDED: dict[str, Any] = {"particles": 50, "resampling": "tempered"}

#: The power of a search for the best.
POWER = 16.0


def run(
    model: Model[..., Any] | Callable[..., Any],
    *args: Any,
    method: Method | None = None,
    score: Score | None = None,
    seed: int | None = None,
    choices: Mapping[str, Any] | None = None,
    hold: Hold | None = None,
    max_steps: int = MAX_STEPS,
    max_memory: int = MAX_MEMORY,
    threads: int | None = None,
    progress: Watch | None = None,
    checkpoint: Checkpoint | str | PathLike[str] | None = None,
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
        `smc(...)`, `ais(...)`, `particle_gibbs(...)`, `pimh(...)`, `mh(...)`, `enumerate_all(...)`, `rejection(...)`,
        `importance(...)`, `hmc(...)`, `nuts(...)`, `vi(...)` or `forward(...)`, also what happens when it is left out.
        It may also be the argument after the model.
    score
        What its scene should be like.
    seed
        Decides every random choice; fresh when left out.
    choices
        Values of choices by address, for one run with those: others are drawn from `seed` where it is given, and
        missing ones are an error where it is not. With `mh`, `hmc`, `nuts`, `vi`, `particle_gibbs` the search starts
        from them.
    hold
        What every run has: values of choices by address, such as `result.held("wing[1]")` gives; see `Search`.
    max_steps
        Most calls and loop steps of one run, those of an `infer` inside included. An operation on many elements counts
        one step for every eight of them, a primitive 256.
    max_memory
        Most bytes of a run, or of a population or several chains together: calls, values and choices.
    threads
        How many to use; all of the machine's when left out. The result does not depend on it.
    progress
        Called now and then with a `Progress`; an exception that it raises ends the search.
    checkpoint
        A file, or a `Checkpoint`. What the search needs to go on is written there about every second. A search whose
        file is there goes on from it, with the same result as if it had not ended; where no seed is given, with the
        seed of the file. Chains and several runs go on from where they were; one population, an enumeration, or a
        chain of `hmc` begins again.

    Returns
    -------
    Result
        The samples, with weights; for enumeration the exact distribution.
    """
    model = as_model(model)
    if method is None and args and isinstance(args[0], Method):
        method, args = args[0], args[1:]
    search = Search(
        model,
        tuple(arguments(model, args, kwargs)),
        score=Score() if score is None else score,
        method=Forward() if method is None else method,
        seed=fresh(begun_seed(seed, checkpoint)),
        choices=choices,
        hold=hold,
        max_steps=max_steps,
        max_memory=max_memory,
    )
    if choices is not None and seed is not None and not starts(search.method):
        return given(search, search.seed)
    return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


def grow(
    model: Model[..., Any] | Callable[..., Any],
    target: Target | str | PathLike[str] | None = None,
    *args: Any,
    score: Score | None = None,
    method: Method | None = None,
    voxel: float | None = None,
    sigma: float = 0.02,
    rule: str = "solid",
    polish: Mh | None = None,
    runs: int = 1,
    seed: int | None = None,
    hold: Hold | None = None,
    max_steps: int = MAX_STEPS,
    max_memory: int = MAX_MEMORY,
    threads: int | None = None,
    progress: Watch | None = None,
    checkpoint: Checkpoint | str | PathLike[str] | None = None,
    **kwargs: Any,
) -> Result:
    """Grow a model into a target, or to a high score of any kind: the best of a search, `runs` times.

    The usual search is `improve`: it begins with a population of particles, and spends three times as much work on
    growing parts of the best run again. It is a search and no sample: for a posterior name a method.

    Parameters
    ----------
    model
        A model that emits shapes.
    target
        What to fill: a `Target`, or a file; may be left out where `score` has something to match.
    args, kwargs
        The model's arguments. What `kwargs` has of `rounds`, `seconds`, `diverse` and `guide` is for the usual
        search. With any other setting of `smc` (particles, order, power, ...) the search is one population by those,
        with a `power` of 16 for ratio weights when left out (1 for drawings). With a `guide` and nothing of the usual
        search it is one population, too: of 50 particles with tempered resampling, when left out.
    score
        Further sketches, such as `floor(0) * match_image("skyline.png", "cam.json")`; they multiply
        `no_self_intersection(rule)`, which is left out for drawings and where they have it, and, where there is a
        target, `match_volume(target, voxel, sigma)`.
    method
        Another search than by those settings.
    voxel, sigma
        As for `match_volume`.
    rule
        As for `no_self_intersection`.
    polish
        The chains that continue from the best of each run, `mh(...)`: the best state of its chains takes its place
        (`Result.polish`).
    runs
        How many results, with seeds `seed`, `seed + 1`, ...
    seed, hold, max_steps, max_memory, threads, progress, checkpoint
        As for `run`. The usual search is written between two rounds.

    Returns
    -------
    Result
        One sample for each run, the best of its search, or as many as are `diverse`; runs in which every particle
        became impossible are left out with a warning, and are an error when there is no other. A best that is worse
        than the empty scene is a warning, too.
    """
    search = asked(
        model,
        target,
        *args,
        score=score,
        method=method,
        voxel=voxel,
        sigma=sigma,
        rule=rule,
        polish=polish,
        runs=runs,
        seed=begun_seed(seed, checkpoint),
        hold=hold,
        max_steps=max_steps,
        max_memory=max_memory,
        **kwargs,
    )
    return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


def asked(
    model: Model[..., Any] | Callable[..., Any],
    target: Target | str | PathLike[str] | None = None,
    *args: Any,
    score: Score | None = None,
    method: Method | None = None,
    voxel: float | None = None,
    sigma: float = 0.02,
    rule: str = "solid",
    polish: Mh | None = None,
    runs: int = 1,
    seed: int | None = None,
    hold: Hold | None = None,
    max_steps: int = MAX_STEPS,
    max_memory: int = MAX_MEMORY,
    **kwargs: Any,
) -> Search:
    """The search that `grow` makes of its arguments, which it then runs."""
    model = as_model(model)
    settings = {name: kwargs.pop(name) for name in (*OF_IMPROVE, *OF_SMC) if name in kwargs}
    if settings.get("guide", True) is None:
        del settings["guide"]
    if method is not None and settings:
        raise InputError(
            "bad-setting",
            name=next(iter(settings)),
            found=repr(next(iter(settings.values()))),
            expected="no settings together with `method`, which has its own",
            suggestion=f"`method` left out, or the setting in `{method.NAME}(...)`",
        )
    product = Score() if score is None else score
    drawn = product.window is not None
    if not drawn and not any(one.function == no_self_intersection.__name__ for one in product.asks):
        product = no_self_intersection(rule) * product
    if target is not None:
        product *= match_volume(target, voxel, sigma)
    elif len(product.asks) == (0 if drawn else 1):
        raise InputError("no-target", name=model.name)
    return Search(
        model,
        tuple(arguments(model, args, kwargs)),
        score=product,
        method=usual(settings, 1.0 if drawn else POWER) if method is None else method,
        seed=fresh(seed),
        hold=hold,
        runs=runs,
        keep="best",
        polish=polish,
        max_steps=max_steps,
        max_memory=max_memory,
    )


def usual(settings: Mapping[str, Any], power: float = POWER) -> Method:
    """The search for the best by settings of `improve`, or where there are others by one population.

    Where its `power` is left out, it is that one with ratio weights.
    """
    if set(settings) <= set(OF_IMPROVE) and set(settings) != {"guide"}:
        return Improve(**settings)
    if "rounds" in settings:
        others = ", ".join(f"`{name}`" for name in settings if name not in OF_IMPROVE)
        raise InputError(
            "bad-setting",
            name="rounds",
            found=repr(settings["rounds"]),
            expected=f"no {others} beside it, which {'is a setting' if ',' not in others else 'are settings'} of `smc`",
            suggestion=f"`method=improve(...)`, which has {', '.join(f.name for f in fields(Improve))}",
        )
    if "guide" in settings:
        settings = {**GUIDED, **settings}
    given_power = settings.get("power")
    sharp = power if settings.get("weights", "ratio") == "ratio" else 1.0
    return Smc(**{**settings, "power": sharp if given_power is None else given_power})


def explain(
    model: Model[..., Any] | Callable[..., Any],
    choice: str,
    *args: Any,
    seed: int = 0,
    max_steps: int = MAX_STEPS,
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
    prepared = task(model, args, kwargs, (), max_steps)
    with translated(model.name, f"seed={seed}"):
        return _engine.explain(prepared, check_seed(seed), choice)
