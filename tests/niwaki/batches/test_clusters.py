"""Claim: Ray and Dask give the bytes of one thread, also when a worker, a node or the process that collects is killed.

Both are optional, and large: `make cluster` installs them. They listen on the loopback only, and each process that is
killed here was started here.
"""

from __future__ import annotations

import importlib.util
import ipaddress
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import batched
import niwaki as nw
import pytest
from niwaki.batches import clusters
from test_lost import ended, notes

NEEDED = {"ray": "ray", "dask": "distributed"}
PROGRAM = "import batched, sys; batched.on_cluster(*sys.argv[1:])"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")


@pytest.fixture(params=list(NEEDED))
def engine(request: pytest.FixtureRequest) -> str:
    if importlib.util.find_spec(NEEDED[request.param]) is None:
        pytest.skip(f"{NEEDED[request.param]} is not installed; `make cluster` runs this")
    return str(request.param)


def alone(folder: Path, seeds: int) -> str:
    with ThreadPoolExecutor(1) as thread:
        list(nw.batch(batched.WAITING, seeds=seeds, folder=folder, executor=thread))
    return batched.whole(folder)


def started(engine: str, folder: Path, seeds: int, slow: float, *, traced: Path | None = None) -> Any:
    """A batch on a cluster of its own, in processes of its own."""
    environment = {**os.environ, "SLOW": str(slow), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    words = [sys.executable, "-c", PROGRAM, engine, str(folder), str(seeds)]
    if traced is not None:
        words = ["strace", "-f", "-qq", "-e", "trace=connect,sendto", "-o", str(traced), *words]
    return subprocess.Popen(
        words,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def until_some(folder: Path, child: Any, least: int) -> None:
    end = time.monotonic() + 120.0
    while sum(1 for _ in notes(folder)) < least and child.poll() is None:
        assert time.monotonic() < end
        time.sleep(0.05)


def below(process: int) -> set[int]:
    """The processes that a process has started, and those that these have."""
    parents = {}
    for place in Path("/proc").glob("[0-9]*/stat"):
        try:
            name, _, rest = place.read_text().rpartition(")")
        except OSError:
            continue
        parents[int(name.split()[0])] = int(rest.split()[1])
    descendants, waiting = set[int](), {process}
    while waiting:
        waiting = {child for child, parent in parents.items() if parent in waiting} - descendants
        descendants |= waiting
    return descendants


def test_a_cluster_gives_the_bytes_of_a_thread(engine: str, tmp_path: Path) -> None:
    with started(engine, tmp_path / "there", 60, 0.0) as child:
        output, error = child.communicate(timeout=180)
    assert child.returncode == 0, error
    assert output.split()[-2:] == ["60", alone(tmp_path / "alone", 60)]


def test_a_worker_is_killed(engine: str, tmp_path: Path) -> None:
    with started(engine, tmp_path / "there", 120, 40.0) as child:
        until_some(tmp_path / "there", child, 10)
        os.kill(int(str(next(notes(tmp_path / "there"))["process"])), signal.SIGKILL)
        output, error = child.communicate(timeout=180)
    assert child.returncode == 0, error
    assert output.split()[-2:] == ["120", alone(tmp_path / "alone", 120)]


def test_the_process_that_collects_is_killed(engine: str, tmp_path: Path) -> None:
    with started(engine, tmp_path / "there", 120, 40.0) as child:
        until_some(tmp_path / "there", child, 10)
        children = below(child.pid)
        child.kill()
        child.communicate(timeout=60)
    assert ended(children, 180.0)
    done_before = sum(1 for _ in notes(tmp_path / "there"))
    with started(engine, tmp_path / "there", 120, 0.0) as child:
        output, error = child.communicate(timeout=180)
    assert child.returncode == 0, error
    assert output.split()[-2:] == ["120", alone(tmp_path / "alone", 120)]
    assert sum(1 for _ in notes(tmp_path / "there")) <= 120 + 1 and done_before >= 10


#: Addresses in the arguments of a system call.
ADDRESS = re.compile(r'inet_(?:addr\(|pton\(AF_INET6, )"([0-9a-fA-F.:]+)"')


def is_own(address: str) -> bool:
    """Whether an address is one of this machine alone."""
    parsed = ipaddress.ip_address(address)
    parsed = getattr(parsed, "ipv4_mapped", None) or parsed
    return parsed.is_loopback or parsed.is_unspecified


def test_addresses_are_told_apart() -> None:
    line = 'connect(6, {sa_family=AF_INET, sin_port=htons(53), sin_addr=inet_addr("8.8.8.8")}, 16) = 0'
    mapped = 'connect(7, {sa_family=AF_INET6, inet_pton(AF_INET6, "::ffff:127.0.0.1", &sin6_addr)}, 28) = 0'
    assert [is_own(address) for address in ADDRESS.findall(line + mapped)] == [False, True]
    assert not is_own("::ffff:192.0.2.2") and not is_own("2001:db8::1") and is_own("::1")


def test_nothing_outside_of_this_machine_is_asked(engine: str, tmp_path: Path) -> None:
    if not Path("/usr/bin/strace").exists():
        pytest.skip("strace is not installed")
    with started(engine, tmp_path / "there", 10, 0.0, traced=tmp_path / "calls") as child:
        _, error = child.communicate(timeout=300)
    assert child.returncode == 0, error
    calls = (tmp_path / "calls").read_text(errors="replace").splitlines()
    outside = [call for call in calls if any(not is_own(address) for address in ADDRESS.findall(call))]
    assert not outside


def test_a_missing_library_has_a_message(monkeypatch: pytest.MonkeyPatch) -> None:
    for engine, library in NEEDED.items():
        monkeypatch.setitem(sys.modules, library, None)
        with pytest.raises(nw.NiwakiError, match="missing-extra"), clusters.ENGINES[engine](1):
            pass
