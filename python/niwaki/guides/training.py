"""Training a guide: rounds of searches whose best runs are traces to learn from."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field, replace
from os import cpu_count
from typing import Any

import numpy as np

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.errors.settings import bad
from niwaki.lang.compiled import translated
from niwaki.lang.models import Model, as_model
from niwaki.methods import Guide, Method, kernels, smc
from niwaki.result import Sample
from niwaki.search import Search
from niwaki.search.checks import check_seed, check_threads, fresh
from niwaki.targets.sketches import Score

#: Of the targets, one in so many judges where none is named.
EVERY = 8

#: The searches for traces: round by round, the last one for all later rounds. Those after the first are guided.
SEARCHES = (smc(600), smc(50, resampling="tempered"))

#: The search that judges a guide.
JUDGE = smc(10, resampling="tempered")


@dataclass(frozen=True)
class Training:
    """Settings of a guide's network and of its training.

    Attributes
    ----------
    architecture : "shared" or "dissertation"
        One network for all choices, which sees windows in the direction of growth; or that of the dissertation (see
        `Training.dissertation`).
    hidden : (int, int)
        Units of the two hidden layers of the shared network.
    components : int
        Gaussians of each mixture.
    share : float
        Share of the prior in each proposal; the weight of a choice is at most 1 / share.
    looks : bool, "target" or "scene"
        Whether it sees the surroundings in the sketches; with the dissertation's network also one of the two images.
    reads : bool or tuple of str
        Whether it sees what is in scope, or the names of the variables that it sees.
    steps : int
        Steps of Adam; None for so many that each choice is seen about `passes` times (the dissertation's: 20,000).
    passes : float
        As many passes over the choices.
    rate : float
        Step size of Adam.
    decays : (float, float)
        Shares of Adam's means that stay at each step: of slopes, and of their squares.
    batch : int
        Choices for each step; whole traces with the dissertation's network.
    averaging : float
        Share of the mean of the weights that stays at each step; 0 for the last weights.
    """

    architecture: str = "shared"
    hidden: tuple[int, int] = (38, 32)
    components: int = 4
    share: float = 0.02
    looks: bool | str = True
    reads: bool | tuple[str, ...] = True
    steps: int | None = None
    passes: float = 6.0
    rate: float = 2e-3
    decays: tuple[float, float] = (0.9, 0.999)
    batch: int = 256
    averaging: float = 0.998

    def __post_init__(self) -> None:
        if self.architecture not in ("shared", "dissertation"):
            raise bad("architecture", self.architecture, '"shared" or "dissertation"', '"shared"')
        images = ("target", "scene") if self.architecture == "dissertation" else ()
        if not isinstance(self.looks, bool) and self.looks not in images:
            raise bad(
                "looks", self.looks, "True or False, or one image with the dissertation's network", "True"
            )
        if not 0.0 < self.share < 1.0:
            raise bad("share", self.share, "a number above 0 and below 1", "0.02")

    @classmethod
    def dissertation(cls, **changes: Any) -> Training:
        """The dissertation's network and its recipe (6.4).

        Each choice has a net of its own, with one hidden layer. It sees 3 by 3 windows of target and scene in four
        resolutions, through filters that are learned too, its position and direction, and what `reads` names. Adam makes
        20,000 steps of one whole trace each. The share of the prior is nearly nothing; the dissertation has none.

        Parameters
        ----------
        changes
            Attributes with other values: `looks` and `reads` make the dissertation's ablations.
        """
        recipe: dict[str, Any] = {
            "share": 1e-6,
            "rate": 0.01,
            "decays": (0.75, 0.75),
            "batch": 1,
            "averaging": 0.0,
        }
        return cls(architecture="dissertation", **(recipe | changes))


@dataclass(frozen=True)
class Round:
    """What one round of training did; given to `progress` as it goes on.

    Attributes
    ----------
    number : int
        Which round, from 0.
    traces, wanted : int
        Traces so far, and how many there will be.
    losses : list of (int, float, float)
        Steps, mean loss of the choices learned from, and of those held out, nats for each choice.
    scores : list of float
        Log scores of the held-out targets, by a search with few particles.
    similarities : list of float
        Their similarities, where the score has one.
    """

    number: int
    traces: int = 0
    wanted: int = 0
    losses: list[tuple[int, float, float]] = field(default_factory=list)
    scores: list[float] = field(default_factory=list)
    similarities: list[float] = field(default_factory=list)


Progress = Callable[[Round], None]


def train_guide(
    model: Model[..., Any] | Callable[..., Any],
    targets: Sequence[Any],
    score: Callable[[Any], Score],
    args: Callable[[Any], Iterable[Any]] | None = None,
    *,
    held_out: Sequence[Any] | None = None,
    rounds: Sequence[int] = (150, 400),
    searches: Sequence[Method] = SEARCHES,
    judge: Method = JUDGE,
    keep: Callable[[Sample], bool] | None = None,
    training: Training | None = None,
    start: Guide | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> Guide:
    """Train a guide for a model on targets of a kind.

    A round searches targets drawn at random; the best run of each is a trace to learn from. The first round searches
    without a guide, each later one by the guide of the round before. Ctrl-C ends the training with the best guide so
    far.

    Parameters
    ----------
    model
        A model.
    targets
        What to grow into: drawings, meshes, or anything that `score` takes.
    score
        The score of a target.
    args
        The model's arguments for a target; none when left out.
    held_out
        Targets that are never learned from; each eighth of `targets` when left out.
    rounds
        Traces of each round.
    searches
        The method of each round, the last one for those after it; any method that gives samples.
    judge
        The method by which held-out targets are grown after each round.
    keep
        Which samples are traces: those that score better than an empty scene when left out.
    training
        Settings of the network.
    start
        A guide to go on with, for the first round's searches too.
    seed
        Decides everything; fresh when left out.
    threads
        How many to use; the result does not depend on it.
    progress
        Called with a `Round` as it goes on.

    Returns
    -------
    Guide
        With a `report`.

    Raises
    ------
    InputError
        No targets, or none that the model reached.
    """
    model, seed, training = as_model(model), fresh(seed), training or Training()
    check_seed(seed)
    everything = list(targets)
    judged = everything[::EVERY] if held_out is None else list(held_out)
    learned = [one for i, one in enumerate(everything) if i % EVERY] if held_out is None else everything
    if not learned:
        raise bad("targets", targets, "at least two targets", "drawings or meshes to grow into")
    if not rounds:
        raise bad("rounds", rounds, "the number of traces of each round", "(150, 400)")

    def search(target: Any, method: Method, guide: Guide | None, number: int) -> Search:
        own = method if guide is None else with_guide(method, guide)
        given = () if args is None else tuple(args(target))
        return Search(model, given, score=score(target), method=own, seed=number)

    draw, guide, told = np.random.default_rng(seed), start, []
    workers = check_threads(threads) or cpu_count() or 1
    try:
        for number, wanted in enumerate(rounds):
            method = searches[min(number, len(searches) - 1)]
            lessons, made = _engine.Lessons(), 0
            now = Round(number, wanted=wanted)
            picks = [*(learned[i] for i in draw.integers(len(learned), size=wanted))]
            seeds = draw.integers(2**63, size=wanted)
            jobs = [search(one, method, guide, int(own)) for one, own in zip(picks, seeds, strict=True)]
            apart = max(1, wanted // 10)
            for job, sample in zip(jobs, best_of(jobs, workers), strict=True):
                if sample is None or not (keep or _gains)(sample):
                    continue
                # The first traces judge how well the others were learned.
                lessons.add(job.task, sample._run, made < apart)
                made += 1
                if progress is not None and made % 10 == 0:
                    progress(replace(now, traces=made))
            if made < 2:
                raise InputError("guide-traces", name=model.name)
            guide, losses = _fit(lessons, jobs[0], training, start if number == 0 else None, seed, threads)
            tries = [search(one, judge, guide, i) for i, one in enumerate(judged)]
            found = [sample for sample in best_of(tries, workers) if sample is not None]
            now = replace(
                now,
                traces=made,
                losses=losses,
                scores=[one.log_score for one in found],
                similarities=[one.similarity for one in found if one.similarity is not None],
            )
            told.append(now)
            guide = guide.reported(
                {"seed": seed, "training": asdict(training), "rounds": [asdict(r) for r in told]}
            )
            if progress is not None:
                progress(now)
    except KeyboardInterrupt:
        if guide is None or not told:
            raise
    assert guide is not None
    return guide


def with_guide(method: Method, guide: Guide) -> Method:
    """A method of particles, or importance sampling, whose choices a guide draws."""
    if not hasattr(method, "proposal"):
        return method
    return replace(method, proposal=kernels.guided(guide))


def best_of(searches: Sequence[Search], workers: int) -> Iterable[Sample | None]:
    """The best sample of each search, in order; None where every particle became impossible."""

    def one(search: Search) -> Sample | None:
        try:
            return max(search.run(threads=1), key=lambda s: s.log_score + s.log_prior)
        except (InputError, ModelFault) as error:
            if error.code != "everything-impossible":
                raise
            return None

    with ThreadPoolExecutor(workers) as pool:
        yield from pool.map(one, searches)


def _gains(sample: Sample) -> bool:
    return sample.has_ended and sample.search.task.gain(sample._run) > 0.0


def _fit(
    lessons: _engine.Lessons,
    search: Search,
    training: Training,
    start: Guide | None,
    seed: int,
    threads: int | None,
) -> tuple[Guide, list[tuple[int, float, float]]]:
    """Train a network on traces."""
    settings = asdict(training) | {"model": search.model.name, "seed": seed % 2**32}
    with translated(search.model.name, f"seed={seed}"):
        engine, told = lessons.train(
            search.task, json.dumps(settings), None if start is None else start._engine, threads
        )
    if told["interrupted"]:
        raise KeyboardInterrupt
    return Guide(engine.data()), told["losses"]
