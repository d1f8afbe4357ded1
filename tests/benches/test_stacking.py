"""The parts of the bench of structures: files that continue, effective draws, two chains without gradients.

Each statistical test fails a true program in fewer than one of ten thousand seeds; seeds are fixed.
"""

from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from stacking.effective import autocorrelation, effective
from stacking.files import Drawn, Verdicts, chain_file, chains
from stacking.metropolis import Units, keeper, walk


def autoregressive(share: float, chains: int, draws: int) -> np.ndarray:
    random = np.random.default_rng(5)
    values = np.zeros((chains, draws, 3))
    values[:, 0] = random.normal(size=(chains, 3))
    for k in range(1, draws):
        fresh = random.normal(size=(chains, 3))
        values[:, k] = share * values[:, k - 1] + np.sqrt(1 - share * share) * fresh
    return values


def test_effective_draws_of_an_autoregression_are_the_known_share():
    draws = autoregressive(0.5, 8, 2000)
    # (1 - a) / (1 + a) of the draws; 16000 draws know it to some percent.
    assert effective(draws) == pytest.approx(16000 / 3, rel=0.12)
    assert autocorrelation(draws)[:3] == pytest.approx([1.0, 0.5, 0.25], abs=0.05)
    assert effective(autoregressive(0.0, 4, 500)) == pytest.approx(2000, rel=0.15)


def test_a_line_that_was_cut_short_is_judged_again(tmp_path: Path):
    first = Verdicts(tmp_path, "stack", "nuts")
    first.add({"chain": 0, "draw": 0, "holds": True})
    first.add({"chain": 0, "draw": 1, "holds": True})
    with first.path.open("a") as lines:
        lines.write('{"chain": 0, "dr')
    again = Verdicts(tmp_path, "stack", "nuts")
    assert [row["draw"] for row in again] == [0, 1]
    again.add({"chain": 0, "draw": 2, "holds": False})
    assert [row["draw"] for row in Verdicts(tmp_path, "stack", "nuts")] == [0, 1, 2]


def test_chains_come_back_as_they_were(tmp_path: Path):
    drawn = Drawn(["a", "b"], np.array([[1.5, -2.0], [0.25, 1e-9]]), 1.0, 2.0, 3.0, 4, 0.5, 0, "none")
    drawn.save(chain_file(tmp_path, "stack", "nuts", 0))
    (chain,) = chains(tmp_path, "stack", "nuts")
    assert chain.choices(1) == {"a": 0.25, "b": 1e-9}
    assert not list(tmp_path.glob("*.part"))


@nw.model
def bounded() -> float:
    return nw.uniform(2.0, 5.0) + nw.exponential(2.0) + nw.gaussian(0.0, 1.0)


def drawn_by(original: bool) -> np.ndarray:
    density = nw.log_density(nw.run(bounded, seed=1).best)
    units = Units(density, density.start) if original else None
    steps = np.ones(3)
    if not original:
        _, steps, _ = walk(density, density.start, units, 3000, 1, lambda *_: None)
    kept: list[np.ndarray] = []
    walk(density, density.start, units, 30_000, 2, keeper(kept, 15), steps)
    return np.array([list(density.values(x).values()) for x in kept])


def test_the_chain_that_is_put_right_draws_from_the_model():
    draws = drawn_by(original=False)
    assert effective(draws[None, :, :]) > 300
    assert draws.mean(axis=0) == pytest.approx([3.5, 0.5, 0.0], abs=0.25)
    assert draws.std(axis=0) == pytest.approx([3.0 / 12**0.5, 0.5, 1.0], rel=0.2)


def test_the_original_chain_draws_from_another():
    # The Jacobian of y in (a, b), (y - a)(b - y), and that of y above 0, y, are in its density.
    draws = drawn_by(original=True)
    assert effective(draws[None, :, :]) > 300
    assert draws.mean(axis=0) == pytest.approx([3.5, 1.0, 0.0], abs=0.25)
    assert draws.std(axis=0) == pytest.approx([3.0 / 20**0.5, 0.5**0.5, 1.0], rel=0.15)


def test_units_are_those_of_the_choices():
    density = nw.log_density(nw.run(bounded, seed=1).best)
    units = Units(density, density.start)
    values = list(density.values(density.start).values())
    for choice, value in zip(density.choices, values, strict=True):
        x = float(density.start[choice.first])
        assert units.value(choice.first, x) == pytest.approx(value, rel=1e-12)
        assert units.coordinate(choice.first, value) == pytest.approx(x, rel=1e-9)
