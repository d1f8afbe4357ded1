"""The claim: `log_density` is the model's own log joint over coordinates, its gradient is the slope, and the JAX text
gives the same; what has no gradient is refused with the reason."""

from __future__ import annotations

import math
import sys
import types
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import model


@model
def garden() -> float:
    place = nw.uniform(-2, 3)
    size = nw.gamma(2.0, 0.5)
    angle = nw.von_mises(0.3, 2.0)
    share = nw.dirichlet([1.5, 2.0, 3.0])
    tall = nw.flip(0.5)
    nw.factor(-((place - size * math.cos(angle)) ** 2))
    nw.factor(-abs(share[0] - share[1]) - max(size, place) ** 2 / 4)
    if place > 0 or tall:
        nw.factor(-place)
    return place


def differences(f: Any, x: np.ndarray) -> np.ndarray:
    """Central differences with one step of Richardson's extrapolation."""

    def central(k: int, h: float) -> float:
        step = np.zeros_like(x)
        step[k] = h
        return (f(x + step) - f(x - step)) / (2 * h)

    return np.array([(4 * central(k, 5e-4) - central(k, 1e-3)) / 3 for k in range(len(x))])


@pytest.mark.parametrize("seed", range(8))
def test_the_gradient_is_the_slope_before_and_after_machine_code(seed: int) -> None:
    density = nw.log_density(nw.run(garden, seed=seed).best)
    assert density.dim == 5
    assert [c.transform for c in density.choices] == ["between", "above", "circle", "simplex"]
    value, gradient = density.value_and_gradient(density.start)
    assert np.allclose(gradient, differences(density, density.start), rtol=1e-6, atol=1e-6)
    assert density.compile()
    again, by_code = density.value_and_gradient(density.start)
    assert np.isclose(value, again, rtol=1e-12)
    assert np.allclose(gradient, by_code, rtol=1e-11, atol=1e-11)


def test_values_come_back_and_the_jacobian_is_of_a_uniform() -> None:
    @model
    def one() -> float:
        return nw.uniform(2, 6)

    sample = nw.run(one, seed=3).best
    density = nw.log_density(sample)
    (name,) = sample.choices
    assert np.isclose(density.values(density.start)[name], sample.choices[name], rtol=1e-12)
    assert density.values(np.zeros(1))[name] == 4.0
    # The density of a uniform, 1/4, times the slope of the transform at its middle, 4/4.
    assert np.isclose(density(np.zeros(1)), np.log(0.25 * 1.0))


def test_values_follow_by_the_path_that_the_point_is_on() -> None:
    @model
    def step() -> float:
        side = nw.gaussian(0, 1)
        low = 1.0 if side > 0 else -2.0
        return nw.uniform(low, low + 2.0)

    density = nw.log_density(nw.run(step, seed=1).best)
    for side, middle in ((0.5, 2.0), (-0.5, -1.0), (0.7, 2.0)):
        assert list(density.values([side, 0.0]).values()) == [side, middle]
    assert density.recordings <= 3


def shim() -> dict[str, types.ModuleType]:
    """NumPy under the names of JAX, with what the text of the test's model needs of its special functions."""
    jax, special = types.ModuleType("jax"), types.ModuleType("jax.scipy.special")
    jax.config = types.SimpleNamespace(update=lambda *_: None)  # type: ignore[attr-defined]
    scipy = types.ModuleType("jax.scipy")
    jax.numpy, jax.scipy, scipy.special = np, scipy, special  # type: ignore[attr-defined]
    return {"jax": jax, "jax.numpy": np, "jax.scipy": scipy, "jax.scipy.special": special}


def test_the_text_for_jax_gives_the_same_and_nan_off_its_path(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, module in shim().items():
        monkeypatch.setitem(sys.modules, name, module)
    density = nw.log_density(nw.run(garden, seed=1).best)
    space: dict[str, Any] = {}
    exec(density.jax(), space)
    assert np.isclose(space["log_density"](density.start), density(density.start), rtol=1e-12)

    @model
    def corner() -> float:
        x = nw.gaussian(0, 1)
        nw.factor(-x if x > 0 else 3 * x)
        return x

    density = nw.log_density(nw.run(corner, seed=1).best)
    exec(density.jax(), space)
    inside = np.isfinite([space["log_density"](np.array([x])) for x in (-0.5, 0.5)])
    assert inside.sum() == 1
    # The engine's own density holds on both sides: it runs the model again.
    assert np.isfinite([density([-0.5]), density([0.5])]).all()
    assert density.recordings == 2


def test_what_has_no_gradient_is_refused_with_the_reason() -> None:
    @model
    def coins() -> bool:
        return nw.flip(0.5)

    with pytest.raises(nw.InputError, match="no continuous choices"):
        nw.log_density(nw.run(coins, seed=1).best)

    @model
    def words() -> str:
        x = nw.gaussian(0, 1)
        return f"{x:.2f}"

    with pytest.raises(nw.ModelFault, match="no derivative") as error:
        nw.log_density(nw.run(words, seed=1).best)
    assert "x:.2f" in error.value.render()

    density = nw.log_density(nw.run(garden, seed=1).best)
    with pytest.raises(nw.InputError, match="coordinates"):
        density([1.0, 2.0])
