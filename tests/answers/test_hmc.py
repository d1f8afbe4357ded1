"""Claim: chains that follow the gradient of a program draw from the program's distribution.

Means of conjugate models and of models whose moments are sums over a grid, bounded, simplex and hierarchical ones among
them, lie within 4.5 standard errors (the errors by the chains' effective sample sizes). A mean of a true sampler falls
outside once in 150,000; about thirty means are judged for each method, so a false alarm comes once in 2,500 sets of
seeds. The seeds are fixed. R-hat stays below 1.1, so that these errors mean something. A mutant without the Jacobian of
its bounds must fall outside.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import diagnostics, kernels, model
from niwaki.gallery.point import point
from niwaki.result.hmc import GradientWarning
from niwaki.words import Bernoulli, Gaussian

METHODS = {
    "hmc": nw.hmc(draws=1500, steps=12, jitter=0.5, warmup=600, chains=4, target_accept=0.85),
    "nuts": nw.nuts(draws=1500, warmup=600, chains=4),
    "dense": nw.nuts(draws=1500, warmup=600, chains=2, metric="dense"),
}


@model
def mean_of_normals(data):
    mean = nw.gaussian(1.0, 2.0)
    for y in data:
        nw.observe(Gaussian(mean, 0.7), y)
    return mean


@model
def share_of_coins(data):
    share = nw.beta(2.0, 3.0)
    for y in data:
        nw.observe(Bernoulli(share), y)
    return share


@model
def tilted():
    x = nw.uniform(-1.0, 2.0)
    nw.factor(-3.0 * x)
    return x


@model
def coins_without_jacobian(data):
    share = nw.beta(2.0, 3.0)
    for y in data:
        nw.observe(Bernoulli(share), y)
    # What a density that forgets the slope of the logistic would say.
    nw.factor(-math.log(share) - math.log(1.0 - share))
    return share


@model
def shares(counts):
    share = nw.dirichlet([1.0, 2.0, 3.0])
    for i in range(3):
        nw.factor(counts[i] * math.log(share[i]))
    return share


@model
def groups(data):
    spread = nw.gamma(3.0, 0.5)
    mean = nw.gaussian(0.0, 2.0)
    for i in range(len(data)):
        group = mean + spread * nw.gaussian(0.0, 1.0)
        nw.observe(Gaussian(group, 0.8), data[i])
    return mean


@model
def bound_by_branch():
    side = nw.gaussian(0.0, 1.0)
    low = 1.0 if side > 0 else -2.0
    x = nw.uniform(low, low + 2.0)
    nw.factor(-x)
    return x


NORMALS = [0.3, 1.9, 0.8, 1.4, 2.2]
COINS = [True, False, True, True, False, True, True]
COUNTS = [4.0, 1.0, 7.0]
GROUPS = [1.8, -0.4, 0.9, 2.6]


def over(grid: np.ndarray, log: np.ndarray, *values: np.ndarray) -> list[float]:
    """Means over a grid with these log densities."""
    weight = np.exp(log - log.max())
    weight /= weight.sum()
    return [float((weight * value).sum()) for value in (values or (grid,))]


def normal_answers() -> dict[str, float]:
    precision = 1 / 4 + len(NORMALS) / 0.49
    mean = (1.0 / 4 + sum(NORMALS) / 0.49) / precision
    return {"mean": mean, "mean^2": mean**2 + 1 / precision}


def coin_answers() -> dict[str, float]:
    a, b = 2.0 + sum(COINS), 3.0 + len(COINS) - sum(COINS)
    mean = a / (a + b)
    return {"share": mean, "share^2": mean**2 + a * b / ((a + b) ** 2 * (a + b + 1))}


def tilted_answers() -> dict[str, float]:
    grid = np.linspace(-1, 2, 300_001)[:-1] + 0.5e-5
    mean, square = over(grid, -3 * grid, grid, grid**2)
    return {"x": mean, "x^2": square}


def share_answers() -> dict[str, float]:
    a = np.array([1.0, 2.0, 3.0]) + COUNTS
    mean = a / a.sum()
    square = a * (a + 1) / (a.sum() * (a.sum() + 1))
    return {f"share[{i}]": mean[i] for i in range(3)} | {f"share[{i}]^2": square[i] for i in range(3)}


def group_answers() -> dict[str, float]:
    """The spread by a grid; given it, all is normal."""
    y, spread = np.array(GROUPS), np.linspace(0.002, 12, 6000)
    log, means = np.empty_like(spread), np.empty_like(spread)
    for k, s in enumerate(spread):
        cover = np.full((4, 4), 4.0) + np.eye(4) * (s * s + 0.64)
        solved = np.linalg.solve(cover, y)
        log[k] = 2 * math.log(s) - 2 * s - 0.5 * np.linalg.slogdet(cover)[1] - 0.5 * y @ solved
        means[k] = 4.0 * solved.sum()
    mean, scale = over(spread, log, means, spread)
    return {"mean": mean, "spread": scale}


def branch_answers() -> dict[str, float]:
    grid = np.linspace(0, 2, 200_001)[:-1] + 0.5e-5
    high, low = np.exp(-(grid + 1)).mean(), np.exp(-(grid - 2)).mean()
    mean = (np.exp(-(grid + 1)) * (grid + 1)).mean() + (np.exp(-(grid - 2)) * (grid - 2)).mean()
    # Half of a normal's mean to either side.
    return {"x": mean / (high + low), "side": math.sqrt(2 / math.pi) * (high - low) / (high + low)}


def point_answers() -> dict[str, float]:
    side = np.linspace(-1.5, 1.5, 3001)
    x, y = np.meshgrid(side, side)
    log = -0.5 * ((y**4 - y**2 + x**2 - 0.25) / 0.1) ** 2
    x_mean, x_square, y_square = over(x, log, x, x * x, y * y)
    return {"x": x_mean, "x^2": x_square, "y^2": y_square}


CASES: dict[str, tuple[Any, tuple[Any, ...], Callable[[], dict[str, float]]]] = {
    "normal": (mean_of_normals, (NORMALS,), normal_answers),
    "coins": (share_of_coins, (COINS,), coin_answers),
    "tilted": (tilted, (), tilted_answers),
    "shares": (shares, (COUNTS,), share_answers),
    "groups": (groups, (GROUPS,), group_answers),
    "branch": (bound_by_branch, (), branch_answers),
    "point": (point, (0.1,), point_answers),
}


def errors(result: nw.Result, answers: dict[str, float]) -> dict[str, float]:
    """How many standard errors each mean is off."""
    z: dict[str, np.ndarray] = {}
    for path, values in result.draws.items():
        name = path.rsplit("/", 1)[-1]
        if values.ndim == 2:
            z.setdefault(name, values)
        else:
            z |= {f"{name}[{i}]": values[:, :, i] for i in range(values.shape[2])}
    off = {}
    for name, answer in answers.items():
        values = z[name.removesuffix("^2")]
        values = values**2 if name.endswith("^2") else values
        off[name] = abs(values.mean() - answer) / diagnostics.mcse_mean(values)
    return off


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("method", METHODS)
def test_means_are_those_of_the_model(case: str, method: str) -> None:
    program, args, answers = CASES[case]
    result = nw.run(program, METHODS[method], *args, seed=13)
    off = errors(result, answers())
    assert max(off.values()) < 4.5, off
    assert len(result) == 1500 * METHODS[method].chains
    assert max(s.rhat for s in result.summary()) < 1.1, result.summary()


@model
def halves():
    x = nw.gaussian(0.0, 1.0)
    if x > 0:
        z = nw.gaussian(1.0, 1.0)
        nw.factor(0.7 * z)
    return x > 0


def above(result: Any) -> tuple[float, float]:
    """The share of draws with x above zero, and how many standard errors it is off."""
    share = np.array([[sample.value for sample in draws] for draws in result.by_chain], dtype=float)
    # E[exp(0.7 z)] of a normal with mean 1 and deviation 1, beside 1.
    weight = math.exp(0.7 + 0.5 * 0.49)
    error = share.mean() - weight / (1.0 + weight)
    return share.mean(), abs(error) / diagnostics.mcse_mean(share)


@pytest.mark.parametrize("kernel", [kernels.nuts_step(), kernels.hmc_step()], ids=repr)
def test_a_structure_is_sampled_by_mh_beside_the_gradient(kernel: kernels.Kernel) -> None:
    """The advice of the warning gives the share 0.720; the gradient alone, its mutant, keeps to one side."""
    method = nw.mh(steps=12_000, warmup=2000, chains=4, thin=4, kernel=kernels.cycle(kernels.prior(), kernel))
    assert above(nw.run(halves, method, seed=3))[1] < 4.5
    with pytest.warns(GradientWarning, match="refused for structure"):
        mutant = nw.run(halves, nw.mh(steps=3000, warmup=500, chains=4, thin=4, kernel=kernel), seed=3)
    assert all(len({sample.value for sample in draws}) == 1 for draws in mutant.by_chain)


@model
def seen_at(scale):
    x = nw.gaussian(0.0, scale)
    y = nw.gaussian(x, scale)
    nw.observe(Gaussian(y, scale), scale)
    return x


SCALES = (1e-300, 1e-160, 1e-30, 1e-12, 1.0, 1e12, 1e30, 1e160, 1e300)


def off_scale(x: np.ndarray, mean: float, variance: float) -> float:
    """How many standard errors mean and square of draws (chains, draws) are off, in units of the model's scale."""
    means = ((x, mean), (x**2, mean**2 + variance))
    return max(abs(values.mean() - truth) / diagnostics.mcse_mean(values) for values, truth in means)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("method", [*METHODS, "lanes", "kernel"])
