"""Plain Python and the engine agree on programs in which a name has several meanings; each once was a difference."""

from __future__ import annotations

import pytest
from features import HEADER
from niwaki.errors import NiwakiError
from test_engine import compared, differs, engine, load, plain

PROGRAMS = {
    "an inner model assigns a name of the function around it": """
def m():
    x = 1
    def near(q):
        x = gaussian(0, 1)
        return x
    return x, infer(near, forward(), 1)
""",
    "an inner model that captures a function, a distribution and a default": """
def m():
    x = 1
    d = Gaussian(x, 1)
    g = lambda u, w=x + 1: u + w + gaussian(0, 1)
    def near(q, k=x + 2):
        x = sample(d) + k
        return g(x) + q
    return infer(near, forward(), 1), infer(near, importance(5), 2)
""",
    "an inner model that calls a function which captures": """
def m():
    x = uniform(0, 1)
    def low(n):
        return gaussian(x, 1) + n
    def high(n):
        return low(n) + (high(n - 1) if n > 0 else 0)
    return infer(high, smc(3), 2), infer(lambda n: high(n), forward(), 1)
""",
    "inner models that are values, alone and in values": """
def m():
    x = gaussian(0, 1)
    def near(x):
        return gaussian(x, 1)
    fs = [near, lambda x: near(x) * 2]
    pair = (near, {"a": fs[1]})
    return infer(fs[1], forward(), x), infer(lambda f, p: f(1) + p[1]["a"](2), forward(), fs[0], pair)
""",
    "a loop over a pattern in an inner model": """
def m():
    a = 3
    def near(n):
        for a, b in [(1, 2), (n, 3)]:
            n = n + gaussian(a, b)
        return n + sum([gaussian(a, 1) for a in range(2)])
    return infer(near, forward(), a)
""",
    "an inner model within an inner model": """
def m():
    x = 2
    def low(x):
        y = gaussian(x, 1)
        return y
    def high(y):
        x = infer(low, forward(), y)
        return x + gaussian(0, 1)
    return infer(high, importance(3), x)
""",
    "functions that capture what a branch may not have assigned": """
def m():
    c = flip(0.5)
    if c:
        z = uniform(0, 1)
        def g(x, n=uniform(0, 1)):
            return x + n
    def h(x, deep):
        def k(y):
            return y + z
        if deep > 0:
            return h(x + uniform(0, 1), deep - 1)
        return g(k(x)) if c else x
    fs = [lambda x: h(x, 1), lambda x: x + z]
    s = infer(lambda f: f(1.0), importance(4), fs[0]) + force(future(h, 1.0, 2))
    for i in range(2):
        s = s + fs[0](s) + gaussian(0, 1)
    return s + fs[1](2) if c else s
""",
    "two functions of one name": """
def make(k):
    def part(x):
        y = gaussian(x, k)
        return y
    return part
def m():
    first, second = make(1), make(2)
    return infer(first, forward(), 1), infer(second, forward(), 1), second(1)
""",
    "keywords in another order": """
def h(a, b, c=5, *, d=6):
    return (a, b, c, d)
def m():
    def near(a, b, c=gaussian(0, 1), *, d=(lambda: 2)()):
        return (a, b, c, d)
    return h(d=gaussian(3, 1), b=gaussian(2, 1), a=gaussian(1, 1)), near(b=gaussian(2, 1), a=gaussian(1, 1))
""",
    "a default that is called": """
def h(x, b=(lambda: 2)(), c=lambda v: v + 1):
    return c(x + b)
def m():
    return h(gaussian(0, 1)), [k(1) for k in [h]]
""",
    "comprehensions that shadow": """
def m():
    x = 5
    return [[x for x in range(x)] for x in range(3)], x, [x + n for n in (x, 1) for x in (n, 2)]
""",
    "long conditions with statements in them": """
def m():
    n = poisson(2)
    a = any(v > 1 for v in [n]) and n and any(v > 2 for v in [n]) and [n] and any(v > 3 for v in [n])
    b = n < abs(n + 1) < max([v for v in [n + 2]]) < n + 3 < sum(v for v in [n, 4]) < 9
    return a, b, (any([]) or n or all(v < 3 for v in [n]) or flip(0.5))
""",
}


@pytest.mark.parametrize("name", PROGRAMS)
def test_the_two_ways_agree(name: str) -> None:
    helpers, _, body = PROGRAMS[name].rpartition("def m():")
    assert not differs(f"{HEADER}{helpers}@model\ndef m():{body}", seeds=3)


