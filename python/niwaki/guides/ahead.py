"""Teaching a guide to look ahead: what a run that is paused will still gain (dissertation 7.2.3)."""

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
    """Teach a guide how much the score of a paused run will still rise, for `smc(look_ahead=...)`.

    Searches by the guide take the targets in turn. In each a few paused particles are kept, and a short search that
    goes on from each shows what was still to be gained. A line through what the guide's network sees at the next
    choices, and the score so far, is fitted to it by ridge regression. Ctrl-C ends the searches and learns from those
    that are done.

    Parameters
    ----------
    guide
        A guide of the model, whose network is the shared one.
    model, targets, score, args, held_out
        As for `niwaki.train_guide`; the targets that are held out decide the strength of the ridge.
    method
        How the searches, and those that go on, are made: without a proposal of its own, by ratio weights. Its power and
        its moves do not count.
    searches
        How many searches.
    states
        How many paused particles of each are kept.
    particles
        How many particles go on from each of them.
    looks
        Whether the line sees what the network sees; False for one in the score so far alone, which costs nothing in a
        search.
    seed
        Decides everything; fresh when left out.
    threads
        How many to use; the result does not depend on it.
    progress
        Called with the searches done and wanted.

    Returns
    -------
    Guide
        The same guide, which can look ahead. Its report's "look_ahead" has the numbers of paused particles ("rises":
        learned from, and held out), what the line misses of both and what a constant would ("error", "deviation": root
        mean squares, nats), how many of the searches that go on "died", and how many searches "failed" by a fault.

    Raises
    ------
    InputError
        The guide is of another model or has the dissertation's network; too few particles paused.

    Examples
    --------
    >>> import niwaki as nw
    >>> from niwaki.gallery.vines import WINDOW, vines
    >>> from niwaki.guides import shipped, train_look_ahead
    >>> from niwaki.targets import drawings
    >>> pictures = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    >>> score, place = lambda one: one.score(WINDOW), lambda one: one.place(WINDOW)
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
        raise bad("guide", guide, "a guide with the shared network", "one that was trained with `Training()`")
    for name, value in (("searches", searches), ("states", states), ("particles", particles)):
        at_least_one(name, value)
    check_room("searches", searches, SEARCH, "search")
    if not isinstance(method, Smc) or method.weights != "ratio" or method.proposal is not None:
        expected = "particles by ratio weights, without a proposal"
        raise bad("method", method, expected, '`smc(10, resampling="tempered")`')
    everything = list(targets)
    judged = everything[::EVERY] if held_out is None else list(held_out)
    learned = [one for i, one in enumerate(everything) if i % EVERY] if held_out is None else everything
    if not learned:
        raise bad("targets", targets, "at least two targets", "drawings or meshes to grow into")
    own = with_guide(method, guide)

    def task(target: Any) -> _engine.Task:
        given = () if args is None else tuple(args(target))
        return Search(model, given, score=score(target), method=own, seed=seed).task

    def watch(done: int, wanted: int, *_: Any) -> None:
        if progress is not None and wanted:
            progress(done, wanted)

    plan = {
        "searches": searches,
        "states": states,
        "particles": [max(method.sizes), particles],
        "settings": method.data(str),
        "looks": bool(looks),
        "seed": seed,
    }
    with translated(model.name, f"seed={seed}"):
        engine, told = _engine.rehearse(
            [task(one) for one in learned],
            [task(one) for one in judged],
            guide._engine,
            json.dumps(plan),
            check_threads(threads) or cpu_count() or 1,
            watch,
        )
    return Guide(engine.data()).with_report({**guide.report, "look_ahead": {"seed": seed, **told}})
