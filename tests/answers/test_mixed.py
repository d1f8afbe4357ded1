"""Claim: chains whose discrete choices move by Metropolis-Hastings and whose continuous ones move along their gradient
draw from the model's distribution, where both decide the structure.

A mixture whose number of components, labels and means are random is conjugate given the labels, so that every labelling
of every number of components can be summed: the exact probabilities of the numbers, of two points sharing a component,
and the exact means of two functions of the means. Each is compared with 40 stretches of a chain of 30,000 proposals
after a warm-up; |t| with 39 degrees of freedom passes 6 once in two million, and some 60 are looked at: a re-seeded
board fails once in 35,000 runs. The mutants that must be rejected are in `crates/search/tests/chain/mixed.rs`.
"""

from __future__ import annotations

import itertools
import math

import niwaki as nw
import numpy as np
import pytest
from niwaki import kernels as k
from niwaki import model
from niwaki.words import Gaussian

DATA = [-0.8, -0.4, 0.9, 0.2]
SHARES, WIDE, NARROW = [0.3, 0.4, 0.3], 2.0, 0.5


@model
def components(data):
    count = 1 + nw.categorical([0.3, 0.4, 0.3])
    means = [nw.gaussian(0.0, 2.0) for _ in range(count)]
    labels = []
    for y in data:
        label = nw.discrete_uniform(0, count - 1)
        nw.observe(Gaussian(means[label], 0.5), y)
        labels = labels + [label]
    return (count, labels[0] == labels[1], means[0], means[labels[2]])


def exact() -> dict[str, float]:
    """Sums over all labellings; the means given one are normal and independent."""
    total: dict[str, float] = {}
    evidence = 0.0
    for count, share in enumerate(SHARES, start=1):
        for labels in itertools.product(range(count), repeat=len(DATA)):
            log, means = math.log(share) - len(DATA) * math.log(count), []
            for group in range(count):
                data = [y for y, label in zip(DATA, labels, strict=True) if label == group]
                precision = 1 / WIDE**2 + len(data) / NARROW**2
                mean = sum(data) / NARROW**2 / precision
                log += -0.5 * math.log(precision * WIDE**2) + 0.5 * precision * mean**2
                means.append((mean, 1 / precision))
            weight = math.exp(log)
            evidence += weight
            third, variance = means[labels[2]]
            values = {
                f"count {count}": 1.0,
                "together": float(labels[0] == labels[1]),
                "first": means[0][0],
                "third": third,
                "third^2": third**2 + variance,
            }
            for name, value in values.items():
                total[name] = total.get(name, 0.0) + weight * value
    return {name: value / evidence for name, value in total.items()}


def seen(sample: nw.Sample) -> dict[str, float]:
    count, together, first, third = sample.value
    hits = {f"count {n}": float(count == n) for n in (1, 2, 3)}
    return hits | {"together": float(together), "first": first, "third": third, "third^2": third**2}


KERNELS = {
    "hmc": k.cycle(k.prior(), k.prior(), k.hmc_step(steps=5, jitter=0.4)),
    "nuts": k.cycle(k.prior(), k.repeat(2, k.prior()), k.nuts_step(max_depth=4)),
    "discrete by mh, means by hmc": k.cycle(
        k.repeat(3, k.on(["count", "label"], k.prior())),
        k.on("means", k.hmc_step(steps=6)),
    ),
    "mixture": k.mixture(k.prior(), k.hmc_step(steps=4), k.regenerate(), weights=[3, 1, 1]),
    "temper": k.tempering(k.cycle(k.prior(), k.prior(), k.hmc_step(steps=5)), (1, 1 / 3, 1 / 9), every=20),
}


@pytest.mark.parametrize("name", KERNELS)
def test_mixed_chains_answer_as_sums_over_labellings_do(name: str) -> None:
    answers = exact()
    result = nw.run(components, nw.mh(steps=33_000, warmup=3_000, thin=3, kernel=KERNELS[name]), DATA, seed=8)
    rows = [seen(sample) for sample in result]
    for key, answer in answers.items():
        values = np.array([row[key] for row in rows])
        stretches = np.array([part.mean() for part in np.array_split(values, 40)])
        t = (stretches.mean() - answer) / max(stretches.std(ddof=1) / math.sqrt(40), 1e-4)
        assert abs(t) < 6, (key, answer, values.mean(), t)
    (trajectories,) = result.trajectories
    assert trajectories.gradients > 3 * trajectories.moved > 3000
    assert trajectories.structures > 20 and trajectories.unwritten == 0
    assert 0.5 < trajectories.acceptance < 0.99 and trajectories.divergences.not_finite == 0
