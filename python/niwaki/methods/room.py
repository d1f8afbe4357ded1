"""Estimates of the memory that the counts of a method need, before its search starts.

The bytes are lower bounds, with the objects in Python: the growth of the resident memory of searches of a model with
one choice, rounded down. A larger model takes more; `max_memory` bounds its runs and populations while they grow.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from niwaki.errors.memory import check_room
from niwaki.methods.annealed import Ais
from niwaki.methods.chains import Mh
from niwaki.methods.direct import Forward, Importance, Rejection
from niwaki.methods.emulate import Emulate
from niwaki.methods.gradients import Hmc, Nuts
from niwaki.methods.improve import Improve
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.normals import Vi
from niwaki.methods.particles import ParticleGibbs, Pimh, Smc

#: Bytes of a stored run, of a particle, of a chain, of a chain that follows the gradient, of a draw of such a chain,
#: and of a planned proposal.
RUN, PARTICLE, CHAIN, GRADIENT_CHAIN, DRAW, MOVE = 700, 1000, 3000, 10_000, 300, 8

#: Bytes of a search that waits for its turn.
SEARCH = 1000

#: A setting, its count, the bytes of one, and the name of one.
Need = tuple[str, int, int, str]


def check_method(method: Method) -> None:
    """Refuse a method whose counts need more memory than is free.

    Raises
    ------
    InputError
        The message has the count, the bytes of each, and the free memory.
    """
    for need in _needs(method):
        check_room(*need)


def _needs(method: Method) -> Iterator[Need]:
    match method:
        case Forward() | Importance():
            yield "n", method.n, RUN, "sample"
        case Rejection():
            yield "n", min(method.n, method.max_tries), RUN, "sample"
        case Ais():
            yield "particles", method.particles, RUN, "particle"
            yield "powers", method.powers if isinstance(method.powers, int) else 1, MOVE, "rung"
        case Smc():
            yield from _of_population(method)
        case ParticleGibbs() | Pimh():
            yield "particles", method.particles, PARTICLE, "particle"
            yield "sweeps", method.sweeps, RUN, "sweep"
        case Improve():
            yield "particles", method.particles, PARTICLE, "particle"
            yield "regrow", method.regrow, PARTICLE, "particle"
            yield "diverse", method.diverse or 1, PARTICLE, "result"
        case Emulate():
            yield "evaluations", method.evaluations, RUN, "evaluation"
        case Mh():
            yield "chains", method.chains, CHAIN, "chain"
        case Hmc() | Nuts():
            yield "chains", method.chains, GRADIENT_CHAIN, "chain"
            yield "draws", method.draws * method.chains, DRAW, "draw of each chain"
        case Vi():
            yield "paths", method.paths, GRADIENT_CHAIN, "path"
            yield "draws", method.draws * method.paths, DRAW, "draw of each path"
    for kernel in (getattr(method, name, None) for name in ("kernel", "rejuvenate")):
        if isinstance(kernel, Kernel):
            yield from _of_kernel(kernel)


def _of_population(method: Smc) -> Iterator[Need]:
    sizes = (method.particles,) if isinstance(method.particles, int) else method.particles
    for size in sizes:
        yield "particles", size, PARTICLE, "particle"
    if method.populations is not None:
        yield "populations", method.populations, PARTICLE * sizes[0], f"population of {sizes[0]:,}"
    elif method.diverse is not None:
        yield "diverse", method.diverse, PARTICLE * sizes[0], f"population of {sizes[0]:,}"
    yield "moves", method.moves, MOVE, "proposal"
    if method.draws is not None:
        yield "chains", method.chains, CHAIN, "chain"
        yield "draws", method.draws * method.chains, RUN, "draw of each chain"


def _of_kernel(kernel: Kernel) -> Iterator[Need]:
    particles: Any = kernel.settings.get("particles")
    if particles is not None:
        yield "particles", particles, PARTICLE, "particle of `regrow`"
    for part in kernel.parts:
        yield from _of_kernel(part)
