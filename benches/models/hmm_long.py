"""The hidden Markov chain with observations for 100,000 steps, as a `for`."""

from niwaki import model, observe, sample
from niwaki.gallery import data
from niwaki.words import Categorical

CHAIN = data.hidden_chain(100_000)
OBSERVATIONS = CHAIN.observations
INITIAL = Categorical(CHAIN.initial)
TRANSITION = [Categorical(row) for row in CHAIN.transition]
EMISSION = [Categorical(row) for row in CHAIN.emission]


@model
def long_chain(steps=100):
    """The last state."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    for n in range(1, steps):
        state = sample(TRANSITION[state])
        observe(EMISSION[state], OBSERVATIONS[n])
    return state
