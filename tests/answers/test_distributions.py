"""Every family has the density, the support and the draws of SciPy.

Densities. Two log densities agree when their difference is below 1e-10 times the larger of one and their
size: near zero nats that is a relative error of 1e-10 in the density itself.

Draws. `DRAWS` draws of each case, fixed seed: Kolmogorov-Smirnov against the distribution function, or
chi-square over the values, neighbours pooled until 25 draws are expected. All cases together raise a false
alarm with probability 1e-4, so that each rejects below 1e-4 / (number of cases). Beside each case stands a
mutant, a slightly wrong distribution that the same draws and the same threshold must reject.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from niwaki import _engine
from scipy import stats

DRAWS = 20_000
SEED = 20_260


@dataclass(frozen=True)
class Case:
    """A distribution of ours, SciPy's word for it, and a wrong one.

    Attributes
    ----------
    family, params
        Ours.
    reference, mutant
        Frozen SciPy distributions (or something with their methods): the same, and one that is not.
    at
        Points at which to compare densities.
    support
        What `support` should answer.
    turn
        Applied to draws before they meet the reference (angles are taken relative to their mean).
    """

    family: str
    params: list[Any]
    reference: Any
    mutant: Any
    at: Sequence[float]
    support: tuple[str, Any, Any]
    turn: Callable[[np.ndarray], np.ndarray] = lambda x: x

    def __str__(self) -> str:
        return f"{self.family}{tuple(self.params)}"


@dataclass(frozen=True)
class Blend:
    """A mixture put together from SciPy's parts."""

    weights: Sequence[float]
    parts: Sequence[Any]

    def _sum(self, name: str, x: Any) -> Any:
        return sum(w * getattr(p, name)(x) for w, p in zip(self.weights, self.parts, strict=True))

    def logpdf(self, x: Any) -> Any:
        return np.log(self._sum("pdf", x))

    def logpmf(self, x: Any) -> Any:
        return np.log(self._sum("pmf", x))

    def pmf(self, x: Any) -> Any:
        return self._sum("pmf", x)

    def cdf(self, x: Any) -> Any:
        return self._sum("cdf", x)


def table(weights: Sequence[float]) -> Any:
    """Index k with probability proportional to `weights[k]`."""
    p = np.array(weights) / sum(weights)
    return stats.rv_discrete(values=(np.arange(len(p)), p))


def truncated(mean: float, sd: float, lo: float, hi: float) -> Any:
    return stats.truncnorm((lo - mean) / sd, (hi - mean) / sd, loc=mean, scale=sd)


def relative_angle(mean: float) -> Callable[[np.ndarray], np.ndarray]:
    return lambda x: np.angle(np.exp(1j * (x - mean)))


INF = math.inf
LINE, HALF, UNIT = ("real", -INF, INF), ("real", 0.0, INF), ("real", 0.0, 1.0)
CIRCLE = ("real", -math.pi, math.pi)
HEAVY = [-1e150, -40.0, -1.0, 0.3, 2.0, 1e4]
POSITIVE = [1e-300, 1e-5, 0.2, 1.0, 3.7, 80.0]

DISCRETE = [
    Case("bernoulli", [0.3], stats.bernoulli(0.3), stats.bernoulli(0.33), [0, 1], ("bool", False, True)),
    Case("bernoulli", [1e-3], stats.bernoulli(1e-3), stats.bernoulli(4e-3), [0, 1], ("bool", False, True)),
    Case(
        "categorical",
        [[2, 0, 1.5, 6]],
        table([2, 0, 1.5, 6]),
        table([2.3, 0, 1.2, 6]),
        range(4),
        ("int", 0, 3),
    ),
    Case(
        "discrete_uniform", [-3, 8], stats.randint(-3, 9), stats.randint(-3, 10), range(-3, 9), ("int", -3, 8)
    ),
    Case("poisson", [0.7], stats.poisson(0.7), stats.poisson(0.77), range(12), ("int", 0, None)),
    Case("poisson", [37.5], stats.poisson(37.5), stats.poisson(38.0), [0, 3, 37, 38, 150], ("int", 0, None)),
    Case("poisson", [4e3], stats.poisson(4e3), stats.poisson(4.012e3), [3500, 4000, 4100], ("int", 0, None)),
    Case("binomial", [9, 0.2], stats.binom(9, 0.2), stats.binom(9, 0.22), range(10), ("int", 0, 9)),
    Case(
        "binomial",
        [700, 0.6],
        stats.binom(700, 0.6),
        stats.binom(700, 0.605),
        [0, 300, 420, 700],
        ("int", 0, 700),
    ),
    Case(
        "geometric",
        [0.15],
        stats.geom(0.15, loc=-1),
        stats.geom(0.16, loc=-1),
        [0, 1, 7, 300],
        ("int", 0, None),
    ),
    Case(
        "mixture",
        [[1.0, 3.0], [("poisson", [2.0]), ("discrete_uniform", [4, 9])]],
        Blend([0.25, 0.75], [stats.poisson(2.0), stats.randint(4, 10)]),
        Blend([0.3, 0.7], [stats.poisson(2.0), stats.randint(4, 10)]),
        range(20),
        ("int", 0, None),
    ),
]

