"""Training of a guide, on the best runs of searches in rounds, or on runs of the guide itself."""

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
from niwaki.guides.report import Round
from niwaki.guides.settings import Training
from niwaki.guides.traces import best_of
from niwaki.guides.training_checkpoint import TrainingCheckpoint
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

#: Without `held_out`, every eighth target judges the guide.
EVERY = 8

#: The first tenth of the traces is held out to measure the loss.
APART = 10

#: Number of searches of each round.
ROUNDS = (150, 400)

#: Methods of the searches for traces: without a guide, and with a guide.
SEARCHES = (smc(600), smc(50, resampling="tempered"))

#: Method of the searches that judge a guide.
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
    """Train a guide for a model on a kind of targets.

    Each round searches random targets, and the best run of each search is a trace for training. The first round
    searches without a guide, each later round with the guide of the round before. After a round its guide grows the
    held-out targets, and the result is the guide that grows them best. Ctrl-C ends the training with the best guide so
    far.

    With `training=Training.bound()` there are no searches: the guide is trained on its own runs, by the evidence bound.
    The result is the guide with the highest bound of the held-out targets.

    Parameters
    ----------
    model
        A model.
    targets
        Drawings, meshes, or other targets that `score` takes.
    score
        A function that returns the score of a target.
    args
        A function that returns the model's arguments for a target. Default: no arguments.
    held_out
        Targets that are never used for training. Default: every eighth of `targets`. Training by the evidence bound
        needs at least one.
    rounds
        Number of searches of each round. Default: (150, 400).
    searches
        The method without a guide, then the methods with a guide; the last is for all later rounds. Any method that
        gives samples. Default: 600 particles, then 50 with tempered resampling.
    judge
        The method that grows held-out targets after each round.
    keep
        A function that tells whether a sample is a trace. Default: samples that score better than an empty scene.
        Failed searches give no trace.
    training
        Settings of the network.
    start
        A guide from which training starts: it draws choices in the first round, and its weights are the first weights
        if it fits the model.
    seed
        Seed of the training. Default: a new seed.
    threads
        Number of threads; the result does not depend on it.
    progress
        A function that gets a `Round` several times in each round.
    checkpoint
        A file, or a `niwaki.Checkpoint`. The state of the training is written there about every second. If the file
        exists, the training resumes from it, and gives the same bytes as without the stop.

    Returns
    -------
    Guide
        The guide, with a `report`.

    Raises
    ------
    InputError
        There are no targets, or the model reaches none of them; or `rounds`, `searches` or `keep` are set for training
        by a bound.
    ModelFault
        No search gave a trace, and some ended with a fault.
    InputError
        The checkpoint is damaged, or belongs to another training or version.

    Examples
    --------
    >>> import niwaki as nw
    >>> from niwaki.gallery.vines import WINDOW, vines
    >>> from niwaki.targets import drawings
    >>> pictures = [drawings.drawing(name) for name in drawings.names("scribbles", "training")]
    >>> guide = nw.train_guide(
    ...     vines, pictures[:9], lambda page: page.score(WINDOW), lambda page: page.place(WINDOW), rounds=[8], seed=1
    ... )
    >>> guide.report["rounds"][0]["wanted"]
    8
    """
    model, seed = as_model(model), fresh(resumed_seed(seed, checkpoint))
    training = training or Training()
    check_seed(seed)
    all_targets = list(targets)
    judging = all_targets[::EVERY] if held_out is None else list(held_out)
    learning = (
        [target for i, target in enumerate(all_targets) if i % EVERY] if held_out is None else all_targets
    )
    if not learning:
        raise bad("targets", targets, "at least two targets", "drawings or meshes to grow into")
    by_examples = training.objective == "examples"
    if not by_examples:
        for name, value in (("rounds", rounds), ("searches", searches), ("keep", keep)):
            if value is not None:
                raise bad(name, value, f"nothing with the objective {training.objective!r}", "None")
        if not judging:
            raise bad("held_out", held_out, "at least one target that judges the guides", "None")
    rounds = (ROUNDS if rounds is None else rounds) if by_examples else (0,)
    searches = SEARCHES if searches is None else searches
    if not rounds or by_examples and not all(is_whole(count) and count >= 2 for count in rounds):
        raise bad("rounds", rounds, "the number of searches of each round, each at least 2", "(150, 400)")
    for search_count in rounds:
        check_room("rounds", search_count, SEARCH, "search of a round")
    if not searches:
        raise bad("searches", searches, "at least one method", "`(smc(600), smc(50))`")
    if start is not None and not isinstance(start, Guide):
        raise bad("start", start, "a guide", '`Guide.load("vines.guide")`')
    school = _School(model, score, args, judge, judging, check_threads(threads) or cpu_count() or 1)
    draw, done_rounds = np.random.default_rng(seed), list[Round]()
    state = TrainingCheckpoint(None)
    if checkpoint is not None:
        hashes = school.about([*learning, *judging], [*searches, judge], start, keep)
        settings = {"rounds": list(rounds), "seed": seed, "training": asdict(training)}
        settings_by_name = {f"its `{name}`": value for name, value in (hashes | settings).items()}
        state = TrainingCheckpoint(Keeper(Checkpoint.of(checkpoint), "training", settings_by_name))
    best, highest, guide = start, -inf, start
    about = {
        "seed": seed,
        "targets": len(learning),
        "held_out": len(judging),
        "training": asdict(training) | {"hidden": list(training.hidden)},
    }
    is_interrupted = False
    try:
        if start is not None and judging:
            finished = state.done(-1)
            done_rounds.append(
                finished[1] if finished else replace(school.judge_guide(start, Round(-1)), rounds=len(rounds))
            )
            if not finished:
                state.store(-1, None, done_rounds[-1])
            highest = float(np.mean(done_rounds[-1].scores)) if done_rounds[-1].scores else -inf
        for number, search_count in enumerate(rounds):
            guided = number + (start is not None)
            method = searches[min(guided, len(searches) - 1)]
            now = Round(number, len(rounds), wanted=search_count)
            picks = [learning[i] for i in draw.integers(len(learning), size=search_count)]
            seeds = draw.integers(2**63, size=search_count)
            finished = state.done(number)
            if finished is not None:
                guide, now = finished
            else:
                first = start if number == 0 else None
                fit = _Fit(training, first, seed, threads, progress, state.stage(number))
                if by_examples:
                    jobs = [
                        school.search(target, method, guide, int(job_seed))
                        for target, job_seed in zip(picks, seeds, strict=True)
                    ]
                    lessons, now = _traces(jobs, school.workers, keep or _gains, now, progress, state)
                    if now.traces < 2:
                        raise InputError(
                            "guide-traces", detail=f"{now.traces} of {search_count} searches gave a trace"
                        )
                    guide, now, is_interrupted = fit.examples(lessons, jobs[0], now)
                else:
                    cases, judges = (
                        [school.search(target, judge, None, 0) for target in group]
                        for group in (learning, judging)
                    )
                    guide, now, is_interrupted = fit.bound(cases, judges, now)
                if is_interrupted:
                    if (best is None or not by_examples) and now.has_learned:
                        done_rounds.append(now)
                        best = guide
                    break
                now = school.judge_guide(guide, now)
                state.store(number, guide, now)
            done_rounds.append(now)
            mean = float(np.mean(now.scores)) if now.scores else inf
            if best is None or mean >= highest or not by_examples:
                best, highest = guide, mean
            if progress is not None:
                progress(now)
    except KeyboardInterrupt:
        is_interrupted = True
    state.finish(is_interrupted)
    if best is None:
        raise KeyboardInterrupt
    if best is start and not done_rounds:
        return best
    return best.with_report(
        {**about, "rounds": [report.data() for report in done_rounds], "interrupted": is_interrupted}
    )


