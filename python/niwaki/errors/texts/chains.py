"""Errors about Markov chains: first states, kernels, selections of choices, and proposals."""

from __future__ import annotations

from niwaki.errors.texts.message import Message

CHAINS = (
    Message(
        "no-start",
        "`{name}` has no possible state to start from: {tried} impossible",
        why="a chain must start from a run with a score above minus infinity; {constraint}",
        help="loosen that constraint (use a `factor` that rises when the run comes closer to it), raise `tries`, or start from "
        "a possible run: give its `choices`, or `start`",
        example="condition(gaussian(0, 1) > 9)",
        cure="observe(Gaussian(gaussian(0, 1), 0.5), 9)",
    ),
    Message(
        "no-address",
        "`{pattern}` matches no choice of `{name}`",
        why="a pattern without `/` must match the last part of an address, a pattern with `/` the whole address, and a label the "
        "last steps of one",
        help="{nearest}",
        example='kernels.on("widht", kernels.drift())',
        cure='kernels.on("width", kernels.drift())',
    ),
    Message(
        "ambiguous-label",
        "`{label}` is a name of several choices of `{name}`",
        why="a label stands for a choice if no other choice has it",
        help="write one of these addresses: {addresses}",
        example='run(tower, hold={"height": 2.0})',
        cure='run(tower, hold={"Storey 1 › height": 2.0})',
    ),
    Message(
        "held-twice",
        "the choice `{address}` is held at two values",
        why="`{first}` and `{second}` name the same choice",
        help="leave out one of the two",
        example="niwaki grow house.py --hold width=2 --hold Width=3",
        cure="niwaki grow house.py --hold width=3",
    ),
    Message(
        "in-use",
        "cannot use these chains now",
        why="another thread moves these chains, and a child of a fork does not have that thread",
        help="wait until the move ends; fork before the move, or continue in the parent process",
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
        help="write calls of the functions of `niwaki.kernels`; their arguments are numbers, texts and kernels",
        example='niwaki sample model.py:m --kernel "cycl(prior())"',
        cure='niwaki sample model.py:m --kernel "cycle(prior(), drift())"',
    ),
    Message(
        "bad-proposal",
        "your proposal returns no distribution",
        why="a search needs the density of the proposed value, and a chain also the density of the reverse proposal",
        help="write a function that returns a distribution and draws "
        "nothing. Its parameters are `old`, the value before (only for `mh`), and variables in scope",
        example="kernels.proposal(lambda old: gaussian(old, 0.1))",
        cure="kernels.proposal(lambda old: Gaussian(old, 0.1))",
    ),
    Message(
        "proposal-kind",
        "your proposal drew a value that the choice cannot hold",
        help="propose values of the same kind as the choice's distribution; restrict the proposal with `on`",
        example='kernels.on("count", kernels.proposal(lambda old: Gaussian(old, 1)))',
        cure='kernels.on("count", kernels.proposal(lambda old: DiscreteUniform(old - 1, old + 1)))',
    ),
    Message(
        "proposal-scope",
        "your proposal needs a variable that is not in scope",
        why="a parameter other than `old` is a variable of the function that makes the choice. It must be assigned before the "
        "choice on every path, and have a number or a truth value",
        help="name such a variable, or restrict the proposal with `on` to the choices where it is in scope",
        example='kernels.on("x", kernels.proposal(lambda x: Gaussian(x, 0.1)))',
        cure='kernels.on("x", kernels.proposal(lambda old: Gaussian(old, 0.1)))',
    ),
    Message(
        "proposal-support",
        "your proposal leaves out values that the choice can have",
        why="weights correct for values that are proposed too often or too rarely. They cannot correct for values that are never "
        "proposed: the answer would lack these values",
        help="propose from a distribution that can draw, even if rarely, every value that the choice can have",
        example='kernels.on("width", kernels.proposal(lambda: Uniform(0.2, 0.4)))',
        cure='kernels.on("width", kernels.proposal(lambda: Gaussian(0.3, 0.1)))',
    ),
    Message(
        "one-value",
        "`{detail}` has one value only: there is nothing to explain",
        help="name a choice that can have several values",
        example="niwaki explain model.py:m --choice delta",
        cure="niwaki explain model.py:m --choice width",
    ),
)
