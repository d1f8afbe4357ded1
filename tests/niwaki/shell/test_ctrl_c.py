"""Claim: Ctrl-C ends every long command with the status 130, and what is there afterwards is whole.

The key is pressed by the progress of a search, or by a host function of the model: each time at the same place.
"""

from __future__ import annotations

import json
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import color, draw, guides
from niwaki.shell import compare, fit, guide, letters, progress
from niwaki.shell.main import app
from PIL import Image
from typer.testing import CliRunner

pytestmark = pytest.mark.filterwarnings("ignore::niwaki.search.warnings.SearchWarning")

BLOCK = """
import niwaki as nw

def block(width=nw.Uniform(1, 4)):
    return nw.box((0, 0, 0), (width, 1, 2))
"""

MODEL = """
import os, signal
from niwaki import box, emit, factor, flip, host, model, uniform

@host
def judged(x):
    if "PRESSED" in os.environ:
        signal.raise_signal(signal.SIGINT)
    return -x

def arm(y, n):
    size = uniform(0.5, 1.5)
    emit(box((0, y + size / 2, 0), (1, size, 1)))
    factor(judged(size))
    if n > 0 and flip(0.8):
        arm(y + size, n - 1)

@model
def tower():
    arm(0.0, 5)
"""

BATCH = 'model = "garden.py:tower"\nseeds = 40\n[grow]\ntarget = "gallery:ship"\nparticles = 5\nvoxel = 1.0\n'

#: Commands whose progress presses the key.
SHOWN = {
    "grow": "grow garden.py:tower --target gallery:ship --particles 10 --voxel 1 --runs 1000 --no-picture -o out",
    "sample": "sample garden.py:tower --steps 1000000 --no-picture -o out",
    "batch": "batch garden.toml -o out --processes 1 --chunk 0",
    "color": "color bug -n 2 -o out",
    "fit": "fit block.py:block --target gallery:ship --evaluations 40 --workers 1 --no-picture -o out",
    "letters": "letters I --particles 4 --searches 3 --format png,svg -o out",
    "check --try": "check garden.py:tower --try garden.py:tower --target gallery:ship",
    "guide train": "guide train vines --targets scribbles --searches 9,9 -o out/vines.guide",
}

#: Commands in which a host function presses it.
HOSTS = {
    "show": "show garden.py:tower -n 3 --seed 1",
    "replay": "replay first/run.json --trust -o out",
    "grow --reroll": "grow garden.py:tower --target gallery:ship --from first/run.json --reroll * --no-picture -o out",
    "grow": "grow garden.py:tower --target gallery:ship --particles 10 --voxel 1 --runs 1000 --no-picture -o out",
    "explain": "explain garden.py:tower --choice arm[1]/size",
}

#: The other commands: none of them searches for long.
SHORT = {"models", "doctor", "studio", "mcp", "init", "repair"}


@contextmanager
def pressing(*_: Any, **__: Any) -> Iterator[Callable[[str], None]]:
    count = 0

    def press(text: str) -> None:
        nonlocal count
        # Before the end of the first run there is no result to keep. A warning calls host functions
        # again after the search, where a person would not press a second time.
        if "evaluations" not in text or ("run 2" in text and count == 0):
            count += 1
            signal.raise_signal(signal.SIGINT)

    yield press


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "garden.py").write_text(MODEL)
    (tmp_path / "block.py").write_text(BLOCK)
    (tmp_path / "garden.toml").write_text(BATCH)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(words: str) -> Any:
    return CliRunner().invoke(app, words.split())


def whole(folder: Path) -> list[str]:
    """The files of a folder, each of which can be read to its end."""
    files = [file for file in folder.rglob("*") if file.is_file()]
    for file in files:
        if file.suffix == ".json":
            json.loads(file.read_bytes())
        elif file.suffix == ".png":
            Image.open(file).load()
        assert not file.name.endswith(".part")
    return sorted(str(file.relative_to(folder)) for file in files)


def stopped(words: str) -> None:
    done = run(words)
    assert done.exit_code == 130, (done.exit_code, done.output, done.exception)
    assert "Traceback" not in done.output and "error[" not in done.output
    assert "interrupted" in done.output or "stopped" in done.output


@pytest.mark.parametrize("name", SHOWN)
def test_ctrl_c_ends_a_command(name: str, place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (progress, letters, guide, compare, fit):
        monkeypatch.setattr(module, "status_line", pressing)
    stopped(SHOWN[name])
    kept = whole(place / "out")
    expected_file = {
        "grow": "run.json",
        "fit": "fit.json",
        "sample": "samples.csv",
        "guide train": "vines.guide.checkpoint",
    }.get(name)
    assert (
        expected_file in kept
        if expected_file
        else not [name_of_file for name_of_file in kept if not name_of_file.startswith(("spec-", "1-of-1"))]
    )


@pytest.mark.parametrize("name", HOSTS)
def test_ctrl_c_inside_of_a_host_function_ends_a_command(
    name: str, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = run("grow garden.py:tower --target gallery:ship --particles 10 --voxel 1 --no-picture -o first")
    assert first.exit_code == 0, first.output
    before = whole(place / "first")
    monkeypatch.setenv("PRESSED", "1")
    stopped(HOSTS[name])
    assert whole(place / "first") == before
    whole(place / "out")


def test_each_command_is_pressed() -> None:
    named = {words.split()[0] for words in (*SHOWN.values(), *HOSTS.values())}
    assert named | SHORT == set(nw.shell.app.COMMANDS) and not named & SHORT


def test_what_learns_to_look_ahead_is_kept(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shipped = guides.shipped(nw.gallery.vines.vines)
    pressed = partial(guides.train_look_ahead, progress=lambda *_: signal.raise_signal(signal.SIGINT))
    monkeypatch.setattr(nw, "train_guide", lambda *_, **__: shipped)
    monkeypatch.setattr(guides, "train_look_ahead", pressed)
    stopped("guide train vines --targets scribbles --searches-ahead 100000 -o out/vines.guide")
    assert nw.Guide.load(place / "out/vines.guide").report["look_ahead"]["interrupted"]


def test_a_colouring_that_is_stopped_is_none() -> None:
    with pytest.raises(KeyboardInterrupt):
        color.color("bug", count=2, seed=1, progress=lambda _: signal.raise_signal(signal.SIGINT))


def test_a_part_whose_growth_is_stopped_is_none(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tower = nw.shell.references.find("garden.py:tower").model
    sample = nw.run(tower, seed=1).best
    monkeypatch.setenv("PRESSED", "1")
    with pytest.raises(KeyboardInterrupt):
        sample.regrow("arm[1]", 10, seed=1)


def test_ctrl_c_while_pictures_are_drawn_keeps_drafts_and_files(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = draw.picture.picture

    def pressed(*scenes: Any, **settings: Any) -> Any:
        if settings.get("samples") != 1:
            raise KeyboardInterrupt
        return drawn(*scenes, **settings)

    for module in (draw.picture, draw.sheet):
        monkeypatch.setattr(module, "picture", pressed)
    stopped("grow garden.py:tower --target gallery:ship --particles 10 --voxel 1 --runs 2 --seed 1 -o out")
    assert whole(place / "out") == ["best.glb", "best.png", "run.json", "sheet.png"]
    assert set(json.loads((place / "out/run.json").read_bytes())["files"]) == {
        "best.glb",
        "best.png",
        "sheet.png",
    }
