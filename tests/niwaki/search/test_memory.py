"""Limits hold: a model that takes too much memory or too many steps ends with a message.

Each kind of value runs in a child process, whose largest resident set is compared with the limit: what the model
took may be at most 1.3 times as much, and the fault must name the limit. The child may not have more than 3 GB at all,
so that one that is not bounded fails and does no harm.
"""

import json
import resource
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import niwaki as nw
import pytest
from niwaki.errors import InputError

BOUND = 64 << 20

pytestmark = pytest.mark.skipif(
    not Path("/proc/self/clear_refs").exists(), reason="the largest resident set is read from Linux's /proc"
)


@dataclass(frozen=True)
class Leaf:
    at: float
    next: object


@nw.model
def lists():
    out = []
    for k in range(1000):
        out = out + [[k] * 30_000]
    return len(out)


@nw.model
def one_list():
    return len([1] * 60_000_000)


@nw.model
def small_lists():
    out = []
    for k in range(1_000_000):
        out = out + [[k, k + 1, k + 2]]
    return len(out)


@nw.model
def doubled():
    out = [0]
    while True:
        out = out + out
    return len(out)


@nw.model
def comprehensions():
    out = []
    for k in range(1000):
        out = out + [[x + k for x in range(20_000)]]
    return len(out)


@nw.model
def tuples():
    out = ()
    for k in range(1_000_000):
        out = (k, out)
    return len(out)


@nw.model
def strings():
    out = []
    for k in range(1_000_000):
        out = out + [f"{k}" + "a name of some length " * 20]
    return len(out)


@nw.model
def records():
    out = None
    for k in range(1_000_000):
        out = Leaf(k + 0.5, out)
    return out.at


@nw.model
def vectors():
    out = []
    for k in range(2_000_000):
        out = out + [nw.vec(k, 1.0, 2.0)]
    return len(out)


@nw.model
def shapes():
    out = []
    for k in range(1_000_000):
        out = out + [nw.box((k, 0, 0), (1, 1, 1))]
    return len(out)


@nw.model
def sorted_lists():
    out = []
    for k in range(1000):
        out = out + [sorted([k] * 20_000)]
    return len(out)


@nw.model
def dirichlets():
    out = []
    for _ in range(10_000):
        out = out + [nw.dirichlet([1.0] * 1000)]
    return len(out)


@nw.model
def calls():
    def deeper(n):
        return deeper(n + 1)

    return deeper(0)


def with_local(n):
    local = [n] * 1000
    x = nw.gaussian(0, 1)
    return with_local(n + 1) + len(local) + x


@nw.model
def locals_of_calls():
    return with_local(0)


@nw.model
def choices():
    total = 0
    while total >= 0:
        total = total + nw.flip(0.5)
    return total


@nw.model
def scored_lists():
    out = []
    for _ in range(10_000):
        out = out + [[nw.gaussian(0, 1)] * 1000]
        nw.factor(0.0)
    return len(out)


def one_more(n):
    return nw.gaussian(0, 1) + n


@nw.model
def futures():
    out = []
    for k in range(10_000_000):
        out = out + [nw.future(one_more, k)]
    return len(out)


CASES = {
    **{
        model.name: (model, nw.forward(1))
        for model in (
            lists,
            small_lists,
            doubled,
            comprehensions,
            tuples,
            strings,
            records,
            vectors,
            shapes,
            sorted_lists,
            dirichlets,
            calls,
            locals_of_calls,
            choices,
        )
    },
    "chain": (choices, nw.mh(steps=10)),
    "chain_of_lists": (scored_lists, nw.mh(steps=10)),
    "chain_of_dirichlets": (dirichlets, nw.mh(steps=10)),
    "particles": (scored_lists, nw.smc(100)),
    "particles_of_calls": (locals_of_calls, nw.smc(100)),
    "futures": (futures, nw.smc(10)),
}


@nw.model
def endless_line(x=0.0):
    nw.emit(nw.box((x, 0, 0), (1, 1, 1)))
    endless_line(x + 2)


@nw.model
def endless_pile():
    nw.emit(nw.box((0, 0, 0), (1, 1, 1)))
    endless_pile()


def peak() -> int:
    """Bytes of the largest resident set of this process."""
    line = next(
        line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM")
    )
    return int(line.split()[1]) * 1024


def child(name: str, threads: int) -> None:
    model, method = CASES[name]
    resource.setrlimit(resource.RLIMIT_AS, (3 << 30, 3 << 30))
    nw.run(warm, seed=1, method=method, threads=threads)
    Path("/proc/self/clear_refs").write_text("5")
    before = peak()
    try:
        nw.run(model, seed=1, method=method, max_memory=BOUND, threads=threads)
        message = "no fault"
    except nw.ModelFault as fault:
        message = str(fault)
    print(json.dumps({"found": message, "grown": peak() - before}))