@dataclass
class _School:
    """A model with the scores of its targets, each of which is made once."""

    model: Model[..., Any]
    score: Callable[[Any], Score]
    args: Callable[[Any], Iterable[Any]] | None
    judge: Method
    held_out: Sequence[Any]
    workers: int

    def __post_init__(self) -> None:
        self._known: dict[int, tuple[Any, Score, tuple[Any, ...]]] = {}

    def search(self, target: Any, method: Method, guide: Guide | None, seed: int) -> Search:
        """Return a search for a run that matches a target."""
        if id(target) not in self._known:
            arguments = () if self.args is None else tuple(self.args(target))
            self._known[id(target)] = target, self.score(target), arguments
        _, score, arguments = self._known[id(target)]
        method_with_guide = method if guide is None else with_guide(method, guide)
        return Search(self.model, arguments, score=score, method=method_with_guide, seed=seed)

    def about(
        self,
        targets: Sequence[Any],
        methods: Sequence[Method],
        start: Guide | None,
        keep: Callable[[Sample], bool] | None,
    ) -> dict[str, Any]:
        """Return hashes, by name, of everything beside the settings that determines a training."""
        goals = [self.search(target, method, None, 0).hash for target in targets for method in methods[-1:]]
        ways = [self.search(targets[0], method, None, 0).hash for method in methods]
        return {
            "targets": text_hash(" ".join(goals)),
            "searches": text_hash(" ".join(ways)),
            "start": None if start is None else start.hash,
            "keep": None if keep is None else source_hash(keep),
        }

    def judge_guide(self, guide: Guide, now: Round) -> Round:
        """Return the round with the scores of the held-out targets."""
        tries = [self.search(target, self.judge, guide, i) for i, target in enumerate(self.held_out)]
        with closing(best_of(tries, self.workers)) as samples:
            grown = [sample for sample in samples if sample is not None]
        similarities = [sample.similarity for sample in grown if sample.similarity is not None]
        return replace(now, scores=[sample.log_score for sample in grown], similarities=similarities)


