"""Checks of what is timed: marginals against forward-backward, scores against full evaluations.

A hidden Markov chain of 6 steps and 3 states is small enough for long chains: forty of them, started apart, give each
marginal with its standard error. The other programs have no such answer; there each total that the chain
carries along must be that of a fresh evaluation of the same choices, bit for bit, and the limit's local ratios must be
differences of its full densities.
"""

import statistics
from pathlib import Path

import numpy as np
from answers import hmm_marginals
from data import gmm, hlr, hmm, lda, save
from niwaki import mh, model, observe, run, sample
from niwaki.words import Categorical

from chains.peers import Peers
from chains.programs import PROGRAMS
from chains.report import Report

DATA = hmm(steps=6, states=3, symbols=3, seed=15)
SEEN = tuple(DATA["observations"])
INITIAL = Categorical(DATA["initial"])
TRANSITION = [Categorical(row) for row in DATA["transition"]]
EMISSION = [Categorical(row) for row in DATA["emission"]]
CHAINS = 40
# Quantile of the t distribution with 39 degrees of freedom, both sides, for a false alarm in ten thousand among the
# eighteen marginals.
ALLOWED = 5.4


@model
def small():
    """The states of six steps."""
    state = sample(INITIAL)
    observe(EMISSION[state], SEEN[0])
    states = [state]
    for n in range(1, 6):
        state = sample(TRANSITION[state])
        observe(EMISSION[state], SEEN[n])
        states = states + [state]
    return states


def marginals(proposals: int, strategy: str = "c3") -> np.ndarray:
    """Shares of the states, (chains, steps, states)."""
    method = mh(steps=proposals, strategy=strategy, chains=CHAINS, warmup=500, thin=25)
    draws = run(small, method=method, seed=7, threads=1).by_chain
    shares = np.zeros((CHAINS, 6, 3))
    for chain, samples in enumerate(draws):
        values = np.array([list(sample.value) for sample in samples])
        for state in range(3):
            shares[chain, :, state] = (values == state).mean(axis=0)
    return shares


def off(shares: np.ndarray) -> float:
    """The most standard errors that a marginal lies from the answer."""
    error = shares.std(axis=0, ddof=1) / np.sqrt(len(shares))
    return float(np.abs((shares.mean(axis=0) - hmm_marginals(DATA)) / error).max())


def bits_apart(name: str, states: int) -> float:
    """The largest difference between a total that a chain carried along and a fresh evaluation, nats."""
    program, worst = PROGRAMS[name], 0.0
    count = program.count(1)
    method = mh(steps=1, keep=0, kernel=program.kernel(count))
    result = run(program.model, count, method=method, seed=3, threads=1)
    for _ in range(states):
        now = result.more(100).last[0]
        fresh = run(program.model, count, choices=now.choices).best
        worst = max(worst, abs(now.log_score - fresh.log_score), abs(now.log_prior - fresh.log_prior))
    return worst


def check(report: Report, peers: Peers, folder: Path, quick: bool) -> None:
    """Check all answers."""
    deviation = off(marginals(2_000 if quick else 12_000))
    report.answer("HMM marginals, standard errors from forward-backward", deviation, ALLOWED)
    for name in PROGRAMS:
        states = 5 if quick else 50
        report.answer(f"{name}: carried score less a fresh one, nats", bits_apart(name, states), 0.0)
    data = {"hmm": DATA, "lda": lda(), "gmm": gmm(), "hlr": hlr()}
    for name, values_of in data.items():
        path = save(folder / f"{name}-check.json", values_of)
        checked = peers.of_limit("check", name, path, 0, 2)
        report.answer(f"{name}, limit: local ratios, relative error", checked["worst"], 1e-7)
        if name == "hmm":
            exact = hmm_marginals(DATA).ravel()
            worst = max(abs(a - b) for a, b in zip(checked["moments"], exact, strict=True))
            report.answer("HMM, limit: marginals of two million proposals", worst, 0.01)
        if name == "hlr":
            report.answer(
                "HLR: means of global choices less the limit's, standard errors",
                regression(checked["moments"], quick),
                6.0,
            )


def regression(limit: list[float], quick: bool) -> float:
    """The most standard errors that our posterior means lie from the limit's, which are counted as exact.

    Twenty chains; 6 is generous for what is left of the limit's own error.
    """
    program = PROGRAMS["hlr"]
    steps = 40_000 if quick else 120_000
    method = mh(steps=steps, warmup=steps // 5, thin=200, chains=20, kernel=program.kernel(20))
    draws = run(program.model, 20, method=method, seed=9, threads=1).by_chain
    means = np.array([np.mean([sample.value[0] for sample in samples], axis=0) for samples in draws])
    error = means.std(axis=0, ddof=1) / np.sqrt(len(means))
    return float(np.abs((means.mean(axis=0) - np.array(limit)) / error).max())


#: Quantiles of the t distribution for a 95 % interval, by number of runs.
QUANTILES = {2: 12.706, 3: 4.303, 20: 2.093}


def spread(values: list[float]) -> float:
    """Half the width of a 95 % interval for the mean of 2, 3 or 20 runs, by Student's t."""
    return QUANTILES[len(values)] * statistics.stdev(values) / len(values) ** 0.5
