"""Claim: help comes at once because it loads no command, and every command that it names is there."""

from __future__ import annotations

import subprocess
import sys

import pytest
import typer
from niwaki.shell.app import COMMANDS, app
from typer.testing import CliRunner

PROGRAM = """
import sys
from niwaki.shell.app import app
try:
    app(["--help"])
except SystemExit:
    pass
print(sorted({name.partition(".")[0] for name in sys.modules} & {"numpy", "PIL", "trimesh", "pydantic"}))
print(sorted(name for name in sys.modules if name.startswith("niwaki.shell.")))
"""


def test_help_loads_no_command() -> None:
    out = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True).stdout
    assert out.splitlines()[-2:] == ["[]", "['niwaki.shell.app']"]
    assert all(name in out for name in COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_each_command_is_there(name: str) -> None:
    assert CliRunner().invoke(app, [name, "--help"]).exit_code == 0
    assert typer.main.get_group(app).commands[name].help


def test_an_unknown_command_is_refused() -> None:
    answer = CliRunner().invoke(app, ["gorw"])
    assert answer.exit_code == 2 and "grow" in answer.output
