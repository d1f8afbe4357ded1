"""A setting of a method inside a model is honoured or refused, never ignored.

Each share is over 600 seeds and within 4.9 standard errors of the exact answer: one false alarm in a million for each.
"""

import math

import niwaki as nw
import pytest
from niwaki import flip, infer, kernels, model


@model
def inner():
    heads = flip(0.3)
    nw.factor(0.0 if heads else -1.5)
    return heads


EXACT = 0.3 / (0.3 + 0.7 * math.exp(-1.5))

# Settings that were ignored once: rejuvenation, chains of the final set, populations, powers, warm-up and kernels.
HONOURED = {
    "populations": nw.smc((30, 20)),
    "anneal": nw.smc(60, anneal=[0.3, 1.0]),
    "draws": nw.smc(60, rejuvenate=kernels.prior(), moves=2, draws=5, at="end"),
    "warmup": nw.mh(60, warmup=20),
    "kernel": nw.mh(60, kernel=kernels.cycle(kernels.neighbour(), kernels.prior())),
    "resampling": nw.smc(60, resampling="tempered"),
    "particle_gibbs": nw.particle_gibbs(8, 8),
    "pimh": nw.pimh(20, 8),
    "importance": nw.importance(150),
    "ais": nw.ais(20, 5, moves=2),
    "rejection": nw.rejection(2),
}


@pytest.mark.parametrize("name", HONOURED)
def test_a_setting_is_honoured(name: str) -> None:
    method = HONOURED[name]

    @model
    def outer():
        return infer(inner, method)

    values = [sample.value for sample in nw.run(outer, nw.forward(600), seed=5, threads=1)]
    error = 4.9 * math.sqrt(EXACT * (1 - EXACT) / len(values))
    assert abs(sum(values) / len(values) - EXACT) < error


def test_a_kernel_that_moves_nothing_shows_that_kernels_are_read() -> None:
    """The mutant of the above: under a kernel that no choice matches a chain would keep its first state."""

    @model
    def outer():
        return infer(inner, nw.mh(60, kernel=kernels.on("nothing*", kernels.prior())))

    with pytest.raises(nw.NiwakiError, match="nothing"):
        nw.run(outer, nw.forward(1), seed=1)


REFUSED = {
    "seconds": nw.smc(seconds=1.0),
    "diverse": nw.smc(diverse=2),
    "thin": nw.mh(60, thin=2),
    "keep": nw.mh(60, keep=10),
    "hmc": nw.hmc(10),
    "nuts": nw.nuts(10),
    "proposal": nw.mh(60, kernel=kernels.proposal(lambda old: old)),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_setting_without_meaning_there_is_refused(name: str) -> None:
    method = REFUSED[name]

    @model
    def outer():
        return infer(inner, method)

    with pytest.raises(nw.ModelError, match=f"`{name}`"):
        outer.core()
