"""Gradients go through an `infer` by enumeration: its probabilities are functions of the choices outside.

For models of different shape, the density equals the engine's log joint at the same choices, to its grid. The gradient
equals central differences of the engine's log joint, which do not use the recording; so does the gradient of machine
code. Chains and normals that follow the gradient are compared with quadrature of the log joint.

The mutant forgets that the normaliser of the inner distribution varies (`nested-gradient-fixed-normaliser`).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import enumerate_all, flip, infer, model
from niwaki.errors import NiwakiError
from niwaki.words import Bernoulli, Binomial, DiscreteUniform, Gaussian, Mixture

DATA = (True, False, True, True)
WORLDS = (0, 1, 2, 3)


def meaning(word, world):
    if word == 0:
        return world == 0
    if word == 1:
        return world > 0
    return world == 3


def literal(word, share):
    world = nw.categorical([share, 0.2, 0.2, 0.3])
    nw.condition(meaning(word, world))
    return world


def speaker(world, rationality, share):
    word = nw.discrete_uniform(0, 2)
    nw.condition(meaning(word, world))
    for found, p in infer(literal, enumerate_all(), word, share):
        if found == world:
            nw.factor(rationality * math.log(p))
    return word


def listener(word, rationality, share):
    world = nw.discrete_uniform(0, 3)
    for found, p in infer(speaker, enumerate_all(), world, rationality, share):
        if found == word:
            nw.factor(math.log(p))
    return world


@model
def implicature():
    """A scalar implicature: what `some` means to one who knows a rational speaker; nested three times."""
    rationality = math.exp(nw.gaussian(0.5, 0.5))
    share = math.exp(nw.gaussian(-1.0, 0.3))
    for world, p in infer(listener, enumerate_all(), 1, rationality, share):
        if world == 3:
            nw.observe(Bernoulli(p), False)


@model
def data_inside():
    """The posterior of a coin's kind after data, of a prior from outside."""
    x = nw.gaussian(0, 1)
    prior = 1 / (1 + math.exp(-x))

    def kind():
        fair = flip(prior)
        for y in DATA:
            nw.observe(Bernoulli(0.5 if fair else 0.9), y)
        return fair

    for fair, p in infer(kind, enumerate_all()):
        if fair:
            nw.factor(3 * math.log(p))


@model
def factor_inside():
    """A factor of outer values, of two choices."""
    x = nw.gaussian(0, 1)
    y = nw.gaussian(0, 2)

    def grid(strength):
        a, b = nw.discrete_uniform(0, 2), flip(0.3)
        nw.factor(strength * a * x - (y - a) ** 2 * (0.5 if b else 0.1))
        return a + (1 if b else 0)

    for value, p in infer(grid, enumerate_all(), 0.7):
        nw.factor(value * p)


@model
def parameter_of_an_observation():
    """A probability is the parameter of an observation outside."""
    x = nw.gaussian(0, 1)

    def pair():
        a, b = flip(1 / (1 + math.exp(-x))), flip(0.4)
        nw.factor(1.5 * x if a and b else 0.0)
        return a or b

    for value, p in infer(pair, enumerate_all()):
        if value:
            for y in DATA:
                nw.observe(Bernoulli(p), y)


@model
def expectation():
    """The mean of an inner distribution is observed with noise."""
    rate = nw.gaussian(0, 1)

    def count():
        return nw.binomial(5, 1 / (1 + math.exp(-rate)))

    nw.observe(Gaussian(sum([n * p for n, p in infer(count, enumerate_all())]), 0.5), 3.4)


@model
def marginal():
    """A draw of the inner distribution, and what it leads to."""
    x = nw.gaussian(0, 1)

    def three():
        k = nw.discrete_uniform(0, 2)
        nw.factor(k * x)
        return k

    values = infer(three, enumerate_all())
    weights = [p for _, p in values]
    k = values[nw.categorical(weights)][0]
    nw.observe(Gaussian(k * 1.0, 0.7), 1.4)


@model
def support_changes():
    """Comparisons of outer values decide which inner runs are possible."""
    x = nw.gaussian(0, 1)

    def ladder():
        k = nw.discrete_uniform(0, 5)
        nw.condition(k == 0 or k < 3 + x)
        nw.factor(0.3 * k * x)
        return k % 3

    nw.factor(sum([k * p for k, p in infer(ladder, enumerate_all())]))


@model
def values_vary():
    """The values of the inner model are numbers of the outer one; two of them are clipped to the same."""
    x = nw.gaussian(0, 1)

    def scaled():
        k = nw.discrete_uniform(0, 4)
        nw.factor(0.2 * k)
        return min(k * x, 1.5)

    total = 0.0
    for value, p in infer(scaled, enumerate_all()):
        total = total + value * p * p
    nw.observe(Gaussian(total, 0.3), 0.4)