@nw.model
def warm():
    nw.factor(0.0)
    return nw.gaussian(0, 1)


def outcome(name: str, threads: int = 1) -> dict[str, object]:
    done = subprocess.run(
        [sys.executable, __file__, name, str(threads)],
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == 0, f"{name}: {done.returncode}\n{done.stderr[-1000:]}"
    return json.loads(done.stdout)


@pytest.mark.parametrize("name", CASES)
def test_the_limit_is_what_a_model_takes(name):
    report = outcome(name)
    assert "memory-budget" in report["found"] and "64 MB" in report["found"], report["found"][:500]
    assert "^" in report["found"]
    assert report["grown"] <= 1.3 * BOUND, f"{report['grown'] / BOUND:.2f} of the limit"


@pytest.mark.parametrize("name", ["particles", "particles_of_calls"])
def test_threads_do_not_matter(name):
    assert outcome(name, 1)["found"] == outcome(name, 3)["found"]


def test_what_is_dropped_is_given_back():
    @nw.model
    def drops():
        total = 0
        for k in range(5000):
            total = total + len([k] * 10_000)
        return total

    assert (
        nw.run(drops, method=nw.forward(1), seed=1, max_memory=8 << 20, max_steps=10**9).best.value
        == 50_000_000
    )


def test_a_long_chain_gives_back_what_its_moves_made():
    @nw.model
    def rebuilt():
        x = nw.gaussian(0, 1)
        nw.factor(-x * x)
        return sum([x + k for k in range(2000)])

    result = nw.run(rebuilt, method=nw.mh(steps=2000), seed=1, max_memory=4 << 20, max_steps=10**9)
    assert len(result) > 0


def test_the_runs_of_an_inner_search_take_steps_of_the_outer_one():
    @nw.model
    def inner():
        total = 0.0
        for _ in range(100):
            total = total + nw.gaussian(0, 1)
        return total

    @nw.model
    def outer():
        return nw.infer(inner, nw.importance(1000))

    assert len(nw.run(outer, nw.forward(1), seed=1, max_steps=200_000)) == 1
    messages = []
    for threads in (1, 3):
        with pytest.raises(nw.ModelFault, match="step-budget") as met:
            nw.run(outer, nw.forward(1), seed=1, max_steps=20_000, threads=threads)
        messages.append(str(met.value))
    assert messages[0] == messages[1] and "with the runs of `infer` of" in messages[0]


def test_a_value_that_does_not_fit_is_refused_before_it_is_made():
    start = time.monotonic()
    with pytest.raises(nw.ModelFault, match="memory-budget"):
        nw.run(one_list, method=nw.forward(1), seed=1, max_memory=BOUND)
    # Only who makes it takes so long.
    assert time.monotonic() - start < 30.0


def test_operations_on_many_elements_take_steps():
    @nw.model
    def sums():
        total = 0
        for k in range(1000):
            total = total + sum(range(k, 100_000))
        return total

    with pytest.raises(nw.ModelFault, match="step-budget"):
        nw.run(sums, method=nw.forward(1), seed=1, max_steps=1_000_000)


def test_an_endless_recursion_ends_with_its_stack():
    start = time.process_time()
    with pytest.raises(nw.ModelFault) as met:
        nw.run(calls, method=nw.forward(1), seed=1, max_steps=2_000_000)
    assert "step-budget" in str(met.value) and "more ..." in str(met.value)
    assert time.process_time() - start < 20.0


def test_endless_scenes_end_by_their_steps():
    for method in (nw.forward(1), nw.smc(2), nw.mh(1)):
        with pytest.raises(nw.ModelFault, match="step-budget"):
            nw.run(endless_line, method=method, seed=1, max_steps=100_000)


def test_the_readable_addresses_and_parts_of_a_run_are_bounded():
    deep = nw.run(nested, 3000, seed=1, max_memory=8 << 20)
    with pytest.raises(nw.ModelFault, match="memory-budget"):
        _ = deep.best.parts
    assert len(nw.run(nested, 300, seed=1, max_memory=8 << 20).best.parts) == 300


@nw.model
def nested(depth):
    nw.emit(nw.box((2 * depth, 0, 0), (1, 1, 1)))
    if depth > 1:
        nested(depth - 1)


def test_what_made_a_search_impossible_is_told_without_running_on():
    """The run died at its second part; it would never end."""
    start = time.process_time()
    with pytest.raises(InputError, match="runs into another part") as met:
        nw.run(endless_pile, method=nw.smc(2), score=nw.no_self_intersection(), seed=1)
    assert "barrier 2" in str(met.value)
    assert time.process_time() - start < 20.0


if __name__ == "__main__":
    child(sys.argv[1], int(sys.argv[2]))