CONTINUOUS = [
    Case("uniform", [-2.0, 3], stats.uniform(-2, 5), stats.uniform(-2, 5.2), [-2, 0, 3], ("real", -2.0, 3.0)),
    Case("gaussian", [1.5, 2], stats.norm(1.5, 2), stats.norm(1.5, 2.2), [-70, 0, 1.5, 9], LINE),
    Case(
        "log_normal",
        [0.4, 0.9],
        stats.lognorm(0.9, scale=math.exp(0.4)),
        stats.lognorm(1.0, scale=1.5),
        POSITIVE,
        HALF,
    ),
    Case("gamma", [0.02, 3.0], stats.gamma(0.02, scale=3), stats.gamma(0.03, scale=3), POSITIVE, HALF),
    Case("gamma", [4.5, 0.5], stats.gamma(4.5, scale=0.5), stats.gamma(4.8, scale=0.5), POSITIVE, HALF),
    Case("gamma", [900.0, 1.0], stats.gamma(900), stats.gamma(903), [700.0, 899.0, 1100.0], HALF),
    Case(
        "inverse_gamma",
        [2.5, 1.5],
        stats.invgamma(2.5, scale=1.5),
        stats.invgamma(2.5, scale=1.6),
        POSITIVE[1:],
        HALF,
    ),
    Case("beta", [0.4, 0.3], stats.beta(0.4, 0.3), stats.beta(0.44, 0.3), [1e-9, 0.2, 0.5, 0.999], UNIT),
    Case("beta", [3.0, 70.0], stats.beta(3, 70), stats.beta(3.1, 70), [1e-9, 0.03, 0.5, 0.999], UNIT),
    Case(
        "exponential", [2.5], stats.expon(scale=1 / 2.5), stats.expon(scale=1 / 2.3), [0.0, *POSITIVE], HALF
    ),
    Case("laplace", [1.0, 0.6], stats.laplace(1, 0.6), stats.laplace(1, 0.66), [-40, 1, 1.1, 9], LINE),
    Case("cauchy", [-1.0, 0.5], stats.cauchy(-1, 0.5), stats.cauchy(-1, 0.56), HEAVY, LINE),
    Case("student_t", [2.5, 1.0, 3.0], stats.t(2.5, 1, 3), stats.t(2.5, 1, 3.3), HEAVY[1:], LINE),
    Case("student_t", [80.0, 0.0, 1.0], stats.t(80), stats.t(80, scale=1.1), [-7.0, 0.0, 2.0], LINE),
    Case(
        "von_mises",
        [3.0, 1.7],
        stats.vonmises(1.7),
        stats.vonmises(2.0),
        [-3.1, 0.0, 3.0],
        CIRCLE,
        relative_angle(3.0),
    ),
    Case(
        "von_mises",
        [0.5, 0.01],
        stats.vonmises(0.01),
        stats.vonmises(0.2),
        [-3.1, 0.0, 3.0],
        CIRCLE,
        relative_angle(0.5),
    ),
    Case(
        "von_mises",
        [-2.0, 300.0],
        stats.vonmises(300.0),
        stats.vonmises(360.0),
        [-3.1, -2.0, 1.0],
        CIRCLE,
        relative_angle(-2.0),
    ),
    Case(
        "truncated_gaussian",
        [1.0, 2.0, -1.0, 6.0],
        truncated(1, 2, -1, 6),
        truncated(1, 2.4, -1, 6),
        [-1.0, 0.0, 6.0],
        ("real", -1.0, 6.0),
    ),
    Case(
        "truncated_gaussian",
        [0.0, 1.0, 7.0, 9.0],
        truncated(0, 1, 7, 9),
        truncated(0, 1.05, 7, 9),
        [7.0, 7.3, 9.0],
        ("real", 7.0, 9.0),
    ),
    Case(
        "truncated_gaussian",
        [0.0, 1.0, -31.0, -30.0],
        truncated(0, 1, -31, -30),
        truncated(0, 1.05, -31, -30),
        [-31.0, -30.1, -30.0],
        ("real", -31.0, -30.0),
    ),
    Case(
        "truncated_gaussian",
        [0.0, 1.0, 0.2, 0.9],
        truncated(0, 1, 0.2, 0.9),
        truncated(0, 0.8, 0.2, 0.9),
        [0.2, 0.5, 0.9],
        ("real", 0.2, 0.9),
    ),
    Case(
        "mixture",
        [[0.3, 0.7], [("gaussian", [-1.0, 0.5]), ("student_t", [4.0, 2.0, 1.0])]],
        Blend([0.3, 0.7], [stats.norm(-1, 0.5), stats.t(4, 2, 1)]),
        Blend([0.33, 0.67], [stats.norm(-1, 0.5), stats.t(4, 2, 1)]),
        [-9.0, -1.0, 0.5, 30.0],
        LINE,
    ),
]

