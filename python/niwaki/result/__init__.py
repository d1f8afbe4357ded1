"""Results of searches.

result       `Result`, a sequence of samples
sample       `Sample`, one run
info         the statistics of each method
invalid      runs that were invalid, by place
chains       statistics of Markov chains, and how chains continue
drawn        draws that are stored as numbers
hmc          statistics of chains that follow a gradient
normals      normals of variational inference
dragged      results of a drag of a part
search_like  the interface of a search that results use
progress     the progress of a search
diagnostics  effective sample sizes, R-hat and other diagnostics of draws; draws for ArviZ
gradient     the log density of a run, with its gradient
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
