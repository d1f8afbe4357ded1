"""Draws: a lower-case name makes a choice at once, `gaussian(0, 1)` for `sample(Gaussian(0, 1))`.

Parameters, defaults and docstring of such a word are those of its class in `distributions`. Written by
tests/house/words.py from the engine's table of families.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from niwaki.words import distributions as d
from niwaki.words.choices import draws

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

flip = draws("flip", d.Bernoulli, bool)
categorical = draws("categorical", d.Categorical, int)
discrete_uniform = draws("discrete_uniform", d.DiscreteUniform, int)
poisson = draws("poisson", d.Poisson, int)
binomial = draws("binomial", d.Binomial, int)
geometric = draws("geometric", d.Geometric, int)
uniform = draws("uniform", d.Uniform, float)
gaussian = draws("gaussian", d.Gaussian, float)
log_normal = draws("log_normal", d.LogNormal, float)
gamma = draws("gamma", d.Gamma, float)
inverse_gamma = draws("inverse_gamma", d.InverseGamma, float)
beta = draws("beta", d.Beta, float)
exponential = draws("exponential", d.Exponential, float)
laplace = draws("laplace", d.Laplace, float)
cauchy = draws("cauchy", d.Cauchy, float)
student_t = draws("student_t", d.StudentT, float)
von_mises = draws("von_mises", d.VonMises, float)
truncated_gaussian = draws("truncated_gaussian", d.TruncatedGaussian, float)
dirichlet = draws("dirichlet", d.Dirichlet, list[float])
multivariate_gaussian = draws("multivariate_gaussian", d.MultivariateGaussian, list[float])
diagonal_gaussian = draws("diagonal_gaussian", d.DiagonalGaussian, list[float])
multinomial = draws("multinomial", d.Multinomial, list[int])
multivariate_bernoulli = draws("multivariate_bernoulli", d.MultivariateBernoulli, list[bool])
mixture: Callable[[Sequence[float], Sequence[d.Distribution]], Any] = draws("mixture", d.Mixture, object)
