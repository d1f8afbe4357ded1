"""A mixture of four Gaussians, to find the clusters of a hundred numbers (dissertation, appendix A).

Every latent variable is a choice: weights, means and deviations of the components, and the component of each point.
"""

from niwaki import model
from niwaki.gallery import data
from niwaki.methods import mh
from niwaki.words import Gaussian, categorical, dirichlet, gaussian, observe, uniform

TITLE = "four clusters of a hundred numbers"
METHOD = mh(steps=400_000, warmup=100_000)

POINTS = data.clusters(1000)
COMPONENTS = 4


@model
def gmm(points=100):
    """Draw weights, means and deviations of the components."""
    weights = dirichlet([1.0] * COMPONENTS)
    means = [gaussian(0.0, 10.0) for _ in range(COMPONENTS)]
    deviations = [uniform(0.1, 4.0) for _ in range(COMPONENTS)]
    for n in range(points):
        point(POINTS[n], weights, means, deviations)
    return weights, means, deviations


def point(x, weights, means, deviations):
    """Draw the component of a point, and observe the point."""
    k = categorical(weights)
    observe(Gaussian(means[k], deviations[k]), x)


MODEL = gmm