def test_a_scale_of_the_model_is_no_matter(method: str, scale: float) -> None:
    """x has mean 1/3 and variance 2/3, y twice the mean and the same variance, of a scale that computers hold.

    Four numbers in each case: a false alarm in 37,000 sets of seeds. Draws that are too narrow by a fifth, the mutant,
    are found out.
    """
    if method == "kernel":
        chain = nw.mh(steps=3000, warmup=1000, chains=4, thin=1, kernel=kernels.nuts_step())
        draws = nw.run(seen_at, chain, scale, seed=5).draws
    else:
        many = nw.hmc(draws=100, steps=8, jitter=0.5, warmup=200, chains=24)
        result = nw.run(
            seen_at, METHODS.get(method, many), scale, seed=5, threads=1 if method == "lanes" else None
        )
        draws = result.draws
        assert result.divergences.total == 0
        for row, (path, values) in zip(result.summary(), draws.items(), strict=False):
            sure = diagnostics.mcse_mean(values / scale)
            assert row.name == path and row.sd / scale == pytest.approx((values / scale).std(ddof=1))
            assert row.mcse / scale == pytest.approx(sure, rel=1e-6)
    assert len(draws) == 2
    for (path, values), mean in zip(draws.items(), (1 / 3, 2 / 3), strict=True):
        x = values / scale
        assert off_scale(x, mean, 2 / 3) < 4.5, path
        assert off_scale(0.8 * (x - x.mean()) + x.mean(), mean, 2 / 3) > 4.5, path
        assert diagnostics.rhat(x) < 1.05


def test_a_density_without_its_jacobian_is_found_out() -> None:
    result = nw.run(coins_without_jacobian, METHODS["nuts"], COINS, seed=11)
    assert max(errors(result, coin_answers()).values()) > 4.5
