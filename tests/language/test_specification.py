"""Every program in the language's specification evaluates, or is refused, as written there."""

from __future__ import annotations

import ast
import math
from pathlib import Path

import pytest
from niwaki.errors import ModelError, ModelFault
from niwaki.lang.plain import run_python
from specification import Case, cases, load

FILES = sorted(Path(__file__).parent.glob("*.md"))
CASES = [case for path in FILES for case in cases(path)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_program(case: Case) -> None:
    model = load(case.program, "model.py")
    expected = case.expected
    assert expected, "a program that claims nothing"
    if "error" in expected:
        with pytest.raises(ModelError) as refused:
            model.core()
        assert str(refused.value) == expected["error"].rstrip("\n")
        return
    model.core()
    choices = ast.literal_eval(expected["choices"]) if "choices" in expected else None
    settings = {"choices": choices} if choices is not None else {"seed": 1}
    if "fault" in expected:
        with pytest.raises(ModelFault) as failed:
            run_python(model, **settings)
        assert str(failed.value) == expected["fault"].rstrip("\n")
        return
    run = run_python(model, **settings)
    if "value" in expected:
        value = eval(expected["value"], {"inf": math.inf})
        assert run.value == value
        assert repr(run.value) == repr(value)
    if "made" in expected:
        assert list(run.choices) == expected["made"].splitlines()
    if "scene" in expected:
        assert [address for address, _ in run.scene] == expected["scene"].splitlines()
    if "score" in expected:
        assert run.log_score == pytest.approx(float(expected["score"]), abs=1e-9)


def test_the_specification_is_there() -> None:
    assert len(CASES) > 50
