"""Errors about Markov chains: their first states, their kernels, and what kernels select and propose."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

CHAINS = (
    Message(
        "no-start",
        "`{name}` has no possible state to start from: {tried} impossible",
        why="a chain starts from a run whose score is above minus infinity; {constraint}",
        help="loosen that constraint (use a `factor` that rises as the run comes closer to it), raise `tries`, or start from "
        "a possible run: give its `choices`, or `start`",
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
        "in-use",
        "these chains cannot be used here",
        why="a moving chain is only half changed, and a child of a fork does not have the thread that moves it",
        help="wait until they end; fork before they move, or continue in the parent",
        example="os.fork() while another thread is in `result.more(10_000)`",
        cure="result.more(10_000); os.fork()",
    ),
    Message(
        "bad-kernel",
        "this kernel cannot run",
        help="see `niwaki.kernels`",
        example="kernels.cycle()",
        cure="kernels.cycle(kernels.prior(), kernels.drift())",
    ),
    Message(
        "unreadable-kernel",
        "`{found}` is not a kernel: {reason}",
        help="write calls of the functions of `niwaki.kernels`, with numbers, texts and kernels in them",
        example='niwaki sample model.py:m --kernel "cycl(prior())"',
        cure='niwaki sample model.py:m --kernel "cycle(prior(), drift())"',
    ),
    Message(
        "bad-proposal",
        "a proposal of your own did not give a distribution",
        why="a search needs the density of the proposed value, and a chain also the density of the reverse proposal",
        help="write a function of `old`, the value before, or of variables in scope that returns a distribution, and draws "
        "nothing; `old` is for `mh` only",
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
        "proposal-scope",
        "a proposal of your own needs a variable that is not in scope",
        why="a parameter other than `old` is a variable of the function that makes the choice; it is assigned before the "
        "choice on every path, and holds a number or a truth value",
        help="name such a variable, or restrict the proposal with `on` to the choices where it is in scope",
        example='kernels.on("x", kernels.proposal(lambda x: Gaussian(x, 0.1)))',
        cure='kernels.on("x", kernels.proposal(lambda old: Gaussian(old, 0.1)))',
    ),
    Message(
        "proposal-support",
        "a proposal of your own leaves out values that the choice can have",
        why="weights correct for values that are proposed too often or too rarely, but not for values that are never "
        "proposed: the answer would lack them",
        help="propose from a distribution that can draw all values of the choice's own distribution, even if rarely",
        example='kernels.on("width", kernels.proposal(lambda: Uniform(0.2, 0.4)))',
        cure='kernels.on("width", kernels.proposal(lambda: Gaussian(0.3, 0.1)))',
    ),
    Message(
        "one-value",
        "`{detail}` has no other value to explain",
        help="name a choice that can have more than one",
        example="niwaki explain model.py:m --choice delta",
        cure="niwaki explain model.py:m --choice width",
    ),
)
