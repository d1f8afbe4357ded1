"""Results of variational inference: normals, their evidence bounds, and the weights of their draws."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from niwaki import _engine
from niwaki.errors import ModelFault
from niwaki.lang.compiled import as_fault
from niwaki.methods import Vi
from niwaki.result.diagnostics import psis
from niwaki.result.drawn import DrawnInfo, Reals
from niwaki.result.hmc import say
from niwaki.result.search_like import SearchLike

#: Above this k, the weights are too uneven for estimates (Vehtari, Simpson, Gelman, Yao & Gabry 2024, section 3.2.4).
UNEVEN = 0.7
#: A normal whose bound is this far below that of another, nats, may hide a k of 0.7. Of normal models, a mean field
#: whose weights have the shape k is below by `-(log(1 - k) + k) / 2` or more, in any number of coordinates.
GAP = -0.5 * (math.log1p(-UNEVEN) + UNEVEN)
#: A difference counts if it is this many standard errors: false alarms are rarer than one in 700.
CLEAR = 3.0
#: If this share of the draws is effective, the weights hardly differ, and the shape of their tail does not matter.
EVEN = 0.95


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class ViInfo(DrawnInfo):
    """Statistics of `vi`: the normals, with the draws from them as numbers.

    There is one normal, or with `family="pathfinder"` one for each path. The log weight of a draw is the log ratio of
    the densities of the model and of all normals together, `log p - log (1/n) sum_j q_j`. Draws of density zero are
    counted, but are not among the samples. The weights of the draws estimate `log_evidence`. A normal over an angle is
    wound around the circle.

    Attributes
    ----------
    search, seed, sizes, log_weights
        As in `DrawnInfo`. The weights are smoothed.
    log_evidence_bound : float
        The evidence bound of the best normal, nats, estimated by its draws: below the log evidence by the divergence
        `KL(q || p)`. Minus infinity if some draws have density zero.
    bound_error : float
        The standard error of the bound, nats.
    k_hat : float
        Pareto's k of the weights. Above 0.7 the normal misses too much, and weighted estimates are unreliable, unless
        nearly all draws are `effective`. It depends only on regions with draws.
    k_curvature : float
        The k of the weights of the best normal, if the model were the normal with the curvature that the slopes at the
        draws show. So it detects a tail that no draw has reached. NaN with fewer than four draws for each coordinate.
    k_curvature_error : float
        The standard error of `k_curvature`.
    log_ratios : array of shape (n,)
        `log p - log q` of the draws over coordinates, nats: the logs of the weights before they are smoothed. `q` is
        the density of all normals together.
    bounds : list of array
        Estimates of the bound by step for each normal, nats: in the ascent of the bound, or along the path.
    means : list of array of shape (dim,)
        The mean of each normal, in coordinates.
    covariances : list of array of shape (dim,) or (dim, dim)
        Variances of independent coordinates, or the covariance.
    best_normal : int
        The number of the normal with the highest bound.
    log_path_bound : float or None
        The evidence bound of the path's normal at which an ascent started, nats; None if a draw has density zero.
    path_bound_error : float or None
        The standard error of `log_path_bound`, nats.
    converged : bool
        Whether the ascent ended by its tolerance.
    impossible : int
        The number of draws of density zero.
    gradients : int
        The number of gradients.
    broke : int or None
        The step at which the ascent broke off, because the bound was no number or fell; the result is from before.
    fault : ModelFault or None
        The fault, with its line, of a draw without a finite density there.
    """

    log_evidence_bound: float
    bound_error: float
    k_hat: float
    k_curvature: float
    k_curvature_error: float
    log_ratios: Reals
    bounds: list[Reals]
    means: list[Reals]
    covariances: list[Reals]
    best_normal: int
    log_path_bound: float | None
    path_bound_error: float | None
    converged: bool
    impossible: int
    gradients: int
    broke: int | None
    fault: ModelFault | None

    @classmethod
    def of(cls, search: SearchLike, seed: int, fit: _engine.Normals) -> ViInfo:
        """Read the results of the engine."""
        normals = range(fit.chains)
        counts = [fit.counters(normal) for normal in normals]
        densities = [fit.densities(normal) for normal in normals]
        bounds = [
            _bound(p - q, count["impossible"]) for (p, q, _), count in zip(densities, counts, strict=True)
        ]
        best = int(np.argmax([mean for mean, _ in bounds]))
        ratios = [p - together for p, _, together in densities]
        log_ratios = np.concatenate(ratios)
        curvature = _curvature(*fit.slopes(best))
        path_bound = counts[best]["path_bound"] or (None, None)
        log_weights, k_hat = psis(log_ratios)
        lost = sum(count["impossible"] for count in counts)
        moments = [fit.moments(normal) for normal in normals]
        faults = (fit.fault(normal) for normal in normals)
        first = next((fault for fault in faults if fault is not None), None)
        return cls(
            log_evidence=_log_mean(log_ratios, len(log_ratios) + lost),
            search=search,
            seed=seed,
            sizes=tuple(map(len, ratios)),
            fixed=[{} for _ in normals],
            log_weights=log_weights,
            log_evidence_bound=bounds[best][0],
            bound_error=bounds[best][1],
            k_hat=k_hat,
            k_curvature=curvature[0],
            k_curvature_error=curvature[1],
            log_ratios=log_ratios,
            bounds=[fit.bounds(normal) for normal in normals],
            means=[mean for mean, _ in moments],
            covariances=[covariance for _, covariance in moments],
            best_normal=best,
            log_path_bound=path_bound[0],
            path_bound_error=path_bound[1],
            converged=all(count["converged"] for count in counts),
            impossible=lost,
            gradients=sum(count["gradients"] for count in counts),
            broke=next((count["broke"] for count in counts if count["broke"] is not None), None),
            fault=as_fault(first, search.model.name, f"seed={seed}"),
            _engine=fit,
        )

    @property
    def metric(self) -> tuple[float | tuple[float, ...], ...]:
        """The best normal's variances, or its covariance by rows, as the `metric` of `hmc` and `nuts`."""
        covariance = self.covariances[self.best_normal].tolist()
        return tuple(tuple(row) if isinstance(row, list) else row for row in covariance)

    @property
    def effective(self) -> float:
        """The effective sample size of the weights."""
        logs = self.log_weights
        if logs is None or not len(logs):
            return 0.0
        shares = np.exp(logs - logs.max())
        return float(shares.sum() ** 2 / np.square(shares).sum())

    def _repr_parts(self, samples: str) -> list[str]:
        bound = f"evidence bound {self.log_evidence_bound:.4g} ({self.bound_error:.1g})"
        return [samples, f"{self.gradients} gradients", bound, f"k-hat {self.k_hat:.2f}"]

    def statistics(self) -> dict[str, Reals]:
        """Numbers of each draw, (normals, draws)."""
        least, ends = min(self.sizes), np.cumsum([0, *self.sizes])[:-1]
        logs = {"log_ratio": self.log_ratios, "log_weight": self.log_weights}
        return {
            name: np.array([values[first : first + least] for first in ends])
            for name, values in logs.items()
            if values is not None
        }

    def warn(self, method: Vi, interrupted: bool) -> None:
        """Warn about an ascent that broke off or did not end, impossible draws, and a poor fit."""
        name = self.search.model.name
        if self.broke is not None:
            why = f":\n{self.fault.render()}" if self.fault else ""
            say(
                f"the ascent of the bound of `{name}` broke off at step {self.broke}, because the bound was no number "
                f"or fell far; the result is the best normal before that step{why}"
            )
        elif not self.converged and not interrupted:
            say(
                f"the bound of `{name}` still grew after {method.steps} steps, by {method.tolerance:g} nats or more in "
                f"a round; give more `steps`, or a larger `tolerance`"
            )
        total = len(self.log_ratios) + self.impossible
        if self.impossible:
            say(
                f"{self.impossible} of {total} draws from the normal of `{name}` have density zero, so that its "
                f"evidence bound is minus infinity; they are left out, and the weights of the others are right"
            )
        missed = self._missed(interrupted)
        if missed:
            wider = "" if method.family == "full-rank" else ' take `family="full-rank"`, or'
            say(
                f"{missed}: the normal misses a part of the distribution, and weighted estimates are "
                f"unreliable;{wider} use `nuts(metric=result.metric)` from `choices=result.best.choices`"
            )

    def _missed(self, interrupted: bool) -> str | None:
        """Word the evidence that the normal misses a part of the distribution; None without evidence."""
        name = self.search.model.name
        if self.k_hat > UNEVEN and self.effective < EVEN * len(self.log_ratios):
            return f"Pareto's k of the weights of `{name}` is {self.k_hat:.2f}, above {UNEVEN}"
        if self.k_curvature - CLEAR * self.k_curvature_error > UNEVEN:
            return (
                f"Pareto's k of the weights of `{name}` is {self.k_hat:.2f} by the draws, but the slopes at the draws "
                f"say that the distribution is much wider than the normal in some direction, where k is "
                f"{self.k_curvature:.2f}"
            )
        if self.log_path_bound is None or self.path_bound_error is None or interrupted:
            return None
        gain = self.log_path_bound - self.log_evidence_bound
        error = math.hypot(self.path_bound_error, self.bound_error)
        if math.isfinite(gain) and gain - CLEAR * error > GAP:
            return (
                f"the evidence bound of `{name}` is {self.log_evidence_bound:.2f}, {gain:.2f} nats below that of the "
                f"path's normal from which the ascent began"
            )
        return None


