"""The reference answers of the benches are right: by counting, or by plain simulation."""

import itertools
import math

import answers
import data
import numpy as np


def test_the_chain_does_not_depend_on_the_machine():
    chain = data.hmm()
    assert chain["observations"][:8] == [6, 4, 3, 1, 4, 9, 4, 0]
    assert len(chain["observations"]) == 100
    assert all(
        abs(sum(row) - 1) < 1e-12 for row in [chain["initial"], *chain["transition"], *chain["emission"]]
    )


def test_forward_pass_is_the_sum_over_all_paths():
    chain = data.hmm(steps=4, states=3, symbols=3, seed=15)
    total = 0.0
    for path in itertools.product(range(3), repeat=4):
        weight = chain["initial"][path[0]]
        for before, after in itertools.pairwise(path):
            weight *= chain["transition"][before][after]
        for state, seen in zip(path, chain["observations"], strict=True):
            weight *= chain["emission"][state][seen]
        total += weight
    assert math.isclose(answers.hmm(chain), math.log(total), abs_tol=1e-12)


def test_marginals_are_shares_of_all_paths():
    chain = data.hmm(steps=4, states=3, symbols=3, seed=15)
    sums, total = np.zeros((4, 3)), 0.0
    for path in itertools.product(range(3), repeat=4):
        weight = chain["initial"][path[0]]
        for before, after in itertools.pairwise(path):
            weight *= chain["transition"][before][after]
        for state, seen in zip(path, chain["observations"], strict=True):
            weight *= chain["emission"][state][seen]
        total += weight
        for step, state in enumerate(path):
            sums[step, state] += weight
    assert np.allclose(answers.hmm_marginals(chain), sums / total, atol=1e-14)


def test_quadrature_meets_simulated_trees():
    # Trees of at most two segments in a row: the mean weight of 400,000, within 4.4 standard errors (false
    # alarm 1e-5) and the table's own error, which size 121 keeps below 1e-3 at this depth.
    random, count = np.random.default_rng(5), 400_000

    def segment(x, y, heading, depth):
        angle = random.normal(heading, 0.3)
        length = random.uniform(0.5, 1.5, count)
        x, y = x + length * np.cos(angle), y + length * np.sin(angle)
        error = (np.hypot(x, y) - (depth + 1)) / 1.5
        return x, y, angle, np.exp(0.35 - 0.5 * error**2)

    x, y, angle, first = segment(np.zeros(count), np.zeros(count), np.zeros(count), 0)
    left, right, straight = (segment(x, y, angle + turn, 1)[3] for turn in (0.5, -0.5, 0.0))
    weights = first * np.where(random.random(count) < 0.7, left * right, straight)
    allowed = 4.4 * weights.std() / math.sqrt(count) + 1e-3
    answer = math.exp(answers.quadrature(121, deepest=1))
    assert abs(answer - weights.mean()) < allowed
    # Mutants: a program that never forks, and one that leaves the last factor out.
    assert abs(answer - (first * straight).mean()) > allowed
    assert abs(answer - first.mean()) > allowed
