"""Claim: whoever is killed at any moment, a worker or the process that collects, the batch goes on with what is missing
and has the bytes of one that was left alone; and nothing stays behind that runs.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import batched
import niwaki as nw
import pytest
from niwaki import batches
from niwaki.batches import pools
from niwaki.batches.pools import local
from niwaki.errors import InputError

UNIX = pytest.mark.skipif(os.name == "nt", reason="signals of Unix")

#: Host functions are known by their module, so it is imported, and not run as a program.
PROGRAM = "import batched, sys; batched.main(*sys.argv[1:])"


def expected_hash(folder: Path, seeds: int) -> str:
    """The hash of a batch that is left alone, in a thread."""
    with ThreadPoolExecutor(1) as thread:
        list(nw.batch(batched.WAITING, seeds=seeds, folder=folder, executor=thread))
    return batched.whole(folder)


def notes(folder: Path) -> Iterator[dict[str, object]]:
    for log in folder.glob("*/log-*"):
        # A line that a kill cut off is none.
        for line in log.read_text().splitlines(keepends=True):
            if line.endswith("\n"):
                yield json.loads(line)


def started(
    folder: Path, seeds: int, slow: float, program: str = PROGRAM, **variables: str
) -> subprocess.Popen[str]:
    environment = {**os.environ, "SLOW": str(slow), "PYTHONPATH": os.pathsep.join(sys.path), **variables}
    words = [sys.executable, "-c", program, str(folder), str(seeds)]
    return subprocess.Popen(words, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def until_some(folder: Path, child: subprocess.Popen[str], least: int) -> None:
    """Wait until the logs have so many lines."""
    end = time.monotonic() + 60.0
    while sum(1 for _ in notes(folder)) < least and child.poll() is None:
        assert time.monotonic() < end
        time.sleep(0.02)


def ended(processes: set[int], seconds: float = 10.0) -> bool:
    """Whether processes are gone, after at most so many seconds."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if not any(Path(f"/proc/{process}/cmdline").exists() for process in processes):
            return True
        time.sleep(0.05)
    return False


@UNIX
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_batch_goes_on_after_its_end(number: signal.Signals, tmp_path: Path) -> None:
    with started(tmp_path / "kill", 60, 20.0) as child:
        until_some(tmp_path / "kill", child, 15)
        child.send_signal(number)
        child.communicate(timeout=60)
    assert child.returncode != 0
    lines_before = list(notes(tmp_path / "kill"))
    there = len(batches.Store(tmp_path / "kill"))
    assert 15 <= there < 60
    if sys.platform == "linux":
        assert ended({int(str(line["process"])) for line in lines_before})
    with started(tmp_path / "kill", 60, 0.0) as child:
        output, error = child.communicate(timeout=60)
    assert child.returncode == 0, error
    assert output.split() == ["60", expected_hash(tmp_path / "alone", 60)]
    # What had a record was not done again; of a chunk that was being written, a line may be missing.
    assert 60 - there <= sum(1 for _ in notes(tmp_path / "kill")) - len(lines_before) <= 60 - there + 1


@UNIX
def test_a_batch_goes_on_without_a_worker(tmp_path: Path) -> None:
    with started(tmp_path / "kill", 60, 20.0) as child:
        until_some(tmp_path / "kill", child, 15)
        os.kill(int(str(next(notes(tmp_path / "kill"))["process"])), signal.SIGKILL)
        output, error = child.communicate(timeout=60)
    assert child.returncode == 0, error
    assert output.split() == ["60", expected_hash(tmp_path / "alone", 60)]
    assert {line["attempt"] for line in notes(tmp_path / "kill")} == {1}


@pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")
@pytest.mark.parametrize("end", ["its own", "Ctrl-C", "a kill", "a worker's"])
def test_what_a_host_function_started_ends_with_its_batch(end: str, tmp_path: Path) -> None:
    program = PROGRAM.replace("[1:])", "[1:], batched.PROLIFIC)")
    (tmp_path / "numbers").mkdir()
    seeds = 10 if end in ("its own", "a worker's") else 2000
    with started(tmp_path / "out", seeds, 20.0, program, STARTED=str(tmp_path / "numbers")) as child:
        if end != "its own":
            until_some(tmp_path / "out", child, 5)
        if end == "a worker's":
            os.kill(int(str(next(notes(tmp_path / "out"))["process"])), signal.SIGKILL)
        elif end in ("Ctrl-C", "a kill"):
            child.send_signal(signal.SIGINT if end == "Ctrl-C" else signal.SIGKILL)
        try:
            # What it left behind would keep the pipe open.
            _, error = child.communicate(timeout=60)
        finally:
            child.kill()
            numbers = {int(file.name) for file in (tmp_path / "numbers").iterdir()}
            have_ended = ended(numbers)
            for number in () if have_ended else numbers:
                with suppress(ProcessLookupError):
                    os.kill(number, signal.SIGKILL)
    assert child.returncode == 0 or end in ("Ctrl-C", "a kill"), error
    assert len(numbers) >= 10 and have_ended