CONCENTRATIONS = [0.6, 2.0, 5.0]
MEAN = [1.0, -2.0, 0.5]
SDS = [0.5, 2.0, 1.5]
COVARIANCE = [[2.0, 0.6, -0.3], [0.6, 1.0, 0.2], [-0.3, 0.2, 0.5]]

# Three sequential coordinates of the Dirichlet and four directions of the Gaussian vector: 6 more tests.
SAMPLING_TESTS = len(DISCRETE) + len(CONTINUOUS) + 2 + 4
ALARM = 1e-4 / SAMPLING_TESTS


def agree(ours: float, theirs: float) -> bool:
    if math.isinf(theirs):
        return ours == theirs
    return abs(ours - theirs) <= 1e-10 * max(1.0, abs(theirs))


def draws(case: Case) -> np.ndarray:
    return case.turn(np.array(_engine.draw(case.family, case.params, SEED, DRAWS), dtype=float))


def chi_square_p(values: np.ndarray, reference: Any) -> float:
    """P-value of integer draws, the tails pooled with their neighbours until 25 are expected."""
    lo, hi = int(values.min()) - 1, int(values.max()) + 1
    expected, seen, cells = 0.0, 0.0, []
    expected = DRAWS * float(reference.cdf(lo - 1))
    for k in range(lo, hi + 1):
        expected += DRAWS * float(reference.pmf(k))
        seen += float(np.count_nonzero(values == k))
        if expected >= 25:
            cells.append([seen, expected])
            expected, seen = 0.0, 0.0
    cells[-1][0] += seen
    cells[-1][1] += DRAWS - sum(cell[1] for cell in cells)
    counts = np.array(cells)
    statistic = float(((counts[:, 0] - counts[:, 1]) ** 2 / counts[:, 1]).sum())
    return float(stats.chi2.sf(statistic, max(len(cells) - 1, 1)))


def kolmogorov_p(values: np.ndarray, reference: Any) -> float:
    return float(stats.kstest(values, reference.cdf).pvalue)


def test_every_family_is_in_the_tables() -> None:
    lists = {
        "diagonal_gaussian",
        "dirichlet",
        "multinomial",
        "multivariate_bernoulli",
        "multivariate_gaussian",
    }
    tested = {case.family for case in DISCRETE + CONTINUOUS} | lists | {"delta"}
    assert tested == set(_engine.FAMILIES)


@pytest.mark.parametrize("case", DISCRETE, ids=str)
def test_discrete_densities(case: Case) -> None:
    for x in case.at:
        assert agree(_engine.log_density(case.family, case.params, x), float(case.reference.logpmf(x))), x
    assert _engine.log_density(case.family, case.params, -100) == -INF
    assert _engine.log_density(case.family, case.params, 0.5) == -INF


@pytest.mark.parametrize("case", CONTINUOUS, ids=str)
def test_continuous_densities(case: Case) -> None:
    for x in case.at:
        theirs = float(case.reference.logpdf(case.turn(np.array(float(x)))))
        assert agree(_engine.log_density(case.family, case.params, x), theirs), x
    lo, hi = case.support[1:]
    for outside in (np.nextafter(lo, -INF), np.nextafter(hi, INF), -INF, INF, math.nan):
        if not lo < outside < hi:
            assert _engine.log_density(case.family, case.params, float(outside)) == -INF, outside


