"""Claim: what goes wrong in the first hour has a message that says what to write instead, and `niwaki models` says how
each model is run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from niwaki import box
from niwaki.draw.scene import Scene
from niwaki.errors import NiwakiError
from niwaki.gallery import entries
from niwaki.shell import progress
from niwaki.shell.main import app
from PIL import Image
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

MODELS = """
from niwaki import *

@model
def spelled():
    emit(box((0, 0, 0), (1, 1, 1)), colour=(1, 0, 0))

@model
def flat():
    emit(box(0, (uniform(1, 2), 1, 1)))

@model
def plane():
    emit(cylinder((0, 0), uniform(1, 2), 1))

@model
def forgotten():
    x = uniform(1, 2)
    box((0, 0, 0), (x, 1, 1))

@model
def returned():
    return box((0, 0, 0), (uniform(1, 2), 1, 1))

@model
def tower():
    emit(box((0, 1, 0), (1, 2 * uniform(0.5, 1), 1)))

@model
def narrow():
    x = gaussian(0, -1)
    emit(box((x, 0, 0), (1, 1, 1)))

@model
def crowded():
    emit(box((0, 1, 0), (uniform(1, 2), 1, 1)), name="road")
    emit(box((0, 1, 0), (1, 2, 1)), name="cable")
"""

FAILING = {
    "the other spelling": ["spelled"],
    "a number for a point": ["flat"],
    "two numbers for a point": ["plane"],
    "a shape without emit": ["forgotten"],
    "a shape that is returned": ["returned"],
    "a floor above the model": ["tower", "--floor", "1"],
    "a parameter out of range": ["narrow"],
    "parts that always collide": ["crowded"],
}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with models and a target, where the shell is."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "first.py").write_text(MODELS)
    Scene([("all", [box((0, 2, 0), (4, 4, 4))])]).export(tmp_path / "box.obj")
    return tmp_path


def run(*words: str) -> Any:
    return CliRunner().invoke(app, list(words))


def test_messages_of_the_first_hour_are_as_reviewed(place: Path, golden: Any) -> None:
    texts = []
    for name, (model, *flags) in FAILING.items():
        words = ["grow", f"first.py:{model}", "--target", "box.obj", "--seed", "1", *flags, "--no-picture"]
        error = run(*words).exception
        assert isinstance(error, NiwakiError), (name, error)
        texts.append(f"## {name}\n\n{error}\n".replace(str(place), "FOLDER"))
    golden(GOLDEN / "first-messages.txt", "\n".join(texts))


def test_each_model_is_listed_with_a_command_that_runs_it() -> None:
    listed = {
        line.split()[0]: line.split()[1] for line in run("models").output.splitlines()[: len(entries())]
    }
    assert set(listed) == {entry.name for entry in entries()}
    assert {name for name, how in listed.items() if how == "sample"} == {
        *("coin", "furniture", "gmm", "harmonies", "hlr", "hmm", "lda", "palettes", "pipes", "point"),
        "toy-blocks",
    }
    for entry in entries():
        if listed[entry.name] == "sample":
            refused = run("grow", entry.name, "--no-picture").exception
            assert isinstance(refused, NiwakiError) and "niwaki sample" in str(refused), entry.name


def test_long_commands_say_how_far_they_are_in_a_file(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    grown = ["grow", "first.py:tower", "--target", "box.obj", "--seed", "1", "--no-picture", "-o", "quiet"]
    assert "growing" not in run(*grown).stderr
    monkeypatch.setattr(progress, "EVERY", 0.0)
    lines = [line for line in run(*grown[:-1], "loud").stderr.splitlines() if line.startswith("growing")]
    assert lines and all("run 1 of 1, step" in line and "Ctrl-C" not in line for line in lines)
    sampled = run("sample", "first.py:tower", "--steps", "2000", "--seed", "1", "--no-picture").stderr
    assert "first.py:tower: " in sampled and " of 8000 proposals" in sampled


def test_losses_are_named_when_some_runs_survive(place: Path) -> None:
    (place / "lucky.py").write_text(
        "from niwaki import *\n\n@model\ndef m():\n    emit(box((0, 2, 0), (4, 4, 4)), name='road')\n"
        "    emit(box((0 if flip(0.6) else 5, 1, 0), (0.2, 0.2, 0.2)), name='cable')\n"
    )
    words = (
        "grow",
        "lucky.py:m",
        "--target",
        "box.obj",
        "--no-picture",
        "--method",
        "smc",
        "--particles",
        "1",
    )
    with pytest.warns(UserWarning, match="runs became impossible") as record:
        run(*words, "--runs", "8", "--seed", "1")
    lost = next(str(warning.message) for warning in record if "became impossible" in str(warning.message))
    assert '"cable" (line 6) runs into "road" (line 5) in 1 of 1; put parts' in lost
    assert "put parts that belong together into one `emit`" in lost and "particles" not in lost


def test_check_tries_two_versions(place: Path) -> None:
    (place / "both.py").write_text(
        "from niwaki import *\n\n@model\ndef good():\n    emit(box((0, uniform(1.9, 2.1), 0), (4, 4, 4)))\n\n"
        "@model\ndef bad():\n    emit(box((0, uniform(9, 10), 0), (4, 4, 4)))\n"
    )
    words = ("check", "both.py:good", "--target", "box.obj", "--try")
    assert "both.py:good is better in 8 of 8" in run(*words, "both.py:bad").stdout
    assert "no clear difference" in run(*words, "both.py:good").stdout
    assert getattr(run(*words[:-1]).exception, "code", None) == "flag-alone"


def test_memory_is_bounded_from_the_shell(place: Path) -> None:
    (place / "greedy.py").write_text(
        "from niwaki import *\n@model\ndef m():\n    xs = [0]\n    while True:\n        xs = xs + xs\n"
        "    emit(box((0, 0, 0), (1, len(xs), 1)))\n"
    )
    words = ("grow", "greedy.py:m", "--target", "box.obj", "--no-picture", "--max-memory")
    assert getattr(run(*words, "2").exception, "code", None) == "memory-budget"
    assert run(*words, "0").exit_code == 2


def test_a_search_that_fails_draws_what_collides_in_red(place: Path) -> None:
    done = run("grow", "first.py:crowded", "--target", "box.obj", "--seed", "1", "--quick", "-o", "bad")
    assert getattr(done.exception, "code", None) == "everything-impossible"
    assert (
        "bad/impossible.png shows such a run; the parts in red make it impossible: Cable, Road" in done.stderr
    )
    with Image.open("bad/impossible.png") as picture:
        red, green, blue = np.asarray(picture.convert("RGB"), dtype=int).reshape(-1, 3).T
    assert ((red > 120) & (green < 90) & (blue < 90)).sum() > 500
    # It is no result: the folder can be used again.
    again = run("grow", "first.py:tower", "--target", "box.obj", "--seed", "1", "--quick", "-o", "bad")
    assert again.exit_code == 0 and not Path("bad/impossible.png").exists()
