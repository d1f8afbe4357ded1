"""Methods as values. The engine checks their settings when a method is created.

annealed    annealed importance sampling
direct      forward runs, enumeration, rejection, likelihood weighting
particles   sequential Monte Carlo, and chains whose proposals are populations
chains      Metropolis-Hastings
gradients   Hamiltonian Monte Carlo
normals     variational inference
improve     a search for the best run, by several of these
emulate     a search for the best run in few runs, by an emulator of its scene
order       learned orders of futures
guide       a network that draws choices in place of the prior
kernels     Markov kernels, for chains
method      the base class: a method as data
checks      checks of types: kernels, proposals, guides
refusals    checks of settings by the engine
room        estimates of the memory that the counts of a method need
"""

from niwaki.methods.annealed import Ais, ais
from niwaki.methods.chains import Mh, mh
from niwaki.methods.checks import at_least_one
from niwaki.methods.direct import (
    EnumerateAll,
    Forward,
    Importance,
    Rejection,
    enumerate_all,
    forward,
    importance,
    rejection,
)
from niwaki.methods.emulate import Emulate, emulate
from niwaki.methods.gradients import Hmc, Nuts, explore, hmc, nuts
from niwaki.methods.guide import Guide
from niwaki.methods.improve import Improve, improve
from niwaki.methods.method import Method
from niwaki.methods.normals import Vi, vi
from niwaki.methods.order import FutureOrder
from niwaki.methods.particles import (
    ParticleGibbs,
    Pimh,
    Smc,
    particle_gibbs,
    pimh,
    smc,
)

__all__ = [
    "Ais",
    "Emulate",
    "EnumerateAll",
    "Forward",
    "FutureOrder",
    "Guide",
    "Hmc",
    "Importance",
    "Improve",
    "Method",
    "Mh",
    "Nuts",
    "ParticleGibbs",
    "Pimh",
    "Rejection",
    "Smc",
    "Vi",
    "ais",
    "at_least_one",
    "emulate",
    "enumerate_all",
    "explore",
    "forward",
    "hmc",
    "importance",
    "improve",
    "mh",
    "nuts",
    "particle_gibbs",
    "pimh",
    "rejection",
    "smc",
    "vi",
]
