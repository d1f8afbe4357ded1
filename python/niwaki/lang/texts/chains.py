"""What is wrong with Markov chains: their first states, their kernels, what kernels select and propose."""

from __future__ import annotations

from niwaki.lang.texts.message import Message

CHAINS = (
    Message(
        "no-start",
        "`{name}` has no possible state to start from: {tried} impossible",
        why="a chain starts from a run whose score is above minus infinity; {constraint}",
        help="loosen that constraint (a `factor` that grows as it is met better), raise `tries`, or start from a run that is "
        "possible: give its `choices`, or `start`",
        example="condition(gaussian(0, 1) > 9)",
        cure="observe(Gaussian(gaussian(0, 1), 0.5), 9)",
    ),
    Message(
        "no-address",
        "`{pattern}` matches no choice of `{name}`",
        why="a pattern without `/` is compared with the last part of an address, any other with the whole address",
        help="the nearest are {nearest}",
        example='kernels.on("widht", kernels.drift())',
        cure='kernels.on("width", kernels.drift())',
    ),
    Message(
        "bad-kernel",
        "this kernel cannot run",
        help="see `niwaki.kernels`",
        example="kernels.cycle()",
        cure="kernels.cycle(kernels.mh(), kernels.drift())",
    ),
    Message(
        "unreadable-kernel",
        "`{found}` is not a kernel: {reason}",
        help="write calls of the functions of `niwaki.kernels`, with numbers, texts and kernels in them",
        example='niwaki sample model.py:m --kernel "cycl(mh())"',
        cure='niwaki sample model.py:m --kernel "cycle(mh(), drift())"',
    ),
    Message(
        "bad-proposal",
        "a proposal of your own did not give a distribution",
        why="a chain needs the density of going there and of coming back",
        help="write a function of the old value that gives back a distribution, and draws nothing",
        example="kernels.proposal(lambda old: gaussian(old, 0.1))",
        cure="kernels.proposal(lambda old: Gaussian(old, 0.1))",
    ),
    Message(
        "proposal-kind",
        "a proposal of your own drew a value that the choice cannot hold",
        help="propose values of the kind that the choice's own distribution draws; restrict the proposal with `on`",
        example='kernels.on("count", kernels.proposal(lambda old: Gaussian(old, 1)))',
        cure='kernels.on("count", kernels.proposal(lambda old: DiscreteUniform(old - 1, old + 1)))',
    ),
    Message(
        "one-value",
        "`{detail}` has no other value to explain",
        help="name a choice that can have more than one",
        example="niwaki explain model.py:m --choice delta",
        cure="niwaki explain model.py:m --choice width",
    ),
)
