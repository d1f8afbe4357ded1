"""Searches from Python: methods agree with exact answers, seeds decide everything, and bad settings have messages."""

from __future__ import annotations

import linecache
import math
import os
import re
import signal
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki.errors import NiwakiError, memory
from niwaki.gallery import entry

GOLDEN = Path(__file__).parents[2] / "golden"


def load(text: str, name: str = "garden.py") -> Any:
    """The model `m` of a program."""
    whole = f"from niwaki import host, model; from niwaki.words import *\n\n{text}"
    linecache.cache[name] = (len(whole), None, whole.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "garden"}
    exec(compile(whole, name, "exec"), space)
    return space["m"]


BLOCK = load("@model\ndef m():\n    emit(box((0, 0, 0), (uniform(1, 2), 1, 1)))\n", "block.py")
COINS = load("""
@model
def m():
    a = flip(0.3)
    b = flip(0.6)
    condition(a or b)
    factor(-0.5 if a else 0.0)
    return (a, b)
""")


def exact() -> dict[tuple[bool, bool], float]:
    """By hand: the two coins, without the case of neither."""
    weights = {(True, True): 0.18 * math.exp(-0.5), (True, False): 0.12 * math.exp(-0.5), (False, True): 0.42}
    total = sum(weights.values())
    return {key: value / total for key, value in weights.items()}


def test_enumeration_is_exact() -> None:
    result = nw.run(COINS, method=nw.enumerate_all())
    assert result.distribution() == pytest.approx(exact())
    assert result.log_evidence == pytest.approx(math.log(0.3 * math.exp(-0.5) + 0.42))


@pytest.mark.parametrize(
    "method", [nw.smc(particles=4000), nw.importance(4000), nw.rejection(4000, bound=0.0)], ids=repr
)
def test_samples_follow_the_exact_answer(method: Any) -> None:
    """Fixed seed. The bound on a share of 4000 (effective about 3000) is 4.5 standard errors: false alarm 7e-6 each."""
    shares = nw.run(COINS, method=method, seed=11).distribution()
    for value, share in exact().items():
        assert abs(shares.get(value, 0.0) - share) < 4.5 * math.sqrt(share * (1 - share) / 2500)


def test_a_seed_decides_and_a_fresh_one_is_kept() -> None:
    first = nw.run(COINS, method=nw.smc(particles=20))
    again = nw.run(COINS, method=nw.smc(particles=20), seed=first.seed)
    assert [s.choices for s in first] == [s.choices for s in again]
    assert nw.run(COINS).seed != nw.run(COINS).seed


@pytest.mark.parametrize("order", ["stochastic", "depth-first"])
@pytest.mark.parametrize("ess", [None, 0.5])
def test_the_same_bytes_on_any_number_of_threads(order: str, ess: float | None, tmp_path: Path) -> None:
    ship = entry("spaceship")
    assert ship is not None
    target = ship.target()
    assert target is not None
    seen = []
    for threads in (1, 2, 8):
        result = nw.grow(
            ship.model, target, particles=60, voxel=0.5, seed=5, threads=threads, order=order, ess=ess
        )
        best = result.best
        mesh = best.export(tmp_path / f"{threads}.glb").read_bytes()
        seen.append((best.log_score, best.log_prior, best.choices, best.order, mesh))
    assert seen[0] == seen[1] == seen[2]


def test_a_branch_that_is_added_changes_no_other_choice() -> None:
    tree = """
@model
def m():
    trunk = gaussian(5, 1)
    sides = [branch(trunk, i) for i in range(3)]
    {more}
    lean = uniform(-1, 1)
    return trunk, sides, lean

def branch(length, i):
    size = uniform(0.3, 0.6) * length
    return branch(size, i) if flip(0.5) else size
"""
    less = nw.run(load(tree.format(more="pass"), "less.py"), seed=3).best.choices
    more = nw.run(load(tree.format(more="extra = branch(gaussian(2, 1), 9)"), "more.py"), seed=3).best.choices
    assert set(less) < set(more)
    assert {address: more[address] for address in less} == less