def with_guide(method: Method, guide: Guide) -> Method:
    """Return a method of particles or importance sampling with a guide; any other method unchanged."""
    method_with_proposal: Any = method
    return (
        replace(method_with_proposal, proposal=kernels.guided(guide))
        if hasattr(method, "proposal")
        else method
    )


def _gains(sample: Sample) -> bool:
    return sample.has_ended and sample.search.task.gain(sample._run) > 0.0


def _traces(
    jobs: Sequence[Search],
    workers: int,
    keep: Callable[[Sample], bool],
    now: Round,
    progress: Progress | None,
    state: TrainingCheckpoint,
) -> tuple[_engine.Lessons, Round]:
    """Return the traces of searches as lessons; traces in the checkpoint are not searched again."""
    lessons, faults = _engine.Lessons(), list[ModelFault]()

    def learn(job: Search, run: _engine.Run | None, now: Round) -> Round:
        if run is None:
            return replace(now, failed=now.failed + 1)
        lessons.add(job.task, run, now.traces < max(1, len(jobs) // APART))
        return replace(now, traces=now.traces + 1)

    finished = state.traces(now.number)
    for job, data in zip(jobs, finished, strict=False):
        now = learn(job, None if data is None else job.task.run_of_data(data), now)
    left = jobs[len(finished) :]
    with closing(best_of(left, workers, faults)) as samples:
        for job, sample in zip(left, samples, strict=True):
            run = None if sample is None or not keep(sample) else sample._run
            now = learn(job, run, now)
            state.add(now.number, run)
            if progress is not None:
                progress(now)
    state.keep(now.number)
    if now.traces == 0 and faults:
        raise faults[0]
    return lessons, now


@dataclass
class _Fit:
    """The training of a round's network; each method returns the guide, the round, and whether Ctrl-C ended it."""

    training: Training
    start: Guide | None
    seed: int
    threads: int | None
    progress: Progress | None
    stage: Stage | None

    def examples(self, lessons: _engine.Lessons, search: Search, now: Round) -> tuple[Guide, Round, bool]:
        """Train on traces."""
        engine, report = self._run(search, now, lambda *rest: lessons.train(search.task, *rest))
        return Guide(engine.data()), replace(now, losses=_table(report["losses"])), report["interrupted"]

    def bound(
        self, searches: Sequence[Search], held_out: Sequence[Search], now: Round
    ) -> tuple[Guide, Round, bool]:
        """Train on runs of the guide itself, by a bound of the evidence."""
        cases, judges = [search.task for search in searches], [search.task for search in held_out]
        engine, report = self._run(searches[0], now, lambda *rest: _engine.raise_bound(cases, judges, *rest))
        now = replace(
            now,
            bounds=_table(row[:3] for row in report["bounds"]),
            lost=_table(row[3:] for row in report["bounds"]),
        )
        return Guide(engine.data()), now, report["interrupted"]

    def _run(
        self, search: Search, now: Round, train: Callable[..., tuple[_engine.Guide, dict[str, Any]]]
    ) -> tuple[_engine.Guide, dict[str, Any]]:
        def watch(step: int, steps: int, *_: Any) -> None:
            if self.progress is not None and steps:
                self.progress(replace(now, step=step, steps=steps))

        # A guide that lacks choices of the model has a smaller network, whose weights do not fit.
        start = self.start
        first = None if start is None or start._engine.lost(search.task) else start._engine
        settings = asdict(self.training) | {"model": search.model.name, "seed": self.seed}
        with translated(search.model.name, f"seed={self.seed}"):
            watched = watch if self.stage is None else self.stage.watched(watch)
            stored_engine = None if self.stage is None else self.stage.engine
            engine, report = train(json.dumps(settings), first, self.threads, watched, stored_engine)
        if report["diverged"] is not None:
            step, label = report["diverged"]
            where = f"step {step}" + ("" if label is None else f", at the choice `{label}`")
            warn(
                f"training has a number that is not finite in {where}: the best weights before it are kept; "
                "lower `rate`",
                SearchWarning,
            )
        return engine, report


def _table(rows: Iterable[Iterable[Any]]) -> list[Any]:
    return [tuple(row) for row in rows]
