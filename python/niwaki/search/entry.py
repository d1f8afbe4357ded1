"""Functions `run`, for any method, and `grow`, for a target: both create a `Search` and run it.

Seeds are 64-bit numbers. Without a seed, a fresh seed is drawn and stored in the result. Equal seeds give equal results
on any number of threads. Ctrl-C stops a search, which then returns its results so far (`Result.interrupted`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from os import PathLike
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS, bad
from niwaki.lang.compiled import arguments, task, translated
from niwaki.lang.models import Model, as_model
from niwaki.methods import Emulate, Forward, Improve, Method, Mh, Smc
from niwaki.result import Result
from niwaki.result.parts import Hold
from niwaki.result.progress import Watch
from niwaki.search import emulated
from niwaki.search.checkpoint import Checkpoint, resumed_seed
from niwaki.search.checks import check_seed, fresh
from niwaki.search.engine_runs import has_start, replay_choices
from niwaki.search.request import Search
from niwaki.search.shipped import usual
from niwaki.targets.sketches import FREE, Score, no_self_intersection, volume_score
from niwaki.targets.target import Target

#: The settings of `improve`, the default search of `grow`.
OF_IMPROVE = ("rounds", "seconds", "effort", "diverse", "generations", "by", "margin", "bins", "guide")
#: The settings of `emulate`.
OF_EMULATE = ("evaluations", "diverse")
#: The engines of `grow`.
ENGINES = ("auto", "sampler", "emulator")
#: The settings of `smc`; with one of these, `grow` searches by one population.
OF_SMC = (*(field.name for field in fields(Smc)), "guide")

#: Settings of one population with a guide: few particles suffice, and tempered resampling spares promising particles.
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
        `importance(...)`, `hmc(...)`, `nuts(...)`, `vi(...)` or `forward(...)`, the default. The method may also be the
        argument after the model.
    score
        The sketches that score its scene.
    seed
        The seed of all random choices; fresh when left out.
    choices
        Values of choices by address. With `mh`, `hmc`, `nuts`, `vi` and `particle_gibbs` the search starts from them.
        Any other method makes the one run with these choices: a `seed` draws missing choices, and without a seed
        missing choices are an error.
    hold
        Values of choices by address that every run has, such as those of `result.held("wing[1]")`; see `Search`.
    max_steps
        The most calls and loop steps of one run, with those of an `infer` inside. An operation on many elements counts
        one step for every eight of them, a primitive 256.
    max_memory
        The most bytes of a run, or of a population or several chains together: calls, values and choices.
    threads
        The number of threads; all of the machine when left out. The result does not depend on it.
    progress
        A function that is called at intervals with a `Progress`; an exception that it raises ends the search.
    checkpoint
        A file, or a `Checkpoint`. The search writes its state there about every second. If the file exists, the search
        resumes from it, with the same result as without the interruption; without a `seed`, it takes the seed of the
        file. Chains and several runs resume where they stopped. One population, an enumeration, or a chain of `hmc`
        begins again.

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
        seed=fresh(resumed_seed(seed, checkpoint)),
        choices=choices,
        hold=hold,
        max_steps=max_steps,
        max_memory=max_memory,
    )
    if choices is not None and seed is not None and not has_start(search.method):
        return replay_choices(search, search.seed)
    return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


def grow(
    model: Model[..., Any] | Callable[..., Any],
    target: Target | str | PathLike[str] | None = None,
    *args: Any,
    score: Score | None = None,
    method: Method | None = None,
    engine: str = "auto",
    voxel: float | None = None,
    sigma: float = 0.02,
    weight: str | None = None,
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
    """Grow a model into a target, or to a high score of any kind: find the best run of a search, `runs` times.

    The default search is `improve`: it begins with a population of particles, and grows parts of the best run again
    until about a second of a processor is spent and nothing is gained. A model whose choices all come before its scene,
    or which calls a host function before every part, is searched by `emulate`, an emulator of its scenes. Neither
    result is a sample of the posterior: for a posterior give a `method`.

    Parameters
    ----------
    model
        A model that emits shapes.
    target
        The volume to fill: a `Target`, or a file. It may be left out if `score` has something to match.
    args, kwargs
        The model's arguments. `rounds`, `seconds`, `effort`, `diverse`, `generations`, `by`, `margin`, `bins` and
        `guide` are settings of the default search. With any other setting of `smc` (particles, order, power, ...) the
        search is one population by these settings, with a default `power` of 16 for ratio weights (1 for drawings);
        with a `guide` its defaults are 50 particles and tempered resampling. Without `guide`, the default search of a
        model of the gallery draws by `guides.usual(...)`; `guide=None` draws from the prior.
    score
        Further sketches, such as `floor(0) * match_image("skyline.png", "cam.json")`. They multiply
        `no_self_intersection(rule)` and, if there is a target, `match_volume(target, voxel, sigma, weight)`. Drawings
        and scores with a `no_self_intersection` of their own have no other.
    method
        A method in place of these settings.
    engine
        "auto": the program decides, never a clock; "sampler": `improve` or `smc`; "emulator": `emulate`, with
        `evaluations` runs. `Result.search.method` and run.json have what was chosen. Settings of `improve` or `smc`
        choose the sampler.
    voxel, sigma, weight
        As for `match_volume`. Without `voxel` and `weight`, a thin target has voxels of half the automatic size, and
        `weight="balanced"`. A target is thin where its parts or gaps are on average thinner than two voxels.
    rule
        As for `no_self_intersection`; "none" lets parts overlap.
    polish
        The chains that continue from the best of each run, `mh(...)`. Their best state takes its place
        (`Result.polish`).
    runs
        The number of results, with seeds `seed`, `seed + 1`, ...
    seed, hold, max_steps, max_memory, threads, progress, checkpoint
        As for `run`. The default search is written to its checkpoint between two rounds.

    Returns
    -------
    Result
        The best sample of each run, or `diverse` samples. Runs in which every particle became impossible are left out
        with a warning; they are an error if no run is left. A best sample that is worse than the empty scene is a
        warning, too.
    """
    search = grow_search(
        model,
        target,
        *args,
        score=score,
        method=method,
        engine=engine,
        voxel=voxel,
        sigma=sigma,
        weight=weight,
        rule=rule,
        polish=polish,
        runs=runs,
        seed=resumed_seed(seed, checkpoint),
        hold=hold,
        max_steps=max_steps,
        max_memory=max_memory,
        **kwargs,
    )
    return search.run(threads=threads, progress=progress, checkpoint=checkpoint)


def grow_search(
    model: Model[..., Any] | Callable[..., Any],
    target: Target | str | PathLike[str] | None = None,
    *args: Any,
    score: Score | None = None,
    method: Method | None = None,
    engine: str = "auto",
    voxel: float | None = None,
    sigma: float = 0.02,
    weight: str | None = None,
    rule: str = "solid",
    polish: Mh | None = None,
    runs: int = 1,
    seed: int | None = None,
    hold: Hold | None = None,
    max_steps: int = MAX_STEPS,
    max_memory: int = MAX_MEMORY,
    **kwargs: Any,
) -> Search:
    """Create the search that `grow` runs, from the same arguments."""
    model = as_model(model)
    if engine not in ENGINES:
        raise bad("engine", engine, " or ".join(f'"{name}"' for name in ENGINES), '"auto"')
    settings = {name: kwargs.pop(name) for name in (*OF_IMPROVE, *OF_SMC, *OF_EMULATE) if name in kwargs}
    is_usual = method is None and "guide" not in settings
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
    is_drawing = product.window is not None
    is_free = is_drawing or rule == FREE
    if not is_free and not any(ask.function == no_self_intersection.__name__ for ask in product.asks):
        product = no_self_intersection(rule) * product
    if target is not None:
        product *= volume_score(target, voxel, sigma, weight)
    elif len(product.asks) == (0 if is_free else 1):
        raise InputError("no-target", name=model.name)
    of_sampler = {name: value for name, value in settings.items() if name != "evaluations"}
    search = Search(
        model,
        tuple(arguments(model, args, kwargs)),
        score=product,
        method=default_method(of_sampler, 1.0 if is_drawing else POWER) if method is None else method,
        seed=fresh(seed),
        hold=hold,
        runs=runs,
        keep="best",
        polish=polish,
        max_steps=max_steps,
        max_memory=max_memory,
    )
    search = _by_engine(search, engine, settings, method is None)
    return _by_usual_guide(search) if is_usual else search


def _by_engine(search: Search, engine: str, settings: Mapping[str, Any], is_free: bool) -> Search:
    """Return the search by the engine that was asked for, or for "auto" by the one that suits the program.

    Parameters
    ----------
    search
        The search by the sampler.
    engine, settings
        The engine, and the settings of a method.
    is_free
        Whether no method was given.
    """
    if engine == "emulator" or "evaluations" in settings:
        of_sampler = [name for name in settings if name not in OF_EMULATE]
        wrong = "" if is_free else "method"
        wrong = wrong or ("engine" if engine == "sampler" else next(iter(of_sampler), ""))
        if wrong:
            value = engine if wrong == "engine" else settings.get(wrong, search.method.NAME)
            raise InputError(
                "bad-setting",
                name=wrong,
                found=repr(value),
                expected='nothing of the sampler together with `evaluations` or `engine="emulator"`',
                suggestion="only one of the two",
            )
        emulated.check(search)
        return replace(search, method=Emulate(**settings))
    return by_program(search, settings) if engine == "auto" and is_free else search


def _by_usual_guide(search: Search) -> Search:
    """Return a usual search with the guide that comes with its model and suits its score."""
    if not isinstance(search.method, Improve):
        return search
    guide = usual(search.model, [ask.function for ask in search.score.asks])
    return search if guide is None else replace(search, method=replace(search.method, guide=guide))


def by_program(search: Search, settings: Mapping[str, Any]) -> Search:
    """Return the search of a model by the method that suits its program: itself, or `emulate` with its settings.

    Parameters
    ----------
    search
        The search by the sampler.
    settings
        The settings of a method that a person gave; with others than `diverse` the sampler stays.
    """
    is_open = set(settings) <= {"diverse"} and emulated.suits(search)
    return replace(search, method=Emulate(**settings)) if is_open else search


def default_method(settings: Mapping[str, Any], power: float = POWER) -> Method:
    """Choose the method of `grow`: `improve` by its settings, or one population by settings of `smc`.

    Parameters
    ----------
    settings
        Settings by name.
    power
        The default power of a population with ratio weights.
    """
    if set(settings) <= set(OF_IMPROVE):
        return Improve(**settings)
    if "rounds" in settings:
        extras = ", ".join(f"`{name}`" for name in settings if name not in OF_IMPROVE)
        raise InputError(
            "bad-setting",
            name="rounds",
            found=repr(settings["rounds"]),
            expected=f"no {extras} beside it, which {'is a setting' if ',' not in extras else 'are settings'} of `smc`",
            suggestion=f"`method=improve(...)`, which has {', '.join(f.name for f in fields(Improve))}",
        )
    if "guide" in settings:
        settings = {**GUIDED, **settings}
    if settings.get("power") is None:
        settings = {**settings, "power": power if settings.get("weights", "ratio") == "ratio" else 1.0}
    return Smc(**settings)


def explain(
    model: Model[..., Any] | Callable[..., Any],
    choice: str,
    *args: Any,
    seed: int = 0,
    max_steps: int = MAX_STEPS,
    **kwargs: Any,
) -> dict[str, Any]:
    """Trace each strategy through one proposal from the prior, in the first state of a seed.

    Parameters
    ----------
    model
        A model.
    choice
        The address of the choice that the proposal changes, or a pattern, for the first match.
    args, kwargs
        The model's arguments.
    seed, max_steps
        As for `run`.

    Returns
    -------
    dict
        `activations`: the calls and loop iterations, each before those it makes, as (label, function, depth, number of
        the caller); `home`: the number of the activation with the choice; `path` and `label` of the choice, `old` and
        `new`; `runs`: by strategy
        the events ("invoked", "unwound", "skipped", "made" or "removed", with the number of the activation), and
        whether the run came to its end. `niwaki.draw.reuse.draw` draws the trace.
    """
    model = as_model(model)
    prepared = task(model, args, kwargs, (), max_steps)
    with translated(model.name, f"seed={seed}"):
        report = _engine.explain(prepared, check_seed(seed), choice)
    addresses: list[str] = []
    for component, _, _, caller in report["activations"]:
        # The model itself is no component of addresses.
        around = addresses[caller] if caller is not None and caller < len(addresses) else None
        addresses.append("" if around is None else f"{around}/{component}".lstrip("/"))
    shown = [model.labels.short(address) if address else model.name for address in addresses]
    report["activations"] = [
        (label, *rest) for label, (_, *rest) in zip(shown, report["activations"], strict=True)
    ]
    report["label"] = model.labels.label(report["path"])
    return report
