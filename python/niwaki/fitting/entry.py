"""`nw.fit`: the parameters of a model that somebody else wrote.

    result = nw.fit(bracket, nw.match_volume("bracket.stl"), evaluations=300, folder="bracket")
    result.best.parameters

The loop asks for points in batches, has them evaluated by worker processes, and tells the outcomes in the order of
asking: the number of workers changes no result. The archive has every evaluation, so the same call goes on where it
stopped.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from niwaki.batches.pools import cores
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.errors.settings import bad, count, real
from niwaki.errors.warned import warn
from niwaki.fitting import align as aligning
from niwaki.fitting import discovery, worker
from niwaki.fitting.archive import Archive, Entry, Repeat, opened, packed, stored_settings
from niwaki.fitting.functions import Loaded
from niwaki.fitting.generator import Generator, number_of, value_of
from niwaki.fitting.goals import Goal, Outcome
from niwaki.fitting.loading import generator_of
from niwaki.fitting.loop import Failure, FitLoop, Point
from niwaki.fitting.pool import Caller, Here, Limit, Reply, Workers
from niwaki.fitting.result import FitResult, scene_of_arrays
from niwaki.search.checks import fresh
from niwaki.search.data import Writer, text_hash
from niwaki.search.space import Parameter, Space
from niwaki.search.warnings import SearchWarning, size_warning
from niwaki.targets.sketches import Score, match_volume
from niwaki.targets.target import Target
from niwaki.words.distributions import Bernoulli, Categorical, DiscreteUniform

#: Evaluations that a batch asks for at most; the proposer decides how many it can name.
BATCH = 8

#: If the first calls all fail, the search stops.
ALL_FAILED = 20

#: One in so many points is called twice.
REPEATED = 50


@dataclass(frozen=True)
class FitProgress:
    """Progress of a fit; the argument of `progress`, after each batch.

    Attributes
    ----------
    done, evaluations : int
        Evaluations so far, and of all.
    failed : int
        Evaluations that failed.
    best : float
        The best log score, nats; minus infinity before the first mesh.
    seconds_each : float
        Median seconds of a call.
    seconds_left : float or None
        Seconds until the end, about.
    """

    done: int
    evaluations: int
    failed: int
    best: float
    seconds_each: float
    seconds_left: float | None


def fit(
    model: Any,
    goal: Any,
    evaluations: int = 300,
    *,
    seconds: float | None = None,
    workers: int | None = None,
    folder: str | PathLike[str] | None = None,
    seed: int | None = None,
    limit: float = 60.0,
    align: bool = False,
    progress: Callable[[FitProgress], None] | None = None,
) -> FitResult:
    """Search the parameters of a model that somebody else wrote.

    The search learns from all of the mesh, not from its score alone. An evaluation that fails is a point without a
    mesh; the table has its text.

    Parameters
    ----------
    model
        A function that returns a mesh (ranges in its signature, or draws while it runs), an OpenSCAD file or
        `nw.scad(...)`, or `nw.command(...)`.
    goal
        A score such as `match_volume(target)`, numbers such as `number("volume", 3.0, tolerance=0.1)`, a product of
        these; or a mesh to fill.
    evaluations
        The number of evaluations in all, with those that the folder has already.
    seconds
        Wall time after which no further evaluations begin.
    workers
        Worker processes, each of which loads the model once; the result does not depend on their number. Default: one
        for each processor.
    folder
        A folder for all evaluations. The same call goes on where an earlier call stopped or was killed.
    seed
        The seed of the search. Default: that of the folder, or a new one.
    limit
        Seconds that a call may take until ten are known. Then ten times their median, and at least a tenth of `limit`.
    align
        Whether to search the place, the turn and the size of the mesh, too, for a target in other units, axes or
        places.
    progress
        A function that is called with `FitProgress` after each batch.

    Returns
    -------
    FitResult
        All evaluations; `best`, `table()`. Ctrl-C keeps what there is.

    Raises
    ------
    InputError
        `no-ranges`: there is nothing to search; `all-failed`: the first 20 evaluations failed; `other-fit`: the folder
        has another search; `fit-worker-ended`: a worker process cannot load the model.
    FileError
        `folder-in-use`: another process searches in the folder.

    Warns
    -----
    SearchWarning
        Meshes are open, inverted or flat; the model is not deterministic, or must run in this process; the target has
        another size or is far away.

    Examples
    --------
    >>> import niwaki as nw
    >>> def block(width=nw.Uniform(1, 4), height=nw.Uniform(1, 4)):
    ...     return nw.box((0, height / 2, 0), (width, height, 2))
    >>> target = nw.Target(*[getattr(block(3, 2), name)() for name in ("vertices", "faces")])
    >>> result = nw.fit(block, nw.match_volume(target), evaluations=20)  # doctest: +SKIP
    >>> sorted(result.best.parameters)  # doctest: +SKIP
    ['height', 'width']
    """
    if worker.ACTIVE:
        raise Loaded("fit-worker-ended", reason="`fit` was called in a worker process")
    generator, wish = generator_of(model), goal_of(goal)
    count("evaluations", evaluations)
    budget = math.inf if seconds is None else real("seconds", seconds, 0)
    place = None if folder is None else Path(folder)
    target = wish.score.target
    if align and target is None:
        raise bad("align", align, "a goal with a target to fill, beside which the mesh is placed", "False")
    start = _seed(seed, place)
    about = {
        **generator.identity(),
        "its parameters": "by run" if generator.space is None else text_hash(repr(generator.space.data())),
        "its goal": text_hash(repr(wish.score.data(Writer(files="hashed"))) + repr(wish.numbers)),
        "its `seed`": start,
        "its `align`": align,
    }
    bounds = Limit(real("limit", limit, 0))
    caller = _caller(generator, workers, bounds)
    start_time = time.monotonic()
    try:
        with opened(place, about) as archive:
            search = _Search(generator, wish, start, archive, caller, bounds, target if align else None)
            search.run(evaluations, budget, progress)
            search.warn()
            return FitResult(
                generator,
                search.loop,
                [archive.entries[number] for number in range(search.loop.evaluated)],
                interrupted=search.interrupted,
                seconds=time.monotonic() - start_time,
                spread=search.spread,
            )
    finally:
        caller.close()


def goal_of(goal: Any) -> Goal:
    """Return the goal that a person gives: a score, numbers, their product; a target or a mesh file, to be filled."""
    if isinstance(goal, Target | str | PathLike):
        return Goal.of(match_volume(goal))
    if isinstance(goal, Goal | Score):
        return Goal.of(goal)
    raise bad(
        "goal", goal, "a score such as `match_volume(target)`, a product of scores, or a mesh file", "a score"
    )


def _seed(seed: int | None, folder: Path | None) -> int:
    """Return the seed; without one that of the folder's archive, or a new one."""
    if seed is None and folder is not None:
        stored = (stored_settings(folder) or {}).get("its `seed`")
        if isinstance(stored, int):
            return stored
    return fresh(seed)


