"""Claim: bounds, moments and evidence of variational inference are those of the model, or Pareto's k warns.

Of conjugate models the evidence, the best bound of each family and the moments are known in closed form. Estimates
by weight lie within 4.5 standard errors of them, the errors by the weights themselves: once in 150,000 a true
estimate does not, and about fifteen are judged. Where the family has the posterior among its members, the bound is
the evidence, without noise.
"""

from __future__ import annotations

import math
import warnings

import niwaki as nw
import numpy as np
import pytest
from conjugate_line import X, Y, line, line_answers
from niwaki import model
from niwaki.errors import InputError
from niwaki.result.hmc import GradientWarning
from niwaki.words import Bernoulli, Poisson, VonMises

COINS = [True, False, True, True, False, True, True]


@model
def share_of_coins(data):
    share = nw.beta(2.0, 3.0)
    for y in data:
        nw.observe(Bernoulli(share), y)
    return share


@model
def funnel():
    v = nw.gaussian(0.0, 3.0)
    for _i in range(8):
        nw.gaussian(0.0, math.exp(0.5 * v))
    return v


@model
def two_modes():
    x = nw.gaussian(0.0, 3.0)
    nw.factor(-2.0 * (x * x - 4.0) ** 2)
    return x


@model
def rooms():
    size = nw.gaussian(0.0, 1.0)
    if size > 0.5:
        nw.gaussian(0.0, 1.0)
    return size


@model
def counted():
    rate = nw.gamma(2.0, 1.0)
    return nw.sample(Poisson(rate))


@model
def walled():
    x = nw.gaussian(0.0, 1.0)
    nw.condition(x > -2.5)
    return x


def weighted(result: nw.Result, values: np.ndarray) -> tuple[float, float]:
    """The mean by weight, and its standard error."""
    w = result.weights
    mean = float(w @ values)
    return mean, float(np.sqrt(np.square(w * (values - mean)).sum()))


def near(result: nw.Result, values: np.ndarray, truth: float, least: float) -> None:
    """Hold an estimate against the truth; its error must be small enough to mean something."""
    mean, error = weighted(result, values)
    assert error < least, (mean, error)
    assert abs(mean - truth) < 4.5 * error, (mean, truth, error)


def quiet(*args, **settings) -> nw.Result:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", GradientWarning)
        return nw.run(*args, **settings)


def test_the_full_rank_has_the_evidence_for_its_bound():
    evidence, mean, cover = line_answers()
    result = nw.run(line, X.tolist(), Y.tolist(), method=nw.vi("full-rank", tolerance=1e-4), seed=1)
    assert result.converged
    assert abs(result.log_evidence_bound - evidence) < 2e-3
    assert result.bound_error < 2e-3
    assert abs(result.log_evidence - evidence) < 2e-3
    assert result.k_hat < 0.7
    assert np.allclose(result.means[0], mean, atol=0.01)
    assert np.allclose(result.covariances[0], cover, rtol=0.03, atol=1e-3)


def test_the_mean_field_has_the_bound_of_the_best_diagonal():
    evidence, mean, cover = line_answers()
    precision = np.linalg.inv(cover)
    best = evidence - 0.5 * (np.log(np.diag(precision)).sum() - np.linalg.slogdet(precision)[1])
    result = quiet(line, X.tolist(), Y.tolist(), method=nw.vi(draws=20_000), seed=2)
    assert result.bound_error < 0.02
    # The optimum is flat: parameters an error of e away cost e^2.
    assert (
        best - 0.02 - 4.5 * result.bound_error < result.log_evidence_bound < best + 4.5 * result.bound_error
    )
    assert result.log_evidence_bound < evidence - 0.01
    slope = result.draws["slope"][0]
    near(result, slope, mean[0], 0.02)
    near(result, slope**2, mean[0] ** 2 + cover[0, 0], 0.05)
    ratios = np.exp(result.log_ratios - evidence)
    assert abs(ratios.mean() - 1.0) < 4.5 * ratios.std() / math.sqrt(len(ratios))


@pytest.mark.parametrize("family", ["mean-field", "full-rank", "pathfinder"])
def test_a_bounded_choice(family):
    a, b = 2.0 + sum(COINS), 3.0 + len(COINS) - sum(COINS)

    def log_beta(a: float, b: float) -> float:
        return math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)

    evidence = log_beta(a, b) - log_beta(2.0, 3.0)
    result = nw.run(share_of_coins, COINS, method=nw.vi(family, draws=10_000, paths=2), seed=3)
    assert result.log_evidence_bound < evidence + 4.5 * result.bound_error
    assert evidence - result.log_evidence_bound < 0.1
    ratios = np.exp(result.log_ratios - evidence)
    assert abs(ratios.mean() - 1.0) < 4.5 * ratios.std() / math.sqrt(len(ratios))
    share = np.concatenate([row["share"] for row in result.values])
    near(result, share, a / (a + b), 0.005)
    near(result, share**2, a * (a + 1) / ((a + b) * (a + b + 1)), 0.005)


