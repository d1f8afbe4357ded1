"""The shell: a replay gives the same bytes, `--json` prints nothing else, errors exit with 2."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from niwaki.errors import NiwakiError
from niwaki.search.checkpoint import Stored
from niwaki.shell import resume
from niwaki.shell.main import app
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"
GROW = ["grow", "spaceship", "--particles", "30", "--voxel", "0.5", "--seed", "3"]

MODEL = """
from niwaki import box, emit, flip, model, uniform

def arm(y, n):
    size = uniform(0.5, 1.5)
    emit(box((0, y + size / 2, 0), (1, size, 1)))
    if n > 0 and flip(0.8):
        arm(y + size, n - 1)

@model
def tower():
    arm(0.0, 5)

@model
def broken():
    xs = []
    xs.append(1)
    return xs
"""


def run(*words: str) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def tower(tmp_path: Path) -> Path:
    (tmp_path / "garden.py").write_text(MODEL)
    return tmp_path / "garden.py"


def test_grow_writes_and_replay_gives_the_same_bytes(tmp_path: Path) -> None:
    first, again = tmp_path / "a", tmp_path / "b"
    grown = run(*GROW, "--runs", "2", "-o", str(first), "--no-picture")
    assert grown.exit_code == 0, grown.output
    assert run("replay", str(first / "run.json"), "-o", str(again), "--no-picture").exit_code == 0
    assert (first / "best.glb").read_bytes() == (again / "best.glb").read_bytes()
    data = json.loads((first / "run.json").read_text())
    assert data["search"]["seed"] == 3 and [row["seed"] for row in data["runs"]] == [3, 4]
    assert data["search"]["method"]["power"] == 16.0
    assert data["search"]["score"][-1]["given"]["voxel"] == 0.5
    choice = data["runs"][0]["choices"][0]
    assert choice["family"] and choice["address"] and "value" in choice
    assert data["runs"][0]["order_choices"][0]["place"] >= 0
    assert sorted(path.name for path in first.iterdir()) == ["best.glb", "run.json"]


@pytest.mark.filterwarnings("ignore:the best result scores")  # the tower is wider than the pillar
def test_pictures(tower: Path, tmp_path: Path) -> None:
    target = tmp_path / "pillar.obj"
    target.write_text(
        "v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n", encoding="utf-8"
    )
    out = tmp_path / "out"
    grown = run(
        "grow", f"{tower}:tower", "--target", str(target), "--particles", "10", "--seed", "1", "-o", str(out)
    )
    assert grown.exit_code == 0, grown.output
    assert {path.name for path in out.iterdir()} == {"best.glb", "best.png", "run.json"}
    assert (out / "best.png").read_bytes()[:4] == b"\x89PNG"


def test_json_prints_the_numbers_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    printed = run(*GROW, "--json", "--runs", "2")
    assert printed.exit_code == 0
    data = json.loads(printed.stdout)
    assert list(data) == ["runs"] and len(data["runs"]) == 2
    names = {
        "log_score",
        "log_prior",
        "similarity",
        "primitives",
        "seconds",
        "cpu_seconds",
        "covered",
        "outside",
        "seed",
    }
    assert all(set(row) == names for row in data["runs"])
    assert not list(tmp_path.iterdir())


def test_models_lists_the_gallery() -> None:
    assert re.search(r"^spaceship +grow +ship +\w", run("models").stdout, re.MULTILINE)


def test_check_reports_and_refuses(tower: Path) -> None:
    good = run("check", f"{tower}:tower")
    assert good.exit_code == 0
    assert "compiled in" in good.stdout and "functions   2" in good.stdout and "size" in good.stdout
    assert "(module" in run("check", f"{tower}:tower", "--core").stdout
    assert run("check", f"{tower}:tower", "--bytecode").stdout
    bad = run("check", f"{tower}:broken")
    assert bad.exit_code == 1
    assert "error[changes-a-value]" in bad.stderr and "^^^^^^^^^^^^" in bad.stderr


@pytest.mark.filterwarnings("ignore:the best result scores")  # the tower is wider than the pillar
def test_a_replay_needs_no_model_file_and_runs_none(tower: Path, tmp_path: Path) -> None:
    out, again = tmp_path / "out", tmp_path / "again"
    words = ["grow", f"{tower}:tower", "--target", str(pillar(tmp_path)), "--particles", "5", "--no-picture"]
    assert run(*words, "-o", str(out)).exit_code == 0
    for text in (MODEL.replace("flip(0.8)", "flip(0.7)"), "raise SystemExit(9)", None):
        tower.unlink() if text is None else tower.write_text(text)
        assert run("replay", str(out / "run.json"), "-o", str(again), "--no-picture").exit_code == 0
        assert (again / "best.glb").read_bytes() == (out / "best.glb").read_bytes()


def pillar(folder: Path) -> Path:
    place = folder / "pillar.obj"
    place.write_text("v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    return place


def refusals(folder: Path, garden: Path) -> dict[str, list[str]]:
    (folder / "broken.json").write_text('{"format": 1, "runs"')
    (folder / "other.json").write_text("{}")
    (folder / "fails.py").write_text("import niwaki\n\n1 / 0\n")
    (folder / "cut.glb").write_bytes(b"glTF\x02\x00\x00\x00\xff")
    return {
        "a name that nobody has": ["grow", "spacship"],
        "a function that is not there": ["check", f"{garden}:towr"],
        "a file that is not there": ["check", f"{folder}/none.py:m"],
        "a file that fails": ["check", f"{folder}/fails.py:m"],
        "no target": ["grow", f"{garden}:tower"],
        "a target that is not there": ["grow", "spaceship", "--target", f"{folder}/none.obj"],
        "a target cut short": ["grow", "spaceship", "--target", f"{folder}/cut.glb"],
        "no particles": ["grow", "spaceship", "--particles", "0"],
        "a setting": ["grow", "spaceship", "--order", "random"],
        "a run that is not there": ["replay", f"{folder}/none.json"],
        "a run cut short": ["replay", f"{folder}/broken.json"],
        "another file": ["replay", f"{folder}/other.json"],
        "a model that does not compile": [
            "grow",
            f"{garden}:broken",
            "--target",
            str(pillar(folder)),
        ],
    }


def test_messages(tower: Path, tmp_path: Path, golden: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    texts = []
    for name, words in refusals(tmp_path, tower).items():
        failed = run(*words)
        assert isinstance(failed.exception, NiwakiError), (name, failed.output, failed.exception)
        text = (
            str(failed.exception).replace(str(tmp_path.resolve()), "FOLDER").replace(str(tmp_path), "FOLDER")
        )
        texts.append(f"## {name}\n\n{text}\n")
    golden(GOLDEN / "shell.txt", "\n".join(texts))


def test_a_process_prints_errors_without_a_traceback() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "niwaki.shell.main", "grow", "spacship"], capture_output=True, text=True
    )
    assert done.returncode == 2
    assert done.stderr.startswith("error[unknown-model]") and "Traceback" not in done.stderr
    assert done.stdout == ""


def has_result(path: Path) -> bool:
    """Whether a checkpoint has the result of a whole run; it may be written before."""
    return path.exists() and any(name.endswith("/done") for name in Stored.read(path).parts)


@pytest.mark.skipif(os.name == "nt", reason="signals of Unix")
def test_ctrl_c_writes_the_best_so_far(tmp_path: Path) -> None:
    out = tmp_path / "out"
    words = [*GROW, "--runs", "100000", "--no-picture", "-o", str(out)]
    child = subprocess.Popen([sys.executable, "-m", "niwaki.shell.main", *words], stdout=subprocess.PIPE)
    while not has_result(out / resume.NAME) and child.poll() is None:
        time.sleep(0.02)
    child.send_signal(signal.SIGINT)
    assert child.wait(timeout=60) == 130
    assert child.stdout is not None
    child.stdout.close()
    data = json.loads((out / "run.json").read_text())
    assert data["interrupted"] and len(data["runs"]) >= 1
    before = (out / "best.glb").read_bytes()
    assert run("replay", str(out / "run.json"), "-o", str(out), "--no-picture").exit_code == 0
    assert (out / "best.glb").read_bytes() == before


OVERLAPPING = """
from niwaki import box, emit, model, uniform

@model
def over():
    height = uniform(1, 2)
    emit(box((0, 0, 0), (1, height, 1)))
    emit(box((0.3, 0, 0), (1, height, 1)))
"""


@pytest.mark.filterwarnings("ignore")
def test_parts_may_overlap_and_a_value_alone_is_held(tmp_path: Path) -> None:
    file, first, second = (tmp_path / name for name in ("over.py", "first", "second"))
    file.write_text(OVERLAPPING)
    words = ("grow", str(file), "--target", "gallery:armchair", "--seed", "1", "--no-picture")
    assert "impossible" in str(run(*words, "-o", str(tmp_path / "none")).exception)
    assert run(*words, "--rule", "none", "-o", str(first)).exit_code == 0
    again = ("grow", str(file), "--from", str(first / "run.json"), "--hold", "height=1.5", "--no-picture")
    assert run(*again, "-o", str(second)).exit_code == 0
    best = json.loads((second / "run.json").read_text())["runs"][0]
    assert "1.5" in json.dumps(best["choices"])
