"""Claim: the README's first program runs as printed, and every picture in the README exists and is small."""

from __future__ import annotations

import re
import runpy
import shlex
from pathlib import Path

import niwaki as nw
import pytest
from niwaki.draw.scene import Scene
from niwaki.shell.main import app
from typer.testing import CliRunner

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_first_program_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    block = re.search(r"```python\n(.*?)```", README, re.DOTALL)
    assert block is not None
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tower.py").write_text(block[1], encoding="utf-8")
    variables = runpy.run_path("tower.py", run_name="__main__")
    assert variables["result"].best.fit.covered > 0.8 and len(variables["ten"]) == 10
    assert nw.Target.load("tower.glb").volume > 0.0
    assert (tmp_path / "tower.png").stat().st_size > 0


def test_its_commands_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = re.search(r"```python\n(.*?)```", README, re.DOTALL)
    assert program is not None
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tower.py").write_text(program[1], encoding="utf-8")
    Scene([("mine", [nw.box((0, 3, 0), (3, 6, 3))])]).export("mine.obj")
    commands = re.findall(r"^    niwaki ((?:show|grow) .*)$", README, re.MULTILINE)
    assert len(commands) == 4
    for command in commands:
        done = CliRunner().invoke(app, [*shlex.split(command), *(["--quick"] if "grow" in command else [])])
        assert done.exit_code == 0, (command, done.output, done.exception)


@pytest.mark.parametrize("picture", re.findall(r"!\[[^]]+\]\(([^)]+\.png)\)", README))
def test_pictures_are_there_and_small(picture: str) -> None:
    assert 0 < (ROOT / picture).stat().st_size < 300_000
