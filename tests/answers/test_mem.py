"""Claim: a memoised function is called once for each value of its arguments in a run, by every method and whoever asks
first.

Each program has an answer that can be written down. Exact methods must give it to 1e-9; shares of samples are compared
with their errors. A z-score passes 5 by chance once in 1.7 million looks, and fewer than 60 are taken: a re-seeded
board fails once in 29,000 runs. A machine that draws anew at each call, or has a call for each caller, gives the urn
another answer; these are mutants (`memo-draws-anew`, `memo-by-caller` in `tests/mutants`).
"""

from __future__ import annotations

import math
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import kernels, mem, model
from niwaki.errors import ModelFault, NiwakiError
from niwaki.words import Bernoulli, Gaussian, infer

#: Strategies of chains, as in the engine.
STRATEGIES = ("c3", "rerun", "resume", "cache")

RED = 0.3


@mem
def is_red(ball):
    return nw.flip(RED)


def look(ball):
    return is_red(ball)


@model
def urn():
    """Two draws with replacement from three balls of unknown colours, of the same colour."""
    first, second = nw.discrete_uniform(1, 3), nw.discrete_uniform(1, 3)
    nw.condition(look(first) == is_red(second))
    return first == second


#: The two are the same ball in 3 of 9 pairs; two different ones have the same colour with this probability.
ALIKE = RED**2 + (1 - RED) ** 2
SAME_BALL = 3 / (3 + 6 * ALIKE)


@model
def readers():
    """A coin that two futures and the model itself read, each after a barrier of its own."""

    def read(n):
        nw.factor(0.1 * n)
        return is_red(7)

    one, two = nw.future(read, 1), nw.future(read, 2)
    own = is_red(7)
    nw.factor(0.5 if own else 0.0)
    return (own, nw.force(one), nw.force(two))


@mem
def strange(n):
    """Chinese restaurant of two tables by recursion: each sits where one before sits, or is flipped anew."""
    if n == 0 or nw.flip(0.5):
        return nw.flip(0.5)
    return strange(nw.discrete_uniform(0, n - 1))


@model
def tables():
    a, b, c = strange(2), strange(1), strange(0)
    nw.observe(Bernoulli(0.9 if a == b else 0.2), True)
    return (a, b, c)


def exact_tables() -> dict[tuple[bool, bool, bool], float]:
    """By hand: 1 copies 0 or is flipped, 2 copies one of both or is flipped."""
    table: dict[tuple[bool, bool, bool], float] = {}
    for a in (False, True):
        for b in (False, True):
            for c in (False, True):
                of_b = 0.25 + 0.5 * (b == c)
                of_a = 0.25 + 0.25 * (a == b) + 0.25 * (a == c)
                table[a, b, c] = 0.5 * of_b * of_a * (0.9 if a == b else 0.2)
    total = math.fsum(table.values())
    return {value: share / total for value, share in table.items()}


def painter():
    p = 0.2 + 0.6 * nw.flip(0.5)

    def paint(_):
        return nw.flip(p)

    return mem(paint)


def differs(color):
    return color(1) == color(1) and color(1) != color(2)


@model
def closures():
    """Two memoised functions from one line of a function, whose calls differ; each captures a choice."""
    one, two = painter(), painter()
    return differs(one) and differs(two)


#: Of two independent flips, whatever p is: 2 * 0.2 * 0.8.
CLOSURES = 0.32**2

EXACT: dict[str, tuple[Any, dict[Any, float]]] = {
    "urn": (urn, {True: SAME_BALL, False: 1 - SAME_BALL}),
    "readers": (
        readers,
        {
            (True, True, True): 0.3 * math.exp(0.5) / (0.3 * math.exp(0.5) + 0.7),
            (False, False, False): 0.7 / (0.3 * math.exp(0.5) + 0.7),
        },
    ),
    "tables": (tables, exact_tables()),
    "closures": (closures, {True: CLOSURES, False: 1 - CLOSURES}),
}

