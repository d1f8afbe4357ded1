"""Claim: a plain run makes the given choices, scores them, and reports faults at the user's lines."""

from __future__ import annotations

import niwaki as nw
import pytest
from niwaki.errors import InputError, ModelFault
from niwaki.lang.densities import grid, total
from niwaki.lang.plain import run_python
from specification import load

PROGRAM = """
def wing(x):
    size = uniform(0.5, 1)
    if flip(0.5):
        return size + wing(x + 1)
    return size

@model
def m(n=2):
    return [wing(i) for i in range(n)]
"""


@pytest.fixture
def model():
    return load(PROGRAM, "wings.py")


def test_a_seed_gives_the_same_run_and_its_choices_give_it_again(model) -> None:
    first = run_python(model, seed=3)
    assert run_python(model, seed=3) == first
    assert run_python(model, choices=first.choices) == first
    assert run_python(model, seed=4) != first


def test_the_seed_draws_missing_choices(model) -> None:
    run = run_python(model, seed=3, choices={"i[0]/wing/size": 0.75})
    assert run.choices["i[0]/wing/size"] == 0.75
    assert run.log_joint == run.log_prior


def test_a_call_of_a_model_returns_its_value(model) -> None:
    assert len(model(3)) == 3
    assert model.name == "m" and model.function.__name__ == "m"


def test_a_missing_choice_names_the_nearest(model) -> None:
    with pytest.raises(InputError) as caught:
        run_python(model, choices={"i[0]/wing/sise": 0.6, "q": 1})
    assert caught.value.code == "missing-choice"
    assert '"i[0]/wing/size"' in str(caught.value) and '"i[0]/wing/sise"' in str(caught.value)


def test_words_outside_of_a_model_raise() -> None:
    with pytest.raises(InputError, match="outside-a-model"):
        nw.gaussian(0, 1)


def test_a_model_needs_a_function() -> None:
    with pytest.raises(InputError, match="model-of-a-value"):
        nw.model(3)  # type: ignore[arg-type]


FAULTS = {
    "division-by-zero": "1 / (n - n)",
    "list-index": "[1][n]",
    "missing-key": "{'a': 1}['b']",
    "type-mismatch": "n + 'a'",
    "math-domain": "math.sqrt(-n)",
    "bad-text": "int('many')",
    "missing-element": "[1].index(n)",
    "missing-field": "n.size",
    "bad-parameter": "gaussian(0, -1)",
    "not-a-distribution": "sample(n)",
    "non-finite-score": "factor(math.inf)",
    "float-overflow": "math.exp(1000.0 * n)",
    "bad-argument": "max([])",
    "bad-format": "f'{n:q}'",
}


@pytest.mark.parametrize("code", FAULTS)
def test_faults_have_a_code_and_the_users_line(code: str) -> None:
    text = f"def part(n):\n    return {FAULTS[code]}\n\n@model\ndef m(n=2):\n    return part(n)\n"
    with pytest.raises(ModelFault) as caught:
        run_python(load(text, "part.py"), seed=1)
    fault = caught.value
    assert fault.code == code
    assert [call.function for call in fault.stack] == ["m", "part"]
    assert fault.stack[-1].span is not None and fault.stack[-1].span.line == 2
    assert "part.py:2:" in str(fault)


def test_endless_recursion_is_a_fault() -> None:
    text = "def part(n):\n    return part(n + 1)\n\n@model\ndef m():\n    return part(0)\n"
    with pytest.raises(ModelFault) as caught:
        run_python(load(text, "part.py"), seed=1)
    assert caught.value.code == "too-deep"
    assert "more ..." in str(caught.value)


def test_scores_are_on_the_grid() -> None:
    assert grid(0.1) * 2.0**32 == round(0.1 * 2.0**32)
    assert grid(-float("inf")) == -float("inf")
    assert grid(-(2.0**19) - 0.3) == -(2.0**19) - round(0.3 * 2.0**32) * 2.0**-32
    assert grid(1e300) == 1e300


def test_sums_are_exact_whatever_their_terms() -> None:
    assert total([1e18, 0.25, 1e300, -1e18, -1e300]) == 0.25
    assert total([1e308] * 3 + [-1e308] * 2) == 1e308
    assert total([1e308, 1e308]) == float("inf")
    assert total([0.5, -float("inf")]) == -float("inf")


def test_the_users_module_is_not_touched(model) -> None:
    before = set(model.function.__globals__)
    run_python(model, seed=1)
    assert set(model.function.__globals__) == before
    assert "__nw__" not in model.function.__code__.co_freevars


def test_a_model_made_inside_of_a_function_sees_its_variables() -> None:
    text = (
        "def make(k):\n    @model\n    def inner(x):\n        return x * k\n    return inner\nm = make(3)\n"
    )
    inner = load(text, "make.py")
    assert run_python(inner, 2, seed=1).value == 6
    assert "(mul" in inner.core().text and " 3)" in inner.core().text


def test_break_and_early_stops_leave_the_path_clean() -> None:
    text = (
        "@model\ndef m():\n    for i in range(3):\n        for j in range(3):\n            if j == 1:\n"
        "                break\n        if any(k == i for k in range(5)):\n            x = flip()\n    y = flip()\n"
    )
    run = run_python(load(text, "loops.py"), seed=1)
    assert list(run.choices) == ["i[0]/x", "i[1]/x", "i[2]/x", "y"]


@pytest.mark.parametrize("body", ["TABLE[name]", "TABLE.gone", "1 / 0", "int(name)"])
def test_a_host_function_fails_as_in_the_engine(body: str) -> None:
    host = f"TABLE = {{}}\n\n@host\ndef look_up(name):\n    return {body}\n"
    text = f"{host}\n@model\ndef m():\n    return look_up('x')\n"
    model = load(text, f"host-{body[:9]}.py")
    with pytest.raises(ModelFault) as plain:
        run_python(model)
    with pytest.raises(ModelFault) as engine:
        nw.run(model, seed=0)
    assert plain.value.code == "host-function"
    assert [str(caught.value).splitlines()[0] for caught in (plain, engine)] == [
        str(plain.value).splitlines()[0]
    ] * 2


@pytest.mark.parametrize(
    ("statement", "code"),
    [
        ("emit(box((0, 0, 0), (1, 1, 0)))", "bad-shape"),
        ("x = (1, 2)\n    x(1)", "not-callable"),
        ("sample((0, 2))", "not-a-distribution"),
    ],
)
def test_a_fault_has_the_code_of_the_engine(statement: str, code: str) -> None:
    model = load(f"@model\ndef m():\n    {statement}\n", f"fails-{code}.py")
    with pytest.raises(ModelFault) as plain:
        run_python(model)
    with pytest.raises(ModelFault) as engine:
        nw.run(model, seed=0)
    assert plain.value.code == engine.value.code == code
