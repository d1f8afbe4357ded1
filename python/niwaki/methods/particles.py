"""Sequential Monte Carlo, and the chains made of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from niwaki.errors import InputError
from niwaki.kernels import Kernel
from niwaki.methods.checks import at_least_one, bad, is_number, is_whole, one_of

ORDERS = ("stochastic", "depth-first")
WEIGHTS = ("ratio", "absolute")
MOMENTS = ("resampled", "end")
RESAMPLING = ("systematic", "residual", "stratified", "multinomial")


@dataclass(frozen=True)
class Smc:
    """Sequential Monte Carlo; see `smc`."""

    particles: int | tuple[int, ...] = 300
    order: str = "stochastic"
    weights: str = "ratio"
    temper: float = 1.0
    resampling: str = "systematic"
    ess: float | None = None
    anneal: float | tuple[float, ...] | None = None
    populations: int = 1
    diverse: int | None = None
    seconds: float | None = None
    rejuvenate: Kernel | None = None
    moves: int = 1
    at: int | str = 1
    draws: int | None = None
    chains: int = 1

    @property
    def plan(self) -> tuple[int, ...]:
        """Sizes of the populations, where no time decides them."""
        if isinstance(self.particles, tuple):
            return self.particles
        return (self.particles,) * self.populations


@dataclass(frozen=True)
class ParticleGibbs:
    """Particle Gibbs; see `particle_gibbs`."""

    particles: int = 100
    sweeps: int = 100
    order: str = "stochastic"
    temper: float = 1.0
    ess: float | None = None
    anneal: tuple[float, ...] | None = None
    ancestors: bool = True
    start: Any = None


@dataclass(frozen=True)
class Pimh:
    """Particle independent Metropolis-Hastings; see `pimh`."""

    particles: int = 100
    sweeps: int = 100
    order: str = "stochastic"
    temper: float = 1.0
    resampling: str = "systematic"
    ess: float | None = None
    anneal: tuple[float, ...] | None = None


def smc(
    particles: int | Sequence[int] = 300,
    order: str = "stochastic",
    weights: str = "ratio",
    temper: float = 1.0,
    resampling: str = "systematic",
    ess: float | None = None,
    *,
    anneal: float | Sequence[float] | None = None,
    populations: int | None = None,
    diverse: int | None = None,
    seconds: float | None = None,
    rejuvenate: Kernel | None = None,
    moves: int = 1,
    at: int | str = 1,
    draws: int | None = None,
    chains: int = 1,
) -> Smc:
    """Particles that are scored and resampled while they grow.

    Parameters
    ----------
    particles
        How many; at least 1. Several numbers are several populations of those sizes: `Result.plan` repeats a search.
    order
        "stochastic": after each barrier a uniform draw among the futures that can run; "depth-first": futures run
        where they are created.
    weights
        "ratio": the ratio of successive scores, so that the final set follows the posterior; "absolute": the whole
        score at every step, an undeclared sharpening without evidence.
    temper
        The power to which scores are raised in the final law; 1 for the posterior. For a score that is a normal
        density of deviation sigma, it is as if sigma were divided by its root. Reported scores are never tempered.
    resampling
        "systematic", "residual", "stratified" or "multinomial".
    ess
        Resample only when the effective sample size falls below this share of the particles; at every barrier when left
        out.
    anneal
        The power on the way: one for each barrier (the last also for those after it), or a share of the particles
        between 0 and 1, so that it rises from 0 to `temper` as fast as this share of the conditional effective sample
        size allows. The final law is that of `temper` whatever the way.
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
        unbiased though costly populations are often the good ones. `Result.plan` says how many there were and how
        large.
    rejuvenate
        A kernel of `niwaki.kernels` that moves each particle without changing the law that all follow, so that copies
        become different again (Gilks & Berzuini 2001). A particle that still runs keeps its skeleton: which parts,
        which futures, where each call waits; one that has ended may change its structure. Not with absolute weights,
        no kernel that anneals or tempers, and `hmc` and `nuts` only at the end.
    moves
        Proposals for each particle, each time; `Result.moved` says how many were made and kept.
    at
        When: once all have ended ("end"); and before that at every so-many-th barrier, or after each resampling
        ("resampled").
    draws, chains
        Once all have ended, follow `chains` of them, drawn by weight, instead of moving each: `draws` states of each
        chain, `moves` proposals apart, are the final set. Much cheaper than as many moves of every particle, as a run
        is built once for a chain, and they go further.
    """
    if seconds is not None:
        if not is_number(seconds) or not 0 < seconds < float("inf"):
            raise bad("seconds", seconds, "a number of seconds above 0", "10")
        if populations is not None or not is_whole(particles):
            other = "populations" if populations is not None else "particles"
            raise bad(other, populations or particles, "no number of populations beside `seconds`", "None")
    sizes = particles if isinstance(particles, int) else tuple(particles)
    for size in (sizes,) if isinstance(sizes, int) else sizes or (0,):
        if not is_whole(size) or size < 1:
            raise InputError("no-particles", found=repr(size))
    one_of("order", order, ORDERS)
    one_of("weights", weights, WEIGHTS)
    one_of("resampling", resampling, RESAMPLING)
    _check_temper(temper)
    _check_ess(ess)
    if diverse is not None:
        at_least_one("diverse", diverse)
    if populations is not None:
        at_least_one("populations", populations)
        if not isinstance(sizes, int):
            raise bad("populations", populations, "nothing beside a list of sizes", "None")
    _check_moves(rejuvenate, moves, at, weights)
    _check_walks(rejuvenate, draws, chains)
    return Smc(
        sizes,
        order,
        weights,
        float(temper),
        resampling,
        ess,
        _way(anneal, weights),
        populations or (diverse if draws is None else None) or 1,
        diverse,
        None if seconds is None else float(seconds),
        rejuvenate,
        moves,
        at,
        draws,
        chains,
    )


def particle_gibbs(
    particles: int = 100,
    sweeps: int = 100,
    order: str = "stochastic",
    temper: float = 1.0,
    ess: float | None = None,
    *,
    anneal: Sequence[float] | None = None,
    ancestors: bool = True,
    start: Any = None,
) -> ParticleGibbs:
    """A chain of whole runs: each sweep is a population that holds the last run, and one of it is the next.

    Right for any number of particles above 1 (Andrieu, Doucet & Holenstein 2010); with ancestor sampling (Lindsten,
    Jordan & Schon 2014) the held run's past changes too. `Result.moves` of `Result.tries` ancestors were another's,
    `Result.renewed` is the share of choices that each sweep made new.

    Parameters
    ----------
    particles, order, temper, ess
        As for `smc`; at least 2 particles. Resampling is multinomial.
    sweeps
        How many; one sample each.
    anneal
        The power at each barrier, as for `smc`.
    ancestors
        Whether the past of the held run is drawn anew at each resampling.
    start
        A sample of the same model to start from; a run that `smc` finds when left out.
    """
    if not is_whole(particles) or particles < 2:
        raise bad("particles", particles, "a whole number above 1", "100")
    at_least_one("sweeps", sweeps)
    one_of("order", order, ORDERS)
    _check_temper(temper)
    _check_ess(ess)
    if start is not None and not hasattr(start, "_outcome"):
        raise bad("start", start, "a sample of a search", "result.best")
    return ParticleGibbs(particles, sweeps, order, float(temper), ess, _fixed(anneal), bool(ancestors), start)


def pimh(
    particles: int = 100,
    sweeps: int = 100,
    order: str = "stochastic",
    temper: float = 1.0,
    resampling: str = "systematic",
    ess: float | None = None,
    *,
    anneal: Sequence[float] | None = None,
) -> Pimh:
    """A chain whose proposals are whole populations, accepted by the ratio of their evidence.

    Right for any number of particles (Andrieu, Doucet & Holenstein 2010, section 2.4.2). `Result.moves` of
    `Result.tries` proposals were accepted. The evidence is the mean of the estimates of all `sweeps + 1` populations,
    in which the `Result.died` that became impossible count as zero; where all did, it is an error.

    Parameters
    ----------
    particles, order, temper, resampling, ess
        As for `smc`.
    sweeps
        How many, after a first population; one sample each, from the first population in which a particle lived.
    anneal
        The power at each barrier, as for `smc`.
    """
    if not is_whole(particles) or particles < 1:
        raise InputError("no-particles", found=repr(particles))
    at_least_one("sweeps", sweeps)
    one_of("order", order, ORDERS)
    one_of("resampling", resampling, RESAMPLING)
    _check_temper(temper)
    _check_ess(ess)
    return Pimh(particles, sweeps, order, float(temper), resampling, ess, _fixed(anneal))


def _check_moves(rejuvenate: Any, moves: int, at: Any, weights: str) -> None:
    at_least_one("moves", moves)
    if at not in MOMENTS and (not is_whole(at) or at < 1):
        raise bad("at", at, 'a number of barriers, "resampled" or "end"', "1")
    if rejuvenate is None:
        return
    if not isinstance(rejuvenate, Kernel):
        raise bad("rejuvenate", rejuvenate, "a kernel", "one of `niwaki.kernels`, such as `kernels.mh()`")
    if weights == "absolute":
        raise bad(
            "rejuvenate",
            rejuvenate,
            "nothing beside absolute weights, which have no law to keep",
            'None, or `weights` to "ratio"',
        )
    changing = _first(rejuvenate, ("anneal", "temper"))
    if changing is not None:
        expected = "a kernel that keeps the particles' law, which annealing and tempering do not"
        raise bad("rejuvenate", rejuvenate, expected, f"{changing.parts[0]!r}, and `anneal=` of `smc`")


def _check_walks(rejuvenate: Kernel | None, draws: int | None, chains: int) -> None:
    at_least_one("chains", chains)
    if draws is None:
        if chains != 1:
            raise bad("chains", chains, "nothing without `draws`, which says how many states of each", "1")
        return
    at_least_one("draws", draws)
    if rejuvenate is None:
        raise bad("draws", draws, "nothing without `rejuvenate`, which says how chains move", "None")


def _first(kernel: Kernel, names: tuple[str, ...]) -> Kernel | None:
    if kernel.name in names:
        return kernel
    return next((found for part in kernel.parts if (found := _first(part, names)) is not None), None)


def _check_temper(temper: float) -> None:
    if not is_number(temper) or not 0 < temper < float("inf"):
        raise InputError("bad-temper", found=repr(temper))


def _check_ess(ess: float | None) -> None:
    if ess is not None and (not is_number(ess) or not 0 <= ess <= 1):
        raise InputError("bad-threshold", found=repr(ess))


def _way(anneal: Any, weights: str) -> float | tuple[float, ...] | None:
    """The way of the temperature, where it makes sense."""
    if anneal is None:
        return None
    if weights == "absolute":
        raise InputError(
            "bad-anneal", found=repr(anneal), reason="absolute weights have no temperature to go"
        )
    if is_number(anneal):
        if not 0 < anneal < 1:
            raise InputError("bad-anneal", found=repr(anneal), reason="a share lies between 0 and 1")
        return float(anneal)
    path = tuple(anneal) if isinstance(anneal, Sequence) and not isinstance(anneal, str) else ()
    if not path or not all(is_number(t) and 0 <= t < float("inf") for t in path):
        raise InputError(
            "bad-anneal", found=repr(anneal), reason="a schedule is a list of numbers that are not negative"
        )
    return tuple(float(t) for t in path)


def _fixed(anneal: Any) -> tuple[float, ...] | None:
    """The same for a chain, whose sweeps must all go the same way."""
    way = _way(anneal, "ratio")
    if isinstance(way, float):
        raise InputError(
            "bad-anneal",
            found=repr(anneal),
            reason="every sweep of a chain goes the same way, so it is a list",
        )
    return way
