"""The figures of chapter 5 can be drawn: a smoke run makes every picture and every line of what it measures."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("matplotlib")

BENCHES = Path(__file__).resolve().parents[2] / "benches"


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("figures")
    settings = {name: value for name, value in os.environ.items() if name != "NIWAKI_REFERENCE_TARGETS"}
    command = [sys.executable, str(BENCHES / "figures_sosmc"), str(folder)]
    subprocess.run(command, check=True, env=settings | {"QUICK": "1"}, stdout=subprocess.DEVNULL)
    return folder


def rows(path: Path) -> list[dict]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_every_figure_is_drawn(drawn: Path) -> None:
    from experiments import EXPERIMENTS
    from PIL import Image

    expected = {
        f"figure-{experiment.figure.replace('.', '-')}-{experiment.name}.png"
        for experiment in EXPERIMENTS
        if experiment.name != "tall-tree"
    }
    files = {path.name for path in drawn.glob("*.png")}
    # Small populations may die among obstacles; those rows say so.
    dead = [row for row in rows(drawn / "examples.jsonl") if "scores" not in row]
    assert expected | {"figure-5-2.png", "figure-5-9-ours.png"} <= files | {
        name for name in expected if any(row["experiment"] in name for row in dead)
    }
    for path in drawn.glob("*.png"):
        with Image.open(path) as image:
            assert min(image.size) > 100


def test_every_search_is_measured(drawn: Path) -> None:
    table = rows(drawn / "examples.jsonl")
    assert len(table) == 18
    assert all(row["cpu"] > 0.0 and row["primitives"] for row in table if "scores" in row)
    compared = rows(drawn / "comparison.jsonl")
    assert {row["method"] for row in compared} == {
        "stochastic",
        "depth-first",
        "usual search",
        "Metropolis-Hastings, same time",
    }
    assert len(compared) == 3 * 4
    # Trees, and memory: boxes and segments, selected and not.
    assert len(rows(drawn / "growth.jsonl")) == 1 + 4
    assert len(rows(drawn / "threads.jsonl")) == 5
