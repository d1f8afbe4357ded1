"""Plain Python and a reader of the core form do the same: values, choices, scores, scenes and answers, exactly.

Random programs (see `programs`) without inner searches, which the reader has not, each run with a few seeds. Seeds
are fixed; a failure prints the smallest program that still fails. Nothing here is statistical.
"""

from __future__ import annotations

import linecache
from typing import Any

import pytest
from core_reader import read
from niwaki.errors import ModelError, ModelFault
from niwaki.lang.plain import Run, run_python
from programs import program, shrink

SEEDS, MORE = 80, 400
NOT_A_PROGRAM = {"unknown-name", "used-before-assigned", "captured-then-changed"}


def load(text: str) -> Any:
    name = f"random-{hash(text)}.py"
    linecache.cache[name] = (len(text), None, text.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "made"}
    exec(compile(text, name, "exec"), space)
    return space["m"]


def seen(run: Run) -> tuple[str, ...]:
    return tuple(map(repr, (run.value, run.choices, run.log_prior, run.log_score, run.scene, run.queries)))


def differs(text: str) -> str:
    """Return the fault of a program, or nothing."""
    try:
        model = load(text)
        core = model.core()
    except SyntaxError:
        return ""
    except ModelError as error:
        return "" if error.code in NOT_A_PROGRAM else str(error)
    for seed in range(3):
        try:
            plain: tuple[str, ...] | None = seen(run_python(model, seed=seed))
        except ModelFault:
            plain = None
        try:
            other: tuple[str, ...] | None = seen(read(core, [], seed=seed))
        except Exception as error:
            if plain is not None:
                return f"seed {seed}: {error!r}"
            continue
        if plain != other:
            return f"seed {seed}:\n{plain}\n{other}"
    return ""


@pytest.mark.parametrize(
    "seed", [*range(SEEDS), *(pytest.param(seed, marks=pytest.mark.soak) for seed in range(SEEDS, MORE))]
)
def test_random_program(seed: int) -> None:
    whole = program(seed, inner=False)
    if differs(whole.text):
        small = shrink(whole, lambda text: bool(differs(text)))
        pytest.fail(f"{small.text}\n{differs(small.text)}")


def test_the_programs_are_worth_running() -> None:
    """Most of them compile and finish, and together they make choices, scenes and scores."""
    runs = []
    for seed in range(60):
        try:
            model = load(program(seed, inner=False).text)
            model.core()
            runs.append(run_python(model, seed=seed))
        except (ModelError, ModelFault):
            continue
    assert len(runs) > 45
    assert sum(len(run.choices) for run in runs) > 300
    assert sum(len(run.scene) for run in runs) > 20
    assert sum(run.log_score != 0 for run in runs) > 10
