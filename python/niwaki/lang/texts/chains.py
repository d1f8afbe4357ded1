"""What is wrong with Markov chains: their first states, their kernels, what kernels select and propose."""

from __future__ import annotations

from niwaki.lang.texts.message import Message

CHAINS = (
    Message(
        "no-start",
        "`{name}` has no possible state to start from: all of {tries} forward runs were impossible",
        why="a chain starts from a run whose score is above minus infinity; these were not: {constraint}",
        help="loosen that constraint (a `factor` that grows as it is met better), raise `tries`, or start from `choices`",
        example="condition(gaussian(0, 1) > 9)",
        cure="observe(Gaussian(gaussian(0, 1), 0.5), 9)",
    ),
)
