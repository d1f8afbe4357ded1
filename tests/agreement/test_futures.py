"""Every executor refuses the use of a future without `force`, with one code and the user's line.

In the engine's particles and enumeration a future may still have to run; chains and plain Python have its value at
once. If one of them accepted it, a wrong answer would go unnoticed.
"""

from __future__ import annotations

from typing import Any

import niwaki as nw
import pytest
from niwaki.errors import ModelFault
from niwaki.lang.plain import run_python
from test_engine import load

HEAD = """import math
from dataclasses import dataclass
from niwaki.methods import enumerate_all
from niwaki import model
from niwaki.words import *

@dataclass(frozen=True)
class Both:
    first: object
    second: object

def now(n):
    return n

def later(n):
    factor(-0.1 * n)
    return n + (1 if flip(0.5) else 0)

def same(promise):
    return promise

@model
def m():
    x = gaussian(0, 1)
    factor(-0.1 * x)
    f = future({callee}, 1)
"""

LOOKS = {
    "truth": "1 if f else 0",
    "not": "not f",
    "and": "f and 1",
    "condition": "condition(f)",
    "any": "any([f])",
    "bool": "bool(f)",
    "equal": "f == 1",
    "equal to nothing": "f == None",
    "unequal": "1 != f",
    "to itself": "f == f",
    "less": "f < 1",
    "in a chain": "0 < f < 1",
    "in": "f in [1, 2]",
    "in what holds it": "f in [f]",
    "among futures": "1 in (1, f)",
    "a key that is searched": "f in {'a': 1}",
    "inside a list": "[f] == [1]",
    "inside lists of other lengths": "[f] == [1, 2]",
    "inside one list": "(lambda xs: xs == xs)([f])",
    "inside a record": "Both(f, 1) == Both(1, 1)",
    "inside a dict": "{'a': f} == {'a': 1}",
    "inside tuples in order": "(f, 1) < (1, 2)",
    "text": "str(f)",
    "an f-string": "f'{f}'",
    "a format": "f'{f:.2f}'",
    "text of a list": "str([f])",
    "joined": "','.join([f])",
    "sum": "f + 1",
    "the other way round": "1 + f",
    "a list and it": "[1] + f",
    "negative": "-f",
    "power": "2 ** f",
    "a built-in sum": "sum([f])",
    "min": "min(f, 2)",
    "sorted": "sorted([f, 1])",
    "abs": "abs(f)",
    "int": "int(f)",
    "mathematics": "math.sqrt(f)",
    "length": "len(f)",
    "loop": "[k for k in f]",
    "range": "range(f)",
    "index": "[1, 2][f]",
    "indexed": "f[0]",
    "slice": "[1, 2][f:]",
    "key": "{'a': 1}[f]",
    "get": "{'a': 1}.get(f)",
    "method": "f.upper()",
    "field": "f.first",
    "count": "[1].count(f)",
    "position": "[1].index(f)",
    "position beside it": "[1, f].index(1)",
    "call": "f()",
    "parameter": "gaussian(f, 1)",
    "parameters": "categorical([f, 1.0])",
    "a distribution": "Gaussian(f, 1)",
    "as a distribution": "sample(f)",
    "observed": "observe(Gaussian(0, 1), f)",
    "observed with it": "observe(Bernoulli(f), True)",
    "factor": "factor(f)",
    "shape": "emit(box((0, 0, 0), (f, 1, 1)))",
    "emitted": "emit(f)",
    "query": "query(f, 1)",
    "vector": "vec(f, 1)",
    "word": "clip(f, 0, 1)",
    "unpacked": "(lambda p: [a for a, b in [p]])(f)",
    "inside": "infer(now, enumerate_all(), f)",
    "inside a closure": "infer(lambda: force(f), enumerate_all())",
}

#: A future that is passed on, and what is seen of it.
PASSES = {
    "f": 1,
    "[f, 2]": [1, 2],
    "(f, f)": (1, 1),
    "{'a': f}['a']": 1,
    "{'a': f}.get('b', f)": 1,
    "Both(f, 2).first": 1,
    "force(f)": 1,
    "force(force(f))": 1,
    "force(same(f))": 1,
    "(lambda: force(f))()": 1,
    "force(future(same, f))": 1,
    "force(force(future(same, f)))": 1,
    "[force(k) for k in [f, f]]": [1, 1],
    "force([f] + [f])": [1, 1],
    "len([f])": 1,
    "[f, 3][::-1]": [3, 1],
    "f is None": False,
    "force(f if x < 100 else None)": 1,
    "force(None if x < 100 else f) is None": True,
    "'a' in {'a': f}": True,
    "list(zip([f], [2]))": [(1, 2)],
    "choose([f, f])": 1,
    "sorted([f])": [1],
    "min([f, f], key=lambda k: force(k))": 1,
}

STRATEGIES = ("rerun", "resume", "cache", "c3")
METHODS: dict[str, Any] = {
    "forward": nw.forward(2),
    "importance": nw.importance(2),
    "particles": nw.smc(2),
    "particles, depth first": nw.smc(2, order="depth-first"),
    "hmc": nw.hmc(2, warmup=2),
}


def text(look: str, callee: str) -> str:
    return HEAD.format(callee=callee) + f"    return {look}\n"


def executors(model: Any) -> dict[str, Any]:
    """Every executor of a model, by name."""
    runs = {name: lambda method=method: nw.run(model, method, seed=1) for name, method in METHODS.items()}
    runs["plain"] = lambda: run_python(model, seed=1)
    for strategy in STRATEGIES:
        runs[strategy] = lambda s=strategy: nw.run(model, nw.mh(20, strategy=s), seed=1)
    return runs


@pytest.mark.parametrize("callee", ["now", "later"])
@pytest.mark.parametrize("look", LOOKS)
def test_a_look_is_refused_everywhere(look: str, callee: str) -> None:
    program = text(LOOKS[look], callee)
    for name, run in executors(load(program)).items():
        with pytest.raises(ModelFault) as error:
            run()
        fault = error.value
        assert fault.code == "future-not-forced", f"{name}: {fault}"
        assert fault.stack[0].span is not None and fault.stack[0].span.line == len(program.splitlines()), name
        assert "force(f)" in str(fault)


@pytest.mark.filterwarnings("ignore::niwaki.result.hmc.GradientWarning")
@pytest.mark.parametrize("look", PASSES)
def test_what_passes_a_future_on_is_not_refused(look: str) -> None:
    model = load(text(look, "now"))
    for name, run in executors(model).items():
        result = run()
        values = [result.value] if name == "plain" else [sample.value for sample in result]
        assert all(repr(value) == repr(PASSES[look]) for value in values), (name, values)


@pytest.mark.parametrize("look", LOOKS)
def test_enumeration_refuses_too(look: str) -> None:
    program = text(LOOKS[look], "later").replace("gaussian(0, 1)", "flip(0.5)")
    with pytest.raises(ModelFault, match="future-not-forced"):
        nw.run(load(program), nw.enumerate_all())
