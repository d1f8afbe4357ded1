"""The engine and plain Python do the same: from one set of choices the same value, scores, scene and answers.

Random programs (see `programs`), in both directions: the choices of an engine's forward run are given to plain
Python, and those of a plain run to the engine. Decisions, whole numbers and addresses are equal; reals agree to 1e-12
of their size. A model that fails in plain Python fails in the engine. Seeds are fixed; a failure prints the smallest
program that still fails. Nothing here is statistical.
"""

from __future__ import annotations

import linecache
import math
import sys
import types
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from features import FEATURES, feature
from niwaki.errors import ModelError, ModelFault, NiwakiError
from niwaki.lang.plain import Run, run_python
from programs import program, shrink

PROGRAMS, MORE = 200, 1000
NOT_A_PROGRAM = {"unknown-name", "used-before-assigned", "captured-then-changed"}


def load(text: str) -> Any:
    name = f"random-{hash(text)}.py"
    linecache.cache[name] = (len(text), None, text.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "made"}
    sys.modules.setdefault("made", types.ModuleType("made"))
    exec(compile(text, name, "exec"), space)
    return space["m"]


def is_same(a: Any, b: Any) -> bool:
    """Equal kind and value; reals to 1e-12 of their size."""
    # Plain Python indexes a NumPy array as it is; the engine has it as tuples.
    a = a.item() if isinstance(a, np.generic) else a
    if type(b).__name__ == "Opaque":
        # The engine's functions are only passed back.
        return callable(a) or type(a) is type(b)
    if type(a) is not type(b):
        return False
    if isinstance(a, float):
        return a == b or (math.isnan(a) and math.isnan(b)) or math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-12)
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(is_same, a, b))
    if isinstance(a, dict):
        return list(a) == list(b) and all(is_same(a[key], b[key]) for key in a)
    if type(a).__name__ == "Shape":
        return same_shape(a, b)
    if type(a).__name__ == "Vec":
        return is_same(a.parts, b.parts)
    return bool(a == b)


def same_shape(a: Any, b: Any) -> bool:
    if a.kind != b.kind or not np.array_equal(a.faces(), b.faces()):
        return False
    return bool(np.allclose(a.vertices(), b.vertices(), rtol=1e-12, atol=1e-12))


def facts(run: Run | nw.Sample) -> dict[str, Any]:
    """Return the facts of a run that must agree."""
    scene = run.scene if isinstance(run, Run) else [(part[0], part[1]) for part in run._trace.parts]
    return {
        "choices": dict(run.choices),
        "value": run.value,
        "log_prior": run.log_prior,
        "log_score": run.log_score,
        "scene": [(address, list(shapes)) for address, shapes in scene],
        "queries": dict(run.queries),
    }


def engine(model: Any, **settings: Any) -> dict[str, Any] | NiwakiError:
    try:
        return facts(nw.run(model, max_steps=2_000_000, **settings).best)
    except NiwakiError as error:
        return error


def plain(model: Any, **settings: Any) -> dict[str, Any] | NiwakiError:
    try:
        return facts(run_python(model, **settings))
    except NiwakiError as error:
        return error


def compared(first: dict[str, Any] | NiwakiError, second: dict[str, Any] | NiwakiError) -> str:
    """How two runs of one model differ, or nothing."""
    if isinstance(first, NiwakiError) or isinstance(second, NiwakiError):
        codes = [r.code if isinstance(r, NiwakiError) else "" for r in (first, second)]
        return "" if codes[0] == codes[1] else f"{codes}\n{first}\n{second}"
    for key in first:
        if not is_same(first[key], second[key]):
            return f"{key}:\n  {first[key]!r}\n  {second[key]!r}"
    return ""


def differs(text: str, seeds: int = 2) -> str:
    """Return the difference between plain Python and the engine for a program, or nothing."""
    try:
        model = load(text)
        model.core()
    except SyntaxError:
        return ""
    except ModelError as error:
        return "" if error.code in NOT_A_PROGRAM else str(error)
    try:
        model.program()
    except NiwakiError as error:
        return str(error)
    for seed in range(seeds):
        plain_facts = plain(model, seed=seed)
        if isinstance(plain_facts, dict) and (
            difference := compared(plain_facts, engine(model, choices=plain_facts["choices"]))
        ):
            return f"plain run, seed {seed}: {difference}"
        if isinstance(plain_facts, NiwakiError) and plain_facts.code == "too-deep":
            continue
        there = engine(model, seed=seed)
        if isinstance(there, dict):
            here = plain(model, choices=there["choices"])
            # A forward run ends early when it becomes impossible, and its trace is the whole run.
            if difference := compared(here, there):
                return f"engine's run, seed {seed}: {difference}"
    return ""


@pytest.mark.parametrize(
    "seed",
    [*range(PROGRAMS), *(pytest.param(seed, marks=pytest.mark.soak) for seed in range(PROGRAMS, MORE))],
)
def test_random_program(seed: int) -> None:
    whole = program(10_000 + seed)
    if differs(whole.text):
        small = shrink(whole, lambda text: bool(differs(text)))
        pytest.fail(f"{small.text}\n{differs(small.text)}")


@pytest.mark.parametrize("name", FEATURES)
def test_feature(name: str) -> None:
    assert not differs(feature(name), seeds=5)


def line(fault: ModelFault) -> int | None:
    place = fault.stack[-1].span if fault.stack else None
    return place and place.line


#: Of the first 250 programs from 50,000 on those that fail in plain Python with their number as the seed.
FAILING = (0, 60, 66, 94, 100, 158, 167, 173, 177, 191, 195, 203, 214, 233, 234, 249)


def test_faults_have_the_same_code() -> None:
    """A failure has the same code in plain Python and in the engine."""
    same_place = 0
    for seed in FAILING:
        model = load(program(50_000 + seed).text)
        model.core()
        with pytest.raises(ModelFault) as failed:
            run_python(model, seed=seed)
        fault = failed.value
        if fault.code == "too-deep":
            continue
        # The two draw other numbers, so that the engine may come to another fault first.
        there = engine(model, seed=seed)
        if isinstance(there, ModelFault) and line(there) == line(fault):
            same_place += 1
            assert there.code == fault.code
    assert len(FAILING) > same_place > 3