def test_the_trace_of_a_sample_has_its_scores() -> None:
    ship = entry("spaceship")
    assert ship is not None
    target = ship.target()
    assert target is not None
    result = nw.run(
        ship.model,
        method=nw.smc(particles=40),
        score=nw.no_self_intersection() * nw.match_volume(target, 0.5),
        seed=2,
    )
    for sample in result[:10]:
        trace = sample._trace.run
        assert (trace.log_score, trace.log_prior) == (sample.log_score, sample.log_prior)
        assert (trace.primitives, trace.similarity) == (sample.primitives, sample.similarity)
        again = nw.run(ship.model, choices=sample.choices, score=result.score).best
        assert again.log_score == sample.log_score
        assert again.value == sample.value


def test_ctrl_c_keeps_the_best_so_far() -> None:
    chain = load("""
@model
def m():
    x = 0.0
    for i in range(100000):
        x = x + gaussian(0, 1)
        factor(-x * x)
    return x
""")
    seen: list[nw.result.Progress] = []

    def watch(now: nw.result.Progress) -> None:
        seen.append(now)
        if len(seen) == 3:
            os.kill(os.getpid(), signal.SIGINT)

    assert threading.current_thread() is threading.main_thread()
    for threads in (None, 2):
        seen.clear()
        result = nw.run(chain, method=nw.smc(particles=50), seed=1, progress=watch, threads=threads)
        assert result.interrupted and len(result) == 50
        assert not result.best.has_ended and len(result.best.choices) > 0
        assert seen[-1].done > seen[0].done


def test_what_progress_raises_ends_the_search() -> None:
    endless = load("@model\ndef m():\n    for i in range(1000000):\n        factor(-flip())\n")

    def refuse(_: nw.result.Progress) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        nw.run(endless, method=nw.smc(particles=50), progress=refuse)


# every message that a search can end with

PROGRAMS = {
    "endless recursion": "def grow(n):\n    return grow(n + flip())\n\n@model\ndef m():\n    return grow(1)\n",
    "an endless pure loop": "@model\ndef m():\n    n = 1\n    while n > 0:\n        n = 1 - n + n\n    return n\n",
    "endless pure recursion": "def f(n):\n    return f(n + 1)\n\n@model\ndef m():\n    return f(1) + flip()\n",
    "an index outside of a list": "@model\ndef m():\n    xs = [1, 2, 3]\n    return xs[flip() + 3]\n",
    "a parameter of a distribution, three calls deep": (
        "def leaf(s):\n    return gaussian(0, s)\n\ndef twig(s):\n    return leaf(s - 2)\n\n"
        "@model\ndef m():\n    for i in range(3):\n        x = twig(1 - i)\n    return x\n"
    ),
    "division by zero": "@model\ndef m():\n    return 1 / (2 - 2 * True)\n",
    "an integer overflow": "@model\ndef m():\n    return 2 ** (62 + flip(1.0)) * 2\n",
    "not enumerable": "@model\ndef m():\n    return gaussian(0, 1)\n",
    "two answers under one key": "@model\ndef m():\n    query('a', 1)\n    query('a', 2)\n",
    "a score that is no number": "@model\ndef m():\n    factor(1e308 * 1e10)\n",
    "an assertion": "@model\ndef m():\n    x = 3\n    assert x < 2, 'too many'\n",
    "a shape of no size": "@model\ndef m():\n    emit(box((0, 0, 0), (1, 0, 1)))\n",
    "not a shape": "@model\ndef m():\n    emit((1, 2, 3))\n",
    "types that do not fit": "@model\ndef m():\n    return flip() + 'a'\n",
    "everything impossible": "@model\ndef m():\n    x = flip(0.5)\n    condition(False)\n    return x\n",
    "a host function that fails": (
        "@host\ndef look_up(name):\n    return {}[name]\n\n@model\ndef m():\n    return look_up('oak')\n"
    ),
}

