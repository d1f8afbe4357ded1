"""Sequential Monte Carlo, and chains whose proposals are populations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import InitVar, dataclass
from typing import Any

from niwaki.methods.checks import check_kernel, look_ahead, with_guide
from niwaki.methods.guide import Guide
from niwaki.methods.kernels import Kernel
from niwaki.methods.method import Method
from niwaki.methods.order import FutureOrder
from niwaki.methods.refusals import as_real


@dataclass(frozen=True)
class Smc(Method):
    """Population of particles that are scored and resampled while they grow.

    Parameters
    ----------
    particles
        The number of particles, at least 1. Several numbers are the sizes of several populations: `Result.info.plan`
        repeats a search.
    order
        "stochastic": after each barrier a uniform draw among the futures that can run; "depth-first": futures run
        where they are created; a `FutureOrder`: a draw by a learned order.
    weights
        "ratio": the ratio of successive scores, so that the final set follows the posterior; "absolute": the whole
        score at every step, which sharpens the search and has no evidence.
    power
        The power of the scores in the final distribution; 1 for the posterior. In a score that is a normal density, the
        power divides the deviation by the root of the power. Reported scores have power 1.
    resampling
        "systematic", "residual", "stratified" or "multinomial": by weight. "tempered": by a power of the weight, at
        most 1, at which half of the possible particles stay effective. Copies carry the rest of the weight, so evidence
        and final distribution stay the same, and fewer promising particles are lost. Not with absolute weights.
    ess
        The share of the particles below which the effective sample size must fall for resampling; at every barrier when
        left out.
    anneal
        The schedule of powers: a power for each barrier (the last also for later barriers), or a share between 0 and 1.
        With a share the power rises from 0 to `power` as fast as the conditional effective sample size stays at this
        share of the particles. The final distribution has the power `power` for every schedule.
    populations
        The number of independent populations of `particles` each, side by side, combined by their evidence. The default
        is 1, or `diverse` if there are no `draws`.
    diverse
        The number of results that differ, best score first: no two share more than half of their choices. A population
        ends as many copies of few runs, so several populations or `draws` are needed. Fewer results are possible, with
        a warning.
    seconds
        A time limit in place of a number of particles. A pilot population measures the cost of a particle, and is
        dropped. Then populations of one size run one after the other. Populations that are complete at the limit count,
        and the running one is dropped; without a complete population the first one is finished. So the evidence is
        unbiased, although good populations often cost more. `Result.info.plan` lists their sizes.
    proposal, guide
        The proposal and the guide that draw choices in place of the prior, as for `importance`. Not with absolute
        weights.
    look_ahead
        The strength of the look-ahead; 0.2 is a good value. Weights of running particles include this share of the gain
        in log score that a guide expects until their end. A guide learns it by `niwaki.guides.train_look_ahead`. At the
        end the share is removed, so evidence and final distribution stay the same. Not with absolute weights, and with
        `rejuvenate` only at the end.
    rejuvenate
        A kernel of `niwaki.kernels` that moves each particle and keeps their distribution, so that copies become
        different again (Gilks & Berzuini 2001). A running particle keeps its structure: its parts, its futures, and the
        place of each call. A particle that has ended may change its structure. Not with absolute weights; `anneal` and
        `tempering` are refused, and `hmc_step` and `nuts_step` move particles at the end only.
    moves
        The number of proposals for each particle, each time; `Result.info` counts all and accepted proposals.
    at
        The moments of moves: "end", once all particles have ended; a number, also at every so-many-th barrier;
        "resampled", also after each resampling.
    draws, chains
        The numbers of states and of chains that replace the final set. Once all particles have ended, `chains` of them,
        drawn by weight, start chains; `draws` states of each chain, `moves` proposals apart, are the final set. Chains
        are much cheaper than as many moves of every particle, because a run is built once for a chain.
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
        check_kernel("rejuvenate", self.rejuvenate)
        _convert(self, guide)

    @property
    def sizes(self) -> tuple[int, ...]:
        """The number of particles of each population, without `seconds`."""
        if not isinstance(self.particles, int):
            return tuple(self.particles)
        diverse = None if self.draws is not None else self.diverse
        return (self.particles,) * (self.populations or diverse or 1)


@dataclass(frozen=True)
class ParticleGibbs(Method):
    """Chain of whole runs: a sweep is a population with the last run in it, and the next run is one of its particles.

    The chain is right for any number of particles above 1 (Andrieu, Doucet & Holenstein 2010). With ancestor sampling
    (Lindsten, Jordan & Schon 2014) the past of the held run changes, too. `Result.info` counts the ancestors that were
    another particle, and has the share of choices that each sweep changed.

    Parameters
    ----------
    particles, order, power, ess
        As for `smc`; at least 2 particles.
    sweeps
        The number of sweeps; each gives one sample.
    resampling
        "multinomial", or "tempered", with independent draws by a power of the weight, as for `smc`. The other methods
        of `smc` are refused, because their draws are not independent with a held run.
    anneal
        The power at each barrier, as for `smc`.
    ancestors
        Whether the past of the held run is drawn again at each resampling.
    proposal, guide
        The proposal and the guide that draw choices in place of the prior, as for `importance`.
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
    """Chain whose proposals are whole populations, accepted by the ratio of their evidence.

    The chain is right for any number of particles (Andrieu, Doucet & Holenstein 2010, section 2.4.2). `Result.info`
    counts the accepted proposals. The evidence is the mean of the estimates of all `sweeps + 1` populations. A
    population that became impossible counts as zero; if all did, it is an error.

    Parameters
    ----------
    particles, order, power, resampling, ess
        As for `smc`.
    sweeps
        The number of sweeps after a first population; each gives one sample, from the first population with a living
        particle on.
    anneal
        The power at each barrier, as for `smc`.
    proposal, guide
        The proposal and the guide that draw choices in place of the prior, as for `importance`.
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
    """Convert the common settings, and check all."""
    for name in ("power", "look_ahead"):
        method._set(name, as_real(getattr(method, name)))
    powers: Any = method.anneal
    is_schedule = isinstance(powers, Sequence) and not isinstance(powers, str)
    method._set("anneal", tuple(map(as_real, powers)) if is_schedule else as_real(powers))
    method._set("proposal", with_guide(method.proposal, guide))
    method._check()
    look_ahead(method.look_ahead, method.proposal)
