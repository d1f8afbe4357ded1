"""A hidden Markov chain of 100 steps: the model of `webppl/hmm.wppl` and `limit/src/hmm.rs`.

The distributions are built once, outside the model. Two variants, which should cost about the same.
"""

import data
from niwaki import model, observe, sample
from niwaki.words import Categorical

CHAIN = data.hmm()
OBSERVATIONS = CHAIN["observations"]
STEPS = len(OBSERVATIONS)
INITIAL = Categorical(CHAIN["initial"])
TRANSITION = [Categorical(row) for row in CHAIN["transition"]]
EMISSION = [Categorical(row) for row in CHAIN["emission"]]


@model
def loop():
    """The last state, by a loop."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    for n in range(1, STEPS):
        state = sample(TRANSITION[state])
        observe(EMISSION[state], OBSERVATIONS[n])
    return state


@model
def recursive():
    """The last state, by recursion, as the WebPPL program is written."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    return later(1, state)


@model
def later(n, previous):
    """The last state, when step n - 1 was in `previous`."""
    if n == STEPS:
        return previous
    state = sample(TRANSITION[previous])
    observe(EMISSION[state], OBSERVATIONS[n])
    return later(n + 1, state)
