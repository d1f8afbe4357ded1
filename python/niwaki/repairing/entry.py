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
from msgspec import structs

from niwaki.batches.pools import cores
from niwaki.errors import InputError
from niwaki.errors.settings import bad, count, real
from niwaki.fitting.pool import Caller, Here, Limit, Reply, Workers
from niwaki.inputs.files import bytes_of
from niwaki.repairing.conflicts import conflicts_of
from niwaki.repairing.literals import literals
from niwaki.repairing.prediction import Rules
from niwaki.repairing.result import Patch, Repair, edits_of
from niwaki.repairing.scripts import ScriptGenerator, split
from niwaki.repairing.search import Repairing, Trial
from niwaki.requirements import Keep, Violation
from niwaki.requirements.boxes import Array
from niwaki.requirements.form import Form
from niwaki.targets.sketches import Score, volume_score
from niwaki.targets.target import Target

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
    target: Target | str | PathLike[str] | None = None,
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
    target
        The solid, or its file, that `covered` and `outside` measure.
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
    judge: Keep | Judge | None = goal if goal is None or callable(goal) else _keep_of(goal)
    score = _score(judge, target)
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
    runs = _Runs(caller, judge, "xyz".index(axis), score)
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
            search = Repairing(
                loose,
                runs,
                base,
                rules,
                evaluations,
                exact=not is_scad,
                resizes=lambda row: bool({*row.names, row.line} & named),
                keep=judge if isinstance(judge, Keep) else None,
                form=Form.of_parts(runs.parts[0], runs.up, score),
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


def _keep_of(goal: Any) -> Keep:
    """Return requirements, read from a file if they are a path; a repair needs at least one."""
    if not isinstance(goal, Keep | str | PathLike):
        raise bad(
            "goal", goal, "`nw.Keep(...)`, the path of a requirements.toml, or a function", "`nw.Keep(...)`"
        )
    keep = Keep.of_data(structs.asdict(goal)) if isinstance(goal, Keep) else Keep.load(goal)
    if not keep.rows():
        place = "nw.Keep" if isinstance(goal, Keep) else Path(goal)
        raise InputError("bad-requirements", path=place, reason="there is no requirement to keep")
    return keep


def _score(judge: Keep | Judge | None, target: Target | str | PathLike[str] | None) -> Score | None:
    """Return the score that measures how parts fill the target; None if nothing asks for it."""
    asking = (
        [name for name, _, row in judge.active() if row.by == "target"] if isinstance(judge, Keep) else []
    )
    if bool(asking) == (target is not None):
        return None if target is None else volume_score(target)
    if asking:
        reason = "it is a share of a target, and a script has none of its own"
        raise InputError(
            "flag-alone", flag=asking[0], other="`--target` (in Python `target=`)", reason=reason
        )
    reason = "no other requirement looks at a target"
    raise InputError(
        "flag-alone", flag="--target", other="`covered` or `outside` in the requirements", reason=reason
    )


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

    def __init__(self, caller: Caller, judge: Keep | Judge | None, up: int, score: Score | None) -> None:
        self.caller, self.judge, self.up, self.score = caller, judge, up, score
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

    def _judged(self, reply: Reply, names: tuple[str, ...], boxes: Array) -> tuple[Violation, ...]:
        if isinstance(self.judge, Keep):
            rows = self.judge.violations(Form.of_parts(reply.parts, self.up, self.score))
        elif self.judge is not None:
            rows = list(self.judge(dict(zip(names, boxes, strict=True))))
        else:
            rows = [Violation(name, tuple(parts), float(amount)) for name, parts, amount in reply.facts]
        return tuple(row for row in rows if row.amount > 0.0)