@pytest.mark.parametrize("case", DISCRETE + CONTINUOUS, ids=str)
def test_supports(case: Case) -> None:
    assert _engine.support(case.family, case.params) == case.support
    values = _engine.draw(case.family, case.params, SEED + 1, 500)
    assert all(math.isfinite(_engine.log_density(case.family, case.params, x)) for x in values)


@pytest.mark.parametrize("case", DISCRETE, ids=str)
def test_discrete_draws(case: Case) -> None:
    values = draws(case)
    assert chi_square_p(values, case.reference) > ALARM
    assert chi_square_p(values, case.mutant) < ALARM


@pytest.mark.parametrize("case", CONTINUOUS, ids=str)
def test_continuous_draws(case: Case) -> None:
    values = draws(case)
    assert kolmogorov_p(values, case.reference) > ALARM
    assert kolmogorov_p(values, case.mutant) < ALARM


def test_dirichlet() -> None:
    reference = stats.dirichlet(CONCENTRATIONS)
    for x in ([0.2, 0.3, 0.5], [1e-7, 0.9 - 1e-7, 0.1]):
        assert agree(_engine.log_density("dirichlet", [CONCENTRATIONS], x), float(reference.logpdf(x)))
    assert _engine.log_density("dirichlet", [CONCENTRATIONS], [0.2, 0.3, 0.6]) == -INF
    assert _engine.support("dirichlet", [CONCENTRATIONS]) == ("simplex", 3, 3)
    values = np.array(_engine.draw("dirichlet", [np.array(CONCENTRATIONS)], SEED, DRAWS))
    assert np.abs(values.sum(axis=1) - 1).max() < 1e-14
    # One entry after another, each relative to what the earlier ones left (stick breaking), is a beta.
    first, second = values[:, 0], values[:, 1] / (1 - values[:, 0])
    assert kolmogorov_p(first, stats.beta(0.6, 7.0)) > ALARM
    assert kolmogorov_p(second, stats.beta(2.0, 5.0)) > ALARM
    assert kolmogorov_p(first, stats.beta(0.6, 8.5)) < ALARM
    assert kolmogorov_p(second, stats.beta(2.0, 5.7)) < ALARM


def test_multivariate_gaussian() -> None:
    params = [MEAN, COVARIANCE]
    reference = stats.multivariate_normal(MEAN, COVARIANCE)
    for x in ([0.0, 0.0, 0.0], [1.0, -2.0, 0.5], [30.0, -9.0, 4.0]):
        assert agree(_engine.log_density("multivariate_gaussian", params, x), float(reference.logpdf(x)))
    assert _engine.log_density("multivariate_gaussian", params, [0.0, 0.0]) == -INF
    assert _engine.support("multivariate_gaussian", params) == ("vector", 3, 3)
    values = np.array(
        _engine.draw("multivariate_gaussian", [np.array(MEAN), np.array(COVARIANCE)], SEED, DRAWS)
    )

    def directions(covariance: np.ndarray) -> list[float]:
        white = np.linalg.solve(np.linalg.cholesky(covariance), (values - MEAN).T)
        return [kolmogorov_p(z, stats.norm()) for z in (*white, white.sum(axis=0) / math.sqrt(3))]

    assert min(directions(np.array(COVARIANCE))) > ALARM
    assert min(directions(np.diag(np.diag(COVARIANCE)))) < ALARM


def test_diagonal_gaussian() -> None:
    params = [MEAN, SDS]
    reference = stats.multivariate_normal(MEAN, np.diag(np.square(SDS)))
    for x in ([0.0, 0.0, 0.0], [1.0, -2.0, 0.5], [30.0, -9.0, 4.0]):
        assert agree(_engine.log_density("diagonal_gaussian", params, x), float(reference.logpdf(x)))
    assert _engine.log_density("diagonal_gaussian", params, [0.0, 0.0]) == -INF
    assert _engine.support("diagonal_gaussian", params) == ("vector", 3, 3)
    assert _engine.enumerate_support("diagonal_gaussian", params) is None
    values = np.array(_engine.draw("diagonal_gaussian", [np.array(MEAN), np.array(SDS)], SEED, DRAWS))

    def directions(sds: np.ndarray) -> list[float]:
        white = ((values - MEAN) / sds).T
        return [kolmogorov_p(z, stats.norm()) for z in (*white, white.sum(axis=0) / math.sqrt(3))]

    assert min(directions(np.array(SDS))) > ALARM
    assert min(directions(np.array(SDS) * [1.0, 1.1, 1.0])) < ALARM


