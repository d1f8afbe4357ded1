"""Distributions as values: `sample(Gaussian(0, 1))`, `observe(Gaussian(m, s), x)`.

The lower-case word of the same name (`gaussian(0, 1)`) draws from it at once. The engine knows a distribution by its
family and its parameters in the order of the fields; densities and draws are the engine's.

Each family is a class, so that an editor can complete and explain it. Written by tests/house/words.py from the engine's
table of families.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, ClassVar

__all__ = [
    "Bernoulli",
    "Beta",
    "Binomial",
    "Categorical",
    "Cauchy",
    "Delta",
    "DiagonalGaussian",
    "Dirichlet",
    "DiscreteUniform",
    "Distribution",
    "Exponential",
    "Gamma",
    "Gaussian",
    "Geometric",
    "InverseGamma",
    "Laplace",
    "LogNormal",
    "Mixture",
    "Multinomial",
    "MultivariateBernoulli",
    "MultivariateGaussian",
    "Poisson",
    "StudentT",
    "TruncatedGaussian",
    "Uniform",
    "VonMises",
]


@dataclass(frozen=True)
class Distribution:
    """Base class of all distributions, with the family's name and the parameters in order."""

    family: ClassVar[str] = ""

    @property
    def parameters(self) -> tuple[Any, ...]:
        """The parameters, in the order of the family's signature."""
        return tuple(getattr(self, field.name) for field in fields(self))


@dataclass(frozen=True)
class Bernoulli(Distribution):
    """True with probability `p`, else False.

    Parameters
    ----------
    p
        Probability of True, in [0, 1].
    """

    family: ClassVar[str] = "bernoulli"

    p: float = 0.5


@dataclass(frozen=True)
class Categorical(Distribution):
    """An index from 0, drawn with probability proportional to its weight.

    Parameters
    ----------
    weights
        Weight of each index, not negative, not all zero; they need not sum to one.
    """

    family: ClassVar[str] = "categorical"

    weights: Sequence[float]


@dataclass(frozen=True)
class DiscreteUniform(Distribution):
    """An integer from `lo` to `hi`, both included, all equally likely.

    Parameters
    ----------
    lo
        Least value.
    hi
        Greatest value, included.
    """

    family: ClassVar[str] = "discrete_uniform"

    lo: int
    hi: int


@dataclass(frozen=True)
class Poisson(Distribution):
    """A count of rare events with the given mean.

    Parameters
    ----------
    rate
        Mean, greater than 0.
    """

    family: ClassVar[str] = "poisson"

    rate: float = 1.0


@dataclass(frozen=True)
class Binomial(Distribution):
    """The number of successes in `n` trials.

    Parameters
    ----------
    n
        Number of trials, at least 0.
    p
        Probability of success of one trial, in [0, 1].
    """

    family: ClassVar[str] = "binomial"

    n: int
    p: float = 0.5


@dataclass(frozen=True)
class Geometric(Distribution):
    """The number of failures before the first success, from 0.

    Parameters
    ----------
    p
        Probability of success of one trial, in (0, 1].
    """

    family: ClassVar[str] = "geometric"

    p: float = 0.5


@dataclass(frozen=True)
class Uniform(Distribution):
    """A real number between `lo` and `hi`, all equally likely.

    Parameters
    ----------
    lo
        Lower end.
    hi
        Upper end, greater than `lo`.
    """

    family: ClassVar[str] = "uniform"

    lo: float = 0.0
    hi: float = 1.0


@dataclass(frozen=True)
class Gaussian(Distribution):
    """A real number from the bell curve.

    Parameters
    ----------
    mean
        Centre.
    sd
        Standard deviation, greater than 0.
    """

    family: ClassVar[str] = "gaussian"

    mean: float = 0.0
    sd: float = 1.0


@dataclass(frozen=True)
class LogNormal(Distribution):
    """A positive number whose logarithm is Gaussian.

    Parameters
    ----------
    mean
        Mean of the logarithm.
    sd
        Standard deviation of the logarithm, greater than 0.
    """

    family: ClassVar[str] = "log_normal"

    mean: float = 0.0
    sd: float = 1.0


@dataclass(frozen=True)
class Gamma(Distribution):
    """A positive number with mean `shape * scale`.

    Parameters
    ----------
    shape
        Shape, greater than 0.
    scale
        Scale, greater than 0.
    """

    family: ClassVar[str] = "gamma"

    shape: float
    scale: float = 1.0


