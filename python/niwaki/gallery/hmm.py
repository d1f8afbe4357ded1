"""A hidden Markov model of ten states, to find the state at each step from observations (appendix A).

The tables are known and the states are not. The distributions are built once, outside of the model.
"""

from niwaki import model
from niwaki.gallery import data
from niwaki.methods import mh
from niwaki.words import Categorical, observe, sample

TITLE = "the states behind a hundred observations"
METHOD = mh(steps=400_000, warmup=100_000)

CHAIN = data.hidden_chain(1000)
OBSERVATIONS = CHAIN.observations
INITIAL = Categorical(CHAIN.initial)
TRANSITION = [Categorical(row) for row in CHAIN.transition]
EMISSION = [Categorical(row) for row in CHAIN.emission]


@model
def hmm(steps=100):
    """Draw the states of the first `steps` steps, and observe the observations."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    states = [state]
    for n in range(1, steps):
        state = sample(TRANSITION[state])
        observe(EMISSION[state], OBSERVATIONS[n])
        states = states + [state]
    return states


MODEL = hmm
