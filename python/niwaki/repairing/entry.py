"""`nw.repair`: a script that breaks requirements, repaired by few of its own numbers.

repair = nw.repair("room.py", nw.Keep(collisions=False, within=((-2, 0, -2), (2, 2.6, 2))))
print(repair.best.difference())
repair.best.apply()
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from niwaki.batches.pools import cores
from niwaki.errors import InputError
from niwaki.errors.settings import bad, count, real
from niwaki.fitting.pool import Caller, Here, Limit, Reply, Workers
from niwaki.inputs.files import bytes_of
from niwaki.repairing.conflicts import conflicts_of
from niwaki.repairing.literals import literals
from niwaki.repairing.prediction import Array, Rules
from niwaki.repairing.requirements import Keep, keep_of
from niwaki.repairing.result import Patch, Repair, edits_of
from niwaki.repairing.scripts import ScriptGenerator, Violation, split
from niwaki.repairing.search import Key, Repairing, Trial

#: A function that judges parts: it gets their boxes by name, and returns what is violated.
Judge = Callable[[Mapping[str, Array]], Sequence[Violation]]


def repair(
    path: str | PathLike[str],
    goal: Keep | str | PathLike[str] | Judge | None = None,
    *,
    run: Callable[[str], Any] | None = None,
    free: Collection[str | int] = (),
    fix: Collection[str | int] = (),
    words: Sequence[Collection[str]] = (),
    patches: int = 1,
    evaluations: int = 100,
    workers: int | None = None,
    limit: float = 60.0,
    up: str | None = None,
    progress: Callable[[Trial], None] | None = None,
) -> Repair:
    """Repair a script that breaks requirements, by few of its own numbers.

    The literals of the script are choices with priors around what is written. Sizes, counts, colours and strings stay,
    unless they are named in `free`. Nothing is written: `repair.best.difference()` shows a patch, and
    `repair.best.apply()` writes it.

    Parameters
    ----------
    path
        A Python script, `file.py:function`, or an OpenSCAD file: see `niwaki.repairing.scripts` for how it shows its
        parts.
    goal
        `nw.Keep(...)`, the path of a `requirements.toml`, or a function of the boxes of all parts by name that returns
        a list of `nw.Violation`. None: `run` judges.
    run
        A function of a text that makes the parts of it, for scripts in a language of their own: what a script may
        show, or `nw.Output` with violations.
    free, fix
        Names and lines of literals that may change although they are sizes or counts, or that stay. A name is that of
        an argument, of a variable or of a called function.
    words
        Sets of names that may replace one another in the script: `[{"LEFT", "RIGHT"}]`.
    patches
        The most patches; they differ in the literals that change.
    evaluations
        The most runs of the script.
    workers
        Worker processes; the result does not depend on their number. Default: one for each processor; 0: this process.
    limit
        Seconds that a run may take: see `nw.fit`.
    up
        The axis that points up, "y" or "z". Default: "z" for OpenSCAD, else "y".
    progress
        A function that is called with each run.

    Returns
    -------
    Repair
        Patches, or what stands against what.

    Raises
    ------
    InputError
        `no-literals`: nothing in the script may change; `script-failed`: it fails as it is written.
    FileError
        The file cannot be read.

    Examples
    --------
    >>> import niwaki as nw
    >>> repair = nw.repair("room.py", nw.Keep(collisions=False))  # doctest: +SKIP
    >>> print(repair.best.difference())  # doctest: +SKIP
    """
    place, function = split(path if isinstance(path, str) else Path(path))
    count("patches", patches)
    count("evaluations", evaluations)
    is_scad = place.suffix.lower() == ".scad"
    axis = up or ("z" if is_scad else "y")
    if axis not in ("y", "z"):
        raise bad("up", up, '"y" or "z"', '"y"')
    if goal is None and run is None:
        raise bad(
            "goal", None, "`nw.Keep(...)`, the path of a requirements.toml, or a function", "`nw.Keep(...)`"
        )
    judge: Keep | Judge | None = goal if goal is None or callable(goal) else keep_of(goal)
    text = bytes_of(place, "model").decode()
    try:
        rows = literals(text, is_scad, free, fix, [sorted(entry) for entry in words])
    except SyntaxError as error:
        raise InputError("script-failed", path=place, reason=f"{error.msg} (line {error.lineno})") from None
    loose = [row for row in rows if not row.is_fixed]
    if not loose:
        raise InputError("no-literals", path=place)
    generator = ScriptGenerator(place, text, rows, function, run)
    bounds = Limit(real("limit", limit, 0))
    recipe = None if workers == 0 else generator.recipe()
    number = cores() if workers is None else count("workers", workers, 0)
    caller: Caller = Here(generator, bounds) if recipe is None else Workers(recipe, number, bounds)
    runs = _Runs(caller, judge, "xyz".index(axis))
    try:
        base = runs([{}])[0]
        if base.boxes is None:
            raise InputError("script-failed", path=place, reason=base.failed)
        search: Repairing | None = None
        interrupted = False
        if base.violations:
            names = runs.names
            size = float((base.boxes[:, 1].max(axis=0) - base.boxes[:, 0].min(axis=0)).max())
            rules = Rules(names, base.boxes, runs.up, size)
            if isinstance(judge, Keep) and judge.within is not None:
                rules.walls = np.array(judge.within)
            named = set(free)
            known = judge if isinstance(judge, Keep) else None
            search = Repairing(
                loose,
                runs,
                base,
                rules,
                evaluations,
                exact=not is_scad,
                resizes=lambda row: bool({*row.names, row.line} & named),
                judge=None if known is None else runs.foresight(known),
            )
            try:
                search.run(progress or (lambda trial: None), patches)
            except KeyboardInterrupt:
                interrupted = True
        answers = () if search is None else _patches(search, place, text, runs, patches)
        is_repaired = not base.violations or (bool(answers) and answers[0].repairs)
        return Repair(
            str(place),
            base.violations,
            answers,
            () if is_repaired or search is None else tuple(conflicts_of(search)),
            runs.number,
            runs.failures,
            interrupted,
            runs.parts[0],
        )
    finally:
        caller.close()


def _patches(search: Repairing, place: Path, text: str, runs: _Runs, most: int) -> tuple[Patch, ...]:
    """Return the patches: those that repair, by their cost; else the one that comes nearest."""
    rows = list(search.rows.values())
    out: list[Patch] = []
    known: set[frozenset[str]] = set()
    for trial in sorted(search.trials, key=lambda trial: (bool(trial.violations), trial.cost, trial.number)):
        if not trial.values or trial.cost >= search.base.cost:
            continue
        # More literals than another patch needs are no patch of their own.
        if any(answer <= trial.values.keys() for answer in known):
            continue
        if trial.violations and (out or trial.violated >= search.base.violated):
            continue
        known.add(frozenset(trial.values))
        edits = edits_of(text, rows, trial.values)
        parts = runs.parts[trial.number]
        out.append(
            Patch(str(place), edits, text, trial.violations, trial.moved, len(edits), trial.cost, parts)
        )
        if trial.violations or len(out) == most:
            break
    return tuple(out)


class _Runs:
    """Runs of the script, judged."""

    def __init__(self, caller: Caller, judge: Keep | Judge | None, up: int) -> None:
        self.caller, self.judge, self.up = caller, judge, up
        self.names: tuple[str, ...] = ()
        self.number = 0
        self.failures: dict[str, int] = {}
        self.parts: list[tuple[Any, ...]] = []

    def __call__(self, points: Sequence[Mapping[str, float]]) -> list[Trial]:
        """Run the script with each set of numbers."""
        replies: dict[int, Reply] = dict(self.caller.call(points))
        return [self._trial(points[place], replies[place]) for place in range(len(points))]

    def _trial(self, values: Mapping[str, float], reply: Reply) -> Trial:
        number = self.number
        self.number += 1
        failed = reply.failed
        names = tuple(name for name, _, _ in reply.parts)
        boxes = None
        violations: tuple[Violation, ...] = ()
        if not failed and not all(len(vertices) for _, vertices, _ in reply.parts):
            failed = "a part is empty"
        if not failed:
            every = np.array([[v.min(axis=0), v.max(axis=0)] for _, v, _ in reply.parts])
            violations = self._judged(reply, names, every)
            self.names = self.names or names
            if names == self.names:
                boxes = every
            else:
                failed = f"it makes other parts: {len(names)} of them"
        if failed:
            self.failures[failed] = self.failures.get(failed, 0) + 1
        self.parts.append(reply.parts)
        return Trial(number, dict(values), boxes, violations, failed)

    def foresight(self, keep: Keep) -> Callable[[Array], Mapping[Key, float]]:
        """Return a function that judges predicted boxes."""
        return lambda boxes: {row.key: row.amount for row in keep.of_boxes(self.names, boxes, self.up)}

    def _judged(self, reply: Reply, names: tuple[str, ...], boxes: Array) -> tuple[Violation, ...]:
        if isinstance(self.judge, Keep):
            rows = self.judge.violations(reply.parts, boxes, self.up)
        elif self.judge is not None:
            rows = list(self.judge(dict(zip(names, boxes, strict=True))))
        else:
            rows = [Violation(name, tuple(parts), float(amount)) for name, parts, amount in reply.facts]
        return tuple(row for row in rows if row.amount > 0.0)
