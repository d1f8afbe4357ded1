"""The figures of the point and of the colourings can be drawn, and the samplers that they compare are correct."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("resvg_py")

ROOM = Path(__file__).resolve().parents[2] / "benches" / "figures_hmc"


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("figures")
    command = [sys.executable, str(ROOM), str(folder), "point", "colors", "exploration"]
    subprocess.run(command, check=True, env=os.environ | {"QUICK": "1"}, stdout=subprocess.DEVNULL)
    return folder


@pytest.fixture
def room(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOM))


def rows(path: Path) -> list[dict]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_every_figure_is_drawn_and_every_chain_is_measured(drawn: Path) -> None:
    from PIL import Image

    names = ["figure-4-2.png", "figure-4-3.png", "figure-4-4.png", "figure-4-5.png"]
    assert sorted(path.name for path in drawn.glob("*.png")) == names
    for name in names:
        with Image.open(drawn / name) as image:
            assert min(image.size) > 200
    assert [row["chain"].split(",")[0] for row in rows(drawn / "point.jsonl")] == ["MH", "MH", "HMC", "NUTS"]
    assert [row["method"] for row in rows(drawn / "colors.jsonl")] == ["MH", "HMC", "explore"]
    compared = rows(drawn / "exploration.jsonl")
    assert [row["design"] for row in compared] == ["bug"] * 3 + ["stack"] * 2
    assert all(row["effective"] > 0 and row["gradients"] > 0 for row in compared)


@pytest.mark.usefixtures("room")
def test_139_bins_hold_a_colour_of_the_screen() -> None:
    import coverage

    edge = np.linspace(0.0, 1.0, 129)
    colors = np.stack(np.meshgrid(edge, edge, edge, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    assert coverage.reached(colors).tolist() == [coverage.REACHABLE]
    assert coverage.reached(np.full((50, 2, 3), 0.3)).tolist() == [1, 1]


def logistic(x: np.ndarray) -> tuple[float, np.ndarray]:
    """A uniform choice on [0, 1] in its unbounded coordinate."""
    return float(np.sum(-np.abs(x) - 2.0 * np.log1p(np.exp(-np.abs(x))))), -np.tanh(0.5 * x)


@pytest.mark.usefixtures("room")
def test_the_originals_mh_draws_from_another_density_and_corrected_from_the_right_one() -> None:
    """Draws of a uniform choice: Beta(2, 2) as published, variance 1/20; uniform when corrected, variance 1/12."""
    import original

    for corrected, variance in ((False, 1 / 20), (True, 1 / 12)):
        draws, accepted = original.mh(
            logistic, np.zeros(1), 30_000, 5, (0.0, 1.0), width=0.6, adapts=False, corrected=corrected
        )
        values = 1.0 / (1.0 + np.exp(-draws[:, 0]))
        # Some 10 000 effective draws: the standard error of a variance is below 0.0007, and this is six of those.
        assert values.var() == pytest.approx(variance, abs=0.0042)
        assert 0.3 < accepted < 0.9


@pytest.mark.usefixtures("room")
def test_the_originals_hmc_draws_from_its_density_at_the_acceptance_it_seeks() -> None:
    import original

    draws, accepted = original.hmc(logistic, np.zeros(2), 4000, 5, 3)
    # The logistic density has variance pi^2 / 3; at 65 % the effective size is some 2000 of 8000.
    assert draws.var() == pytest.approx(np.pi**2 / 3, rel=0.2)
    assert accepted == pytest.approx(0.65, abs=0.05)
