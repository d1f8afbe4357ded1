"""A folder of results is of one run: run.json never stands beside a file of another, whenever the process ends."""

from __future__ import annotations

import hashlib
import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from niwaki import Search, model, uniform
from niwaki.errors import FileError, NiwakiError
from niwaki.shell import results, run_files
from niwaki.shell.main import app
from niwaki.shell.references import ModelReference
from typer.testing import CliRunner

UNIX = pytest.mark.skipif(os.name == "nt", reason="signals of Unix")

#: Writes runs into a folder for ever, in turn of two kinds, each with other files; each file holds its run's hash.
WRITER = """
import itertools, json, sys
from pathlib import Path
from niwaki.errors.files import write_whole
from niwaki.errors.folders import held_folder
from niwaki.shell import results
folder, both = Path(sys.argv[1]), json.loads(Path(sys.argv[2]).read_text())
for number in itertools.count():
    data = both[number % 2]
    names = ["best.glb", "best.png"] if number % 2 else ["best.glb", "best.stl", "sheet.png"]
    with held_folder(folder), results.results_folder(folder, data, names):
        for name in names:
            write_whole(folder / name, data["hash"].encode() * 200)
"""


@model
def coin():
    return uniform(0.0, 1.0)


def data(seed: int) -> dict[str, Any]:
    return run_files.written(Search(coin, seed=seed).run(), ModelReference("coin.py:coin", coin))


def check_whole(folder: Path) -> None:
    """Every file beside run.json is of its run, and has the hash that is written there."""
    data = run_files.load(folder / "run.json")
    beside = [place for place in folder.iterdir() if place.name in results.KNOWN]
    for place in beside:
        text = place.read_bytes()
        assert text == data["hash"].encode() * 200, place.name
        digest = data["files"][place.name]
        assert digest is None or digest == hashlib.sha256(text).hexdigest()


def killed(folder: Path, kills: int, chance: random.Random) -> None:
    """Kill a writer at random moments, and look at the folder each time."""
    both = folder / "both.json"
    both.write_text(json.dumps([data(1), data(2)]))
    out = folder / "out"
    for _ in range(kills):
        child = subprocess.Popen([sys.executable, "-c", WRITER, str(out), str(both)])
        while not (out / "run.json").exists() and child.poll() is None:
            time.sleep(0.01)
        time.sleep(0.35 + 0.2 * chance.random())
        child.send_signal(signal.SIGKILL)
        assert child.wait() == -signal.SIGKILL
        check_whole(out)


@UNIX
def test_a_kill_mixes_no_runs(tmp_path: Path) -> None:
    killed(tmp_path, 8, random.Random(0))


@UNIX
@pytest.mark.soak
def test_many_kills_mix_no_runs(tmp_path: Path) -> None:
    seed = random.SystemRandom().getrandbits(32)
    print("seed", seed)
    killed(tmp_path, 100, random.Random(seed))


def write(folder: Path, data: dict[str, Any], *names: str) -> None:
    with results.results_folder(folder, data, names):
        for name in names:
            (folder / name).write_bytes(data["hash"].encode() * 200)


def names(folder: Path) -> set[str]:
    return {place.name for place in folder.iterdir()}


def test_the_files_of_a_former_run_go_unless_they_were_changed(tmp_path: Path) -> None:
    (tmp_path / "image.png").write_text("mine")
    write(tmp_path, data(1), "best.glb", "best.stl", "sheet.png")
    (tmp_path / "sheet.png").write_text("retouched")
    write(tmp_path, data(2), "best.glb")
    assert names(tmp_path) == {"run.json", "best.glb", "image.png", "sheet.png"}
    assert list(json.loads((tmp_path / "run.json").read_text())["files"]) == ["best.glb"]


def test_a_run_file_cannot_have_other_files_removed(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    folder.mkdir()
    (tmp_path / "outside.glb").write_text("mine")
    (folder / "thesis.pdf").write_text("mine")
    (folder / "image.png").write_text("mine")
    bad = {"../outside.glb": None, "thesis.pdf": None, "image.png": None, str(tmp_path / "outside.glb"): None}
    (folder / "run.json").write_text(json.dumps({**data(1), "files": bad}))
    write(folder, data(2), "best.glb")
    assert names(folder) == {"run.json", "best.glb", "thesis.pdf", "image.png"}
    assert (tmp_path / "outside.glb").exists()


def test_a_file_that_fails_leaves_the_others_and_run_json(tmp_path: Path) -> None:
    with (
        pytest.raises(KeyboardInterrupt),
        results.results_folder(tmp_path, data(1), ["best.glb", "best.png"]),
    ):
        (tmp_path / "best.glb").write_bytes(b"glb")
        raise KeyboardInterrupt
    stored = run_files.load(tmp_path / "run.json")
    assert stored["files"] == {"best.glb": hashlib.sha256(b"glb").hexdigest()}


def test_where_there_is_no_room_the_folder_stays_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, data(1), "best.glb")
    before = {place.name: place.read_bytes() for place in tmp_path.iterdir()}

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("niwaki.errors.files.os.fsync", full)
    with pytest.raises(FileError, match="No space left"):
        write(tmp_path, data(2), "best.glb", "best.stl")
    assert {place.name: place.read_bytes() for place in tmp_path.iterdir()} == before


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


GROW = ["grow", "spaceship", "--particles", "20", "--voxel", "0.5", "--no-picture"]


def test_two_runs_at_once_do_not_share_a_folder(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "niwaki.shell.main", *GROW, "-o", str(tmp_path / "out")]
    children = [
        subprocess.Popen([*command, "--seed", str(seed)], stdout=-3, stderr=subprocess.PIPE, text=True)
        for seed in (1, 2)
    ]
    ends = [(child.communicate()[1], child.returncode) for child in children]
    codes = sorted(code for _, code in ends)
    assert codes[0] == 0 and set(codes) <= {0, 2}
    assert all("folder-in-use" in text or "already-there" in text for text, code in ends if code == 2)
    data = json.loads((tmp_path / "out" / "run.json").read_text())
    glb = (tmp_path / "out" / "best.glb").read_bytes()
    assert data["files"] == {"best.glb": hashlib.sha256(glb).hexdigest()}
    assert (
        run("replay", tmp_path / "out" / "run.json", "-o", tmp_path / "again", "--no-picture").exit_code == 0
    )
    assert (tmp_path / "again" / "best.glb").read_bytes() == glb


def test_a_replay_keeps_a_folder_of_one_run(tmp_path: Path) -> None:
    first, second = tmp_path / "one", tmp_path / "two"
    assert run(*GROW, "--runs", "2", "--seed", "1", "-o", first).exit_code == 0
    assert run(*GROW, "--seed", "2", "-o", second).exit_code == 0
    best = run_files.load(first / "run.json")["best"]
    # Another format of the same run joins; another run of the same search takes its place.
    assert run("replay", first / "run.json", "-o", first, "--format", "obj", "--no-picture").exit_code == 0
    assert names(first) == {"run.json", "best.glb", "best.obj"}
    words = ["replay", first / "run.json", "-o", first, "--run", 2 - best, "--format", "ply", "--no-picture"]
    assert run(*words).exit_code == 0
    assert names(first) == {"run.json", "best.ply"}
    data = run_files.load(first / "run.json")
    assert data["shown"] == 1 - best and data["best"] == best and list(data["files"]) == ["best.ply"]
    # Another search does not.
    refused = run("replay", second / "run.json", "-o", first, "--no-picture")
    assert isinstance(refused.exception, NiwakiError) and "already exists" in str(refused.exception)
    assert names(first) == {"run.json", "best.ply"}