SAMPLERS: dict[str, nw.methods.Method] = {
    "rejection": nw.rejection(4000, 0.9),
    "importance": nw.importance(6000),
    "particles": nw.smc(20, populations=300),
    "particles in program order": nw.smc(20, order="depth-first", populations=300),
    "particles, moved": nw.smc(10, populations=300, rejuvenate=kernels.prior()),
}


@pytest.mark.parametrize("name", EXACT)
def test_enumeration_gives_the_answer(name: str) -> None:
    program, truth = EXACT[name]
    distribution = nw.run(program, nw.enumerate_all()).distribution()
    assert distribution == pytest.approx(truth, abs=1e-9)


def z_scores(result: Any, truth: dict[Any, float], size: int = 1) -> list[float]:
    """How far shares are from the truth, in standard errors of independent groups of samples."""
    weights = np.exp([sample.log_weight for sample in result])
    scores = []
    for value, share in truth.items():
        hits = weights * np.array([sample.value == value for sample in result])
        groups = hits.reshape(-1, size).sum(axis=1) - share * weights.reshape(-1, size).sum(axis=1)
        scores.append(groups.mean() / max(groups.std() / math.sqrt(len(groups)), 1e-12))
    return scores


@pytest.mark.parametrize("method", SAMPLERS)
@pytest.mark.parametrize("name", EXACT)
def test_samples_follow_the_answer(name: str, method: str) -> None:
    program, truth = EXACT[name]
    result = nw.run(program, SAMPLERS[method], seed=5, threads=1)
    assert {sample.value for sample in result if sample.log_weight > -math.inf} <= set(truth)
    assert max(map(abs, z_scores(result, truth, 20 if "particles" in method else 1))) < 5


@pytest.mark.parametrize("name", EXACT)
def test_chains_follow_the_answer(name: str) -> None:
    """Shares of 40 stretches of one chain, with their standard error."""
    program, truth = EXACT[name]
    moves = kernels.mixture(kernels.prior(), kernels.neighbour(), kernels.regenerate(1))
    result = nw.run(program, nw.mh(44_000, kernel=moves, warmup=4000, thin=10, keep=4000), seed=3)
    values = [sample.value for sample in result.samples][-4000:]
    for value, share in truth.items():
        means = np.array([found_value == value for found_value in values], float).reshape(40, -1).mean(axis=1)
        assert abs(means.mean() - share) < 6 * means.std() / math.sqrt(39), (value, means.mean(), share)


@pytest.mark.parametrize("name", EXACT)
def test_strategies_give_the_same_chain(name: str) -> None:
    program, _ = EXACT[name]
    runs = {
        strategy: nw.run(program, nw.mh(300, strategy=strategy, thin=1, keep=300), seed=2)
        for strategy in STRATEGIES
    }
    seen = {
        key: [(s.value, s.log_prior, s.log_score, s.choices) for s in run.samples]
        for key, run in runs.items()
    }
    assert all(chain == seen["rerun"] for chain in seen.values())


# continuous


@mem
def offset(group):
    return nw.gaussian(0.0, 1.0)


GROUPS, SEEN = (0, 1, 1, 2), (0.5, 1.5, 1.0, -0.5)


@model
def hierarchy():
    """Groups with a mean of their own around a common one, which closures capture."""
    mu = nw.gaussian(0.0, 2.0)

    def own(group):
        return nw.gaussian(mu, 1.0)

    mean = mem(own)
    for group, y in zip(GROUPS, SEEN):  # noqa: B905
        nw.observe(Gaussian(mean(group), 0.5), y)
    return mu


def exact_mu() -> tuple[float, float]:
    """Mean and standard deviation of mu: each group's mean of data has variance 1 + 0.25 / n around it."""
    precision, total = 0.25, 0.0
    for group in set(GROUPS):
        data = [y for g, y in zip(GROUPS, SEEN, strict=True) if g == group]
        variance = 1.0 + 0.25 / len(data)
        precision += 1 / variance
        total += sum(data) / len(data) / variance
    return total / precision, precision**-0.5