def test_the_funnel_is_not_fitted_and_k_says_so():
    with pytest.warns(GradientWarning, match="Pareto's k"):
        result = nw.run(funnel, method=nw.vi(draws=4000), seed=4)
    assert result.k_hat > 0.7
    # The evidence is 1: the bound is below it.
    assert result.log_evidence_bound < -0.3


@model
def direction(concentration, seen):
    """An angle, and measured angles."""
    angle = nw.von_mises(0.0, concentration)
    for y in seen:
        nw.observe(VonMises(angle, 2.0), y)
    return angle


@model
def phase():
    """A number, and an angle that follows it round and round."""
    x = nw.gaussian(0.0, 30.0)
    return nw.von_mises(0.1 * x, 4.0)


def around(concentration: float, seen: list[float]) -> float:
    """The log evidence of `direction`, by the rule of midpoints, which is exact for a periodic function."""
    angle = (np.arange(4096) + 0.5) * (2.0 * np.pi / 4096) - np.pi

    def log_density(x, mean, k):
        return k * np.cos(x - mean) - math.log(2.0 * math.pi * float(np.i0(k)))

    logs = log_density(angle, 0.0, concentration) + sum(log_density(y, angle, 2.0) for y in seen)
    return float(np.log(np.exp(logs).sum() * 2.0 * np.pi / 4096))


def has_evidence(result: nw.Result, truth: float) -> None:
    """Hold the bound and the evidence against the truth."""
    assert result.log_evidence_bound < truth + 4.5 * result.bound_error + 1e-9, result
    ratios = np.exp(result.log_ratios - truth)
    assert abs(ratios.mean() - 1.0) < 4.5 * ratios.std() / math.sqrt(len(ratios)) + 1e-9, result


@pytest.mark.parametrize("family", ["mean-field", "full-rank", "pathfinder"])
@pytest.mark.parametrize("concentration", [0.0, 0.01, 0.3, 1.0, 50.0])
@pytest.mark.parametrize("seen", [[], [3.0, -3.1], [0.5, 0.7, 0.4]])
def test_an_angle_has_its_evidence(family, concentration, seen):
    """The last mode of three data is across the cut of the circle. 45 runs; each alarm is false once in 75,000."""
    result = quiet(direction, concentration, seen, method=nw.vi(family, draws=2000), seed=11)
    has_evidence(result, around(concentration, seen))


@pytest.mark.parametrize("family", ["mean-field", "full-rank", "pathfinder"])
def test_an_angle_that_follows_a_number_round_and_round(family):
    # A normal with correlations knows the turn by the number. A mean field cannot: it stays in one turn, and says so.
    if family == "mean-field":
        with pytest.warns(GradientWarning, match="misses a part"):
            result = nw.run(phase, method=nw.vi(family, draws=2000), seed=12)
        assert result.log_evidence_bound < 4.5 * result.bound_error
    else:
        result = quiet(phase, method=nw.vi(family, draws=2000), seed=12)
        has_evidence(result, 0.0)
        assert result.effective > 0.95 * len(result)


def test_two_equal_modes_have_equal_weight():
    """Draws of several paths are one proposal. 12 seeds, each within 4.5 standard errors."""
    x = np.linspace(-6.0, 6.0, 200_001)
    log = -0.5 * (x / 3.0) ** 2 - math.log(3.0) - 0.5 * math.log(2.0 * math.pi) - 2.0 * (x * x - 4.0) ** 2
    truth = float(np.log(np.exp(log).sum() * (x[1] - x[0])))
    split = 0
    for seed in range(12):
        result = quiet(two_modes, method=nw.vi("pathfinder", paths=8, draws=500), seed=seed)
        signs = [float(np.sign(mean[0])) for mean in result.means]
        if len(set(signs)) == 1:
            continue
        split += signs.count(1.0) != 4
        has_evidence(result, truth)
        right = np.concatenate([row["x"] for row in result.values]) > 0.0
        near(result, right.astype(float), 0.5, 0.02)
    # Where both modes had as many paths, weights by the own normal would be right too.
    assert split > 4


