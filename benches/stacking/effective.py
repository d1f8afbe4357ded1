"""The autocorrelation of the vector of all corners (dissertation 4.5), and effective draws.

Mean and variance are those of all chains together. Effective draws are N / (1 + 2 sum of autocorrelations), summed in
pairs while these are positive (Geyer 1992).
"""

from __future__ import annotations

from typing import Any

import numpy as np

Reals = Any


def autocorrelation(corners: Reals) -> Reals:
    """Of draws (chains, draws, n), for every lag."""
    chains, draws = corners.shape[:2]
    flat = corners.reshape(chains, draws, -1)
    off = flat - flat.mean(axis=(0, 1))
    variance = (off**2).sum(axis=2).mean()
    return np.array(
        [(off[:, : draws - lag] * off[:, lag:]).sum(axis=2).mean() / variance for lag in range(draws)]
    )


def effective(corners: Reals) -> float:
    """Effective draws of (chains, draws, n)."""
    correlations = autocorrelation(corners)
    total = 0.0
    for lag in range(0, len(correlations) - 1, 2):
        pair = correlations[lag] + correlations[lag + 1]
        if pair <= 0.0:
            break
        total += 2.0 * pair
    return float(corners.shape[0] * corners.shape[1] / max(total - 1.0, 1.0 / corners.shape[1]))