@UNIX
def test_a_worker_that_leads_no_group_yet_ends_with_its_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    # As one that is still being started: nobody would wait for it, and it waits for others.
    monkeypatch.setattr(pools, "end_group", lambda leader: None)
    workers = pools.Workers(processes=1)
    assert workers._pool is not None
    workers._pool.submit(time.sleep, 60)
    (process,) = workers._leaders().values()
    workers.close(at_once=True)
    assert process.exitcode == -signal.SIGKILL


def test_what_ends_its_worker_is_given_up_alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    search = nw.Search(batched.dangerous, method=nw.importance(1))
    values = [search.with_seed(seed).run().best.choices["x"] for seed in range(3)]
    monkeypatch.setenv("DEADLY", "1")
    outcomes = []
    with pytest.raises(InputError, match="searches-lost") as error:
        for outcome in nw.batch(search, seeds=3, folder=tmp_path, processes=1):
            outcomes.append(outcome.seed)
    assert 0 < len(outcomes) < 3 and outcomes == [seed for seed in range(3) if values[seed] <= batched.LIMIT]
    assert f"{3 - len(outcomes)} of 3 searches" in str(error.value)
    assert len(batches.Store(tmp_path)) == len(outcomes)


def test_a_program_without_a_guard_ends_with_its_first_workers(tmp_path: Path) -> None:
    # Each start of a worker leaves a line: one pool is started, and no other in its place.
    (tmp_path / "unguarded.py").write_text(
        "import os, niwaki as nw\n"
        f"os.write(os.open({str(tmp_path / 'starts')!r}, os.O_WRONLY | os.O_APPEND | os.O_CREAT), b'start\\n')\n"
        "@nw.model\ndef coin():\n    return nw.flip(0.5)\n"
        "list(nw.batch(nw.Search(coin, method=nw.importance(1)), seeds=12, processes=2))\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    program = [sys.executable, str(tmp_path / "unguarded.py")]
    done = subprocess.run(program, env=environment, capture_output=True, text=True)
    assert done.returncode != 0 and "error[workers-not-started]" in done.stderr, done.stderr
    assert (tmp_path / "starts").read_text().count("start") == 3


def test_an_executor_that_is_not_ours_is_not_replaced(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("DEADLY", "1")
    search = nw.Search(batched.dangerous, method=nw.importance(1))
    with local(1) as executor, pytest.raises(InputError, match="executor-broken"):
        list(nw.batch(search, seeds=12, folder=tmp_path, executor=executor))


@pytest.mark.skipif(sys.platform != "linux", reason="switches of the GNU C library")
def test_a_process_that_computes_other_bits_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2,-AVX2_Usable,-FMA_Usable")
    with local(1) as executor:
        bits = executor.submit(nw._engine.fingerprint).result()
        if bits == nw._engine.fingerprint():
            pytest.skip("this C library has no other functions")
        with pytest.raises(InputError, match="worker-differs"):
            list(nw.batch(batched.PILES, folder=tmp_path, executor=executor))
    assert not batches.is_batch(tmp_path) or not len(batches.Store(tmp_path))


@pytest.mark.soak
@UNIX
def test_ten_kills_at_random(tmp_path: Path) -> None:
    seed = random.randrange(10**6)
    print(f"seed {seed}")
    chance, kills = random.Random(seed), 0
    while True:
        with started(tmp_path / "kill", 1000, 30.0) as child:
            end = time.monotonic() + 120.0
            try:
                output, error = child.communicate(timeout=chance.uniform(0.5, 2.0) if kills < 10 else 120)
            except subprocess.TimeoutExpired:
                assert time.monotonic() < end
                child.send_signal(signal.SIGKILL)
                child.communicate()
                kills += 1
                continue
        assert child.returncode == 0, error
        break
    assert kills == 10
    assert output.split() == ["1000", expected_hash(tmp_path / "alone", 1000)]
