"""Convergence and effective sample size of Markov chains, with NumPy alone.

Draws of one quantity are an array (chains, draws). R-hat and effective sample sizes are those of Vehtari, Gelman,
Simpson, Carpenter & Buerkner 2021 ("Rank-normalization, folding, and localization"); the vector autocorrelation is
that of the dissertation's Figures 4.3 and 4.5, with each chain's own mean and variance, not one method's for all.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass
from operator import add
from statistics import NormalDist
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki.errors.extras import optional

Reals = NDArray[np.float64]


def rhat(draws: ArrayLike) -> float:
    """Rank-normalised split R-hat: 1 when the chains agree in place and in spread; above 1.01 they have not mixed.

    Parameters
    ----------
    draws
        (chains, draws), at least 4 draws.

    Returns
    -------
    float
        The larger of the R-hats of the ranks and of the folded ranks (Vehtari et al. 2021, section 4.1); NaN for draws
        that are not finite, too few, or all the same.
    """
    x = _split(_chains(draws))
    if not _usable(x):
        return math.nan
    folded = np.abs(x - np.median(x))
    return max(_plain_rhat(_normal_scores(x)), _plain_rhat(_normal_scores(folded)))


def ess_bulk(draws: ArrayLike) -> float:
    """Effective sample size for the middle of a distribution: of the rank-normalised split chains.

    Parameters
    ----------
    draws
        (chains, draws), at least 4 draws.
    """
    x = _split(_chains(draws))
    return _ess(_normal_scores(x)) if _usable(x) else _no_estimate(x)


def ess_tail(draws: ArrayLike) -> float:
    """Effective sample size for the tails: the smaller one of the 5 % and the 95 % quantile.

    Parameters
    ----------
    draws
        (chains, draws), at least 4 draws.
    """
    x = _chains(draws)
    return min(ess_quantile(x, 0.05), ess_quantile(x, 0.95))


def ess_mean(draws: ArrayLike) -> float:
    """Effective sample size for the mean, of the split chains as they are.

    Parameters
    ----------
    draws
        (chains, draws), at least 4 draws.
    """
    x = _split(_chains(draws))
    return _ess(x / _unit(x)) if _usable(x) else _no_estimate(x)


def ess_quantile(draws: ArrayLike, share: float) -> float:
    """Effective sample size for a quantile: of the draws' being below it (Vehtari et al. 2021, section 4.3).

    Parameters
    ----------
    draws
        (chains, draws), at least 4 draws.
    share
        Which quantile, in (0, 1).
    """
    whole = _chains(draws)
    if not _usable(_split(whole)):
        return _no_estimate(_split(whole))
    below = _split((whole <= np.quantile(whole, share)).astype(np.float64))
    return _ess(below) if np.ptp(below) > 0 else _no_estimate(below)


def mcse_mean(draws: ArrayLike) -> float:
    """Monte Carlo standard error of the mean.

    Parameters
    ----------
    draws
        (chains, draws), at least 4 draws.
    """
    x = _chains(draws)
    return _deviation(x) / math.sqrt(ess_mean(x))


def autocorrelation(draws: ArrayLike) -> Reals:
    """The autocorrelation of one chain at every lag, with its own mean and variance.

    Parameters
    ----------
    draws
        (draws,) of a number, or (draws, coordinates) of a vector, whose inner products count (dissertation fig. 4.3).

    Returns
    -------
    (draws,) float64
        `AC(t) = 1 / ((n - t) V) sum_i (v_i - m) . (v_{i+t} - m)` with the mean m and V the mean squared distance to
        it. Far lags are noise. (The dissertation takes m and V of the HMC run for every method's chain.)
    """
    x = np.asarray(draws, dtype=np.float64)
    x = x[:, None] if x.ndim == 1 else x
    n = len(x)
    centred = x - x.mean(axis=0)
    lagged = _lagged_sums(centred.T).sum(axis=0)
    scale = lagged[0] / n
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(lagged / (n - np.arange(n)) / scale)


def ess_vector(draws: ArrayLike) -> float:
    """Effective sample size of vectors, from their autocorrelation up to where it is lost in noise.

    Parameters
    ----------
    draws
        (draws, coordinates) of one chain, or (chains, draws, coordinates).

    Returns
    -------
    float
        `n / (1 + 2 sum of AC)` of n draws in all, with Geyer's initial monotone positive sequence. One chain is
        measured by its own mean and variance; several also by how far their means lie apart, as in Vehtari et al. 2021,
        eq. 10, with inner products for products: chains that stay each in its own place count as about one draw each.
    """
    x = np.asarray(draws, dtype=np.float64)
    if x.ndim == 3 and len(x) > 1:
        chains, n, _ = x.shape
        centred = x - x.mean(axis=1, keepdims=True)
        lagged = _lagged_sums(np.moveaxis(centred, 1, 2)).sum(axis=1) / n
        return _effective_size(lagged, float(x.mean(axis=1).var(axis=0, ddof=1).sum()))
    x = x[0] if x.ndim == 3 else x
    n = len(x)
    # Geyer's pairs need the biased estimate, whose far lags shrink.
    rho = autocorrelation(x) * (n - np.arange(n)) / n
    return n / _time(rho)


def psis(log_ratios: ArrayLike) -> tuple[Reals, float]:
    """Pareto-smoothed importance weights: the largest are replaced by quantiles of the tail that fits them.

    Parameters
    ----------
    log_ratios
        (n,) logs of the weights, up to a constant, nats.

    Returns
    -------
    (n,) float64
        Logs of the smoothed weights; the largest of them is at most the largest of the given ones.
    float
        Pareto's k of the tail: below 0.5 the weights have a finite variance, above 0.7 estimates by them are not to be
        trusted. Infinite where too few weights are given to say, minus infinity where all are the same.

    Notes
    -----
    Vehtari, Simpson, Gelman, Yao & Gabry 2024, section 2.4; the tail is fitted as by Zhang & Stephens 2009.
    """
    logs = np.array(log_ratios, dtype=np.float64)
    n = len(logs)
    tail = math.ceil(min(0.2 * n, 3.0 * math.sqrt(n)))
    if tail < 5 or not np.isfinite(logs).all():
        return logs, math.inf
    if np.ptp(logs) < 1e-12:
        return logs, -math.inf
    most = logs.max()
    order = np.argsort(logs, kind="stable")
    largest, cut = order[-tail:], math.exp(logs[order[-tail - 1]] - most)
    excess = np.exp(logs[largest] - most) - cut
    if excess[0] <= 0.0 or excess[-1] - excess[0] <= 0.0:
        excess = np.maximum(excess, np.finfo(np.float64).tiny)
    k, scale = _pareto(excess)
    shares = (np.arange(tail) + 0.5) / tail
    # Of a tail as heavy as can be the last quantiles overflow; they become the largest weight.
    with np.errstate(over="ignore"):
        steps = np.log1p(-shares)
        quantiles = -scale * steps if k == 0.0 else scale * np.expm1(-k * steps) / k
    logs[largest] = np.minimum(np.log(cut + quantiles), 0.0) + most
    return logs, k


def _pareto(x: Reals) -> tuple[float, float]:
    """Shape and scale of the generalised Pareto distribution of sorted excesses (Zhang & Stephens 2009).

    The shape is drawn towards 0.5 by ten observations' worth, which steadies it for few.
    """
    n = len(x)
    points = 30 + int(math.sqrt(n))
    b = 1.0 - np.sqrt(points / (np.arange(1, points + 1) - 0.5))
    b = b / (3.0 * x[int(n / 4 + 0.5) - 1]) + 1.0 / x[-1]
    k = np.log1p(-b[:, None] * x).mean(axis=1)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        likelihood = n * (np.log(-b / k) - k - 1.0)
        likelihood = np.where(np.isfinite(likelihood), likelihood, -math.inf)
        weight = np.exp(likelihood - likelihood.max())
    b_mean = float((b * weight).sum() / weight.sum())
    shape = float(np.log1p(-b_mean * x).mean())
    return (n * shape + 5.0) / (n + 10.0), -shape / b_mean


def ebfmi(energy: ArrayLike) -> Reals:
    """Energy Bayesian fraction of missing information of each chain; below 0.3 momentum hardly moves the energy.

    Parameters
    ----------
    energy
        (chains, draws) of the Hamiltonian at each draw, nats.

    Returns
    -------
    (chains,) float64
        The mean squared change of the energy over its variance (Betancourt 2016, eq. 8).
    """
    e = _chains(energy)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.square(np.diff(e, axis=1)).mean(axis=1) / np.var(e, axis=1, ddof=1))


@dataclass(frozen=True)
class Summary:
    """Summary of one quantity.

    Attributes
    ----------
    name : str
        Of the quantity.
    mean, sd : float
        Over all draws.
    mcse : float
        Standard error of the mean.
    ess_bulk, ess_tail : float
        Effective sample sizes.
    rhat : float
        Rank-normalised split R-hat.
    """

    name: str
    mean: float
    sd: float
    mcse: float
    ess_bulk: float
    ess_tail: float
    rhat: float


@dataclass(frozen=True)
class Divergences:
    """Trajectories that broke off after the warm-up, by the reason; each was rejected.

    Attributes
    ----------
    energy : int
        Diverged: the energy drifted, because the step is too large for how sharply the density bends there.
    structure : int
        Refused for structure: the run would make other choices there.
    impossible : int
        The density is zero there.
    not_finite : int
        The density or its gradient is no number there; see `HmcInfo.fault`.
    """

    energy: int = 0
    structure: int = 0
    impossible: int = 0
    not_finite: int = 0

    def __add__(self, other: Divergences) -> Divergences:
        """The sum of two counts, by reason."""
        return Divergences(*map(add, astuple(self), astuple(other)))

    @property
    def total(self) -> int:
        """The number of all trajectories that broke off."""
        return sum(astuple(self))

    @property
    def named(self) -> list[str]:
        """Each count above 0 with its name, as results print them."""
        names = ("diverged", "refused for structure", "impossible", "not finite")
        return [f"{count} {name}" for count, name in zip(astuple(self), names, strict=True) if count]


class Summaries(tuple[Summary, ...]):
    """Summaries of several quantities; printed, they are a table.

    Attributes
    ----------
    divergences : Divergences
        Trajectories that broke off, of chains that follow the gradient; printed under the table.
    """

    divergences: Divergences = Divergences()

    def __repr__(self) -> str:
        heads = ("", "mean", "sd", "mcse", "ess bulk", "ess tail", "r-hat")
        rows = [heads]
        for s in self:
            sizes = (f"{s.ess_bulk:.0f}", f"{s.ess_tail:.0f}", f"{s.rhat:.3f}")
            rows.append((s.name, f"{s.mean:.4g}", f"{s.sd:.4g}", f"{s.mcse:.2g}", *sizes))
        widths = [max(len(row[k]) for row in rows) for k in range(len(heads))]
        lines = [
            "  ".join(
                [row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:], widths[1:], strict=True))]
            )
            for row in rows
        ]
        if self.divergences.total:
            lines.append(f"trajectories: {', '.join(self.divergences.named)}")
        return "\n".join(line.rstrip() for line in lines)


def summarise(draws: Mapping[str, ArrayLike], divergences: Divergences | None = None) -> Summaries:
    """Mean, deviation, standard error, effective sizes and R-hat of each quantity.

    Parameters
    ----------
    draws
        Arrays (chains, draws, ...) by name; the elements of a vector are summarised one by one.
    divergences
        Trajectories that broke off, of chains that follow the gradient.
    """
    rows = []
    for name, values in draws.items():
        x = np.asarray(values, dtype=np.float64)
        for place in np.ndindex(*x.shape[2:]):
            quantity = x[(slice(None), slice(None), *place)]
            label = f"{name}[{', '.join(map(str, place))}]" if place else name
            mean, sd = float(quantity.mean()), _deviation(quantity) if quantity.size > 1 else math.nan
            rows.append(
                Summary(
                    label,
                    mean,
                    sd,
                    mcse_mean(quantity),
                    ess_bulk(quantity),
                    ess_tail(quantity),
                    rhat(quantity),
                )
            )
    summaries = Summaries(rows)
    if divergences is not None:
        summaries.divergences = divergences
    return summaries


def to_arviz(draws: Mapping[str, ArrayLike], stats: Mapping[str, ArrayLike] | None = None) -> Any:
    """Draws and their statistics for ArviZ: a `DataTree` with 1.x, an `InferenceData` before.

    Parameters
    ----------
    draws
        Arrays (chains, draws, ...) by name.
    stats
        Arrays (chains, draws) by the names that ArviZ knows: `energy`, `diverging`, `acceptance_rate`, `n_steps`,
        `tree_depth`, `step_size`, `lp`; others are kept under their own names.

    Raises
    ------
    FileError
        ArviZ is not installed.
    """
    with warnings.catch_warnings():
        # ArviZ 0.23 warns about its successor on import.
        warnings.simplefilter("ignore", FutureWarning)
        arviz = optional(
            "arviz", "passing draws to ArviZ", "arviz", "use `niwaki.diagnostics`, which needs NumPy only"
        )
    posterior = {name: np.asarray(values) for name, values in draws.items()}
    groups: dict[str, Any] = {"posterior": posterior}
    if stats:
        groups["sample_stats"] = {name: np.asarray(values) for name, values in stats.items()}
    if int(arviz.__version__.split(".")[0]) >= 1:
        return arviz.from_dict(groups)
    return arviz.from_dict(**groups)


def _chains(draws: ArrayLike) -> Reals:
    """(chains, draws) float64; a single chain may come as (draws,)."""
    x = np.asarray(draws, dtype=np.float64)
    return x[None, :] if x.ndim == 1 else x


def _unit(x: Reals) -> float:
    """A power of two near the largest number if its square may leave the range of numbers; else 1."""
    most = float(np.abs(x).max(initial=0.0))
    return 2.0 ** (math.frexp(most)[1] - 1) if 0.0 < most < math.inf and not 1e-100 < most < 1e100 else 1.0


def _deviation(x: Reals) -> float:
    """Standard deviation of all draws."""
    unit = _unit(x)
    return float(np.std(x / unit, ddof=1)) * unit


def _split(x: Reals) -> Reals:
    """Each chain as two; the middle draw of an odd number is left out."""
    half = x.shape[1] // 2
    return np.concatenate([x[:, :half], x[:, x.shape[1] - half :]])


def _usable(x: Reals) -> bool:
    return x.shape[1] >= 2 and bool(np.isfinite(x).all()) and float(np.ptp(x)) > 0.0


def _no_estimate(x: Reals) -> float:
    """The effective size if it cannot be estimated: NaN, or the number of draws if all are equal."""
    constant = x.shape[1] >= 2 and bool(np.isfinite(x).all())
    return float(x.size) if constant else math.nan


def _normal_scores(x: Reals) -> Reals:
    """Normal quantiles of the ranks over all chains, ties at their mean rank (Blom 1958)."""
    flat = x.ravel()
    _, where, counts = np.unique(flat, return_inverse=True, return_counts=True)
    ranks = np.cumsum(counts) - 0.5 * (counts - 1)
    normal = NormalDist()
    scores = np.array([normal.inv_cdf(share) for share in (ranks - 0.375) / (flat.size + 0.25)])
    return np.asarray(scores[where].reshape(x.shape))


def _plain_rhat(x: Reals) -> float:
    """R-hat of chains as they are: the deviation over all chains by that within them."""
    n = x.shape[1]
    within = float(x.var(axis=1, ddof=1).mean())
    between = float(x.mean(axis=1).var(ddof=1))
    if within == 0.0:
        return math.nan
    return math.sqrt((n - 1) / n + between / within)


def _lagged_sums(x: Reals) -> Reals:
    """`sum_i x_i x_{i+t}` of each chain at every lag, by the fast Fourier transform."""
    n = x.shape[-1]
    size = 2 ** math.ceil(math.log2(2 * n))
    spectrum = np.fft.rfft(x, size, axis=-1)
    return np.asarray(np.fft.irfft(np.square(np.abs(spectrum)), size, axis=-1)[..., :n])


def _ess(x: Reals) -> float:
    """Effective sample size of chains as they are (Vehtari et al. 2021, eq. 10 to 13)."""
    chains, n = x.shape
    lagged = _lagged_sums(x - x.mean(axis=1, keepdims=True)) / n
    return _effective_size(lagged, float(x.mean(axis=1).var(ddof=1)) if chains > 1 else 0.0)


def _effective_size(lagged: Reals, between: float) -> float:
    """Effective sample size from each chain's autocovariances at every lag and the variance of the chains' means."""
    chains, n = lagged.shape
    within = lagged[:, 0].mean() * n / (n - 1)
    total = within * (n - 1) / n + between
    rho = 1.0 - (within - lagged.mean(axis=0)) / total
    rho[0] = 1.0
    # A chain that alternates may have a size above its number of draws, but not without bound.
    return float(chains * n / max(_time(rho), 1.0 / math.log10(chains * n)))


def _time(rho: Reals) -> float:
    """The autocorrelation time from pairs of lags while they are positive, none above its elder (Geyer 1992, 3.3)."""
    pairs = max((len(rho) - 1) // 2, 1)
    sums = rho[0 : 2 * pairs : 2] + rho[1 : 2 * pairs : 2]
    negative = np.flatnonzero(sums <= 0.0)
    last = int(negative[0]) if len(negative) else pairs - 1
    kept = np.minimum.accumulate(sums[:last]) if last else np.zeros(0)
    # The first lag of the pair that ends the sum still counts, once, where it is positive.
    return float(-1.0 + 2.0 * kept.sum() + max(float(rho[2 * last]), 0.0))


def together(chains: Sequence[Mapping[str, NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    """Stack the values of the choices that all chains have, (chains, draws, ...)."""
    return {
        path: np.array([chain[path] for chain in chains])
        for path, values in (chains[0].items() if chains else ())
        if all(path in chain and chain[path].shape == values.shape for chain in chains)
    }
