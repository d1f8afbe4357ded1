"""Processes: a search runs in a child that was forked after, beside or inside of a search, and in one that was spawned.

A fork copies of the parent's threads only the one that forks, so each claim here is that nobody waits for a thread that
is not there. A child that waits is ended by its alarm, and that fails the test.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

MODELS = '''
import os, signal, sys, threading, time, warnings
import multiprocessing
import niwaki as nw
from niwaki import host, kernels, model
from niwaki.words import *

warnings.simplefilter("ignore", DeprecationWarning)

@model
def tower(n=4):
    y = 0.0
    for i in range(n):
        size = uniform(0.5, 1.5)
        emit(box((0, y + size / 2, 0), (1, size, 1)))
        y = y + size
    factor(-y)
    return y

@model
def coin():
    return flip(0.5)

@model
def outer():
    return [infer(coin, nw.importance(20)) for _ in range(3)]

@host
def searched(x):
    return nw.run(coin, nw.importance(20), seed=1).best.value

@model
def calls():
    return searched(uniform(0, 1))

def work(threads=None):
    """A bit of everything that the engine does in parallel."""
    found = [nw.run(tower, nw.smc(50), seed=1, threads=threads).log_evidence]
    found.append(nw.run(tower, nw.improve(rounds=1), seed=1, threads=threads).best.log_score)
    found.append(nw.run(tower, nw.mh(200, chains=2), seed=1, threads=threads).best.log_score)
    sample = nw.run(tower, seed=1)
    found.append(len(sample.best.picture(size=(32, 32)).tobytes()))
    found.append(nw.run(outer, seed=1).best.value)
    found.append(nw.run(outer, nw.importance(8), seed=1, threads=threads).best.value)
    return repr(found)

def forked(child):
    """The text that a child gives, or how it ended."""
    read, write = os.pipe()
    number = os.fork()
    if number == 0:
        signal.alarm(20)
        os.write(write, str(child()).encode())
        os._exit(0)
    os.close(write)
    with os.fdopen(read) as pipe:
        text = pipe.read()
    _, status = os.waitpid(number, 0)
    return text if status == 0 else f"status {status}"
'''


def ran(folder: Path, text: str, threads: int) -> str:
    """Return the output of a program; its children have an alarm, and it has a limit of time itself."""
    file = folder / "program.py"
    file.write_text(MODELS + text)
    done = subprocess.run(
        [sys.executable, str(file)],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, "RAYON_NUM_THREADS": str(threads)},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
both = pytest.mark.parametrize("threads", [1, 2])


@both
def test_a_child_searches_after_its_parent_did(tmp_path: Path, threads: int) -> None:
    text = (
        "first = work(); print(forked(work) == first, forked(lambda: forked(work)) == first, work() == first)"
    )
    assert ran(tmp_path, text, threads) == "True True True\n"


@both
@pytest.mark.parametrize("way", ["fork", "spawn", "forkserver"])
def test_a_pool_of_processes_searches(tmp_path: Path, threads: int, way: str) -> None:
    text = f"""
if __name__ == "__main__":
    first = work()
    with multiprocessing.get_context("{way}").Pool(2) as pool:
        print([one == first for one in pool.map_async(work, [None, 1]).get(40)])
"""
    assert ran(tmp_path, text, threads) == "[True, True]\n"


@both
def test_a_child_is_forked_while_another_thread_searches(tmp_path: Path, threads: int) -> None:
    text = """
first = work()
stop = []
def on():
    while not stop:
        work()
other = threading.Thread(target=on)
other.start()
ways = {first}
for k in range(12):
    time.sleep(0.003 * k)
    ways.add(forked(work))
stop.append(1)
other.join()
print(ways - {first})
"""
    assert ran(tmp_path, text, threads) == "set()\n"


@both
def test_chains_that_move_at_a_fork_cannot_be_used_in_the_child(tmp_path: Path, threads: int) -> None:
    text = """
moving = threading.Event()
result = nw.run(tower, nw.mh(100), seed=1, progress=lambda now: moving.set())
moving.clear()
other = threading.Thread(target=lambda: result.more(200_000))
other.start()
moving.wait()
def used():
    try:
        return result.info.bests
    except nw.NiwakiError as error:
        return error
print(forked(used))
print(forked(work) == work())
other.join()
print(len(result.info.bests))
"""
    printed = ran(tmp_path, text, threads)
    assert "error[in-use]" in printed and "forked" in printed
    assert printed.endswith("True\n1\n")


@both
def test_a_child_that_comes_back_from_a_callback_ends(tmp_path: Path, threads: int) -> None:
    text = """
def fork_once(now, seen=[]):
    if not seen:
        seen.append(os.fork())
        if seen[0] == 0:
            signal.alarm(20)
        else:
            print(os.waitstatus_to_exitcode(os.waitpid(seen[0], 0)[1]))
nw.run(tower, nw.mh(150_000), seed=1, progress=fork_once)
"""
    assert ran(tmp_path, text, threads) == "70\n"


@both
def test_a_host_function_may_search(tmp_path: Path, threads: int) -> None:
    text = """
signal.alarm(20)
print(len(nw.run(calls, nw.importance(20), seed=1)), len(nw.run(calls, nw.smc(20), seed=1)))
"""
    assert ran(tmp_path, text, threads) == "20 20\n"


@both
def test_many_threads_search_at_once(tmp_path: Path, threads: int) -> None:
    text = """
signal.alarm(40)
first, found = work(), []
others = [threading.Thread(target=lambda: found.append(work())) for _ in range(6)]
[one.start() for one in others]
[one.join() for one in others]
print(set(found) == {first}, len(found))
def name(task):
    try:
        return open(f"/proc/self/task/{task}/comm").read()
    except OSError:
        return "has ended"
def ours():
    return len([task for task in os.listdir("/proc/self/task") if name(task).startswith("niwaki")])
while ours() > 4 * int(os.environ["RAYON_NUM_THREADS"]):
    time.sleep(0.01)
"""
    assert ran(tmp_path, text, threads) == "True 6\n"
