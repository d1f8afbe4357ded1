"""Methods as values: what `run` is asked to do, with every setting checked when it is made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from niwaki.errors import InputError

ORDERS = ("stochastic", "depth-first")
WEIGHTS = ("ratio", "absolute")
STRATEGIES = ("c3", "rerun", "resume", "cache")
METRICS = ("diagonal", "dense", "low-rank", "unit")
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


@dataclass(frozen=True)
class EnumerateAll:
    """Exact enumeration; see `enumerate_all`."""

    max_runs: int = 1_000_000


@dataclass(frozen=True)
class Rejection:
    """Rejection sampling; see `rejection`."""

    n: int = 100
    bound: float = 0.0
    max_tries: int = 1_000_000


@dataclass(frozen=True)
class Importance:
    """Likelihood weighting; see `importance`."""

    n: int = 1000


@dataclass(frozen=True)
class Forward:
    """Runs of the prior; see `forward`."""

    n: int = 1


@dataclass(frozen=True)
class Mh:
    """Metropolis-Hastings; see `mh`."""

    steps: int = 10_000
    strategy: str = "c3"
    chains: int = 1
    thin: int | None = None
    keep: int = 1000
    warmup: int = 0
    seed: int | None = None
    tries: int = 1000

    @property
    def spacing(self) -> int:
        """Proposals between two samples; 0 for none."""
        if self.keep == 0:
            return 0
        return self.thin if self.thin is not None else max(1, -(-(self.steps - self.warmup) // self.keep))


@dataclass(frozen=True)
class Hmc:
    """Hamiltonian Monte Carlo; see `hmc`."""

    draws: int = 1000
    steps: int = 100
    jitter: float = 0.0
    chains: int = 4
    warmup: int = 1000
    thin: int = 1
    target_accept: float = 0.65
    metric: str = "diagonal"
    step_size: float | None = None


@dataclass(frozen=True)
class Nuts:
    """The no-U-turn sampler; see `nuts`."""

    draws: int = 1000
    max_depth: int = 10
    chains: int = 4
    warmup: int = 1000
    thin: int = 1
    target_accept: float = 0.8
    metric: str = "diagonal"
    step_size: float | None = None


Method = Smc | ParticleGibbs | Pimh | EnumerateAll | Rejection | Importance | Forward | Mh


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
        `diverse` as many as that, when left out.
    diverse
        Give so many results that differ, best score first: none shares more than half of its choices with another. One
        population ends as many copies of few runs, so this needs several. Where fewer are found, fewer are given, with
        a warning.
    seconds
        Instead of a number of particles: populations one after the other until this time is spent, their sizes planned
        from measured costs and told by `Result.plan`.
    """
    if seconds is not None:
        if not _number(seconds) or not 0 < seconds < float("inf"):
            raise _bad("seconds", seconds, "a number of seconds above 0", "10")
        if populations is not None or not _whole(particles):
            other = "populations" if populations is not None else "particles"
            raise _bad(other, populations or particles, "no number of populations beside `seconds`", "None")
    sizes = particles if isinstance(particles, int) else tuple(particles)
    for size in (sizes,) if isinstance(sizes, int) else sizes or (0,):
        if not _whole(size) or size < 1:
            raise InputError("no-particles", found=repr(size))
    _one_of("order", order, ORDERS)
    _one_of("weights", weights, WEIGHTS)
    _one_of("resampling", resampling, RESAMPLING)
    _check_temper(temper)
    _check_ess(ess)
    if diverse is not None:
        at_least_one("diverse", diverse)
    if populations is not None:
        at_least_one("populations", populations)
        if not isinstance(sizes, int):
            raise _bad("populations", populations, "nothing beside a list of sizes", "None")
    return Smc(
        sizes,
        order,
        weights,
        float(temper),
        resampling,
        ess,
        _way(anneal, weights),
        populations or diverse or 1,
        diverse,
        None if seconds is None else float(seconds),
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
    if not _whole(particles) or particles < 2:
        raise _bad("particles", particles, "a whole number above 1", "100")
    at_least_one("sweeps", sweeps)
    _one_of("order", order, ORDERS)
    _check_temper(temper)
    _check_ess(ess)
    if start is not None and not hasattr(start, "_outcome"):
        raise _bad("start", start, "a sample of a search", "result.best")
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
    `Result.tries` proposals were accepted; the evidence is the mean of all populations' estimates.

    Parameters
    ----------
    particles, order, temper, resampling, ess
        As for `smc`.
    sweeps
        How many; one sample each.
    anneal
        The power at each barrier, as for `smc`.
    """
    if not _whole(particles) or particles < 1:
        raise InputError("no-particles", found=repr(particles))
    at_least_one("sweeps", sweeps)
    _one_of("order", order, ORDERS)
    _one_of("resampling", resampling, RESAMPLING)
    _check_temper(temper)
    _check_ess(ess)
    return Pimh(particles, sweeps, order, float(temper), resampling, ess, _fixed(anneal))


def mh(
    steps: int = 10_000,
    strategy: str = "c3",
    chains: int = 1,
    thin: int | None = None,
    keep: int = 1000,
    warmup: int = 0,
    seed: int | None = None,
    tries: int = 1000,
) -> Mh:
    """Markov chains: one state each, changed proposal by proposal (dissertation chapter 3).

    Parameters
    ----------
    steps
        Proposals of each chain, warm-up included.
    strategy
        How much of the model is run again for a proposal: "c3" (from the changed choice on, skipping calls whose inputs
        are unchanged), "resume" (from the choice on), "cache" (from the start, skipping), "rerun" (all of it). The states
        are the same to the bit; only the time differs.
    chains
        How many, side by side on the machine's threads.
    thin
        Proposals between two samples; when left out as many as give `keep` samples. It doubles when samples take too
        much memory.
    keep
        About how many samples of each chain; 0 for none (the best state is always kept).
    warmup
        Proposals before the first sample; step sizes are adapted in them, and never after.
    seed
        As for `run`, which comes first.
    tries
        Most forward runs for a first state that is possible.
    """
    for name, value in (("steps", steps), ("chains", chains), ("tries", tries)):
        at_least_one(name, value)
    if thin is not None:
        at_least_one("thin", thin)
    for name, value in (("keep", keep), ("warmup", warmup)):
        if not _whole(value) or value < 0:
            raise InputError(
                "bad-setting",
                name=name,
                found=repr(value),
                expected="a whole number, 0 or more",
                suggestion="0",
            )
    if warmup >= steps:
        raise InputError(
            "bad-setting",
            name="warmup",
            found=repr(warmup),
            expected="fewer proposals than `steps`",
            suggestion=repr(steps // 5),
        )
    _one_of("strategy", strategy, STRATEGIES)
    return Mh(steps, strategy, chains, thin, keep, warmup, seed, tries)


def enumerate_all(max_runs: int = 1_000_000) -> EnumerateAll:
    """The exact distribution of a model's value, by visiting every run.

    Parameters
    ----------
    max_runs
        Most complete runs to visit.
    """
    return EnumerateAll(at_least_one("max_runs", max_runs))


def rejection(n: int = 100, bound: float = 0.0, max_tries: int = 1_000_000) -> Rejection:
    """Exact samples: forward runs, kept with probability `exp(log_score - bound)`.

    Parameters
    ----------
    n
        How many samples.
    bound
        A log score that no run exceeds, nats; 0 serves for conditions.
    max_tries
        Most runs to try.
    """
    if not _number(bound) or bound != bound:
        raise InputError(
            "bad-setting", name="bound", found=repr(bound), expected="a number of nats", suggestion="0"
        )
    return Rejection(_samples(n), float(bound), at_least_one("max_tries", max_tries))


def importance(n: int = 1000) -> Importance:
    """Independent forward runs, each weighted by its score.

    Parameters
    ----------
    n
        How many runs.
    """
    return Importance(_samples(n))


def forward(n: int = 1) -> Forward:
    """Runs of the prior: every choice is drawn from its distribution, whatever the score.

    Parameters
    ----------
    n
        How many runs.
    """
    return Forward(_samples(n))


def hmc(
    draws: int = 1000,
    steps: int = 100,
    jitter: float = 0.0,
    chains: int = 4,
    warmup: int = 1000,
    thin: int = 1,
    target_accept: float = 0.65,
    metric: str = "diagonal",
    step_size: float | None = None,
) -> Hmc:
    """Chains that follow the gradient for a fixed number of steps (dissertation 4.3).

    Parameters
    ----------
    draws
        Of each chain, after warm-up.
    steps
        Leapfrog steps of a trajectory; the dissertation takes 100 for colours and 1000 for stacks.
    jitter
        The number of steps varies by this share of itself, [0, 1]; 0, the dissertation's setting, keeps it.
    chains
        How many; two or more show whether they agree.
    warmup
        Transitions of each chain in which step size and metric are adapted; not among the draws.
    thin
        Transitions for each draw.
    target_accept
        Mean acceptance that the step size is adapted to, (0, 1).
    metric
        What is learnt of the target's shape: "diagonal", a scale for each coordinate; "low-rank", and a few directions;
        "dense", the whole covariance, which suits what is nearly normal; "unit", nothing (the dissertation's setting).
    step_size
        A step to keep instead of an adapted one.
    """
    common = _chain_settings(draws, chains, warmup, thin, target_accept, metric, step_size)
    if not _number(jitter) or not 0 <= jitter <= 1:
        raise InputError(
            "bad-setting", name="jitter", found=repr(jitter), expected="a share in [0, 1]", suggestion="0.5"
        )
    return Hmc(steps=at_least_one("steps", steps), jitter=float(jitter), **common)


def nuts(
    draws: int = 1000,
    max_depth: int = 10,
    chains: int = 4,
    warmup: int = 1000,
    thin: int = 1,
    target_accept: float = 0.8,
    metric: str = "diagonal",
    step_size: float | None = None,
) -> Nuts:
    """Chains that follow the gradient until they turn back (Hoffman & Gelman 2014; Betancourt 2017).

    Parameters
    ----------
    max_depth
        Most doublings of a trajectory: 2^max_depth - 1 steps; up to 20.
    draws, chains, warmup, thin, target_accept, metric, step_size
        As for `hmc`.
    """
    common = _chain_settings(draws, chains, warmup, thin, target_accept, metric, step_size)
    if not _whole(max_depth) or not 1 <= max_depth <= 20:
        raise InputError(
            "bad-setting",
            name="max_depth",
            found=repr(max_depth),
            expected="a whole number from 1 to 20",
            suggestion="10",
        )
    return Nuts(max_depth=max_depth, **common)


def _chain_settings(
    draws: int,
    chains: int,
    warmup: int,
    thin: int,
    target_accept: float,
    metric: str,
    step_size: float | None,
) -> dict[str, Any]:
    """Check what all chains have in common."""
    if not _whole(warmup) or warmup < 0:
        raise InputError(
            "bad-setting",
            name="warmup",
            found=repr(warmup),
            expected="a whole number, 0 or more",
            suggestion="1000",
        )
    if not _number(target_accept) or not 0 < target_accept < 1:
        raise InputError(
            "bad-setting",
            name="target_accept",
            found=repr(target_accept),
            expected="a share between 0 and 1",
            suggestion="0.8",
        )
    if step_size is not None and (not _number(step_size) or not 0 < step_size < float("inf")):
        raise InputError(
            "bad-setting",
            name="step_size",
            found=repr(step_size),
            expected="a number above 0",
            suggestion="0.1, or leave it out",
        )
    _one_of("metric", metric, METRICS)
    return {
        "draws": at_least_one("draws", draws),
        "chains": at_least_one("chains", chains),
        "warmup": warmup,
        "thin": at_least_one("thin", thin),
        "target_accept": float(target_accept),
        "metric": metric,
        "step_size": None if step_size is None else float(step_size),
    }


def _bad(name: str, found: Any, expected: str, suggestion: str) -> InputError:
    return InputError("bad-setting", name=name, found=repr(found), expected=expected, suggestion=suggestion)


def _check_temper(temper: float) -> None:
    if not _number(temper) or not 0 < temper < float("inf"):
        raise InputError("bad-temper", found=repr(temper))


def _check_ess(ess: float | None) -> None:
    if ess is not None and (not _number(ess) or not 0 <= ess <= 1):
        raise InputError("bad-threshold", found=repr(ess))


def _way(anneal: Any, weights: str) -> float | tuple[float, ...] | None:
    """The way of the temperature, where it makes sense."""
    if anneal is None:
        return None
    if weights == "absolute":
        raise InputError(
            "bad-anneal", found=repr(anneal), reason="absolute weights have no temperature to go"
        )
    if _number(anneal):
        if not 0 < anneal < 1:
            raise InputError("bad-anneal", found=repr(anneal), reason="a share lies between 0 and 1")
        return float(anneal)
    path = tuple(anneal) if isinstance(anneal, Sequence) and not isinstance(anneal, str) else ()
    if not path or not all(_number(t) and 0 <= t < float("inf") for t in path):
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


def _whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _samples(n: int) -> int:
    if not _whole(n) or n < 1:
        raise InputError("no-samples", detail=f"n={n!r}")
    return n


def at_least_one(name: str, value: int) -> int:
    """The value, where it is a whole number above zero."""
    if not _whole(value) or value < 1:
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(value),
            expected="a whole number above 0",
            suggestion="1 or more",
        )
    return value


def _one_of(name: str, value: str, known: tuple[str, ...]) -> None:
    if value not in known:
        listed = ", ".join(f'"{one}"' for one in known)
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(value),
            expected=f"one of {listed}",
            suggestion=f'"{known[0]}"',
        )
