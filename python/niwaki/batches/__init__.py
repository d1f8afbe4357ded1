"""Many searches: each case by each seed, on many processors or machines, into one folder that goes on.

entry      `batch`, which searches and gives the results in order; `stored`, which reads them
islands    `spread`, the populations of one search on many workers
spec       what is searched: cases, which are searches without a seed, and seeds
body       a result as bytes, and back
segments   files of records that only grow
store      the folder: specs, segments and logs
plan       what is missing, and how much of it makes a chunk
working    what a worker does with a chunk
pools      where chunks are worked on
clusters   Ray, as an executor
running    chunks, results, and workers that are lost
export     a batch as a table, a contact sheet and meshes
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