SETTINGS: dict[str, Callable[[], Any]] = {
    "particles": lambda: nw.smc(particles=0),
    "a number of particles that is none": lambda: nw.smc(1.5),
    "a number of particles of many digits": lambda: nw.smc(10**5000),
    "particles that do not fit": lambda: nw.run(COINS, nw.smc(10**15)),
    "power": lambda: nw.smc(power=-1.0),
    "ess": lambda: nw.smc(ess=3.0),
    "order": lambda: nw.smc(order="random"),
    "weights": lambda: nw.smc(weights="raio"),
    "resampling": lambda: nw.smc(resampling="none"),
    "samples": lambda: nw.importance(0),
    "seed": lambda: nw.run(COINS, seed=-1),
    "threads": lambda: nw.run(COINS, threads=0),
    "max_steps": lambda: nw.run(COINS, max_steps=0),
    "arguments": lambda: nw.run(COINS, 1, 2),
    "an argument's value": lambda: nw.run(load("@model\ndef m(x):\n    return x\n"), object()),
    "choices": lambda: nw.run(COINS, choices={"a": True}),
    "a value too deep": lambda: (
        nw.run(
            load(
                "@model\ndef m():\n    xs = ()\n    for i in range(1000):\n        xs = (xs, i)\n    return xs\n"
            )
        ).value
    ),
    "too many runs": lambda: nw.run(COINS, method=nw.enumerate_all(max_runs=2)),
    "rejection's bound": lambda: nw.run(
        load("@model\ndef m():\n    factor(1)\n"), method=nw.rejection(3), seed=1
    ),
    "rejection's budget": lambda: nw.run(
        load("@model\ndef m():\n    condition(False)\n"), method=nw.rejection(3, max_tries=10), seed=1
    ),
    "the rule": lambda: nw.no_self_intersection("volume"),
    "no best sample": lambda: nw.run(COINS, method=nw.enumerate_all(), seed=1).best,
    "a target that is not there": lambda: nw.grow(BLOCK, "nowhere.obj"),
    "voxel": lambda: nw.match_volume(tetrahedron(), voxel=-1.0),
    "sigma": lambda: nw.match_volume(tetrahedron(), sigma=0.0),
    "a grid too large": lambda: nw.match_volume(tetrahedron(), voxel=1e-6),
    "nothing to grow into": lambda: nw.grow(BLOCK),
    "runs": lambda: nw.grow(BLOCK, tetrahedron(), runs=0),
}


def tetrahedron() -> nw.Target:
    return nw.Target(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    )


def search(model: Any, method: Any) -> nw.Result:
    return nw.run(model, method=method, seed=1, max_steps=100_000)


def refused(ask: Callable[[], Any]) -> str:
    """The message, without what differs from folder to folder."""
    with pytest.raises(NiwakiError) as error:
        print(ask())
    text = str(error.value).replace(str(Path.cwd()), "FOLDER")
    return re.sub(r" at 0x[0-9a-f]+", "", re.sub(r"[0-9.]+ s\b", "TIME", text))


def test_messages_of_models_that_fail(golden: Any) -> None:
    sections = []
    for name, text in PROGRAMS.items():
        model = load(text)
        method = nw.enumerate_all() if name == "not enumerable" else nw.smc(particles=4)
        message = refused(lambda: [s.queries for s in search(model, method)])  # noqa: B023
        sections.append(f"## {name}\n\n{message}\n")
    golden(GOLDEN / "searches.txt", "\n".join(sections))


def test_messages_of_settings(golden: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr(memory, "free_memory", lambda: 8 * 10**9)
    sections = [f"## {name}\n\n{refused(ask)}\n" for name, ask in SETTINGS.items()]
    golden(GOLDEN / "settings.txt", "\n".join(sections))
