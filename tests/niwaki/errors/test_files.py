"""Claim: a file is written whole or not at all, also with other writers and readers, and when the process ends."""

from __future__ import annotations

import errno
import os
import random
import signal
import stat
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from faults import trials
from niwaki.errors import FileError
from niwaki.errors import files as module
from niwaki.errors.files import write_whole
from niwaki.errors.folders import LEFT_OVER, held_folder

UNIX = pytest.mark.skipif(os.name == "nt", reason="Unix only")

#: Several times the size of a pipe or a page, so that a reader would see a torn file.
SIZE = 300_000

WRITER = f"""
import sys
from pathlib import Path
from niwaki.errors.files import write_whole
place, letter, count = Path(sys.argv[1]), sys.argv[2].encode(), int(sys.argv[3])
for _ in range(count):
    write_whole(place, letter * {SIZE})
"""


def is_whole(data: bytes) -> bool:
    return len(data) == SIZE and len(set(data)) == 1


def watched(place: Path, running: Callable[[], bool]) -> list[bytes]:
    """Return the ends of the torn files that a reader saw."""
    torn, reads = [], 0
    while running() or reads == 0:
        data = place.read_bytes()
        reads += 1
        if not is_whole(data):
            torn.append(data[:1] + data[-1:])
    return torn


def names(folder: Path) -> set[str]:
    return {place.name for place in folder.iterdir()}


def test_threads_that_save_the_same_file_do_not_tear_it(tmp_path: Path) -> None:
    place = write_whole(tmp_path / "one.bin", b"x" * SIZE)

    done: list[str] = []

    def write(letter: str) -> None:
        for _ in range(20):
            write_whole(place, letter.encode() * SIZE)
        done.append(letter)

    threads = [threading.Thread(target=write, args=(letter,)) for letter in "abcd"]
    for thread in threads:
        thread.start()
    assert watched(place, lambda: any(thread.is_alive() for thread in threads)) == []
    assert sorted(done) == list("abcd")
    assert names(tmp_path) == {"one.bin"}


def test_processes_that_save_the_same_file_do_not_tear_it(tmp_path: Path) -> None:
    place = write_whole(tmp_path / "one.bin", b"x" * SIZE)
    command = [sys.executable, "-c", WRITER, str(place)]
    children = [subprocess.Popen([*command, letter, "20"]) for letter in "abcd"]
    assert watched(place, lambda: any(child.poll() is None for child in children)) == []
    assert [child.wait() for child in children] == [0, 0, 0, 0]
    assert names(tmp_path) == {"one.bin"}


@UNIX
def test_a_kill_leaves_the_old_file_whole(tmp_path: Path) -> None:
    place = write_whole(tmp_path / "one.bin", b"x" * SIZE)
    chance = random.Random(0)
    for _ in range(5):
        child = subprocess.Popen([sys.executable, "-c", WRITER, str(place), "y", "1000000"])
        time.sleep(0.3 + 0.2 * chance.random())
        child.send_signal(signal.SIGKILL)
        child.wait()
        assert is_whole(place.read_bytes())


@UNIX
def test_a_file_has_the_permissions_of_any_new_file_and_then_keeps_its_own(tmp_path: Path) -> None:
    place, plain = tmp_path / "one.bin", tmp_path / "plain"
    plain.touch()
    write_whole(place, b"first")
    assert stat.S_IMODE(place.stat().st_mode) == stat.S_IMODE(plain.stat().st_mode)
    place.chmod(0o640)
    write_whole(place, b"second")
    assert place.read_bytes() == b"second" and stat.S_IMODE(place.stat().st_mode) == 0o640


@UNIX
def test_a_link_keeps_pointing_to_the_file(tmp_path: Path) -> None:
    (tmp_path / "far").mkdir()
    real, link = tmp_path / "far" / "real.bin", tmp_path / "link.bin"
    real.write_bytes(b"first")
    link.symlink_to(real)
    write_whole(link, b"second")
    assert link.is_symlink() and real.read_bytes() == b"second"
    assert names(tmp_path / "far") == {"real.bin"}


