"""The mixture of Gaussians of appendix A, in many equivalent variants.

Each takes the number of points, 100 to 1000 for the sizes 1 to 10, and makes the same choices and observations in the
same order. FORMS names them.
"""

from niwaki import categorical, dirichlet, gaussian, model, observe, query, uniform
from niwaki.gallery.gmm import COMPONENTS, POINTS
from niwaki.words import Gaussian


def components():
    """Weights, means and deviations."""
    weights = dirichlet([1.0] * COMPONENTS)
    means = [gaussian(0.0, 10.0) for _ in range(COMPONENTS)]
    deviations = [uniform(0.1, 4.0) for _ in range(COMPONENTS)]
    return weights, means, deviations


def point(n, weights, means, deviations):
    """The component of point n."""
    k = categorical(weights)
    observe(Gaussian(means[k], deviations[k]), POINTS[n])
    return k


@model
def one_by_one(points=100):
    """By recursion from the first point to the last."""
    weights, means, deviations = components()
    onward(0, points, weights, means, deviations)
    return means


def onward(n, points, weights, means, deviations):
    """Points n and later."""
    if n < points:
        point(n, weights, means, deviations)
        onward(n + 1, points, weights, means, deviations)


@model
def by_halves(points=100):
    """By recursion over halves of the points."""
    weights, means, deviations = components()
    half(0, points, weights, means, deviations)
    return means


def half(i, j, weights, means, deviations):
    """Points i to j - 1."""
    if j - i == 1:
        point(i, weights, means, deviations)
    else:
        middle = (i + j) // 2
        half(i, middle, weights, means, deviations)
        half(middle, j, weights, means, deviations)


@model
def for_loop(points=100):
    """A `for`."""
    weights, means, deviations = components()
    for n in range(points):
        k = categorical(weights)
        observe(Gaussian(means[k], deviations[k]), POINTS[n])
    return means


@model
def comprehension(points=100):
    """A comprehension, whose list is not used further."""
    weights, means, deviations = components()
    _ = [point(n, weights, means, deviations) for n in range(points)]
    return means


@model
def returned_list(points=100):
    """A `for` that returns the list of all components."""
    weights, means, deviations = components()
    found = []
    for n in range(points):
        k = categorical(weights)
        observe(Gaussian(means[k], deviations[k]), POINTS[n])
        found = found + [k]
    return means, found


@model
def queried(points=100):
    """By halves, with a `query` of each mean and deviation, as the WebPPL program has them."""
    weights, means, deviations = components()
    for k in range(COMPONENTS):
        query(f"mean {k}", means[k])
        query(f"deviation {k}", deviations[k])
    half(0, points, weights, means, deviations)


FORMS = {
    "one by one": one_by_one,
    "by halves": by_halves,
    "for": for_loop,
    "comprehension": comprehension,
    "returned list": returned_list,
    "query": queried,
}
