"""Claim: a search of the shell goes on after Ctrl-C and after a kill, and writes the files of one left alone."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from niwaki.errors import InputError
from niwaki.shell import resume
from niwaki.shell.main import app
from typer.testing import CliRunner

#: The shell, with checkpoints ten times as often as usual, so that short searches have some.
PROGRAM = """
from functools import partial
from niwaki.shell import main, resume
resume.Checkpoint = partial(resume.Checkpoint, every=0.1)
main.main()
"""
GROW = ["grow", "gnarly-tree", "--rounds", "12", "--seed", "5", "--voxel", "0.5", "--no-picture"]


def run(*words: Any) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


def ended(sign: int, out: Path, *words: str) -> tuple[int, str]:
    """The exit status and the output of a command that is sent a signal when it has written a checkpoint."""
    place = out / resume.NAME
    before = place.stat().st_mtime_ns if place.exists() else 0
    command = [sys.executable, "-c", PROGRAM, *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as child:
        while child.poll() is None and not (place.exists() and place.stat().st_mtime_ns > before):
            time.sleep(0.02)
        child.send_signal(sign)
        output, _ = child.communicate(timeout=120)
    return child.returncode, output


def runs(folder: Path) -> Any:
    """Return the hash and the runs of a run.json, without times."""
    data = json.loads((folder / "run.json").read_text())
    times = ("seconds", "cpu_seconds")
    return data["hash"], [{key: row[key] for key in row if key not in times} for row in data["runs"]]


def test_a_search_goes_on_after_ctrl_c_and_a_kill(tmp_path: Path) -> None:
    alone, out = tmp_path / "alone", tmp_path / "out"
    assert run(*GROW, "-o", alone).exit_code == 0
    assert not (alone / resume.NAME).exists()
    status, output = ended(signal.SIGINT, out, *GROW, "-o", str(out))
    assert status == 130
    assert output.splitlines()[-1] == f"interrupted; resume with: niwaki grow --resume {out}"
    assert json.loads((out / "run.json").read_text())["interrupted"]
    ended(signal.SIGKILL, out, "grow", "--resume", str(out))
    again = run("grow", "--resume", out)
    assert again.exit_code == 0, again.output
    assert runs(out) == runs(alone)
    assert (out / "best.glb").read_bytes() == (alone / "best.glb").read_bytes()
    assert not (out / resume.NAME).exists()


def test_what_cannot_go_on_is_refused(tmp_path: Path) -> None:
    def refused(*words: Any) -> str:
        error = run(*words).exception
        assert isinstance(error, InputError)
        return error.code

    assert refused("grow", "--resume", tmp_path) == "no-checkpoint"
    (tmp_path / resume.NAME).write_text("no checkpoint\n")
    assert refused("grow", "--resume", tmp_path) == "bad-checkpoint"
    assert refused("grow", "spaceship", "--resume", tmp_path) == "flags-exclude"
    assert refused("grow", "--resume", tmp_path, "--seed", 1) == "flags-exclude"
    missing = run("grow")
    assert missing.exit_code == 2 and "Missing argument 'MODEL'" in missing.output


def test_a_search_that_begins_replaces_the_checkpoint_and_says_so(tmp_path: Path) -> None:
    (tmp_path / resume.NAME).write_text("of an older search\n")
    grown = run(
        "grow",
        "spaceship",
        "--seed",
        "1",
        "--particles",
        "10",
        "--voxel",
        "0.5",
        "--no-picture",
        "--force",
        "-o",
        tmp_path,
    )
    assert grown.exit_code == 0, grown.output
    assert "the checkpoint of an unfinished search" in grown.stderr
    assert not (tmp_path / resume.NAME).exists()


def test_chains_of_the_shell_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("line.py").write_text(
        "from niwaki import gaussian, model, observe\nfrom niwaki.words import Gaussian\n\n"
        "@model\ndef line():\n    at = gaussian(0, 1)\n    observe(Gaussian(at, 1.0), 2.0)\n    return at\n"
    )
    words = ["sample", "line.py:line", "--steps", "1000000", "--seed", "3"]
    status, output = ended(signal.SIGINT, Path("out"), *words, "-o", "out")
    assert status in (0, 130), output
    if status == 130:
        assert output.splitlines()[-1] == "interrupted; resume with: niwaki sample --resume out"
        assert run("sample", "--resume", "out").exit_code == 0
    assert run(*words, "-o", "alone").exit_code == 0
    assert runs(Path("out")) == runs(Path("alone"))
    assert Path("out/samples.csv").read_text() == Path("alone/samples.csv").read_text()
