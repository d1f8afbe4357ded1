"""The first hour as a new user types it: every command in order, and what the shell says to each."""

from __future__ import annotations

import re
import warnings
from pathlib import Path
from typing import Any

import pytest
from niwaki import box
from niwaki.draw.scene import Scene
from niwaki.errors import NiwakiError
from niwaki.shell import progress
from niwaki.shell.main import app
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

TOWER = """
from niwaki import box, emit, flip, model, uniform

@model
def tower(width=1.0, count: int = 5):
    \"\"\"Arms on one another, and a hat below.\"\"\"
    arm(0.0, width, count)
    hat(width)

def arm(y, width, n):
    size = uniform(0.5, 1.5)
    emit(box((0, y + size / 2, 0), (width, size, width)), name="arm")
    if n > 0 and flip(0.8):
        arm(y + size, width, n - 1)

def hat(width):
    side = uniform(0.2, 0.8)
    emit(box((0, -side / 2, 0), (side, side, width)), name="hat")
"""

BRIDGE = """
from niwaki import box, cylinder, emit, model, uniform

@model
def bridge():
    emit(box((0, 0, 0), (6, 0.3, 2)), name="road")
    for i in range(4):
        emit(cylinder((i - 1.5, uniform(0.5, 1.0), 0), 0.1, 2.4), name="cable")
"""

#: What is typed, and between the commands what the user does to files.
TASKS: list[str | tuple[str, str, str]] = [
    "show tower.py -n 3 --seed 1 --quick",
    "check tower.py",
    "grow tower.py --target pillar.obj --seed 1 --quick",
    "grow tower.py widht=1.5 --target pillar.obj",
    "grow tower.py width=wide --target pillar.obj",
    "grow tower.py width=1.2 count=3 --target pillar.obj --seed 1 --runs 3 --export 2 --quick -o wide",
    "grow tower.py --target pillar.obj -o wide",
    "grow tower.py width=1.2 --target pillar.obj --from wide/run.json --run 2 --hold hat --seed 7 --quick -o held",
    "grow tower.py width=1.2 --target pillar.obj --from wide/run.json --reroll hut -o other",
    "grow tower.py width=1.2 --target pillar.obj --from wide/run.json --reroll hat --seed 7 --quick -o other",
    "replay wide/run.json --run 3 --format obj -o third --no-picture",
    "replay wide/run.json --run 9 -o ninth",
    ("tower.py", "side = uniform(0.2, 0.8)", "side = uniform(2.0, 3.0)"),
    "replay wide/run.json -o same --no-picture",
    "replay wide/run.json --anyway -o mended --no-picture",
    "grow bridge.py --target pillar.obj --seed 1 --quick -o bridge",
    ("bridge.py", "name=\"road\")", "colour=(1, 0, 0))"),
    "check bridge.py",
    ("bridge.py", "colour=(1, 0, 0))", "name=\"road\")"),
    ("bridge.py", "(i - 1.5, uniform(0.5, 1.0), 0)", "(i - 1.5, uniform(1.4, 1.6), 0)"),
    "grow bridge.py --target pillar.obj --seed 1 --quick -o bridge",
    "grow spaceship --seed 1 --quick -o ship",
    "grow spceship",
    "color bug -n 1 --seed 1 --side 64 -o colours",
]  # fmt: skip


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(progress, "EVERY", 1e9)
    (tmp_path / "tower.py").write_text(TOWER)
    (tmp_path / "bridge.py").write_text(BRIDGE)
    Scene([("pillar", [box((0, 2, 0), (1, 4, 1))])]).export(tmp_path / "pillar.obj")
    return tmp_path


def output_of(words: str) -> str:
    """Return the output of a command, with its warnings and errors."""
    with warnings.catch_warnings(record=True) as noted:
        warnings.simplefilter("always")
        done: Any = CliRunner().invoke(app, words.split())
    text = done.output + "".join(
        f"warning: {warning.message}\n" for warning in noted if issubclass(warning.category, UserWarning)
    )
    if isinstance(done.exception, NiwakiError):
        text += f"{done.exception}\n"
    elif done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return text


def plain(text: str, place: Path) -> str:
    """Without what differs from run to run: places and times."""
    text = text.replace(str(place.resolve()), "FOLDER").replace(str(place), "FOLDER")
    text = re.sub(r"\d+\.\d+ s\b", "TIME s", text)
    text = re.sub(r"\b(start|compile|target|search|pictures?|files|runs) \d+\.\d+", r"\1 TIME", text)
    text = re.sub(r"compiled in \d+\.\d+ ms", "compiled in TIME ms", text)
    return "\n".join(line.rstrip() for line in text.splitlines())


def test_the_first_hour_is_as_reviewed(place: Path, golden: Any) -> None:
    texts = []
    for task in TASKS:
        if isinstance(task, tuple):
            name, before, after = task
            text = (place / name).read_text()
            assert before in text
            (place / name).write_text(text.replace(before, after))
            texts.append(f"(in {name}: {before}  ->  {after})\n")
        else:
            texts.append(f"$ niwaki {task}\n{plain(output_of(task), place)}\n")
    golden(GOLDEN / "first-hour-log.txt", "\n".join(texts))
