"""Training a guide: rounds of searches whose best runs are traces to learn from, or runs of its own."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing
from dataclasses import asdict, dataclass, replace
from math import inf
from os import PathLike, cpu_count
from typing import Any

import numpy as np

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.errors.memory import check_room
from niwaki.errors.settings import bad, is_whole
from niwaki.errors.warned import warn
from niwaki.guides.memory import Memory
from niwaki.guides.report import Round
from niwaki.guides.settings import Training
from niwaki.guides.traces import best_of
from niwaki.lang.compiled import translated
from niwaki.lang.models import Model, as_model
from niwaki.methods import Guide, Method, kernels, smc
from niwaki.methods.room import SEARCH
from niwaki.result import Sample
from niwaki.search import Search
from niwaki.search.checkpoint import Checkpoint, resumed_seed
from niwaki.search.checks import check_seed, check_threads, fresh
from niwaki.search.data import source_hash, text_hash
from niwaki.search.keeper import Keeper, Stage
from niwaki.search.warnings import SearchWarning
from niwaki.targets.sketches import Score

#: Of the targets, one in so many judges where none is named.
EVERY = 8

#: Of the traces, the first tenth judges how well the others are learned.
APART = 10

#: Searches of each round.
ROUNDS = (150, 400)

#: The searches for traces: the first without a guide, the other wherever there is one.
SEARCHES = (smc(600), smc(50, resampling="tempered"))

#: The search that judges a guide.
JUDGE = smc(10, resampling="tempered")


Progress = Callable[[Round], None]


def train_guide(
    model: Model[..., Any] | Callable[..., Any],
    targets: Sequence[Any],
    score: Callable[[Any], Score],
    args: Callable[[Any], Iterable[Any]] | None = None,
    *,
    held_out: Sequence[Any] | None = None,
    rounds: Sequence[int] | None = None,
    searches: Sequence[Method] | None = None,
    judge: Method = JUDGE,
    keep: Callable[[Sample], bool] | None = None,
    training: Training | None = None,
    start: Guide | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    checkpoint: Checkpoint | str | PathLike[str] | None = None,
) -> Guide:
    """Train a guide for a model on targets of a kind.

    A round searches targets drawn at random; the best run of each is a trace to learn from. The first round searches
    without a guide, each later one by the guide of the round before. Then the guide grows the held-out targets, and
    the one that does it best is the result. Ctrl-C ends the training with the best guide so far.

    With `training=Training.bound()` there are no searches: the guide learns from runs of its own, by the evidence
    bound. The result is the guide with the highest bound of the held-out targets.

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
        Targets that are never learned from; each eighth of `targets` when left out. A guide that learns by the evidence
        bound needs one.
    rounds
        Searches of each round; (150, 400) when left out.
    searches
        The method without a guide, and those with a guide, the last one for all later rounds; any method that gives
        samples. When left out 600 particles, then 50 with tempered resampling.
    judge
        The method by which held-out targets are grown after each round.
    keep
        Which samples are traces: those that score better than an empty scene when left out. What fails is left out.
    training
        Settings of the network.
    start
        A guide to go on with: it draws in the first round, and its weights are the first ones where it fits the model.
    seed
        Decides everything; fresh when left out.
    threads
        How many to use; the result does not depend on it.
    progress
        Called with a `Round` as it goes on.
    checkpoint
        A file, or a `niwaki.Checkpoint`. What the training needs to go on is written there about every second; a
        training whose file is there goes on from it, and gives the same bytes as if it had not ended.

    Returns
    -------
    Guide
        With a `report`.

    Raises
    ------
    InputError
        No targets, or none that the model reached; `rounds`, `searches` or `keep` without examples.
    ModelFault
        Every search ended by a fault, or gave no trace and some ended so.
    InputError
        The checkpoint is damaged, or of another training or version.

    Examples
    --------
    >>> import niwaki as nw
    >>> from niwaki.gallery.vines import WINDOW, vines
    >>> from niwaki.targets import drawings
    >>> pictures = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    >>> guide = nw.train_guide(
    ...     vines, pictures[:9], lambda one: one.score(WINDOW), lambda one: one.place(WINDOW), rounds=[8], seed=1
    ... )
    >>> guide.report["rounds"][0]["wanted"]
    8
    """
    model, seed = as_model(model), fresh(resumed_seed(seed, checkpoint))
    training = training or Training()
    check_seed(seed)
    everything = list(targets)
    judged = everything[::EVERY] if held_out is None else list(held_out)
    learned = [one for i, one in enumerate(everything) if i % EVERY] if held_out is None else everything
    if not learned:
        raise bad("targets", targets, "at least two targets", "drawings or meshes to grow into")
    by_examples = training.objective == "examples"
    if not by_examples:
        for name, value in (("rounds", rounds), ("searches", searches), ("keep", keep)):
            if value is not None:
                raise bad(name, value, f"nothing with the objective {training.objective!r}", "None")
        if not judged:
            raise bad("held_out", held_out, "at least one target by which the best guide is known", "None")
    rounds = (ROUNDS if rounds is None else rounds) if by_examples else (0,)
    searches = SEARCHES if searches is None else searches
    if not rounds or by_examples and not all(is_whole(one) and one >= 2 for one in rounds):
        raise bad("rounds", rounds, "the number of searches of each round, each at least 2", "(150, 400)")
    for wanted in rounds:
        check_room("rounds", wanted, SEARCH, "search of a round")
    if not searches:
        raise bad("searches", searches, "at least one method", "`(smc(600), smc(50))`")
    if start is not None and not isinstance(start, Guide):
        raise bad("start", start, "a guide", '`Guide.load("vines.guide")`')
    school = _School(model, score, args, judge, judged, check_threads(threads) or cpu_count() or 1)
    draw, told = np.random.default_rng(seed), list[Round]()
    memory = Memory(None)
    if checkpoint is not None:
        decisive = school.about([*learned, *judged], [*searches, judge], start, keep)
        settings = {"rounds": list(rounds), "seed": seed, "training": asdict(training)}
        named = {f"its `{name}`": value for name, value in (decisive | settings).items()}
        memory = Memory(Keeper(Checkpoint.of(checkpoint), "training", named))
    best, highest, guide = start, -inf, start
    about = {
        "seed": seed,
        "targets": len(learned),
        "held_out": len(judged),
        "training": asdict(training) | {"hidden": list(training.hidden)},
    }
    pressed = False
    try:
        if start is not None and judged:
            known = memory.done(-1)
            told.append(known[1] if known else replace(school.judged(start, Round(-1)), rounds=len(rounds)))
            if not known:
                memory.leave(-1, None, told[-1])
            highest = float(np.mean(told[-1].scores)) if told[-1].scores else -inf
        for number, wanted in enumerate(rounds):
            guided = number + (start is not None)
            method = searches[min(guided, len(searches) - 1)]
            now = Round(number, len(rounds), wanted=wanted)
            picks = [learned[i] for i in draw.integers(len(learned), size=wanted)]
            seeds = draw.integers(2**63, size=wanted)
            known = memory.done(number)
            if known is not None:
                guide, now = known
            else:
                first = start if number == 0 else None
                fit = _Fit(training, first, seed, threads, progress, memory.stage(number))
                if by_examples:
                    jobs = [
                        school.search(one, method, guide, int(own))
                        for one, own in zip(picks, seeds, strict=True)
                    ]
                    lessons, now = _traces(jobs, school.workers, keep or _gains, now, progress, memory)
                    if now.traces < 2:
                        raise InputError(
                            "guide-traces", detail=f"{now.traces} of {wanted} searches gave a trace"
                        )
                    guide, now, pressed = fit.examples(lessons, jobs[0], now)
                else:
                    cases, judges = (
                        [school.search(one, judge, None, 0) for one in some] for some in (learned, judged)
                    )
                    guide, now, pressed = fit.bound(cases, judges, now)
                if pressed:
                    if (best is None or not by_examples) and now.has_learned:
                        told.append(now)
                        best = guide
                    break
                now = school.judged(guide, now)
                memory.leave(number, guide, now)
            told.append(now)
            mean = float(np.mean(now.scores)) if now.scores else inf
            if best is None or mean >= highest or not by_examples:
                best, highest = guide, mean
            if progress is not None:
                progress(now)
    except KeyboardInterrupt:
        pressed = True
    memory.finish(pressed)
    if best is None:
        raise KeyboardInterrupt
    if best is start and not told:
        return best
    return best.with_report({**about, "rounds": [one.data() for one in told], "interrupted": pressed})


@dataclass
class _School:
    """A model, and the scores of its targets, each made once."""

    model: Model[..., Any]
    score: Callable[[Any], Score]
    args: Callable[[Any], Iterable[Any]] | None
    judge: Method
    held_out: Sequence[Any]
    workers: int

    def __post_init__(self) -> None:
        self._known: dict[int, tuple[Any, Score, tuple[Any, ...]]] = {}

    def search(self, target: Any, method: Method, guide: Guide | None, seed: int) -> Search:
        """A search for a run that matches a target."""
        if id(target) not in self._known:
            given = () if self.args is None else tuple(self.args(target))
            self._known[id(target)] = target, self.score(target), given
        _, score, given = self._known[id(target)]
        own = method if guide is None else with_guide(method, guide)
        return Search(self.model, given, score=score, method=own, seed=seed)

    def about(
        self,
        targets: Sequence[Any],
        methods: Sequence[Method],
        start: Guide | None,
        keep: Callable[[Sample], bool] | None,
    ) -> dict[str, Any]:
        """What decides a training beside its settings, by name: hashes."""
        goals = [self.search(one, method, None, 0).hash for one in targets for method in methods[-1:]]
        ways = [self.search(targets[0], method, None, 0).hash for method in methods]
        return {
            "targets": text_hash(" ".join(goals)),
            "searches": text_hash(" ".join(ways)),
            "start": None if start is None else start.hash,
            "keep": None if keep is None else source_hash(keep),
        }

    def judged(self, guide: Guide, now: Round) -> Round:
        """The round, with the scores of the held-out targets."""
        tries = [self.search(one, self.judge, guide, i) for i, one in enumerate(self.held_out)]
        with closing(best_of(tries, self.workers)) as samples:
            found = [sample for sample in samples if sample is not None]
        alike = [one.similarity for one in found if one.similarity is not None]
        return replace(now, scores=[one.log_score for one in found], similarities=alike)


def with_guide(method: Method, guide: Guide) -> Method:
    """A method of particles, or importance sampling, whose choices a guide draws; another as it is."""
    own: Any = method
    return replace(own, proposal=kernels.guided(guide)) if hasattr(method, "proposal") else method


def _gains(sample: Sample) -> bool:
    return sample.has_ended and sample.search.task.gain(sample._run) > 0.0


def _traces(
    jobs: Sequence[Search],
    workers: int,
    keep: Callable[[Sample], bool],
    now: Round,
    progress: Progress | None,
    memory: Memory,
) -> tuple[_engine.Lessons, Round]:
    """The best runs of searches, those that are kept; without searching again for those that are remembered."""
    lessons, faults = _engine.Lessons(), list[ModelFault]()

    def learn(job: Search, run: _engine.Run | None, now: Round) -> Round:
        if run is None:
            return replace(now, failed=now.failed + 1)
        lessons.add(job.task, run, now.traces < max(1, len(jobs) // APART))
        return replace(now, traces=now.traces + 1)

    known = memory.traces(now.number)
    for job, data in zip(jobs, known, strict=False):
        now = learn(job, None if data is None else job.task.run_of_data(data), now)
    left = jobs[len(known) :]
    with closing(best_of(left, workers, faults)) as samples:
        for job, sample in zip(left, samples, strict=True):
            run = None if sample is None or not keep(sample) else sample._run
            now = learn(job, run, now)
            memory.add(now.number, run)
            if progress is not None:
                progress(now)
    memory.keep(now.number)
    if now.traces == 0 and faults:
        raise faults[0]
    return lessons, now


@dataclass
class _Fit:
    """Training the network of a round. Each way gives the guide, the round, and whether Ctrl-C ended it."""

    training: Training
    start: Guide | None
    seed: int
    threads: int | None
    progress: Progress | None
    stage: Stage | None

    def examples(self, lessons: _engine.Lessons, search: Search, now: Round) -> tuple[Guide, Round, bool]:
        """On traces."""
        engine, told = self._run(search, now, lambda *rest: lessons.train(search.task, *rest))
        return Guide(engine.data()), replace(now, losses=_table(told["losses"])), told["interrupted"]

    def bound(
        self, searches: Sequence[Search], held_out: Sequence[Search], now: Round
    ) -> tuple[Guide, Round, bool]:
        """On runs of its own, by a bound of the evidence."""
        cases, judges = [one.task for one in searches], [one.task for one in held_out]
        engine, told = self._run(searches[0], now, lambda *rest: _engine.raise_bound(cases, judges, *rest))
        now = replace(
            now,
            bounds=_table(one[:3] for one in told["bounds"]),
            lost=_table(one[3:] for one in told["bounds"]),
        )
        return Guide(engine.data()), now, told["interrupted"]

    def _run(
        self, search: Search, now: Round, train: Callable[..., tuple[_engine.Guide, dict[str, Any]]]
    ) -> tuple[_engine.Guide, dict[str, Any]]:
        def watch(step: int, steps: int, *_: Any) -> None:
            if self.progress is not None and steps:
                self.progress(replace(now, step=step, steps=steps))

        # The weights of a guide that lacks choices of the model would have to be those of a smaller network.
        start = self.start
        first = None if start is None or start._engine.lost(search.task) else start._engine
        settings = asdict(self.training) | {"model": search.model.name, "seed": self.seed}
        with translated(search.model.name, f"seed={self.seed}"):
            seen = watch if self.stage is None else self.stage.watched(watch)
            kept = None if self.stage is None else self.stage.engine
            engine, told = train(json.dumps(settings), first, self.threads, seen, kept)
        if told["diverged"] is not None:
            step, label = told["diverged"]
            where = f"step {step}" + ("" if label is None else f", at the choice `{label}`")
            warn(
                f"training met a number that is not finite in {where}: the best weights before are kept; "
                "lower `rate`",
                SearchWarning,
            )
        return engine, told


def _table(rows: Iterable[Iterable[Any]]) -> list[Any]:
    return [tuple(row) for row in rows]
