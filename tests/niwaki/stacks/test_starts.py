"""Claim: a start balances within the tolerance and passes both judges.

Seeds are fixed. `benches/stacks.py` measures the rates of all kinds.
"""

from __future__ import annotations

from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki import stacks
from niwaki.stacks import Structure, balanced, simulated, start

pytest.importorskip("mujoco")


def worst(choices: dict[str, float]) -> float:
    """How many widths the worst balance is off."""
    return nw.residuals(stacks.cut_stack, choices=choices)[0].widths


def test_a_start_balances_and_stands(tmp_path: Path) -> None:
    density, x = start(stacks.cut_stack, seed=2, width=0.01)
    choices = density.values(x)
    assert worst(choices) < 3.0
    sample = nw.run(stacks.cut_stack, choices=choices).best
    structure = Structure.of(sample)
    assert balanced(structure).holds
    assert simulated(structure, seconds=1.0).stands
    # The same blocks, the upper half pushed by three quarters of what holds it, lean on nothing.
    pushed = structure.corners.copy()
    pushed[3:, :, 0] += 0.05
    assert not simulated(Structure(pushed, structure.touches, 0.3, structure.downs, (6,)), seconds=1.0).stands
    file = sample.scene.export(tmp_path / "tower.glb")
    assert Path(file).read_bytes()[:4] == b"glTF"


def test_a_draw_of_the_prior_does_not() -> None:
    run = nw.run_python(stacks.cut_stack, seed=2)
    assert worst(run.choices) > 100.0
    assert not balanced(Structure.of(run)).holds


def test_the_same_seed_starts_at_the_same_place() -> None:
    (_, first), (_, second) = (start(stacks.cut_stack, seed=3, width=0.1) for _ in range(2))
    np.testing.assert_array_equal(first, second)
