"""Draws: a distribution's lower-case name makes a choice at once, `gaussian(0, 1)` for `sample(Gaussian(0, 1))`.

Parameters, defaults and docstring of such a word are those of its class in `distributions`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, ParamSpec, TypeVar

from niwaki.words import distributions as d
from niwaki.words.running import runner

__all__ = [
    "beta",
    "binomial",
    "categorical",
    "cauchy",
    "choose",
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
    "sample",
    "student_t",
    "truncated_gaussian",
    "uniform",
    "von_mises",
]

P = ParamSpec("P")
T = TypeVar("T")


def _draws(name: str, family: Callable[P, d.Distribution], drawn: type[T]) -> Callable[P, T]:
    """The word that draws from a family, and what type of value it gives."""

    def draw(*args: P.args, **kwargs: P.kwargs) -> T:
        value: T = runner(name).sample(family(*args, **kwargs))
        return value

    draw.__name__ = draw.__qualname__ = name
    draw.__doc__, draw.__wrapped__ = family.__doc__, family  # type: ignore[attr-defined]
    return draw


def sample(dist: d.Distribution) -> Any:
    """Draw a value from a distribution.

    Parameters
    ----------
    dist
        A distribution value such as `Gaussian(0, 1)`.
    """
    return runner("sample").sample(dist)


flip = _draws("flip", d.Bernoulli, bool)
categorical = _draws("categorical", d.Categorical, int)
discrete_uniform = _draws("discrete_uniform", d.DiscreteUniform, int)
poisson = _draws("poisson", d.Poisson, int)
binomial = _draws("binomial", d.Binomial, int)
geometric = _draws("geometric", d.Geometric, int)
uniform = _draws("uniform", d.Uniform, float)
gaussian = _draws("gaussian", d.Gaussian, float)
log_normal = _draws("log_normal", d.LogNormal, float)
gamma = _draws("gamma", d.Gamma, float)
inverse_gamma = _draws("inverse_gamma", d.InverseGamma, float)
beta = _draws("beta", d.Beta, float)
exponential = _draws("exponential", d.Exponential, float)
laplace = _draws("laplace", d.Laplace, float)
cauchy = _draws("cauchy", d.Cauchy, float)
student_t = _draws("student_t", d.StudentT, float)
von_mises = _draws("von_mises", d.VonMises, float)
truncated_gaussian = _draws("truncated_gaussian", d.TruncatedGaussian, float)
dirichlet = _draws("dirichlet", d.Dirichlet, list[float])
multivariate_gaussian = _draws("multivariate_gaussian", d.MultivariateGaussian, list[float])
diagonal_gaussian = _draws("diagonal_gaussian", d.DiagonalGaussian, list[float])
multinomial = _draws("multinomial", d.Multinomial, list[int])
multivariate_bernoulli = _draws("multivariate_bernoulli", d.MultivariateBernoulli, list[bool])
mixture: Callable[[Sequence[float], Sequence[d.Distribution]], Any] = _draws("mixture", d.Mixture, object)


def choose(values: Sequence[T], weights: Sequence[float] | None = None) -> T:
    """One of `values`, all equally likely or with probability proportional to its weight.

    Parameters
    ----------
    values
        What to choose from, a list or tuple; not empty.
    weights
        Weight of each value, as many as values.
    """
    dist = d.DiscreteUniform(0, len(values) - 1) if weights is None else d.Categorical(weights)
    index: int = runner("choose").sample(dist)
    return values[index]
