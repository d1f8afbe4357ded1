"""Claim: annealed importance sampling gives the evidence of conjugate models, follows their posteriors and those of
finite programs whose structure changes, by any kernel. Its settings are held. A search that was stopped gives what it
has.

The evidence is judged by the mean weight and its standard error over particles, within 4.5 of them: once in 150,000 a
true mean is not, and about ten are judged. The engine's tests (`crates/search/tests/methods/annealed.rs`) have its
unbiasedness over many searches, and mutants.
"""

from __future__ import annotations

import math
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from conjugate_line import X, Y, line, line_answers
from niwaki import flip, infer, kernels, model
from niwaki.errors import NiwakiError


@model
def branching():
    """Structure that changes, and runs that are impossible."""
    n = nw.discrete_uniform(0, 3)
    total = 0
    for _ in range(n):
        total = total + (1 if flip(0.4) else 0)
    nw.condition(total > 0)
    nw.factor(1.7 * total - 0.5 * n)
    return total


def judged(result: Any, truth: float) -> float:
    """By how many standard errors the mean weight is off."""
    weights = np.exp([sample.log_weight - truth for sample in result])
    error = weights.std(ddof=1) / math.sqrt(len(weights))
    return float(abs(weights.mean() - 1.0) / error)


KERNELS = {
    "prior": None,
    "drift": kernels.drift(0.3),
    "block": kernels.block(0.2),
    "hmc": kernels.hmc_step(5, step=0.2),
    "cycle": kernels.cycle(kernels.on("slope", kernels.drift(0.2)), kernels.prior()),
}


@pytest.mark.parametrize("name", KERNELS)
def test_the_evidence_of_a_line(name: str) -> None:
    result = nw.run(line, X.tolist(), Y.tolist(), method=nw.ais(400, 60, KERNELS[name], moves=5), seed=3)
    assert result.log_evidence is not None and result.info.tries == 400
    assert judged(result, line_answers()[0]) < 4.5
    assert math.log(np.mean(np.exp([sample.log_weight for sample in result]))) == pytest.approx(
        result.log_evidence
    )
    assert result.info.effective > 100 and result.info.moved.proposed > 0 and len(result.info.powers) == 60


def test_a_ladder_beats_none() -> None:
    """With as many runs the weights of likelihood weighting have collapsed."""
    plain = nw.run(line, X.tolist(), Y.tolist(), method=nw.importance(400), seed=3)
    weights = np.exp([sample.log_weight for sample in plain])
    assert weights.sum() ** 2 / (weights**2).sum() < 40


@pytest.mark.parametrize("kernel", [None, kernels.neighbour(), kernels.regenerate(1), kernels.regrow(3)])
def test_structure_that_changes(kernel: Any) -> None:
    exact = nw.run(branching, nw.enumerate_all())
    result = nw.run(branching, nw.ais(3000, (0.2, 0.6, 1), kernel, moves=3), seed=5)
    # The share of possible runs is one number for all particles, so its error is added: (1 - p) / (n p).
    possible = 3000 / result.info.tries
    weights = np.exp([sample.log_weight - exact.log_evidence for sample in result])
    error = math.sqrt((weights.var() + (1 - possible)) / len(weights))
    assert abs(weights.mean() - 1.0) < 4.5 * error
    for value, share in exact.distribution().items():
        share_weights = weights * [sample.value == value for sample in result]
        error = math.sqrt((share_weights.var() + share * share * (1 - possible)) / len(share_weights))
        assert abs(share_weights.mean() - share) < 4.5 * error, value


def test_inside_a_model() -> None:
    """The value of one particle, drawn by weight; its share over 600 seeds within 4.9 standard errors."""

    @model
    def heads():
        up = flip(0.3)
        nw.factor(0.0 if up else -1.5)
        return up

    @model
    def outer():
        return infer(heads, nw.ais(20, 4, moves=2))

    exact = 0.3 / (0.3 + 0.7 * math.exp(-1.5))
    values = [sample.value for sample in nw.run(outer, nw.forward(600), seed=5, threads=1)]
    assert abs(sum(values) / 600 - exact) < 4.9 * math.sqrt(exact * (1 - exact) / 600)


def test_threads_do_not_matter() -> None:
    first, second = (nw.run(branching, nw.ais(50, 5), seed=2, threads=threads) for threads in (1, 2))
    assert first.log_evidence == second.log_evidence
    assert [sample.choices for sample in first] == [sample.choices for sample in second]


def test_ctrl_c_gives_what_there_is() -> None:
    def press(progress: nw.result.Progress) -> None:
        if progress.done > 0:
            raise KeyboardInterrupt

    result = nw.run(line, X.tolist(), Y.tolist(), method=nw.ais(10**5, 100), seed=1, progress=press)
    assert result.interrupted and 0 < len(result) < 10**5 and result.log_evidence is None


@pytest.mark.parametrize(
    ("name", "make"),
    [
        ("particles", lambda: nw.ais(1)),
        ("powers", lambda: nw.ais(powers=0)),
        ("powers", lambda: nw.ais(powers=(0.5, 0.2, 1))),
        ("powers", lambda: nw.ais(powers=(0.5, 2))),
        ("powers", lambda: nw.ais(powers=())),
        ("moves", lambda: nw.ais(moves=0)),
        ("kernel", lambda: nw.ais(kernel=3)),  # type: ignore[arg-type]
        ("kernel", lambda: nw.ais(kernel=kernels.tempering(kernels.prior()))),
        ("kernel", lambda: nw.ais(kernel=kernels.anneal(kernels.prior(), steps=9, start=0.1))),
    ],
)
def test_settings_are_held(name: str, make: Any) -> None:
    with pytest.raises(NiwakiError, match=f"`{name}`"):
        make()


def test_a_search_is_a_value() -> None:
    search = nw.Search(branching, method=nw.ais(30, (0.1, 1), kernels.neighbour()), seed=4)
    again = nw.Search.of_json(search.json("inside"))
    assert again.method == search.method
    assert again.run().log_evidence == search.run().log_evidence


def test_a_pattern_that_matches_nothing_is_an_error() -> None:
    with pytest.raises(NiwakiError, match="slop"):
        nw.run(
            line, X.tolist(), Y.tolist(), method=nw.ais(kernel=kernels.on("slop", kernels.drift())), seed=1
        )
