"""Claim: the core form follows its grammar; the core form of two models is a golden file, for review."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from niwaki.errors import ModelError
from niwaki.lang.core import Form, literal, write
from specification import load

GOLDEN = Path(__file__).parents[2] / "golden"

SHIP = """
def wing(x, size=1.0):
    zc = gaussian(x, sd=0.5)
    emit(box((x, 0, zc), (size, 1, 2)), box((-x, 0, zc), (size, 1, 2)))
    if flip(0.5) and zc < 3:
        future(wing, x + size)
    return zc


@model
def m(n=3):
    \"\"\"A body with wings.\"\"\"
    kinds = ["box", "cylinder"]
    rear = -5.0
    for i in range(n):
        kind = choose(kinds)
        rear += uniform(2, 5) if kind == "box" else 1.0
        if 0 < rear < 4:
            continue
        future(wing, rear)
    query("length", rear)
    return rear
"""

CLOSURES = """
from typing import NamedTuple

class Part(NamedTuple):
    kind: str
    size: float = 1.0

SIZES = [1, 2, 3.5]
RULES = [lambda x: x + 1]

@model
def m(n):
    def even(k):
        return k == 0 or odd(k - 1)
    def odd(k):
        return k != n and even(k - 1)
    parts = [Part("a", s * n) for s in SIZES if s != 2]
    best = max(parts, key=lambda p: p.size - n)
    (a, *rest), f = SIZES, lambda x, by=n + 1: x * by
    while any(p.size > 100 for p in parts):
        parts = parts[1:]
    assert a < f(2) < 10 ** 6, f"{a:.2f} is {best.kind!r}"
    return sorted(map(f, rest), reverse=True), even(4), RULES[0](n), {"k": -1}
"""


@pytest.mark.parametrize(("name", "program"), [("ship", SHIP), ("closures", CLOSURES)])
def test_golden(name: str, program: str, golden) -> None:
    golden(GOLDEN / f"{name}.core", load(program, f"{name}.py").core().text)


def test_literals_read_back() -> None:
    assert [literal(x) for x in (True, 0, -1.5, None, 1e300)] == ["true", "0", "-1.5", "none", "1e+300"]
    assert [literal(x) for x in (math.inf, -math.inf, math.nan)] == ["inf", "-inf", "nan"]
    assert literal('a"\n\u00e9') == '"a\\"\\n\\u00e9"'


def test_labels_and_spans_can_be_left_out() -> None:
    core = load(SHIP, "ship.py").core()
    assert "@" not in core.write(spans=False)
    assert "#" not in core.write(components=False)
    assert core.parameters == ("n",) and core.required == 0


def test_an_empty_head_is_a_plain_list() -> None:
    assert write(Form("unpack", [Form("", ["$a", "$b"]), "$c"])) == "(unpack ($a $b) $c)"


def test_the_core_form_is_kept() -> None:
    model = load(SHIP, "ship.py")
    assert model.core() is model.core()


def test_distributions_are_not_records() -> None:
    text = "D = Uniform(0, 1)\n\n@model\ndef m():\n    return sample(Gaussian(sd=2)) + sample(D)\n"
    core = load(text, "dist.py").core()
    assert "(dist gaussian 0.0 2)" in core.write(spans=False)
    assert "(dist uniform 0 1)" in core.write(spans=False)
    assert not core.classes


def test_values_that_are_not_hashable_are_refused() -> None:
    for call, code in (("map(T, [1])", "unknown"), ("T(1)", "not-a-function")):
        text = f"T = ([1],)\n\n@model\ndef m():\n    return {call}\n"
        try:
            load(text, "unhashable.py").core()
        except ModelError as error:
            assert error.code == code
        else:
            assert code == "unknown", "a tuple is a value; calling it fails when it runs"