def test_a_normal_that_fits_has_no_warning():
    """Bounds and slopes of the fitted families raise no alarm where the weights are sound: 40 runs."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", GradientWarning)
        warnings.filterwarnings("error", "(?s).*misses a part", GradientWarning)
        for seed in range(20):
            result = nw.run(share_of_coins, COINS, method=nw.vi(), seed=seed)
            assert result.k_curvature < 0.7
            result = nw.run(line, X.tolist(), Y.tolist(), method=nw.vi("full-rank"), seed=seed)
            assert result.k_curvature < 0.7


def test_paths_find_both_modes():
    result = quiet(two_modes, method=nw.vi("pathfinder", paths=8, draws=1000), seed=5)
    signs = {float(np.sign(mean[0])) for mean in result.means}
    assert signs == {-1.0, 1.0}
    x = np.concatenate([row["x"] for row in result.values])
    assert np.abs(np.abs(x).mean() - 2.0) < 0.1


def test_draws_of_density_zero_are_left_out_and_the_evidence_is_right():
    with warnings.catch_warnings(record=True) as record:
        warnings.simplefilter("always", GradientWarning)
        result = nw.run(walled, method=nw.vi(start="run", draws=20_000), seed=6)
    assert any("density zero" in str(warning.message) for warning in record)
    assert result.impossible > 0
    assert result.log_evidence_bound == -math.inf
    assert len(result) == 20_000 - result.impossible
    ratios = np.concatenate([np.exp(result.log_ratios), np.zeros(result.impossible)])
    truth = 0.5 * (1.0 + math.erf(2.5 / math.sqrt(2.0)))
    assert abs(ratios.mean() - truth) < 4.5 * ratios.std() / math.sqrt(len(ratios))


def test_same_seed_same_bits_on_any_number_of_threads():
    for family in ("mean-field", "full-rank", "pathfinder"):
        first, second = (
            quiet(share_of_coins, COINS, method=nw.vi(family, draws=50, steps=200), seed=7, threads=threads)
            for threads in (1, 4)
        )
        assert np.array_equal(first.log_ratios, second.log_ratios)
        assert all(np.array_equal(a, b) for a, b in zip(first.positions, second.positions, strict=True))
    other = quiet(share_of_coins, COINS, method=nw.vi(draws=50, steps=200), seed=8)
    assert not np.array_equal(other.positions[0], first.positions[0])


@pytest.mark.parametrize("wrong", [rooms, counted])
def test_a_structure_that_changes_is_refused(wrong):
    for family in ("mean-field", "pathfinder"):
        with pytest.raises(InputError, match="no-normal-fits"):
            nw.run(wrong, method=nw.vi(family), seed=1)


def test_a_result_is_a_start_and_a_metric():
    _, mean, cover = line_answers()
    data = X.tolist(), Y.tolist()
    for family in ("mean-field", "full-rank"):
        result = quiet(line, *data, method=nw.vi(family, draws=200), seed=9)
        (start,) = result.resampled(1)
        chains = nw.run(
            line,
            *data,
            method=nw.nuts(draws=1000, warmup=100, metric=result.metric),
            choices=start.choices,
            seed=9,
        )
        slope = chains.draws["slope"]
        error = nw.diagnostics.mcse_mean(slope)
        assert error < 0.03
        assert abs(slope.mean() - mean[0]) < 4.5 * error
    with pytest.raises(InputError, match="3 coordinates"):
        nw.run(line, *data, method=nw.nuts(metric=[1.0, 1.0, 1.0]), seed=9)


def test_resampled_draws_have_equal_weight():
    result = nw.run(share_of_coins, COINS, method=nw.vi(draws=2000), seed=10)
    share = np.array([sample.value for sample in result.resampled(2000)])
    mean, error = weighted(result, result.draws["share"][0])
    assert abs(share.mean() - mean) < error


def test_bad_settings():
    for settings, message in (
        ({"family": "normal"}, "one of"),
        ({"start": "top"}, "one of"),
        ({"family": "pathfinder", "start": "run"}, "pathfinder"),
        ({"tolerance": 0.0}, "above 0"),
        ({"samples": 0}, "above 0"),
        ({"draws": -3}, "above 0"),
    ):
        with pytest.raises(InputError, match=message):
            nw.vi(**settings)
    for metric in ("round", [0.0, 1.0], [[1.0, 2.0]], [[1.0], ["a"]], [float("nan")]):
        with pytest.raises(InputError, match="metric"):
            nw.nuts(metric=metric)