@UNIX
def test_only_regular_files_are_replaced(tmp_path: Path) -> None:
    pipe, folder = tmp_path / "pipe", tmp_path / "folder"
    os.mkfifo(pipe)
    folder.mkdir()
    for place, reason in ((pipe, "a pipe"), (folder, "directory"), (tmp_path / "a\0b", "null")):
        with pytest.raises(FileError, match=reason):
            write_whole(place, b"bytes")
    assert stat.S_ISFIFO(pipe.stat().st_mode) and names(tmp_path) == {"pipe", "folder"}


def test_a_write_protected_file_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place = tmp_path / "one.bin"
    place.write_bytes(b"first")
    monkeypatch.setattr(module.os, "access", lambda *_: False)  # root may write anything
    with pytest.raises(FileError, match="write-protected"):
        write_whole(place, b"second")
    assert place.read_bytes() == b"first"


@UNIX
def test_a_full_disk_leaves_the_old_file(tmp_path: Path) -> None:
    # A limit of the system on the size of files stops a write half-way, as a full disk does.
    place = tmp_path / "one.bin"
    place.write_bytes(b"first")
    program = f"""
import resource
from pathlib import Path
from niwaki.errors import FileError
from niwaki.errors.files import write_whole
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
try:
    write_whole(Path({str(place)!r}), b"y" * {SIZE})
except FileError as error:
    print(error)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "error[file-unwritable]" in done.stdout and "too large" in done.stdout
    assert place.read_bytes() == b"first" and names(tmp_path) == {"one.bin"}


@pytest.mark.parametrize("raised", [OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), KeyboardInterrupt()])
def test_an_interrupted_write_leaves_no_part(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, raised: BaseException
) -> None:
    place = tmp_path / "one.bin"
    place.write_bytes(b"first")

    def fails(_: int) -> None:
        raise raised

    monkeypatch.setattr(module.os, "fsync", fails)
    with pytest.raises((FileError, KeyboardInterrupt)) as caught:
        write_whole(place, b"second")
    assert isinstance(raised, KeyboardInterrupt) or "No space left" in str(caught.value)
    assert place.read_bytes() == b"first" and names(tmp_path) == {"one.bin"}


def test_a_folder_is_for_one_run_at_a_time(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "out"
    with held_folder(folder):
        with pytest.raises(FileError, match="folder-in-use"), held_folder(folder):
            pass
        program = "import pathlib, sys\nfrom niwaki.errors.folders import held_folder\n"
        program += "with held_folder(pathlib.Path(sys.argv[1])): pass"
        done = subprocess.run([sys.executable, "-c", program, str(folder)], capture_output=True, text=True)
        assert done.returncode == 1 and "folder-in-use" in done.stderr
        (folder / "file").touch()
    with held_folder(folder):
        pass
    assert names(folder) == {"file"}


def test_a_folder_without_results_is_not_left(tmp_path: Path) -> None:
    with held_folder(tmp_path / "out"):
        pass
    assert names(tmp_path) == set()


def test_what_a_killed_process_left_is_removed_later(tmp_path: Path) -> None:
    old, young = tmp_path / ".niwaki-0.part", tmp_path / ".niwaki-1.part"
    old.touch()
    young.touch()
    long_ago = time.time() - LEFT_OVER - 60.0
    os.utime(old, (long_ago, long_ago))
    with held_folder(tmp_path):
        pass
    assert names(tmp_path) == {young.name}


def test_a_disk_that_fails_at_any_call_leaves_the_old_file_or_the_new_one(tmp_path):
    seen = []
    for trial in trials(
        tmp_path,
        lambda folder: write_whole(folder / "one.bin", b"second" * SIZE),
        lambda folder: write_whole(folder / "one.bin", b"first" * SIZE),
    ):
        seen.append((trial.fault, trial.call))
        assert trial.error is None or isinstance(trial.error, FileError), trial
        assert [place.name for place in trial.folder.iterdir()] == ["one.bin"], trial
        data = (trial.folder / "one.bin").read_bytes()
        assert data in (b"first" * SIZE, b"second" * SIZE), trial
        # Without an error the bytes are there.
        assert trial.error is not None or data == b"second" * SIZE, trial
    assert {("short", "write"), ("full", "write"), ("EIO", "fsync"), ("EACCES", "replace")} <= set(seen)