def _caller(generator: Generator, workers: int | None, limit: Limit) -> Caller:
    """Return worker processes, or calls in this process with a line that says what is lost."""
    number = cores() if workers is None else count("workers", workers)
    recipe = generator.recipe()
    if recipe is not None:
        return Workers(recipe, number, limit, generator.worker_command())
    warn(
        f"{generator.reason}, so it runs in this process: a call that hangs waits for ever, a crash ends the program, "
        "and one call runs at a time. Define the function at the top of a file to have it run in worker processes",
        SearchWarning,
    )
    return Here(generator, limit)


class _Search:
    """A search under way."""

    def __init__(
        self,
        generator: Generator,
        goal: Goal,
        seed: int,
        archive: Archive,
        caller: Caller,
        limit: Limit,
        target: Target | None,
    ) -> None:
        self.generator, self.goal, self.seed, self.archive = generator, goal, seed, archive
        self.caller, self.limit, self.target = caller, limit, target
        self.interrupted = False
        for entry in archive.entries.values():
            limit.note(Reply(kind=entry.kind, seconds=entry.seconds))
        space = generator.space or self._discovered()
        if target is not None:
            space = Space({**_parameters(space), **aligning.PARAMETERS})
        self.loop = FitLoop(space, goal, seed)
        self._known: dict[tuple[tuple[str, float], ...], Entry] = {}

    def _discovered(self) -> Space:
        """Find the parameters of a function that is defined by run."""
        missing = [number for number in range(discovery.RUNS) if number not in self.archive.probes]
        points = [discovery.probe(self.seed, number) for number in missing]
        replies: dict[int, Reply] = dict(self.caller.call(points))
        for place, number in enumerate(missing):
            self.archive.add_probe(number, replies[place].drawn)
        traces = [self.archive.probes[number] for number in range(discovery.RUNS)]
        if not any(traces) and (failed := [reply for reply in replies.values() if reply.failed]):
            raise _all_failed(self.generator.name, len(failed), failed[0].failed)
        return discovery.space_of(self.generator.name, [trace for trace in traces if trace])

    def run(self, evaluations: int, budget: float, progress: Callable[[FitProgress], None] | None) -> None:
        """Evaluate points until all evaluations, or the seconds, are spent, or Ctrl-C."""
        started = time.monotonic()
        stored = len(self.archive.entries)
        try:
            while self.loop.evaluated < evaluations and time.monotonic() - started < budget:
                points = self.loop.ask(min(BATCH, evaluations - self.loop.evaluated))
                if not points:
                    # All points of the space are known.
                    break
                self._evaluate(points)
                self._repeat([point.number for point in points if point.number % REPEATED == REPEATED - 1])
                if progress is not None and self.loop.evaluated > stored:
                    progress(self._progress(evaluations, started, stored))
            if len(self.loop.answers):
                self._repeat([self.loop.best.number])
        except KeyboardInterrupt:
            if not self.loop.evaluated:
                raise
            self.interrupted = True

    def _evaluate(self, points: Sequence[Point]) -> None:
        """Have points evaluated, and tell what came of them."""
        space = self.loop.space
        numbers = [
            {name: number_of(space, name, value) for name, value in point.parameters.items()}
            for point in points
        ]
        missing = []
        for place, point in enumerate(points):
            entry = self.archive.entries.get(point.number) or self._repeated(point.number, numbers[place])
            if entry is None or entry.numbers != numbers[place]:
                missing.append(place)
            else:
                self._tell(point, entry)
        for place, reply in self.caller.call([_without_align(numbers[place]) for place in missing]):
            point, values = points[missing[place]], numbers[missing[place]]
            self._tell(point, self._entry(point, values, reply))

    def _repeated(self, number: int, numbers: Mapping[str, float]) -> Entry | None:
        """Return the evaluation of an equal point, with another number."""
        entry = self._known.get(tuple(sorted(numbers.items())))
        if entry is None:
            return None
        again = replace(entry, number=number)
        self.archive.add(again)
        return again

    def _entry(self, point: Point, numbers: dict[str, float], reply: Reply) -> Entry:
        """Measure the mesh of a reply, and store it."""
        rest = (reply.kind, reply.seconds, reply.defects, reply.drawn)
        if reply.vertices is None or reply.faces is None:
            entry = Entry(point.number, numbers, Failure(reply.failed), *rest)
        else:
            vertices = self._placed(reply.vertices, point.parameters)
            outcome = self._measured(vertices, reply.faces)
            mesh = packed(vertices, reply.faces) if isinstance(outcome, Outcome) else b""
            entry = Entry(point.number, numbers, outcome, *rest, mesh)
        self.archive.add(entry)
        return entry

    def _placed(self, vertices: Any, values: Mapping[str, Any]) -> Any:
        return vertices if self.target is None else aligning.aligned(vertices, self.target, values)

    def _measured(self, vertices: Any, faces: Any) -> Outcome | Failure:
        """Score a mesh; a mesh that the engine refuses is a failure."""
        try:
            return self.goal.measure(scene_of_arrays(vertices, faces))
        except (ValueError, InputError) as error:
            return Failure(f"its mesh cannot be scored: {str(error).splitlines()[0]}")

    def _tell(self, point: Point, entry: Entry) -> None:
        self._known.setdefault(tuple(sorted(entry.numbers.items())), entry)
        used = None
        if self.generator.space is None and isinstance(entry.outcome, Outcome):
            # A run that failed may have drawn only some of its parameters.
            drawn = {row.name for row in entry.drawn} | set(aligning.PARAMETERS)
            used = [name for name in self.loop.space.names if name in drawn]
        self.loop.tell(point, entry.outcome, used=used)
        failed = [outcome for outcome in self.loop.outcomes[:ALL_FAILED] if isinstance(outcome, Failure)]
        if len(failed) == ALL_FAILED:
            raise _all_failed(self.generator.name, ALL_FAILED, failed[0].text)

    def _repeat(self, numbers: Sequence[int]) -> None:
        """Call points for a second time."""
        entries = [self.archive.entries[number] for number in numbers if number not in self.archive.repeats]
        entries = [entry for entry in entries if isinstance(entry.outcome, Outcome)]
        for place, reply in self.caller.call([_without_align(entry.numbers) for entry in entries]):
            entry, score, is_same = entries[place], -math.inf, False
            if reply.vertices is not None and reply.faces is not None:
                vertices = self._placed(reply.vertices, self._values(entry))
                is_same = packed(vertices, reply.faces) == entry.mesh
                outcome = entry.outcome if is_same else self._measured(vertices, reply.faces)
                score = outcome.score if isinstance(outcome, Outcome) else -math.inf
            self.archive.add_repeat(Repeat(entry.number, score, is_same))

    def _values(self, entry: Entry) -> dict[str, Any]:
        return {name: value_of(self.loop.space, name, number) for name, number in entry.numbers.items()}

    @property
    def spread(self) -> float | None:
        """The largest difference between the log scores of two calls of one point."""
        pairs = []
        for repeat in self.archive.repeats.values():
            outcome = self.archive.entries[repeat.number].outcome
            assert isinstance(outcome, Outcome)
            pairs.append(0.0 if repeat.is_equal else abs(outcome.score - repeat.score))
        return max((pair for pair in pairs if not math.isnan(pair)), default=None)

    def _progress(self, evaluations: int, started: float, stored: int) -> FitProgress:
        scores = [outcome.score for outcome in self.loop.outcomes if isinstance(outcome, Outcome)]
        done, each = self.loop.evaluated, (time.monotonic() - started) / max(self.loop.evaluated - stored, 1)
        failed = done - len(scores)
        left = each * (evaluations - done)
        return FitProgress(
            done, evaluations, failed, max(scores, default=-math.inf), self.limit.median or 0.0, left
        )

    def warn(self) -> None:
        """Warn about meshes with defects, a function that is not deterministic, and a target of another size."""
        entries = [self.archive.entries[number] for number in range(self.loop.evaluated)]
        meshes = [entry for entry in entries if isinstance(entry.outcome, Outcome)]
        texts = [_defects(meshes)]
        repeats = [repeat for repeat in self.archive.repeats.values() if not repeat.is_equal]
        if repeats:
            share = f"{len(repeats)} of {len(self.archive.repeats)}"
            texts.append(
                f"`{self.generator.name}` is not deterministic: {share} points gave another mesh when they were called "
                f"again, and their log scores differ by up to {self.spread:.3g} nats. Give its random numbers a seed"
            )
        target = self.goal.score.target
        if target is not None and meshes and self.target is None:
            best = self.archive.entries[self.loop.best.number]
            if best.mesh:
                scene = scene_of_arrays(*best.arrays)
                texts += [size_warning(target, scene), _far(target, scene)] if len(scene) else []
        if self.loop.evaluated and not self.goal.has_features:
            texts.append(
                f"the goal has nothing but its score to learn from ({', '.join(self.goal.without)}): the search needs "
                "many more evaluations than with a volume, an image or numbers"
            )
        for text in filter(None, texts):
            warn(text, SearchWarning)


