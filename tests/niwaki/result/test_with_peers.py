"""Claims that need optional packages, the real ones: the emitted text gives the engine's numbers in JAX, and ArviZ
computes our figures from our draws. A skipped test names what is missing; `make bench-hmc` runs them all.
"""

from __future__ import annotations

import importlib.util
import math
import warnings
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import diagnostics, model
from niwaki.gallery.point import point


def needs(name: str) -> Any:
    missing = importlib.util.find_spec(name) is None
    return pytest.mark.skipif(missing, reason=f"{name} is not installed (extra bench-hmc)")


@model
def greenhouse() -> float:
    """Every kind of support, and functions that JAX has under other names or not at all."""
    place = nw.uniform(-2, 3)
    size = nw.gamma(2.0, 0.5)
    angle = nw.von_mises(0.3, 2.0)
    share = nw.dirichlet([1.5, 2.0, 3.0])
    heavy = nw.student_t(4.0, place, size)
    within = nw.truncated_gaussian(0.0, 1.0, -1.0, 2.0)
    nw.factor(-((place - size * math.cos(angle)) ** 2) + math.lgamma(1.0 + size))
    nw.factor(-abs(share[0] - share[1]) - max(size, place) ** 2 / 4 - math.erf(heavy))
    nw.factor(math.atan2(within, size) - math.hypot(place, within))
    return place


@needs("jax")
@pytest.mark.parametrize("seed", range(4))
def test_jax_agrees_with_the_engine_on_value_and_gradient(seed: int) -> None:
    import jax

    density = nw.log_density(nw.run(greenhouse, seed=seed).best)
    space: dict[str, Any] = {}
    exec(density.jax(), space)
    both = jax.jit(jax.value_and_grad(space["log_density"]))
    random, compared = np.random.default_rng(seed), 0
    for _ in range(20):
        x = density.start + 0.2 * random.normal(size=density.dim)
        value, gradient = (np.asarray(part) for part in both(x))
        if np.isnan(value):
            continue  # Off the recorded path, where the engine records again.
        ours, slope = density.value_and_gradient(x)
        assert np.isclose(value, ours, rtol=1e-10)
        assert np.allclose(gradient, slope, rtol=1e-8, atol=1e-8 * np.abs(slope).max())
        compared += 1
    assert compared >= 5
    # A mutant: the density of a point nearby is another one.
    assert not np.isclose(both(density.start + 1e-3)[0], density(density.start), rtol=1e-10)


@needs("arviz")
def test_arviz_takes_our_draws_and_finds_our_figures() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import arviz

        result = nw.run(point, nw.nuts(draws=500, warmup=300, chains=4), 0.1, seed=2)
        tree = result.to_arviz()
        # From 1.0 on ArviZ' own tails are those of its `ci_prob`; ours are the outer tenths, as in the paper.
    tail = arviz.ess(tree, method="tail", prob=(0.05, 0.95))
    rhat, bulk = arviz.rhat(tree), arviz.ess(tree)
    if int(arviz.__version__.split(".")[0]) >= 1:
        assert type(tree).__name__ == "DataTree"
    else:
        assert type(tree).__name__ == "InferenceData"
    assert {"energy", "diverging", "tree_depth", "n_steps", "lp"} <= set(tree["sample_stats"].data_vars)
    for name, draws in result.draws.items():
        assert tree["posterior"][name].shape == (4, 500)
        for theirs, ours in (
            (rhat, diagnostics.rhat(draws)),
            (bulk, diagnostics.ess_bulk(draws)),
            (tail, diagnostics.ess_tail(draws)),
        ):
            theirs = theirs["posterior"] if "posterior" in getattr(theirs, "children", ()) else theirs
            assert np.isclose(float(theirs[name]), ours, rtol=1e-6), name