@model
def hidden_states():
    """A hidden chain of three states, its transitions from outside."""
    stay = 1 / (1 + math.exp(-nw.gaussian(0, 1)))
    spread = math.exp(nw.gaussian(0, 0.3))

    def states():
        s = 0
        for y in (0.1, 0.9, 1.2):
            s = s if flip(stay) else 1 - s
            nw.observe(Gaussian(s * 1.0, spread), y)
        return s

    for s, p in infer(states, enumerate_all()):
        if s == 1:
            nw.factor(2 * math.log(p))


@model
def the_most_probable():
    """The first of the list, which is another one from some point on."""
    x = nw.gaussian(0, 1)

    def two():
        return flip(1 / (1 + math.exp(-x)))

    best, p = infer(two, enumerate_all())[0]
    nw.factor((2.0 if best else 1.0) * p)


@model
def mixtures_and_weights():
    """Weights of a mixture and of a table from outside."""
    x = nw.gaussian(0, 1)

    def drawn():
        k = nw.sample(Mixture([1.0, math.exp(x)], [Binomial(3, 0.3), DiscreteUniform(2, 5)]))
        j = nw.categorical([1.0, max(x, 0.0), x * x])
        return (k + j) % 4

    for value, p in infer(drawn, enumerate_all()):
        nw.factor(0.5 * value * p)


@model
def invalid_inside():
    """Where a distribution inside is invalid, the run is impossible."""
    x = nw.gaussian(0, 1)

    def risky():
        k = nw.discrete_uniform(0, 2)
        return flip(0.2 + 0.35 * k + 0.1 * x)

    for value, p in infer(risky, enumerate_all()):
        if value:
            nw.factor(2 * p)


MODELS = (
    implicature,
    data_inside,
    factor_inside,
    parameter_of_an_observation,
    expectation,
    marginal,
    support_changes,
    values_vary,
    hidden_states,
    the_most_probable,
    mixtures_and_weights,
    invalid_inside,
)


def log_joint(of: Any, choices: dict[str, Any]) -> float:
    """The engine's own log joint."""
    return float(nw.run(of, choices=choices, threads=1).best.log_joint)


def differences(f: Callable[[np.ndarray], float], x: np.ndarray) -> np.ndarray:
    """Central differences, extrapolated once. The grid of scores has steps of 2^-32 nats."""
    gradient = []
    for k in range(len(x)):
        step = np.zeros_like(x)
        slopes = []
        for h in (1e-3, 5e-4):
            step[k] = h
            slopes.append((f(x + step) - f(x - step)) / (2 * h))
        gradient.append((4 * slopes[1] - slopes[0]) / 3)
    return np.array(gradient)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("of", MODELS, ids=lambda of: of.__name__)
def test_the_gradient_is_that_of_differences(of: Any, seed: int) -> None:
    sample = nw.run(of, seed=seed, threads=1).best
    density = nw.log_density(sample)
    assert all(choice.transform == "line" for choice in density.choices)

    def plain(x: np.ndarray) -> float:
        moved = {choice.name: float(x[choice.first]) for choice in density.choices}
        return log_joint(of, {**sample.choices, **moved})

    value, gradient = density.value_and_gradient(density.start)
    assert abs(value - sample.log_joint) < 1e-7 * max(1.0, abs(value))
    expected = differences(plain, density.start)
    assert np.allclose(gradient, expected, rtol=1e-5, atol=1e-5), (gradient, expected)
    # Machine code, and other points, some of them on other paths.
    density.compile()
    for shift in (0.0, -0.9, 0.4, 1.3):
        x = density.start + shift
        value, gradient = density.value_and_gradient(x)
        if np.isfinite(value):
            assert abs(value - plain(x)) < 1e-6 * max(1.0, abs(value)), (shift, value, plain(x))
            expected = differences(plain, x)
            assert np.allclose(gradient, expected, rtol=1e-4, atol=1e-4), (shift, gradient, expected)


def test_ties_of_a_symmetric_model_keep_their_order() -> None:
    """Values that are equally probable by symmetry are ranked as in a plain run, at every point and on one path."""

    @model
    def symmetric():
        x = nw.gaussian(0, 1)

        def pairs():
            a, b = flip(1 / (1 + math.exp(-x))), flip(1 / (1 + math.exp(-x)))
            return (a, b)

        for (a, _), p in infer(pairs, enumerate_all())[1:3]:
            nw.factor(p if a else 0.3 * p)

    density = nw.log_density(nw.run(symmetric, choices={"x": 0.7}).best)
    for x in np.linspace(0.1, 2.0, 40):
        value, _ = density.value_and_gradient([x])
        assert abs(value - log_joint(symmetric, {"x": x})) < 1e-7
    assert density.recordings == 1


