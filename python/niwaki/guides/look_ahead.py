"""Training of a guide's look-ahead: the future gain of a paused run (dissertation 7.2.3)."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from os import cpu_count
from typing import Any

from niwaki import _engine
from niwaki.errors.memory import check_room
from niwaki.errors.settings import bad
from niwaki.guides.training import EVERY, JUDGE, with_guide
from niwaki.lang.compiled import translated
from niwaki.lang.models import Model, as_model
from niwaki.methods import Guide, Smc, at_least_one
from niwaki.methods.room import SEARCH
from niwaki.search import Search
from niwaki.search.checks import check_seed, check_threads, fresh
from niwaki.targets.sketches import Score


def train_look_ahead(
    guide: Guide,
    model: Model[..., Any] | Callable[..., Any],
    targets: Sequence[Any],
    score: Callable[[Any], Score],
    args: Callable[[Any], Iterable[Any]] | None = None,
    *,
    held_out: Sequence[Any] | None = None,
    method: Smc = JUDGE,
    searches: int = 2000,
    states: int = 4,
    particles: int = 10,
    looks: bool = True,
    seed: int | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Guide:
    """Train a guide to predict how much the score of a paused run will still rise, for `smc(look_ahead=...)`.

    Searches with the guide take the targets in turn. Each search keeps a few paused particles, and a short search from
    each of these particles shows the gain that was still to come. Ridge regression fits a linear function to these
    gains; its inputs are the inputs of the guide's network at the next choices, and the score so far. Ctrl-C ends the
    searches, and the training uses those that are done.

    Parameters
    ----------
    guide
        A guide of the model with the shared network.
    model, targets, score, args, held_out
        See `niwaki.train_guide`. The held-out targets select the strength of the ridge.
    method
        The method of all searches: ratio weights, without a proposal. Its power and its moves are ignored.
    searches
        Number of searches.
    states
        Number of paused particles that each search keeps.
    particles
        Number of particles that continue from each paused particle.
    looks
        Whether the function has the inputs of the network. With False it has only the score so far, and takes no time
        in a search.
    seed
        Seed of the training. Default: a new seed.
    threads
        Number of threads; the result does not depend on it.
    progress
        A function that gets the number of searches so far, and of all searches.

    Returns
    -------
    Guide
        The guide with a look-ahead. Its report's "look_ahead" has the numbers of paused particles for training and held
        out ("rises"); the root mean square error of the function and of a constant, in nats ("error", "deviation");
        the number of continued searches that "died"; and the number of searches that "failed" with a fault.

    Raises
    ------
    InputError
        The guide belongs to another model or has the dissertation's network; too few particles paused.

    Examples
    --------
    >>> import niwaki as nw
    >>> from niwaki.gallery.vines import WINDOW, vines
    >>> from niwaki.guides import shipped, train_look_ahead
    >>> from niwaki.targets import drawings
    >>> pictures = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    >>> score, place = lambda drawing: drawing.score(WINDOW), lambda drawing: drawing.place(WINDOW)
    >>> guide = train_look_ahead(shipped(vines), vines, pictures[:9], score, place, searches=18, seed=1)
    >>> guide.report["look_ahead"]["rises"]
    [56, 16]
    >>> method = nw.smc(10, resampling="tempered", guide=guide, look_ahead=0.2)
    """
    model, seed = as_model(model), fresh(seed)
    check_seed(seed)
    if not isinstance(guide, Guide):
        raise bad("guide", guide, "a guide", '`niwaki.train_guide(...)` or `Guide.load("vines.guide")`')
    if guide.form.get("image") is not None:
        raise bad(
            "guide", guide, "a guide with the shared network", "a guide of a training with `Training()`"
        )
    for name, value in (("searches", searches), ("states", states), ("particles", particles)):
        at_least_one(name, value)
    check_room("searches", searches, SEARCH, "search")
    if not isinstance(method, Smc) or method.weights != "ratio" or method.proposal is not None:
        expected = "particles by ratio weights, without a proposal"
        raise bad("method", method, expected, '`smc(10, resampling="tempered")`')
    all_targets = list(targets)
    judging = all_targets[::EVERY] if held_out is None else list(held_out)
    training = (
        [target for i, target in enumerate(all_targets) if i % EVERY] if held_out is None else all_targets
    )
    if not training:
        raise bad("targets", targets, "at least two targets", "drawings or meshes to grow into")
    guided_method = with_guide(method, guide)

    def task(target: Any) -> _engine.Task:
        arguments = () if args is None else tuple(args(target))
        return Search(model, arguments, score=score(target), method=guided_method, seed=seed).task

    def watch(done: int, total: int, *_: Any) -> None:
        if progress is not None and total:
            progress(done, total)

    plan = {
        "searches": searches,
        "states": states,
        "particles": [max(method.sizes), particles],
        "settings": method.data(str),
        "looks": bool(looks),
        "seed": seed,
    }
    with translated(model.name, f"seed={seed}"):
        engine, report = _engine.rehearse(
            [task(target) for target in training],
            [task(target) for target in judging],
            guide._engine,
            json.dumps(plan),
            check_threads(threads) or cpu_count() or 1,
            watch,
        )
    return Guide(engine.data()).with_report({**guide.report, "look_ahead": {"seed": seed, **report}})
