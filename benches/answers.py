"""Answers computed without sampling; each timed run is compared with them.

The evidence of the particle programs, and the marginals of the hidden Markov chain.
"""

import math

import numpy as np

DEEPEST = 5


def hmm(chain: dict[str, list]) -> float:
    """Log probability of the observations, nats: the forward pass, exact."""
    forward, log_evidence = np.array(chain["initial"]), 0.0
    transition, emission = np.array(chain["transition"]), np.array(chain["emission"])
    for n, seen in enumerate(chain["observations"]):
        if n > 0:
            forward = forward @ transition
        forward = forward * emission[:, seen]
        log_evidence += math.log(forward.sum())
        forward = forward / forward.sum()
    return log_evidence


def hmm_marginals(chain: dict[str, list]) -> np.ndarray:
    """Probabilities of the states given all observations, (N, S): forward-backward, exact."""
    transition, emission = np.array(chain["transition"]), np.array(chain["emission"])
    seen = chain["observations"]
    forward = [np.array(chain["initial"]) * emission[:, seen[0]]]
    for symbol in seen[1:]:
        forward.append((forward[-1] / forward[-1].sum()) @ transition * emission[:, symbol])
    backward = [np.ones(len(transition))]
    for symbol in reversed(seen[1:]):
        later = transition @ (emission[:, symbol] * backward[-1])
        backward.append(later / later.sum())
    both = np.array(forward) * np.array(backward[::-1])
    return both / both.sum(axis=1, keepdims=True)


def branching() -> float:
    """Log evidence of the branching program, nats: good to 0.002.

    Linear interpolation errs with the square of the spacing, so two tables, one twice as fine, cancel it.
    """
    return (4 * quadrature(121) - quadrature(61)) / 3


def quadrature(size: int, deepest: int = DEEPEST) -> float:
    """Log evidence of the branching program with tables of `size` by `size`, nats.

    The value of a segment and all that grows from it depends on its depth and on where it starts seen from
    the origin: the distance r and the angle a between its heading and the direction away from the origin.
    With the end of the segment at (r', a'),

        Z_d(r, a) = E[w(r') (0.7 Z_{d+1}(r', a' + 0.5) Z_{d+1}(r', a' - 0.5) + 0.3 Z_{d+1}(r', a'))]

    and the bracket is 1 at the last depth. The expectation over the angle is Gauss-Hermite, over the length
    Gauss-Legendre; Z_{d+1} is read from a table with linear interpolation.
    """
    nodes, weights = np.polynomial.hermite_e.hermegauss(11)
    turns, turn_weights = 0.3 * nodes, weights / weights.sum()
    nodes, weights = np.polynomial.legendre.leggauss(7)
    lengths, length_weights = 1.0 + 0.5 * nodes, weights / weights.sum()
    reach = 1.5 * (deepest + 1)
    r, a = np.meshgrid(np.linspace(0, reach, size), np.linspace(-math.pi, math.pi, size), indexing="ij")
    later = np.ones_like(r)
    for depth in range(deepest, -1, -1):
        if depth == 0:
            r, a = np.zeros((1, 1)), np.zeros((1, 1))
        now = np.zeros_like(r)
        for turn, turn_weight in zip(turns, turn_weights, strict=True):
            for length, length_weight in zip(lengths, length_weights, strict=True):
                x, y = r + length * np.cos(a + turn), length * np.sin(a + turn)
                end, away = np.hypot(x, y), np.arctan2(y, x)
                angle = a + turn - away
                error = (end - (depth + 1)) / 1.5
                value = np.exp(0.35 - 0.5 * error**2)
                if depth < deepest:
                    fork = read(later, end, angle + 0.5, reach) * read(later, end, angle - 0.5, reach)
                    value = value * (0.7 * fork + 0.3 * read(later, end, angle, reach))
                now += turn_weight * length_weight * value
        later = now
    return float(np.log(later[0, 0]))


def read(table: np.ndarray, radius: np.ndarray, angle: np.ndarray, reach: float) -> np.ndarray:
    """Linear interpolation in a table over [0, reach] by one turn; angles wrap, in radians."""
    radii, angles = table.shape
    row = np.clip(radius / reach, 0, 1) * (radii - 1)
    column = ((angle + math.pi) % (2 * math.pi)) / (2 * math.pi) * (angles - 1)
    i, j = np.minimum(row.astype(int), radii - 2), np.minimum(column.astype(int), angles - 2)
    u, v = row - i, column - j
    near = table[i, j] * (1 - v) + table[i, j + 1] * v
    far = table[i + 1, j] * (1 - v) + table[i + 1, j + 1] * v
    return near * (1 - u) + far * u