def _defects(meshes: Sequence[Entry]) -> str:
    counts = {name: sum(name in entry.defects for entry in meshes) for name in ("open", "inverted", "flat")}
    shares = [f"{100 * number / len(meshes):.0f} % are {name}" for name, number in counts.items() if number]
    if not shares:
        return ""
    return (
        f"of {len(meshes)} meshes {', '.join(shares)}. They are scored all the same: what the outside reaches through "
        "a gap is not filled, and a flat mesh fills nothing"
    )


def _far(target: Target, scene: Scene) -> str:
    """Warn about a mesh that is farther from its target than the target is long."""
    low, high = scene.bounds
    goal = target.bounds
    gap = np.maximum(np.maximum(low - goal[1], goal[0] - high), 0.0)
    away = float(np.linalg.norm(gap))
    if away <= float(target.size.max()):
        return ""
    return (
        f"the best mesh is {away:.3g} from the target, which is {float(target.size.max()):.3g} long: move one of them, "
        "or search with `align=True`"
    )


def _without_align(numbers: Mapping[str, float]) -> dict[str, float]:
    """Return the numbers of a generator's own parameters."""
    return {name: number for name, number in numbers.items() if name not in aligning.PARAMETERS}


def _parameters(space: Space) -> dict[str, Any]:
    """Return the parameters from which an equal space can be made."""
    axes, parameters = space.axes, {}
    for axis in axes:
        range_: Any = axis.range or list(axis.values)
        if axis.kind == "whole":
            range_ = DiscreteUniform(axis.values[0], axis.values[-1])
        elif axis.weights is not None:
            range_ = Bernoulli(axis.weights[1]) if axis.values == (False, True) else Categorical(axis.weights)
        rules = [
            {axes[other].name: [axes[other].values[level] for level in levels] for other, levels in rule}
            for rule in axis.when
        ]
        parameters[axis.name] = Parameter(range_, rules or None)
    return parameters


def _all_failed(name: str, number: int, text: str) -> InputError:
    return InputError("all-failed", name=name, count=number, reason=text)
