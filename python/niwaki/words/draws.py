"""Draws: a lower-case name makes a choice at once, `gaussian(0, 1)` for `sample(Gaussian(0, 1))`.

Parameters and defaults of such a word are those of its class in `distributions`, and a `label`. Written by
tests/house/words.py from the engine's table of families.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from niwaki.words import distributions as d
from niwaki.words.running import runner

__all__ = [
    "beta",
    "binomial",
    "categorical",
    "cauchy",
    "diagonal_gaussian",
    "dirichlet",
    "discrete_uniform",
    "exponential",
    "flip",
    "gamma",
    "gaussian",
    "geometric",
    "inverse_gamma",
    "laplace",
    "log_normal",
    "mixture",
    "multinomial",
    "multivariate_bernoulli",
    "multivariate_gaussian",
    "poisson",
    "student_t",
    "truncated_gaussian",
    "uniform",
    "von_mises",
]


def flip(p: float = 0.5, *, label: str | None = None) -> bool:
    """True with probability `p`, else False.

    Parameters
    ----------
    p
        Probability of True, in [0, 1].
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: bool = runner("flip").sample(d.Bernoulli(p))
    return drawn


def categorical(weights: Sequence[float], *, label: str | None = None) -> int:
    """An index from 0, drawn with probability proportional to its weight.

    Parameters
    ----------
    weights
        Weight of each index, not negative, not all zero; they need not sum to one.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: int = runner("categorical").sample(d.Categorical(weights))
    return drawn


def discrete_uniform(lo: int, hi: int, *, label: str | None = None) -> int:
    """An integer from `lo` to `hi`, both included, all equally likely.

    Parameters
    ----------
    lo
        Least value.
    hi
        Greatest value, included.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: int = runner("discrete_uniform").sample(d.DiscreteUniform(lo, hi))
    return drawn


def poisson(rate: float = 1.0, *, label: str | None = None) -> int:
    """A count of rare events with the given mean.

    Parameters
    ----------
    rate
        Mean, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: int = runner("poisson").sample(d.Poisson(rate))
    return drawn


def binomial(n: int, p: float = 0.5, *, label: str | None = None) -> int:
    """The number of successes in `n` trials.

    Parameters
    ----------
    n
        Number of trials, at least 0.
    p
        Probability of success of one trial, in [0, 1].
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: int = runner("binomial").sample(d.Binomial(n, p))
    return drawn


def geometric(p: float = 0.5, *, label: str | None = None) -> int:
    """The number of failures before the first success, from 0.

    Parameters
    ----------
    p
        Probability of success of one trial, in (0, 1].
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: int = runner("geometric").sample(d.Geometric(p))
    return drawn


def uniform(lo: float = 0.0, hi: float = 1.0, *, label: str | None = None) -> float:
    """A real number between `lo` and `hi`, all equally likely.

    Parameters
    ----------
    lo
        Lower end.
    hi
        Upper end, greater than `lo`.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("uniform").sample(d.Uniform(lo, hi))
    return drawn


def gaussian(mean: float = 0.0, sd: float = 1.0, *, label: str | None = None) -> float:
    """A real number from the bell curve.

    Parameters
    ----------
    mean
        Centre.
    sd
        Standard deviation, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("gaussian").sample(d.Gaussian(mean, sd))
    return drawn


def log_normal(mean: float = 0.0, sd: float = 1.0, *, label: str | None = None) -> float:
    """A positive number whose logarithm is Gaussian.

    Parameters
    ----------
    mean
        Mean of the logarithm.
    sd
        Standard deviation of the logarithm, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("log_normal").sample(d.LogNormal(mean, sd))
    return drawn


def gamma(shape: float, scale: float = 1.0, *, label: str | None = None) -> float:
    """A positive number with mean `shape * scale`.

    Parameters
    ----------
    shape
        Shape, greater than 0.
    scale
        Scale, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("gamma").sample(d.Gamma(shape, scale))
    return drawn


def inverse_gamma(shape: float, scale: float = 1.0, *, label: str | None = None) -> float:
    """A positive number whose reciprocal is gamma distributed.

    Parameters
    ----------
    shape
        Shape, greater than 0.
    scale
        Scale, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("inverse_gamma").sample(d.InverseGamma(shape, scale))
    return drawn