def test_gradients_follow_what_a_memoised_function_captures() -> None:
    mean, sd = exact_mu()
    result = nw.run(hierarchy, nw.nuts(4000, warmup=500), seed=1)
    values = np.array([sample.value for sample in result.samples])
    stretches = values.reshape(40, -1).mean(axis=1)
    assert abs(values.mean() - mean) < 6 * stretches.std() / math.sqrt(39)
    assert values.std() == pytest.approx(sd, rel=0.15)


def test_a_chain_moves_what_a_memoised_function_captures() -> None:
    mean, _ = exact_mu()
    result = nw.run(hierarchy, nw.mh(84_000, kernel=kernels.drift(), warmup=4000, thin=20, keep=4000), seed=4)
    values = np.array([sample.value for sample in result.samples])[-4000:]
    stretches = values.reshape(40, -1).mean(axis=1)
    assert abs(values.mean() - mean) < 6 * stretches.std() / math.sqrt(39)


@model
def by_a_moving_argument():
    x = nw.gaussian(0.0, 1.0)
    return offset(x)


def test_an_argument_that_follows_a_gradient_is_refused() -> None:
    with pytest.raises(NiwakiError) as caught:
        nw.run(by_a_moving_argument, nw.hmc(5, warmup=5), seed=1)
    assert caught.value.code == "memo-argument-varies"
    # Other methods exchange the call's choices together with the argument.
    assert len(nw.run(by_a_moving_argument, nw.mh(50), seed=1).samples) > 0


# addresses


def test_a_call_has_an_address_of_its_own() -> None:
    plain = nw.run_python(urn, seed=4)
    assert {name for name in plain.choices if name.startswith("is_red(")} <= {
        f"is_red({k})/bernoulli" for k in (1, 2, 3)
    }
    sample = nw.run(urn, nw.rejection(1), seed=4).best
    assert nw.run_python(urn, choices=sample.choices).value == sample.value


def test_a_call_can_be_held() -> None:
    held = {"is_red(2)/bernoulli": True}
    distribution = nw.run(urn, nw.enumerate_all(), hold=held).distribution()
    # The second ball is asked for, and red: 1 of 9 pairs is (2, 2), 4 have one 2 and another ball that must be red.
    assert distribution[True] == pytest.approx(1 / (1 + 4 * RED), abs=1e-9)


# refused


def test_what_is_no_argument_is_refused_in_both() -> None:
    @model
    def m():
        return is_red(lambda: 3)

    for run in (lambda: nw.run_python(m, seed=1), lambda: nw.run(m, nw.forward(1), seed=1)):
        with pytest.raises(ModelFault) as caught:
            run()
        assert caught.value.code == "memo-argument"


@mem
def round_and_round(n):
    return nw.flip(0.5) and round_and_round(1 - n)


def test_a_call_that_needs_itself_is_refused_in_both() -> None:
    @model
    def m():
        return round_and_round(0) and round_and_round(0)

    choices = {"round_and_round(0)/bernoulli": True, "round_and_round(1)/bernoulli": True}
    with pytest.raises(ModelFault) as caught:
        nw.run_python(m, choices=choices)
    assert caught.value.code == "memo-cycle"
    for method in (nw.smc(50), nw.mh(200), nw.importance(50), nw.enumerate_all()):
        with pytest.raises(ModelFault) as caught:
            nw.run(m, method, seed=1)
        assert caught.value.code == "memo-cycle"


def test_a_memoised_function_is_not_given_to_an_inner_search() -> None:
    def inner(f):
        return f(1)

    @model
    def m():
        def paint(_):
            return nw.flip(0.5)

        return infer(inner, nw.forward(), mem(paint))

    for run in (lambda: nw.run_python(m, seed=1), lambda: nw.run(m, nw.forward(1), seed=1)):
        with pytest.raises(ModelFault) as caught:
            run()
        assert caught.value.code == "memo-outside"


def test_parts_of_a_model_with_memoised_functions_are_not_grown_again() -> None:
    with pytest.raises(NiwakiError) as caught:
        nw.run(urn, nw.mh(50, kernel=kernels.regrow(3)), seed=1)
    assert caught.value.code == "memo-regrow"
