"""Claim: a command ends as it should wherever its output goes: text that an encoding lacks is written as escapes.

Several commands run one after the other in a process, since most of a command's time is the start of its process.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

MODEL = """
from niwaki import box, emit, model, uniform

@model
def \u0434\u0435\u0440\u0435\u0432\u043e():
    emit(box((0, 1, 0), (1, uniform(0.5, 1.5), 1)), name="\u0441\u0442\u0432\u043e\u043b")
"""
FILE, FOLDER = "\u043c\u043e\u0434\u0435\u043b\u044c.py", "\u2713 \u043e\u0442\u0432\u0435\u0442"
COMMANDS = (
    ["check", FILE],
    ["show", FILE, "-n", "1", "--quick", "--seed", "1"],
    ["grow", FILE, "--target", "box.obj", "--particles", "5", "--seed", "1", "--no-picture", "-o", FOLDER],
    ["replay", f"{FOLDER}/run.json", "-o", "again", "--no-picture"],
    ["color", "house", "-o", f"{FOLDER} 2", "--seed", "1", "-n", "1", "--side", "64", "--pixels", "64"],
    ["models"],
)
ENCODINGS = {
    "ascii": {"PYTHONIOENCODING": "ascii"},
    "cp1252": {"PYTHONIOENCODING": "cp1252"},
    "strict": {"PYTHONIOENCODING": "ascii:strict"},
    "C": {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / FILE).write_text(MODEL, "utf-8")
    (tmp_path / "box.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    )
    return tmp_path


#: Runs the commands that `;` ends, each with the named streams closed, and writes their exit codes. Words arrive as
#: bytes, because the C locale cannot decode them.
PROGRAM = """
import sys
from niwaki.shell.main import main
closed, *words = sys.argv[1:]
codes = []
while words:
    end = words.index(";")
    sys.argv = ["niwaki", *words[:end]]
    del words[: end + 1]
    for name in closed.split():
        if getattr(sys, name) is not None:
            getattr(sys, name).close()
        setattr(sys, name, None)
    try:
        main()
    except SystemExit as ended:
        codes.append(ended.code)
open("codes", "w").write(" ".join(map(str, codes)))
"""
STREAMS = {1: "stdout", 2: "stderr"}


def run(commands: Iterable[list[str]], folder: Path, closed: tuple[int, ...] = (), **settings: Any) -> Any:
    """Run commands in a process, whose streams with these numbers are closed; return the exit codes and the process."""
    words = [word for command in commands for word in (*command, ";")]
    program = [sys.executable, "-P", "-c", PROGRAM, " ".join(STREAMS[number] for number in closed)]
    done = subprocess.run(
        [*program, *map(os.fsencode, words)],
        cwd=folder,
        stderr=subprocess.PIPE,
        preexec_fn=lambda: [os.close(number) for number in closed],
        **settings,
    )
    assert done.returncode == 0, done.stderr.decode()
    return [int(code) for code in (folder / "codes").read_text().split()], done


@pytest.mark.parametrize("encoding", ["ascii", "cp1252", pytest.param("strict", marks=pytest.mark.soak), "C"])
def test_text_that_an_encoding_lacks_ends_no_command(folder: Path, encoding: str) -> None:
    environment = {**os.environ, **ENCODINGS[encoding]}
    # In the C locale Python cannot name the folder, and a run.json keeps only names that are text.
    commands = COMMANDS[:2] if encoding == "C" else COMMANDS
    refused = ["check", f"{FILE}:\u043d\u0435\u0442"]
    codes, done = run([*commands, refused], folder, stdout=subprocess.PIPE, env=environment)
    assert codes == [0] * len(commands) + [2], done.stderr.decode()
    assert b"\\u0434\\u0435\\u0440" in done.stdout and b"Traceback" not in done.stderr
    assert encoding == "C" or (folder / "again" / "best.glb").is_file()


@pytest.mark.parametrize("closed", [(1,), (2,), (1, 2)])
def test_a_closed_output_ends_no_command(folder: Path, closed: tuple[int, ...]) -> None:
    codes, done = run(COMMANDS[:3], folder, closed)
    assert codes == [0, 0, 0], done.stderr.decode()
    assert (folder / FOLDER / "best.glb").is_file()