FAULTS = {
    "query([1, 2], 3.0)": "type-mismatch",
    "query((1, [2]), 3.0)": "type-mismatch",
    "query(box((0, 0, 0), (1, 1, 1)), 3.0)": "type-mismatch",
    "query(lambda: 1, 3.0)": "type-mismatch",
    "query(G, 3.0)": "type-mismatch",
    "query(1, 3.0); query(1.0, 2)": "query-twice",
    "query(True, 3.0); query(1, 2)": "query-twice",
    "emit(1)": "type-mismatch",
    "emit(None)": "type-mismatch",
    "emit([box((0, 0, 0), (1, 1, 1)), [1]])": "type-mismatch",
    "emit(Point(1.0))": "type-mismatch",
    "emit({})": "type-mismatch",
    "sample(3)": "not-a-distribution",
    "observe(3, 1.0)": "not-a-distribution",
    'observe(Gaussian(0, 1), "a")': "type-mismatch",
    "observe(Gaussian(0, 1), None)": "type-mismatch",
    "observe(Bernoulli(0.5), G)": "type-mismatch",
    'observe(Categorical([1, 2]), {"a": 1})': "type-mismatch",
    "observe(Gaussian(0, -1), 1.0)": "bad-parameter",
    'observe(Gaussian(0, -1), "a")': "bad-parameter",
}


UNASSIGNED = {
    "a variable that a function reads": "z = 1\n    def h(): return z",
    "a default of a function that is called": "def g(n=uniform(0, 1)): return n\n    def h(): return g(2)",
    "a default of a function as a value": "def g(n=uniform(0, 1)): return n\n    def h(): return [g]",
    "a variable in an inner model": "z = 1\n    def h(): return infer(lambda: z, forward())",
}


@pytest.mark.parametrize("name", UNASSIGNED)
def test_what_has_no_value_is_a_fault_where_it_is_read(name: str) -> None:
    """In the function that captures it, not where that function is defined or called."""
    text = f"def m():\n    if flip(0.0):\n        {UNASSIGNED[name]}\n    return"
    for end, code in (("h()", "unassigned-variable"), ("len([h])", None)):
        model = load(f"{HEADER}@model\n{text} {end}\n")
        for facts in (plain(model, seed=1), engine(model, seed=1)):
            assert getattr(facts, "code", None) == code, facts


@pytest.mark.parametrize("line", FAULTS)
def test_the_two_ways_refuse(line: str) -> None:
    model = load(f"{HEADER}@model\ndef m():\n    {line}\n    return 1\n")
    for facts in (plain(model, seed=1), engine(model, seed=1)):
        assert isinstance(facts, NiwakiError) and facts.code == FAULTS[line], facts  # type: ignore[attr-defined]


def test_a_message_has_the_name_of_the_source() -> None:
    """Where a name has several variables, the engine's message has it as it was written."""
    text = "def m():\n    n = 1\n    return n, [x for x in [1, 2] for n in (n, 1)]"
    model = load(f"{HEADER}@model\n{text}\n")
    for facts in (plain(model, seed=1), engine(model, seed=1)):
        assert isinstance(facts, NiwakiError) and facts.code == "unassigned-variable", facts  # type: ignore[attr-defined]
        assert "%" not in str(facts)


def test_a_default_of_any_constant() -> None:
    text = (
        "def m(f=lambda v: v + 1, d=G, p=Leaf(2.5), xs=[G, 1]):\n    return f(1), sample(d), p.size, len(xs)"
    )
    model = load(f"{HEADER}@model\n{text}\n")
    facts = plain(model, seed=1)
    assert isinstance(facts, dict) and not compared(facts, engine(model, choices=facts["choices"]))


def test_a_new_variable_elsewhere_changes_no_stream() -> None:
    """The random numbers of an inner function do not depend on the names of the function around it."""
    text = (
        HEADER
        + """
@model
def m():
    FIRST
    def near(q):
        x = gaussian(0, 1)
        for a, b in [(1, 2)]:
            y = gaussian(a, b)
        return x + y + q + [gaussian(x, 1) for x in (1, 2)][0]
    return infer(near, forward(), 1), near(2)
"""
    )
    first, second = (
        engine(load(text.replace("FIRST", line)), seed=3) for line in ("n = 1", "x, a, y, q = 1, 2, 3, 4")
    )
    assert isinstance(first, dict) and isinstance(second, dict)
    assert first["value"] == second["value"]
