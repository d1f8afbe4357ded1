"""Claim: our diagnostics are those of ArviZ, and detect what they should detect.

The reference numbers of `REFERENCE` were computed with ArviZ 0.23.4 from the chains that `chains` makes of whole-number
arithmetic; where ArviZ is installed, it is compared as well. Nothing here is random.
"""

from __future__ import annotations

import importlib.util
import math
import warnings
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import diagnostics

HAS_ARVIZ = importlib.util.find_spec("arviz") is not None
needs_arviz = pytest.mark.skipif(not HAS_ARVIZ, reason="ArviZ is not installed (extra `arviz`)")


def noise(chains: int, draws: int) -> Any:
    """Uniform numbers in (0, 1) by a linear congruence: the same in every NumPy."""
    state, numbers = 12345, []
    for _ in range(chains * draws):
        state = (6364136223846793005 * state + 1442695040888963407) % 2**64
        numbers.append(((state >> 11) + 0.5) / 2**53)
    return np.array(numbers).reshape(chains, draws)


def walk(persistence: float, chains: int, draws: int) -> Any:
    x = noise(chains, draws) - 0.5
    for t in range(1, draws):
        x[:, t] += persistence * x[:, t - 1]
    return x


def chains() -> dict[str, Any]:
    return {
        "independent": walk(0.0, 4, 500),
        "sticky": walk(0.9, 4, 500),
        "alternating": walk(-0.7, 4, 251),
        "heavy": np.tan(math.pi * (noise(2, 333) - 0.5)),
        "apart": walk(0.3, 4, 100) + np.arange(4)[:, None],
        "ties": np.floor(3 * noise(4, 100)),
        "short": walk(0.0, 2, 10),
    }


#: R-hat, bulk, tail and mean ESS, MCSE of the mean, E-BFMI of the first chain; ArviZ 0.23.4.
REFERENCE: dict[str, tuple[float, ...]] = {
    "independent": (
        1.0011391779436507,
        1897.5348481506198,
        1972.5410124096659,
        1871.3883946672515,
        0.006671468772571586,
        2.012803325248192,
    ),
    "sticky": (
        1.046144780650925,
        82.89021833955913,
        97.1369661888561,
        79.02618497551569,
        0.07802063293234593,
        0.2515556598693523,
    ),
    "alternating": (
        1.0038036386486313,
        3000.0,
        891.6562017091169,
        3000.0,
        0.007322996188623407,
        3.2903680843801872,
    ),
    "heavy": (
        1.0008282771783124,
        693.8087585663212,
        523.1313211605369,
        674.302942754053,
        1.693681842922507,
        1.999729972559225,
    ),
    "apart": (
        2.8226848608276423,
        5.003276995127672,
        43.446315049675775,
        4.6483430052737145,
        0.5387172509675077,
        1.3983022711370419,
    ),
    "ties": (
        0.9957966951896454,
        449.39652428395203,
        400.0,
        449.1368888159344,
        0.039383593528949615,
        2.0526315789473686,
    ),
    "short": (
        1.0825416640040135,
        24.29028275228291,
        21.73913043478261,
        26.020599913279625,
        0.05633475432545237,
        1.907353546821222,
    ),
}


def ours(x: Any) -> tuple[float, ...]:
    d = diagnostics
    sizes = (d.ess_bulk(x), d.ess_tail(x), d.ess_mean(x))
    return (d.rhat(x), *sizes, d.mcse_mean(x), float(d.ebfmi(x)[0]))


@pytest.mark.parametrize("name", chains())
def test_figures_are_those_of_arviz(name: str) -> None:
    assert ours(chains()[name]) == pytest.approx(REFERENCE[name], rel=1e-10)


@needs_arviz
@pytest.mark.parametrize("name", chains())
def test_figures_are_those_of_the_installed_arviz(name: str) -> None:
    assert ours(chains()[name]) == pytest.approx(theirs(chains()[name]), rel=1e-10)


def theirs(x: Any) -> tuple[float, ...]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import arviz

        settings: dict[str, Any] = {"bulk": {}, "tail": {"prob": (0.05, 0.95)}, "mean": {}}
        if int(arviz.__version__.split(".")[0]) >= 1:
            from arviz_stats.base import array_stats as stats

            sizes = [stats.ess(x, method=method, **extra) for method, extra in settings.items()]
            statistics = (stats.rhat(x), *sizes, stats.mcse(x, method="mean"), np.ravel(stats.bfmi(x))[0])
        else:
            sizes = [arviz.ess(x, method=method, **extra) for method, extra in settings.items()]
            statistics = (arviz.rhat(x), *sizes, arviz.mcse(x, method="mean"), arviz.bfmi(x)[0])
    return tuple(float(number) for number in statistics)


def test_what_has_not_mixed_is_seen() -> None:
    samples = chains()
    assert diagnostics.rhat(samples["independent"]) < 1.01
    assert diagnostics.rhat(samples["apart"]) > 2.0
    # Chains that agree in place and not in spread: only the folded ranks see it.
    spread = walk(0.0, 4, 500) * np.array([1, 1, 1, 5])[:, None]
    assert diagnostics.rhat(spread) > 1.1
    # A chain that drifts disagrees with its own second half.
    drifting = walk(0.0, 1, 500) + np.linspace(0, 2, 500)
    assert diagnostics.rhat(drifting) > 1.3