@dataclass(frozen=True)
class InverseGamma(Distribution):
    """A positive number whose reciprocal is gamma distributed.

    Parameters
    ----------
    shape
        Shape, greater than 0.
    scale
        Scale, greater than 0.
    """

    family: ClassVar[str] = "inverse_gamma"

    shape: float
    scale: float = 1.0


@dataclass(frozen=True)
class Beta(Distribution):
    """A real number in (0, 1) with mean `a / (a + b)`.

    Parameters
    ----------
    a
        Weight towards 1, greater than 0.
    b
        Weight towards 0, greater than 0.
    """

    family: ClassVar[str] = "beta"

    a: float
    b: float


@dataclass(frozen=True)
class Exponential(Distribution):
    """A waiting time with mean `1 / rate`.

    Parameters
    ----------
    rate
        Events per unit, greater than 0.
    """

    family: ClassVar[str] = "exponential"

    rate: float = 1.0


@dataclass(frozen=True)
class Laplace(Distribution):
    """A real number that falls off exponentially on both sides.

    Parameters
    ----------
    loc
        Centre.
    scale
        Mean distance from the centre, greater than 0.
    """

    family: ClassVar[str] = "laplace"

    loc: float = 0.0
    scale: float = 1.0


@dataclass(frozen=True)
class Cauchy(Distribution):
    """A real number with very heavy tails.

    Parameters
    ----------
    loc
        Centre.
    scale
        Half width at half height, greater than 0.
    """

    family: ClassVar[str] = "cauchy"

    loc: float = 0.0
    scale: float = 1.0


@dataclass(frozen=True)
class StudentT(Distribution):
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

    family: ClassVar[str] = "student_t"

    df: float
    loc: float = 0.0
    scale: float = 1.0


@dataclass(frozen=True)
class VonMises(Distribution):
    """An angle in radians, around `mean`.

    Parameters
    ----------
    mean
        Central angle, radians.
    concentration
        How tight, at least 0.
    """

    family: ClassVar[str] = "von_mises"

    mean: float = 0.0
    concentration: float = 1.0


@dataclass(frozen=True)
class TruncatedGaussian(Distribution):
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

    family: ClassVar[str] = "truncated_gaussian"

    mean: float
    sd: float
    lo: float
    hi: float


@dataclass(frozen=True)
class Dirichlet(Distribution):
    """A list of shares that sum to one.

    Parameters
    ----------
    concentrations
        One for each share, greater than 0.
    """

    family: ClassVar[str] = "dirichlet"

    concentrations: Sequence[float]


@dataclass(frozen=True)
class MultivariateGaussian(Distribution):
    """A list of numbers that vary together.

    Parameters
    ----------
    mean
        Centre, (n,).
    covariance
        Symmetric and positive definite, (n, n).
    """

    family: ClassVar[str] = "multivariate_gaussian"

    mean: Sequence[float]
    covariance: Sequence[Sequence[float]]


@dataclass(frozen=True)
class DiagonalGaussian(Distribution):
    """A list of numbers that vary by themselves, each with its own centre and spread.

    Parameters
    ----------
    mean
        Centres, (n,).
    sd
        Standard deviations, (n,), greater than 0.
    """

    family: ClassVar[str] = "diagonal_gaussian"

    mean: Sequence[float]
    sd: Sequence[float]


@dataclass(frozen=True)
class Multinomial(Distribution):
    """How often each category came in `n` trials.

    Parameters
    ----------
    n
        Trials, at least 0.
    weights
        Weight of each category in a trial, not negative; at least one greater than 0.
    """

    family: ClassVar[str] = "multinomial"

    n: int
    weights: Sequence[float]


@dataclass(frozen=True)
class MultivariateBernoulli(Distribution):
    """A list of truth values that are drawn by themselves.

    Parameters
    ----------
    ps
        Of each its probability of being true, in [0, 1].
    """

    family: ClassVar[str] = "multivariate_bernoulli"

    ps: Sequence[float]


@dataclass(frozen=True)
class Mixture(Distribution):
    """A draw from one of several distributions, picked with probability proportional to its weight.

    Parameters
    ----------
    weights
        Weight of each component.
    components
        Distribution values, as many as weights.
    """

    family: ClassVar[str] = "mixture"

    weights: Sequence[float]
    components: Sequence[Distribution]


@dataclass(frozen=True)
class Delta(Distribution):
    """Always the same value.

    Parameters
    ----------
    value
        What every draw gives.
    """

    family: ClassVar[str] = "delta"

    value: Any


#: In the order of this file.
FAMILIES: tuple[type[Distribution], ...] = tuple(Distribution.__subclasses__())