def _bound(ratios: Reals, impossible: int) -> tuple[float, float]:
    """The mean of the log ratios and its standard error."""
    if impossible or not len(ratios):
        return -math.inf, math.nan
    with np.errstate(over="ignore"):
        spread = float(ratios.std(ddof=1)) if len(ratios) > 1 else math.nan
        return float(ratios.mean()), spread / math.sqrt(len(ratios))


def _curvature(z: Reals, slopes: Reals) -> tuple[float, float]:
    """Estimate the k of the weights of a normal model by the slopes of the log weights at the draws, with its error.

    For a normal model these slopes are a linear function of the draws, `slopes = B z` with `z` standard normal, and
    the log weight grows like `k z^2 / 2` where it grows most: `k` is the largest eigenvalue of `B`. For any other
    model `B` is the mean curvature. One half of the draws determines the direction, and the other half the growth
    along it, so that the noise in the choice of the direction does not raise the growth.

    Parameters
    ----------
    z, slopes
        (n, dim): standard normal numbers of the draws, and the slopes of their log weights by these.
    """
    n, dim = z.shape
    if n < 4 * (dim + 1) or not (np.isfinite(slopes).all() and dim):
        return math.nan, math.nan
    even, odd = slice(0, None, 2), slice(1, None, 2)
    centred = z[even] - z[even].mean(axis=0)
    b = np.linalg.lstsq(centred, slopes[even], rcond=None)[0]
    direction = np.linalg.eigh(b + b.T)[1][:, -1]
    along, slope = z[odd] @ direction, slopes[odd] @ direction
    along -= along.mean()
    squares = float(np.square(along).sum())
    k = float(along @ slope) / squares
    rest = slope - slope.mean() - k * along
    return k, math.hypot(*(along * rest)) / squares


def _log_mean(logs: Reals, count: int) -> float | None:
    """Log of the mean of `exp(logs)` and zeros up to `count` numbers."""
    if not len(logs):
        return None
    most = float(logs.max())
    return most + math.log(float(np.exp(logs - most).sum()) / count)
