"""What a search gives back.

result       `Result`, a sequence of samples
sample       `Sample`, one run
info         what each method says of its search
chains       Markov chains: what they say, and how they go on
hmc          what chains that follow a gradient say
progress     how far a search is
diagnostics  whether draws of chains can be trusted; draws for ArviZ
gradient     the log density of a run, with its gradient
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
