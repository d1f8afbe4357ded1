"""What a search gives back.

result       `Result`, a sequence of samples
sample       `Sample`, one run
info         the statistics of each method
invalid      runs that were invalid, by place
chains       statistics of Markov chains, and how chains continue
drawn        draws that are kept as numbers
hmc          statistics of chains that follow a gradient
normals      normals of variational inference
dragged      what a drag of a part gives
search_like  what a result knows of its search
progress     how far a search is
diagnostics  whether draws of chains can be trusted; draws for ArviZ
gradient     the log density of a run, with its gradient
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
