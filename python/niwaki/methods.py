"""Methods as values: what `run` is asked to do, with every setting checked when it is made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from niwaki.errors import InputError
from niwaki.kernels import Kernel

ORDERS = ("stochastic", "depth-first")
WEIGHTS = ("ratio", "absolute")
STRATEGIES = ("c3", "rerun", "resume", "cache")
METRICS = ("diagonal", "dense", "low-rank", "unit")
RESAMPLING = ("systematic", "residual", "stratified", "multinomial")


@dataclass(frozen=True)
class Smc:
    """Sequential Monte Carlo; see `smc`."""

    particles: int = 300
    order: str = "stochastic"
    weights: str = "ratio"
    temper: float = 1.0
    resampling: str = "systematic"
    ess: float | None = None


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
    kernel: Kernel | None = None
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


Method = Smc | EnumerateAll | Rejection | Importance | Forward | Mh


def smc(
    particles: int = 300,
    order: str = "stochastic",
    weights: str = "ratio",
    temper: float = 1.0,
    resampling: str = "systematic",
    ess: float | None = None,
) -> Smc:
    """A population of particles that is scored and resampled while it grows.

    Parameters
    ----------
    particles
        How many; at least 1.
    order
        "stochastic": after each barrier a uniform draw among the futures that can run; "depth-first": futures run
        where they are created.
    weights
        "ratio": the ratio of successive scores, so that the final set follows the posterior; "absolute": the whole
        score at every step, an undeclared sharpening without evidence.
    temper
        The power to which scores are raised while searching; 1 for the posterior. Reported scores are never tempered.
    resampling
        "systematic", "residual", "stratified" or "multinomial".
    ess
        Resample only when the effective sample size falls below this share of the particles; at every barrier when left
        out.
    """
    if not _whole(particles) or particles < 1:
        raise InputError("no-particles", found=repr(particles))
    _one_of("order", order, ORDERS)
    _one_of("weights", weights, WEIGHTS)
    _one_of("resampling", resampling, RESAMPLING)
    if not _number(temper) or not 0 < temper < float("inf"):
        raise InputError("bad-temper", found=repr(temper))
    if ess is not None and (not _number(ess) or not 0 <= ess <= 1):
        raise InputError("bad-threshold", found=repr(ess))
    return Smc(particles, order, weights, float(temper), resampling, ess)


def mh(
    steps: int = 10_000,
    strategy: str = "c3",
    kernel: Kernel | None = None,
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
    kernel
        How it proposes, a value of `niwaki.kernels`; `kernels.mh()` when left out.
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
    if kernel is not None and not isinstance(kernel, Kernel):
        raise InputError(
            "bad-setting",
            name="kernel",
            found=repr(kernel),
            expected="a kernel",
            suggestion="one of `niwaki.kernels`, such as `kernels.drift()`",
        )
    return Mh(steps, strategy, kernel, chains, thin, keep, warmup, seed, tries)


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
    return Hmc(steps=_at_least_one("steps", steps), jitter=float(jitter), **common)


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
        "draws": _at_least_one("draws", draws),
        "chains": _at_least_one("chains", chains),
        "warmup": warmup,
        "thin": _at_least_one("thin", thin),
        "target_accept": float(target_accept),
        "metric": metric,
        "step_size": None if step_size is None else float(step_size),
    }


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
