"""Draws: a distribution's lower-case name makes a choice at once, `gaussian(0, 1)` for `sample(Gaussian(0, 1))`.

A table in the shape of functions, so that an editor can complete and explain every family; this is why it is long.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

from niwaki.words import distributions as d
from niwaki.words.running import runner

T = TypeVar("T")


def sample(dist: d.Distribution) -> Any:
    """Draw a value from a distribution.

    Parameters
    ----------
    dist
        A distribution value such as `Gaussian(0, 1)`.
    """
    return runner("sample").sample(dist)


def flip(p: float = 0.5) -> bool:
    """True with probability `p`, else False.

    Parameters
    ----------
    p
        Probability of True, in [0, 1].
    """
    drawn: bool = runner("flip").sample(d.Bernoulli(p))
    return drawn


def categorical(weights: Sequence[float]) -> int:
    """An index from 0, drawn with odds proportional to `weights`.

    Parameters
    ----------
    weights
        Odds of each index, not negative, not all zero; they need not sum to one.
    """
    drawn: int = runner("categorical").sample(d.Categorical(weights))
    return drawn


def discrete_uniform(lo: int, hi: int) -> int:
    """An integer from `lo` to `hi`, both included, all equally likely.

    Parameters
    ----------
    lo
        Least value.
    hi
        Greatest value, included.
    """
    drawn: int = runner("discrete_uniform").sample(d.DiscreteUniform(lo, hi))
    return drawn


def poisson(rate: float = 1.0) -> int:
    """A count of rare events with the given mean.

    Parameters
    ----------
    rate
        Mean, greater than 0.
    """
    drawn: int = runner("poisson").sample(d.Poisson(rate))
    return drawn


def binomial(n: int, p: float = 0.5) -> int:
    """The number of successes in `n` trials.

    Parameters
    ----------
    n
        Number of trials, at least 0.
    p
        Probability of success of one trial, in [0, 1].
    """
    drawn: int = runner("binomial").sample(d.Binomial(n, p))
    return drawn


def geometric(p: float = 0.5) -> int:
    """The number of failures before the first success, from 0.

    Parameters
    ----------
    p
        Probability of success of one trial, in (0, 1].
    """
    drawn: int = runner("geometric").sample(d.Geometric(p))
    return drawn


def uniform(lo: float = 0.0, hi: float = 1.0) -> float:
    """A real number between `lo` and `hi`, all equally likely.

    Parameters
    ----------
    lo
        Lower end.
    hi
        Upper end, greater than `lo`.
    """
    drawn: float = runner("uniform").sample(d.Uniform(lo, hi))
    return drawn


def gaussian(mean: float = 0.0, sd: float = 1.0) -> float:
    """A real number from the bell curve.

    Parameters
    ----------
    mean
        Centre.
    sd
        Standard deviation, greater than 0.
    """
    drawn: float = runner("gaussian").sample(d.Gaussian(mean, sd))
    return drawn


def log_normal(mean: float = 0.0, sd: float = 1.0) -> float:
    """A positive number whose logarithm is Gaussian.

    Parameters
    ----------
    mean
        Mean of the logarithm.
    sd
        Standard deviation of the logarithm, greater than 0.
    """
    drawn: float = runner("log_normal").sample(d.LogNormal(mean, sd))
    return drawn


def gamma(shape: float, scale: float = 1.0) -> float:
    """A positive number with mean `shape * scale`.

    Parameters
    ----------
    shape
        Shape, greater than 0.
    scale
        Scale, greater than 0.
    """
    drawn: float = runner("gamma").sample(d.Gamma(shape, scale))
    return drawn


def inverse_gamma(shape: float, scale: float = 1.0) -> float:
    """A positive number whose reciprocal is gamma distributed.

    Parameters
    ----------
    shape
        Shape, greater than 0.
    scale
        Scale, greater than 0.
    """
    drawn: float = runner("inverse_gamma").sample(d.InverseGamma(shape, scale))
    return drawn


def beta(a: float, b: float) -> float:
    """A real number in (0, 1) with mean `a / (a + b)`.

    Parameters
    ----------
    a
        Weight towards 1, greater than 0.
    b
        Weight towards 0, greater than 0.
    """
    drawn: float = runner("beta").sample(d.Beta(a, b))
    return drawn


def exponential(rate: float = 1.0) -> float:
    """A waiting time with mean `1 / rate`.

    Parameters
    ----------
    rate
        Events per unit, greater than 0.
    """
    drawn: float = runner("exponential").sample(d.Exponential(rate))
    return drawn


def laplace(loc: float = 0.0, scale: float = 1.0) -> float:
    """A real number that falls off exponentially on both sides.

    Parameters
    ----------
    loc
        Centre.
    scale
        Mean distance from the centre, greater than 0.
    """
    drawn: float = runner("laplace").sample(d.Laplace(loc, scale))
    return drawn


def cauchy(loc: float = 0.0, scale: float = 1.0) -> float:
    """A real number with very heavy tails.

    Parameters
    ----------
    loc
        Centre.
    scale
        Half width at half height, greater than 0.
    """
    drawn: float = runner("cauchy").sample(d.Cauchy(loc, scale))
    return drawn


def student_t(df: float, loc: float = 0.0, scale: float = 1.0) -> float:
    """A real number from a bell with heavy tails.

    Parameters
    ----------
    df
        Degrees of freedom, greater than 0.
    loc
        Centre.
    scale
        Width, greater than 0.
    """
    drawn: float = runner("student_t").sample(d.StudentT(df, loc, scale))
    return drawn


def von_mises(mean: float = 0.0, concentration: float = 1.0) -> float:
    """An angle in radians, around `mean`.

    Parameters
    ----------
    mean
        Central angle, radians.
    concentration
        How tight, at least 0.
    """
    drawn: float = runner("von_mises").sample(d.VonMises(mean, concentration))
    return drawn


def truncated_gaussian(mean: float, sd: float, lo: float, hi: float) -> float:
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
    """
    drawn: float = runner("truncated_gaussian").sample(d.TruncatedGaussian(mean, sd, lo, hi))
    return drawn


def dirichlet(concentrations: Sequence[float]) -> list[float]:
    """A list of shares that sum to one.

    Parameters
    ----------
    concentrations
        One for each share, greater than 0.
    """
    drawn: list[float] = runner("dirichlet").sample(d.Dirichlet(concentrations))
    return drawn


def multivariate_gaussian(mean: Sequence[float], covariance: Sequence[Sequence[float]]) -> list[float]:
    """A list of numbers that vary together.

    Parameters
    ----------
    mean
        Centre, (n,).
    covariance
        Symmetric and positive definite, (n, n).
    """
    drawn: list[float] = runner("multivariate_gaussian").sample(d.MultivariateGaussian(mean, covariance))
    return drawn


def mixture(weights: Sequence[float], components: Sequence[d.Distribution]) -> Any:
    """A draw from one of several distributions, picked with odds proportional to `weights`.

    Parameters
    ----------
    weights
        Odds of each component.
    components
        Distribution values, as many as weights.
    """
    drawn: Any = runner("mixture").sample(d.Mixture(weights, components))
    return drawn


def choose(values: Sequence[T], weights: Sequence[float] | None = None) -> T:
    """One of `values`, all equally likely or with odds proportional to `weights`.

    Parameters
    ----------
    values
        What to choose from, a list or tuple; not empty.
    weights
        Odds of each value, as many as values.
    """
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    index: int = runner("choose").sample(dist)
    return values[index]
