"""`niwaki init`: its folder works as it is: its test passes, and every command of its README runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from niwaki.errors import InputError
from niwaki.shell.app import COMMANDS, app
from typer.testing import CliRunner


def test_the_test_of_a_new_folder_passes_and_fails_with_another_requirement(tmp_path: Path) -> None:
    folder = tmp_path / "house"
    assert CliRunner().invoke(app, ["init", str(folder)], catch_exceptions=False).exit_code == 0
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_house.py"]
    passed = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert passed.returncode == 0 and "1 passed" in passed.stdout, passed.stdout
    rules = folder / "requirements.toml"
    rules.write_text(rules.read_text().replace("[2.0, 3.0]", "[7.0, 8.0]"))
    failed = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert failed.returncode == 1 and "height 7 to 8" in failed.stdout, failed.stdout


def test_the_readme_has_ten_lines_and_names_commands_that_there_are(tmp_path: Path) -> None:
    CliRunner().invoke(app, ["init", str(tmp_path)], catch_exceptions=False)
    lines = (tmp_path / "README.md").read_text().splitlines()
    named = [line.split()[1] for line in lines if line.startswith("    niwaki ")]
    assert len(lines) == 10 and len(named) == 5 and set(named) <= set(COMMANDS)


def test_no_file_is_replaced_without_force(tmp_path: Path) -> None:
    (tmp_path / "house.py").write_text("mine")
    refused = CliRunner().invoke(app, ["init", str(tmp_path)]).exception
    assert isinstance(refused, InputError) and refused.code == "already-there"
    assert [path.name for path in tmp_path.iterdir()] == ["house.py"]
    assert (tmp_path / "house.py").read_text() == "mine"
    assert CliRunner().invoke(app, ["init", str(tmp_path), "--force"], catch_exceptions=False).exit_code == 0
    assert (tmp_path / "house.py").read_text() != "mine"
