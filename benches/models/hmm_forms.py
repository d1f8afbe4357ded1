"""The hidden Markov chain of appendix A, in many equivalent variants.

Each takes the number of steps, 100 to 1000 for the sizes 1 to 10, and makes the same choices and observations in the
same order; so the densities of equal choices are equal. FORMS names them.
"""

from niwaki import model, observe, query, sample
from niwaki.gallery.hmm import EMISSION, INITIAL, OBSERVATIONS, TRANSITION


@model
def one_by_one(steps=100):
    """By recursion from the last step to the first; the last state."""
    return upto(steps - 1)


def upto(n):
    """The state of step n."""
    if n == 0:
        state = sample(INITIAL)
    else:
        previous = upto(n - 1)
        state = sample(TRANSITION[previous])
    observe(EMISSION[state], OBSERVATIONS[n])
    return state


@model
def by_halves(steps=100):
    """By recursion over halves of the chain; the last state."""
    return half(0, steps, -1)


def half(i, j, state):
    """The state of step j - 1, where step i - 1 was in `state`."""
    if j - i == 1:
        return step(i, state)
    middle = (i + j) // 2
    return half(middle, j, half(i, middle, state))


def step(n, previous):
    """The state of step n."""
    state = sample(INITIAL) if n == 0 else sample(TRANSITION[previous])
    observe(EMISSION[state], OBSERVATIONS[n])
    return state


@model
def for_loop(steps=100):
    """A `for`; the last state."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    for n in range(1, steps):
        state = sample(TRANSITION[state])
        observe(EMISSION[state], OBSERVATIONS[n])
    return state


@model
def while_loop(steps=100):
    """A `while`; the last state."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    n = 1
    while n < steps:
        state = sample(TRANSITION[state])
        observe(EMISSION[state], OBSERVATIONS[n])
        n = n + 1
    return state


@model
def returned_list(steps=100):
    """A `for` that returns the list of all states."""
    state = sample(INITIAL)
    observe(EMISSION[state], OBSERVATIONS[0])
    states = [state]
    for n in range(1, steps):
        state = sample(TRANSITION[state])
        observe(EMISSION[state], OBSERVATIONS[n])
        states = states + [state]
    return states


@model
def queried(steps=100):
    """One by one, with a `query` of each state; the last state."""
    return recorded(steps - 1)


def recorded(n):
    """The state of step n, recorded."""
    if n == 0:
        state = sample(INITIAL)
    else:
        previous = recorded(n - 1)
        state = sample(TRANSITION[previous])
    observe(EMISSION[state], OBSERVATIONS[n])
    query(f"state {n}", state)
    return state


FORMS = {
    "one by one": one_by_one,
    "by halves": by_halves,
    "for": for_loop,
    "while": while_loop,
    "returned list": returned_list,
    "query": queried,
}
