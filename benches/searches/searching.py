"""One search on one thread: its best result, how complete that is, and its CPU seconds.

CPU seconds are those of the process for the whole call of `niwaki.grow`, as a user writes it, after the model has been
compiled. A method's size is scaled, once or twice, so that its searches of the pilot seeds together cost what those of
the default cost. Costs vary from search to search, so this is rough: what each search used is in its record.
"""

from __future__ import annotations

import math
import time
import warnings
from functools import cache, lru_cache
from typing import Any

import niwaki as nw
from niwaki import _engine
from niwaki.search import SearchWarning

from searches.methods import Method, method
from searches.problems import Case, Problem, problem
from searches.seeds import PILOT

#: Errors that say that no run was possible.
DEAD = ("everything-impossible", "no-start", "obstacle-at-start")
#: A size whose cost is within this factor of the budget is scaled once more, not measured once more.
NEAR = 1.5
#: Most by which a size is made larger and smaller at once. Searches that died cost next to nothing, so that their sizes
#: grow until one lives, which may cost a thousand times as much.
LARGER, SMALLER = 3.0, 30.0

Job = tuple[str, str, int, int]


@lru_cache(maxsize=8)
def case_of(name: str, seed: int) -> Case:
    """The case of a problem, kept for the methods that take turns on it."""
    return problem(name).case(seed)


def grown(task: Problem, case: Case, how: Method, size: int, seed: int) -> nw.Result | None:
    """The result of a search, None where no run was possible."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SearchWarning)
        try:
            return nw.grow(
                task.model, case.target, score=case.score, seed=seed, threads=1, **how.settings(size)
            )
        except nw.InputError as error:
            if error.code not in DEAD:
                raise
            return None


@cache
def compiled(name: str) -> None:
    """Compile a model, with a search that is too small to cost anything."""
    task_problem = problem(name)
    grown(task_problem, case_of(name, PILOT[0]), Method("", lambda n: {"particles": n}), 2, 0)


def searched(job: Job) -> dict[str, Any]:
    """The record of a search: a job is the names of a problem and a method, the method's size, and a seed."""
    name, how, size, seed = job
    compiled(name)
    task, case = problem(name), case_of(name, seed)
    start = time.process_time()
    result = grown(task, case, method(how), size, seed)
    record: dict[str, Any] = {"problem": name, "method": how, "seed": seed, "size": size}
    record["settings"] = method(how).text(size)
    record["cpu"] = time.process_time() - start
    record["empty"] = empty(case)
    if result is None or not math.isfinite(result.best.log_score):
        return record | {"score": None, "shares": {}, "primitives": 0}
    best = result.best
    return record | {
        "score": best.log_score,
        "shares": case.measure(best.scene),
        "primitives": best.primitives,
        "spent": sum(getattr(result.info, "spent", {}).values()),
        "rounds": max(len(getattr(result.info, "rounds", ())) - 1, 0),
        "restarts": getattr(result.info, "restarts", 0),
    }


def empty(case: Case) -> float:
    """The log score of the empty scene, nats: what a search that dies leaves its user with."""
    score = nw.Score() if case.score is None else case.score
    if case.target is not None:
        score *= nw.match_volume(case.target)
    return _engine.Sketch(score.specs).log_score()


def cost(name: str, how: str, size: int) -> float:
    """CPU seconds of the searches of the pilot seeds together."""
    return sum(searched((name, how, size, seed))["cpu"] for seed in PILOT)


def sized(job: tuple[str, str, float]) -> dict[str, Any]:
    """The record of a size: a job is the names of a problem and a method, and the CPU seconds that it may use.

    The seconds are those of all pilot seeds together; for a method without a size they are measured here.
    """
    name, how, budget = job
    size = method(how).size
    spent = cost(name, how, size)
    if size:
        if not 1.0 / NEAR < budget / spent < NEAR:
            size = scaled(size, budget / spent)
            spent = cost(name, how, size)
        size = scaled(size, budget / spent)
    settings = method(how).text(size)
    return {"problem": name, "method": how, "size": size, "settings": settings, "pilot_cpu": spent}


def scaled(size: int, ratio: float) -> int:
    """A size times a ratio."""
    return max(2, round(size * min(LARGER, max(1.0 / SMALLER, ratio))))
