"""Claim: `niwaki fit` fits a function of a file to a mesh or an image, and goes on where it stopped."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.shell.app import app
from PIL import Image
from typer.testing import CliRunner

MODEL = """
from niwaki import Uniform, box, model

def slab(width=Uniform(0.5, 2.0), height=Uniform(0.5, 2.0)):
    if height > 1.9:
        raise ValueError("too high")
    return box((0, height / 2, 0), (width, height, 1))

def other(width):
    return None

@model
def grown():
    return 1
"""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("slab.py").write_text(MODEL)
    shape = _engine.shape("box", (0, 0.6, 0), (1.5, 1.2, 1))
    Scene([("slab", [shape])]).export("slab.obj")
    camera = nw.Camera.orthographic((0, 0.6, 9), (0, 0.6, 0), height=2.0)
    blank = np.zeros((40, 60), bool)
    blank[9, 9] = True
    mask = nw.match_image(blank, camera).views[0].mask(Scene([("slab", [shape])]))
    Image.fromarray(np.where(mask, 255, 0).astype(np.uint8)).save("photo.png")
    return tmp_path


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in ("fit", *words)])


def test_a_fit_writes_its_folder_and_goes_on(place: Path) -> None:
    words = ("slab.py:slab", "--target", "slab.obj", "--voxel", "0.1", "--workers", "1", "--quick")
    first = run(*words, "--evaluations", "16", "--seed", "1")
    assert first.exit_code == 0, (first.output, first.exception)
    assert "16 evaluations" in first.output and "IoU" in first.output
    folder = place / "slab-fit"
    names = {file.name for file in folder.iterdir()}
    assert names == {"archive.fit", "fit.json", "table.csv", "best.glb", "best.png", "sheet.png"}
    again = run(*words, "--evaluations", "20", "--json", "-o", folder)
    assert json.loads(again.output)["evaluations"] == 20
    rows = list(csv.DictReader((folder / "table.csv").read_text().splitlines()))
    assert len(rows) == 20 and {"width", "height", "log_score", "failure", "seconds"} <= set(rows[0])
    best = json.loads((folder / "fit.json").read_text())["best"]
    assert best["log_score"] == max(float(row["log_score"]) for row in rows if row["log_score"])


def test_an_image_without_a_camera_is_seen_from_the_front(place: Path) -> None:
    done = run(
        "slab.py:slab",
        "--match-image",
        "photo.png",
        "--workers",
        "1",
        "--evaluations",
        "16",
        "--seed",
        "2",
        "--json",
    )
    assert done.exit_code == 0, (done.output, done.exception)
    # The middle of the heights is as high as the silhouette, which shows 1.5 by 1.2.
    best = json.loads(done.output)["best"]["parameters"]
    assert best["width"] / best["height"] == pytest.approx(1.5 / 1.2, rel=0.3)
    assert not (place / "slab-fit").exists()


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (("slab.py:slob",), "unknown-model", "slab.py defines slab, other"),
        (("none.py:slab",), "unknown-model", "there is no file"),
        (("slab",), "unknown-model", "write file.py:function"),
        (("slab.py:grown", "--target", "slab.obj"), "unknown-model", "`niwaki grow slab.py:grown`"),
        (("slab.py:slab",), "no-target", "--target FILE"),
        (("slab.py:slab", "--target", "slab.obj", "--evaluations", "0"), "bad-setting", "`evaluations`"),
    ],
)
def test_bad_words_are_refused(place: Path, words: tuple[str, ...], code: str, text: str) -> None:
    error = run(*words).exception
    assert isinstance(error, InputError), error
    assert error.code == code and text in str(error)
