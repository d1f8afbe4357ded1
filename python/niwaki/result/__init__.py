"""What a search gives back.

result       `Result` and its `Sample`s
info         what each method says of its search
chains       Markov chains that can go on
hmc          chains that follow a gradient
progress     how far a search is
diagnostics  whether draws of chains can be trusted; draws for ArviZ
gradient     the log density of a run, with its gradient
"""

from niwaki.result.result import Result, Sample

__all__ = ["Result", "Sample"]
