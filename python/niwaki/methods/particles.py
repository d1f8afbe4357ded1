"""Sequential Monte Carlo, and chains whose proposals are populations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import InitVar, dataclass
from typing import Any

from niwaki.methods.checks import guided as with_guide
from niwaki.methods.checks import is_kernel, look_ahead
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.order import FutureOrder
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class Smc(Method):
    """Particles that are scored and resampled while they grow.

    Parameters
    ----------
    particles
        How many; at least 1. Several numbers are several populations of those sizes: `Result.info.plan` repeats a
        search.
    order
        "stochastic": after each barrier a uniform draw among the futures that can run; "depth-first": futures run
        where they are created; a `FutureOrder`: a draw by an order that was learned.
    weights
        "ratio": the ratio of successive scores, so that the final set follows the posterior; "absolute": the whole
        score at every step, an undeclared sharpening without evidence.
    power
        The power to which scores are raised in the final law; 1 for the posterior. For a score that is a normal
        density of deviation sigma, it is as if sigma were divided by its root. Reported scores are those of power 1.
    resampling
        "systematic", "residual", "stratified" or "multinomial": by weight. "tempered": by a power of the weight, at
        most 1 and as high as half of the possible particles stay effective; copies carry the rest of the weight, so
        evidence and final law are the same, and fewer particles that look bad for the moment are lost. Not with
        absolute weights.
    ess
        Resample only when the effective sample size falls below this share of the particles; at every barrier when left
        out.
    anneal
        The schedule of powers: one for each barrier (the last also for those after it), or a share of the particles
        between 0 and 1, so that the power rises from 0 to `power` as fast as this share of the conditional effective
        sample size allows. The final law is that of `power` for every schedule.
    populations
        So many independent populations of `particles` each, side by side, combined by their evidence. 1, or with
        `diverse` and no `draws` as many as that, when left out.
    diverse
        Give so many results that differ, best score first: none shares more than half of its choices with another. One
        population ends as many copies of few runs, so this needs several, or `draws`. Where fewer are found, fewer are
        given, with a warning.
    seconds
        Instead of a number of particles: a pilot, which is thrown away, measures what a particle costs; then
        populations of one size run one after the other. Those that are complete when this time is spent count, the one
        that still runs is dropped; where none is complete the first is finished, and takes longer. So the evidence is
        unbiased though costly populations are often the good ones. `Result.info.plan` lists their sizes.
    proposal, guide
        What draws choices in place of the prior, as for `importance`. Not with absolute weights.
    look_ahead
        Let weights count this share of what a guide expects the log scores of running particles to gain until they end;
        0.2 is a good one. A guide learns it by `niwaki.guides.train_look_ahead`. In the end it counts nothing, so
        evidence and final law are the same for every value. Not with absolute weights, and with `rejuvenate` only at
        the end.
    rejuvenate
        A kernel of `niwaki.kernels` that moves each particle without changing the law that all follow, so that copies
        become different again (Gilks & Berzuini 2001). A particle that still runs keeps its skeleton: which parts,
        which futures, where each call waits; one that has ended may change its structure. Not with absolute weights,
        no `anneal` or `tempering`, and `hmc_step` and `nuts_step` only at the end.
    moves
        Proposals for each particle, each time; `Result.info` counts them, and those that were accepted.
    at
        When: once all have ended ("end"); and before that at every so-many-th barrier, or after each resampling
        ("resampled").
    draws, chains
        Once all have ended, follow `chains` of them, drawn by weight, instead of moving each: `draws` states of each
        chain, `moves` proposals apart, are the final set. Much cheaper than as many moves of every particle, as a run
        is built once for a chain, and they go further.
    """

    NAME = "smc"
    particles: int | Sequence[int] = 300
    order: str | FutureOrder = "stochastic"
    weights: str = "ratio"
    power: float = 1.0
    resampling: str = "systematic"
    ess: float | None = None
    anneal: float | Sequence[float] | None = None
    populations: int | None = None
    diverse: int | None = None
    seconds: float | None = None
    proposal: Kernel | None = None
    look_ahead: float | None = None
    rejuvenate: Kernel | None = None
    moves: int = 1
    at: int | str = 1
    draws: int | None = None
    chains: int = 1
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        if isinstance(self.particles, (list, tuple, range)):
            self._set("particles", tuple(self.particles))
        self._set("seconds", as_real(self.seconds))
        is_kernel("rejuvenate", self.rejuvenate)
        _convert(self, guide)

    @property
    def sizes(self) -> tuple[int, ...]:
        """How many particles each of its populations has, where they are not told by seconds."""
        if not isinstance(self.particles, int):
            return tuple(self.particles)
        different = None if self.draws is not None else self.diverse
        return (self.particles,) * (self.populations or different or 1)


@dataclass(frozen=True)
class ParticleGibbs(Method):
    """A chain of whole runs: each sweep is a population that contains the last run; one of its particles is the next.

    Right for any number of particles above 1 (Andrieu, Doucet & Holenstein 2010); with ancestor sampling (Lindsten,
    Jordan & Schon 2014) the held run's past changes too. `Result.info` counts the ancestors that were
    another particle, and has the share of choices that each sweep changed.

    Parameters
    ----------
    particles, order, power, ess
        As for `smc`; at least 2 particles.
    sweeps
        How many; one sample each.
    resampling
        "multinomial", or "tempered": then independent draws too, by a power of the weight, as for `smc`. The others
        of `smc` are not offered: beside a held run their draws are not independent.
    anneal
        The power at each barrier, as for `smc`.
    ancestors
        Whether the past of the held run is drawn again at each resampling.
    proposal, guide
        What draws choices in place of the prior, as for `importance`.
    look_ahead
        As for `smc`.
    """

    NAME = "particle_gibbs"
    particles: int = 100
    sweeps: int = 100
    order: str | FutureOrder = "stochastic"
    power: float = 1.0
    resampling: str = "multinomial"
    ess: float | None = None
    anneal: Sequence[float] | None = None
    ancestors: bool = True
    proposal: Kernel | None = None
    look_ahead: float | None = None
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        self._set("ancestors", bool(self.ancestors))
        _convert(self, guide)


@dataclass(frozen=True)
class Pimh(Method):
    """A chain whose proposals are whole populations, accepted by the ratio of their evidence.

    Right for any number of particles (Andrieu, Doucet & Holenstein 2010, section 2.4.2). `Result.info` counts the
    accepted proposals. The evidence is the mean of the estimates of all `sweeps + 1` populations, in which those that
    became impossible count as zero; where all did, it is an error.

    Parameters
    ----------
    particles, order, power, resampling, ess
        As for `smc`.
    sweeps
        How many, after a first population; one sample each, from the first population in which a particle lived.
    anneal
        The power at each barrier, as for `smc`.
    proposal, guide
        What draws choices in place of the prior, as for `importance`.
    look_ahead
        As for `smc`.
    """

    NAME = "pimh"
    particles: int = 100
    sweeps: int = 100
    order: str | FutureOrder = "stochastic"
    power: float = 1.0
    resampling: str = "systematic"
    ess: float | None = None
    anneal: Sequence[float] | None = None
    proposal: Kernel | None = None
    look_ahead: float | None = None
    guide: InitVar[Guide | None] = None

    def __post_init__(self, guide: Guide | None) -> None:
        """Check the settings."""
        _convert(self, guide)


smc, particle_gibbs, pimh = Smc, ParticleGibbs, Pimh


def _convert(method: Smc | ParticleGibbs | Pimh, guide: Guide | None) -> None:
    """Convert and check the settings that all have."""
    for name in ("power", "look_ahead"):
        method._set(name, as_real(getattr(method, name)))
    powers: Any = method.anneal
    is_schedule = isinstance(powers, Sequence) and not isinstance(powers, str)
    method._set("anneal", tuple(map(as_real, powers)) if is_schedule else as_real(powers))
    method._set("proposal", with_guide(method.proposal, guide))
    method._check()
    look_ahead(method.look_ahead, method.proposal)