@pytest.mark.parametrize(
    ("n", "weights"), [(9, [1.0, 2.0, 0.5]), (40, [0.1, 0.0, 0.2, 0.7]), (0, [1.0, 1.0]), (3, [2.0])]
)
def test_multinomial(n: int, weights: list[float]) -> None:
    shares = np.array(weights) / np.sum(weights)
    reference = stats.multinomial(n, shares)
    values = np.array(_engine.draw("multinomial", [n, np.array(weights)], SEED, DRAWS))
    assert values.dtype.kind == "i"
    assert (values.sum(axis=1) == n).all()
    for x in values[:50]:
        assert agree(
            _engine.log_density("multinomial", [n, weights], list(map(int, x))), float(reference.logpmf(x))
        )
    assert _engine.log_density("multinomial", [n, weights], [n + 1] + [0] * (len(weights) - 1)) == -INF
    assert _engine.log_density("multinomial", [n, weights], [0.5] * len(weights)) == -INF
    assert _engine.support("multinomial", [n, weights]) == ("counts", len(weights), len(weights))
    listed = _engine.enumerate_support("multinomial", [n, weights])
    assert listed is not None
    total = math.fsum(math.exp(_engine.log_density("multinomial", [n, weights], x)) for x in listed)
    assert abs(total - 1) < 1e-12
    assert len({tuple(x) for x in listed}) == len(listed)
    # The first count is a binomial, and of the rest the second one, too.
    if n > 3:
        rest = 1 - shares[0]
        assert chi_square_p(values[:, 0], stats.binom(n, shares[0])) > ALARM
        assert chi_square_p(values[:, 0], stats.binom(n, shares[0] * 1.05)) < ALARM
        of_rest = values[values[:, 0] == values[0, 0]]
        mean, share = of_rest[:, -1].mean(), shares[-1] / rest
        trials = n - values[0, 0]
        error = math.sqrt(trials * share * (1 - share) / len(of_rest))
        assert abs(mean - trials * share) < 5 * error


def test_multivariate_bernoulli() -> None:
    ps = [0.2, 0.7, 1.0, 0.5]
    values = _engine.draw("multivariate_bernoulli", [np.array(ps)], SEED, DRAWS)
    assert all(type(x) is bool for x in values[0])
    seen = np.array(values)
    assert seen[:, 2].all()
    # Each is a flip, and so is the agreement of two: 5 standard errors, once in 1.7 million.
    for column, p in (
        (seen[:, 0], 0.2),
        (seen[:, 1], 0.7),
        (seen[:, 0] == seen[:, 1], 0.2 * 0.7 + 0.8 * 0.3),
    ):
        assert abs(column.mean() - p) < 5 * math.sqrt(p * (1 - p) / DRAWS)
        assert abs(column.mean() - p - 0.05) > 5 * math.sqrt(p * (1 - p) / DRAWS)
    log_density = _engine.log_density("multivariate_bernoulli", [ps], [True, False, True, True])
    assert agree(log_density, math.log(0.2 * 0.3 * 0.5))
    assert _engine.log_density("multivariate_bernoulli", [ps], [1, 0, 1, 1]) == log_density
    assert _engine.log_density("multivariate_bernoulli", [ps], [True, False, True]) == -INF
    listed = _engine.enumerate_support("multivariate_bernoulli", [ps])
    assert listed is not None
    assert len(listed) == 8
    total = math.fsum(math.exp(_engine.log_density("multivariate_bernoulli", [ps], x)) for x in listed)
    assert abs(total - 1) < 1e-12
    assert _engine.support("multivariate_bernoulli", [ps]) == ("truths", 4, 4)


def test_delta() -> None:
    for value in (True, 3, 0.25, [1.0, 2.0]):
        assert _engine.draw("delta", [value], SEED, 2) == [value, value]
        assert _engine.log_density("delta", [value], value) == 0.0
        assert _engine.enumerate_support("delta", [value]) == [value]
        assert _engine.log_density("delta", [value], 7.5) == -INF
    assert type(_engine.draw("delta", [True], SEED, 1)[0]) is bool
    assert _engine.support("delta", [0.25]) == ("real", 0.25, 0.25)