def beta(a: float, b: float, *, label: str | None = None) -> float:
    """A real number in (0, 1) with mean `a / (a + b)`.

    Parameters
    ----------
    a
        Weight towards 1, greater than 0.
    b
        Weight towards 0, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("beta").sample(d.Beta(a, b))
    return drawn


def exponential(rate: float = 1.0, *, label: str | None = None) -> float:
    """A waiting time with mean `1 / rate`.

    Parameters
    ----------
    rate
        Events per unit, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("exponential").sample(d.Exponential(rate))
    return drawn


def laplace(loc: float = 0.0, scale: float = 1.0, *, label: str | None = None) -> float:
    """A real number that falls off exponentially on both sides.

    Parameters
    ----------
    loc
        Centre.
    scale
        Mean distance from the centre, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("laplace").sample(d.Laplace(loc, scale))
    return drawn


def cauchy(loc: float = 0.0, scale: float = 1.0, *, label: str | None = None) -> float:
    """A real number with very heavy tails.

    Parameters
    ----------
    loc
        Centre.
    scale
        Half width at half height, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("cauchy").sample(d.Cauchy(loc, scale))
    return drawn


def student_t(df: float, loc: float = 0.0, scale: float = 1.0, *, label: str | None = None) -> float:
    """A real number from a bell with heavy tails.

    Parameters
    ----------
    df
        Degrees of freedom, greater than 0.
    loc
        Centre.
    scale
        Width, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("student_t").sample(d.StudentT(df, loc, scale))
    return drawn


def von_mises(mean: float = 0.0, concentration: float = 1.0, *, label: str | None = None) -> float:
    """An angle in radians, around `mean`.

    Parameters
    ----------
    mean
        Central angle, radians.
    concentration
        How tight, at least 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("von_mises").sample(d.VonMises(mean, concentration))
    return drawn


def truncated_gaussian(mean: float, sd: float, lo: float, hi: float, *, label: str | None = None) -> float:
    """A Gaussian kept between `lo` and `hi`.

    Parameters
    ----------
    mean
        Centre of the whole bell.
    sd
        Standard deviation of the whole bell, greater than 0.
    lo
        Lower end.
    hi
        Upper end, greater than `lo`.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: float = runner("truncated_gaussian").sample(d.TruncatedGaussian(mean, sd, lo, hi))
    return drawn


def dirichlet(concentrations: Sequence[float], *, label: str | None = None) -> list[float]:
    """A list of shares that sum to one.

    Parameters
    ----------
    concentrations
        One for each share, greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: list[float] = runner("dirichlet").sample(d.Dirichlet(concentrations))
    return drawn


def multivariate_gaussian(
    mean: Sequence[float], covariance: Sequence[Sequence[float]], *, label: str | None = None
) -> list[float]:
    """A list of numbers that vary together.

    Parameters
    ----------
    mean
        Centre, (n,).
    covariance
        Symmetric and positive definite, (n, n).
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: list[float] = runner("multivariate_gaussian").sample(d.MultivariateGaussian(mean, covariance))
    return drawn


def diagonal_gaussian(mean: Sequence[float], sd: Sequence[float], *, label: str | None = None) -> list[float]:
    """A list of numbers that vary by themselves, each with its own centre and spread.

    Parameters
    ----------
    mean
        Centres, (n,).
    sd
        Standard deviations, (n,), greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: list[float] = runner("diagonal_gaussian").sample(d.DiagonalGaussian(mean, sd))
    return drawn


def multinomial(n: int, weights: Sequence[float], *, label: str | None = None) -> list[int]:
    """How often each category came in `n` trials.

    Parameters
    ----------
    n
        Trials, at least 0.
    weights
        Weight of each category in a trial, not negative; at least one greater than 0.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: list[int] = runner("multinomial").sample(d.Multinomial(n, weights))
    return drawn


def multivariate_bernoulli(ps: Sequence[float], *, label: str | None = None) -> list[bool]:
    """A list of truth values that are drawn by themselves.

    Parameters
    ----------
    ps
        Of each its probability of being true, in [0, 1].
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    drawn: list[bool] = runner("multivariate_bernoulli").sample(d.MultivariateBernoulli(ps))
    return drawn


def mixture(
    weights: Sequence[float], components: Sequence[d.Distribution], *, label: str | None = None
) -> Any:
    """A draw from one of several distributions, picked with probability proportional to its weight.

    Parameters
    ----------
    weights
        Weight of each component.
    components
        Distribution values, as many as weights.
    label
        The choice's name for people, a constant text; by default what the choice decides.
    """
    return runner("mixture").sample(d.Mixture(weights, components))