def test_a_path_is_left_where_the_runs_change() -> None:
    """On either side of a bound other runs are possible: recorded again, with the values of a plain run."""
    density = nw.log_density(nw.run(support_changes, choices={"x": 0.5}).best)
    for x in (-0.5, 0.5, 1.5, -1.5, 0.6, -0.4):
        assert abs(density([x]) - log_joint(support_changes, {"x": x})) < 1e-7
    assert density.recordings == 4


def test_a_method_that_draws_is_refused_and_names_the_enumeration() -> None:
    @model
    def outer():
        x = nw.gaussian(0, 1)
        n = infer(literal, nw.importance(20), 1, math.exp(x))
        nw.factor(n * x)

    with pytest.raises(NiwakiError) as caught:
        nw.run(outer, nw.hmc(5, warmup=5), seed=1)
    assert caught.value.code == "no-derivative" and "enumerate_all()" in str(caught.value)


def test_a_method_that_draws_may_stand_beside_what_varies() -> None:
    """Where its arguments do not vary it is a constant, as it was."""

    @model
    def outer():
        x = nw.gaussian(0, 1)
        n = infer(literal, nw.importance(20), 1, 0.3)
        nw.factor(n * x)
        return n

    sample = nw.run(outer, seed=3).best
    assert nw.log_density(sample).value_and_gradient([0.4])[1][0] == pytest.approx(sample.value - 0.4)


def test_faults_inside_are_those_of_a_plain_run() -> None:
    @model
    def never():
        x = nw.gaussian(0, 1)

        def none():
            nw.condition(flip(1 / (1 + math.exp(-x))) and x > 1000)

        infer(none, enumerate_all())

    @model
    def many():
        x = nw.gaussian(0, 1)

        def loop():
            for _ in range(12):
                nw.factor(0.1 * x if flip(0.5) else 0.0)

        nw.factor(infer(loop, enumerate_all(max_runs=100))[0][1])

    for of, code in ((never, "infer-failed"), (many, "infer-failed")):
        with pytest.raises(NiwakiError) as plain:
            nw.run(of, nw.forward(1), seed=1)
        assert plain.value.code == code


def moments(of: Any, name: str, low: float, high: float) -> tuple[float, float, float]:
    """Mean, variance and log evidence of one choice, by quadrature of the engine's log joint."""
    x = np.linspace(low, high, 401)
    logs = np.array([log_joint(of, {name: float(at)}) for at in x])
    weights = np.exp(logs - logs.max())
    mean = float(np.average(x, weights=weights))
    evidence = logs.max() + math.log(weights.sum() * (x[1] - x[0]))
    return mean, float(np.average((x - mean) ** 2, weights=weights)), evidence


@pytest.mark.parametrize("of", [data_inside, expectation, support_changes], ids=lambda of: of.__name__)
@pytest.mark.parametrize(
    "method", [nw.hmc(1500, steps=8, warmup=300, chains=2), nw.nuts(1500, warmup=300, chains=2)]
)
def test_chains_follow_the_outer_posterior(of: Any, method: Any) -> None:
    """Means and second moments within 4.5 standard errors (twelve quantities: a false alarm once in 12,000)."""
    name = "rate" if of is expectation else "x"
    mean, variance, _ = moments(of, name, -7.0, 7.0)
    draws = np.asarray(nw.run(of, method, seed=4).draws[name])
    for values, truth in ((draws, mean), ((draws - mean) ** 2, variance)):
        # By batches, which counts the correlation of the draws.
        batches = values.reshape(-1, 50).mean(axis=1)
        error = batches.std(ddof=1) / math.sqrt(len(batches))
        assert abs(batches.mean() - truth) < 4.5 * error, (batches.mean(), truth, error)


@pytest.mark.filterwarnings("ignore:Pareto's k")
@pytest.mark.parametrize("of", [data_inside, expectation], ids=lambda of: of.__name__)
def test_normals_find_the_evidence(of: Any) -> None:
    """The evidence by weighed draws, against quadrature: tails heavier than a normal's weigh little here."""
    _, _, truth = moments(of, "rate" if of is expectation else "x", -8.0, 8.0)
    result = nw.run(of, nw.vi(draws=4000), seed=2)
    assert result.log_evidence is not None
    assert abs(result.log_evidence - truth) < 0.05, (result.log_evidence, truth)


def test_an_ascent_finds_the_top() -> None:
    """Chains that begin with an ascent come near the highest point of a grid."""
    x = np.linspace(-4, 4, 801)
    highest = max(log_joint(expectation, {"rate": float(at)}) for at in x)
    result = nw.run(expectation, nw.explore(chains=16), seed=1)
    assert highest - 0.05 < max(sample.log_joint for sample in result.samples) < highest + 1e-6