@pytest.mark.parametrize("case", DISCRETE, ids=str)
def test_listed_values_have_all_the_probability(case: Case) -> None:
    values = _engine.enumerate_support(case.family, case.params)
    if case.support[2] is None:
        assert values is None
        return
    total = math.fsum(math.exp(_engine.log_density(case.family, case.params, x)) for x in values)
    assert abs(total - 1) < 1e-12
    assert len(set(values)) == len(values)
    assert all(math.isfinite(_engine.log_density(case.family, case.params, x)) for x in values)


def test_large_counts_and_degrees_of_freedom_keep_their_digits() -> None:
    # From Stirling's series and the Gaussian limit; SciPy itself loses digits here.
    assert agree(
        _engine.log_density("poisson", [1e12], 10**12), -0.5 * math.log(2 * math.pi * 1e12) - 1e-12 / 12
    )
    assert agree(_engine.log_density("student_t", [1e14, 0, 1], 1.0), float(stats.norm.logpdf(1.0)))


def test_a_draw_is_a_function_of_its_coordinates() -> None:
    draw = _engine.draw("gaussian", [0, 1], 5, 4)
    assert draw == [_engine.draw_at("gaussian", [0, 1], 5, k, 0, 0) for k in range(4)]
    home = (5, 1, 2**100 + 7, 3)
    seen = {_engine.draw_at("gaussian", [0, 1], *home)}
    for k, other in enumerate((6, 2, 7, 4)):
        seen.add(_engine.draw_at("gaussian", [0, 1], *home[:k], other, *home[k + 1 :]))
    assert len(seen) == 5
    assert _engine.draw_at("gaussian", [0, 1], *home) in seen


@pytest.mark.parametrize(
    ("family", "params", "parameter", "text"),
    [
        ("gaussian", [0, -1.0], "sd", "-1.0"),
        ("gaussian", [math.nan, 1.0], "mean", "nan"),
        ("gaussian", [0.0, math.inf], "sd", "inf"),
        ("bernoulli", [1.5], "p", "1.5"),
        ("uniform", [2.0, 2.0], "hi", "2.0"),
        ("discrete_uniform", [2, 1], "hi", "1"),
        ("discrete_uniform", [0, 1.5], "hi", "1.5"),
        ("categorical", [[0.0, 0.0]], "weights", "[0.0, 0.0]"),
        ("categorical", [[]], "weights", "[]"),
        ("geometric", [0.0], "p", "0.0"),
        ("truncated_gaussian", [0, 1, 3, 2], "hi", "2"),
        ("dirichlet", [[1.0, 0.0]], "concentrations", "[1.0, 0.0]"),
        ("multivariate_gaussian", [[0, 0], [[1, 2], [2, 1]]], "covariance", "[[1.0, 2.0], [2.0, 1.0]]"),
        ("diagonal_gaussian", [[0.0, 1.0], [1.0, 0.0]], "sd", "[1.0, 0.0]"),
        ("diagonal_gaussian", [[0.0, 1.0], [1.0]], "sd", "[1.0]"),
        ("multinomial", [-1, [1.0, 1.0]], "n", "-1"),
        ("multinomial", [2, [0.0, 0.0]], "weights", "[0.0, 0.0]"),
        ("multivariate_bernoulli", [[0.5, 1.5]], "ps", "[0.5, 1.5]"),
        ("mixture", [[1.0], [("gaussian", [0, 1]), ("gaussian", [0, 1])]], "components", "2 distributions"),
        ("beta", [1.0], "b", "missing"),
    ],
)
def test_bad_parameters_give_an_error_with_the_cause(
    family: str, params: list[Any], parameter: str, text: str
) -> None:
    with pytest.raises(_engine.BadParameter) as caught:
        _engine.draw(family, params, 1, 1)
    error = caught.value
    assert isinstance(error, ValueError)
    assert (error.family, error.parameter, error.found) == (family, parameter, text)
    assert str(error) == f"`{parameter}` of {family} is {text}, expected {error.expected}"


def test_what_is_no_parameter_at_all_is_a_type_error() -> None:
    for params in (["one", 1.0], [None, 1.0], [{}, 1.0, object()]):
        with pytest.raises((TypeError, _engine.BadParameter)):
            _engine.draw("gaussian", params, 1, 1)
    with pytest.raises(ValueError, match="no distribution `normal`"):
        _engine.draw("normal", [0, 1], 1, 1)