def test_draws_without_an_effective_size() -> None:
    assert math.isnan(diagnostics.rhat(np.full((4, 100), 3.0)))
    assert diagnostics.ess_bulk(np.full((4, 100), 3.0)) == 400
    for bad in (math.nan, math.inf):
        x = walk(0.0, 4, 100)
        x[1, 3] = bad
        assert math.isnan(diagnostics.rhat(x)) and math.isnan(diagnostics.ess_tail(x))


def test_autocorrelation_of_a_vector_is_that_of_its_parts_weighted_by_variance() -> None:
    x = np.stack([walk(0.9, 1, 400)[0], 0.1 * walk(0.0, 1, 400)[0]], axis=1)
    n, centred = len(x), x - x.mean(axis=0)
    by_hand = [float((centred[: n - t] * centred[t:]).sum() / (n - t)) for t in (0, 1, 7)]
    correlation = diagnostics.autocorrelation(x)
    assert correlation[0] == pytest.approx(1.0)
    assert correlation[[1, 7]] == pytest.approx([by_hand[1] / by_hand[0], by_hand[2] / by_hand[0]])
    alone = diagnostics.autocorrelation(x[:, 0])
    assert correlation[1] < alone[1]


def test_a_vector_of_one_coordinate_has_the_size_of_the_coordinate() -> None:
    # phi = 0.9: (1 - phi) / (1 + phi) of the draws, 53 of 1000; one chain's estimate is within a factor of 2.
    x = walk(0.9, 1, 1000)[0]
    assert 26 < diagnostics.ess_vector(x[:, None]) < 106
    assert 700 < diagnostics.ess_vector(walk(0.0, 1, 1000)[0][:, None]) < 1400


def test_autoregressive_chains_have_the_known_autocorrelation_and_size() -> None:
    """x' = phi x + noise: AC(t) = phi^t, and n draws count as n (1 - phi) / (1 + phi)."""
    n, far = 40_000, 8
    for phi in (0.0, 0.5, 0.9):
        # Three coordinates of different sizes; inner products weigh them by variance, and each has the same phi.
        x = np.stack([scale * walk(phi, 3, n)[k] for k, scale in enumerate((1.0, 0.5, 2.0))], axis=1) + 7.0
        # Bartlett: an estimate of AC(t) has a standard error below sqrt((1 + phi^2) / (1 - phi^2) / n) = 0.0155 at 0.9,
        # times the root of 1.2 for three unequal coordinates; 5 of those.
        error = 5.0 * math.sqrt(1.2 * (1 + phi**2) / (1 - phi**2) / n)
        correlation = diagnostics.autocorrelation(x)[:far]
        assert np.abs(correlation - phi ** np.arange(far)).max() < error
        effective = n * (1.0 - phi) / (1.0 + phi)
        assert diagnostics.ess_vector(x) == pytest.approx(effective, rel=0.15)
        # The dissertation's measure, with another run's mean and variance, is another number.
        wrong = (x[: n - 1] * x[1:]).sum() / (n - 1) / (x * x).sum(axis=1).mean()
        assert abs(wrong - phi) > error


def test_several_chains_of_vectors_have_the_sum_of_their_sizes_unless_they_stay_apart() -> None:
    chains = np.stack([walk(0.9, 8, 1000), 2.0 * walk(0.9, 9, 1000)[1:]], axis=2)
    # 53 each.
    assert diagnostics.ess_vector(chains) == pytest.approx(8 * 1000 * 0.1 / 1.9, rel=0.3)
    assert diagnostics.ess_vector(chains[:1]) == diagnostics.ess_vector(chains[0])
    coordinate = chains[:, :, :1]
    plain = diagnostics.ess_vector(np.concatenate([coordinate[:, :500], coordinate[:, 500:]]))
    assert plain == pytest.approx(diagnostics.ess_mean(coordinate[:, :, 0]))
    apart = 0.01 * chains[:, :20] + np.arange(8)[:, None, None]
    assert 4.0 < diagnostics.ess_vector(apart) < 10.0


def test_a_summary_is_a_table() -> None:
    summaries = diagnostics.summarise(
        {"x": walk(0.0, 4, 100), "v": np.stack([walk(0.5, 4, 100)] * 2, axis=2)}
    )
    assert [row.name for row in summaries] == ["x", "v[0]", "v[1]"]
    lines = repr(summaries).splitlines()
    assert len(lines) == 4 and lines[0].split()[:2] == ["mean", "sd"]


@needs_arviz
def test_draws_go_to_arviz() -> None:
    draws = {"x": walk(0.0, 4, 50), "v": noise(4, 150).reshape(4, 50, 3)}
    stats = {"energy": noise(4, 50), "diverging": noise(4, 50) < 0.1}
    data = diagnostics.to_arviz(draws, stats)
    posterior, sample_stats = data["posterior"], data["sample_stats"]
    assert dict(posterior.sizes)["chain"] == 4 and dict(posterior.sizes)["draw"] == 50
    assert np.array_equal(np.asarray(posterior["v"]), draws["v"])
    assert np.array_equal(np.asarray(sample_stats["diverging"]), stats["diverging"])


def test_without_arviz_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "arviz", None)
    with pytest.raises(nw.NiwakiError, match=r"niwaki\[arviz\]'`, or use `niwaki.diagnostics`") as caught:
        diagnostics.to_arviz({"x": walk(0.0, 2, 10)})
    assert caught.value.code == "missing-extra"
