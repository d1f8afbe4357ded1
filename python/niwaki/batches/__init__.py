"""Batches of searches: each case with each seed, on many processors or machines, in one folder that can be resumed.

| module | contents |
| --- | --- |
| `entry` | `batch`, which searches and yields the results in order; `stored`, which reads them |
| `islands` | `spread`, the populations of one search on many workers |
| `spec` | the cases, which are searches without a seed, and the seeds |
| `body` | a result as bytes, and back |
| `segments` | files of records that only grow |
| `store` | the folder: specs, segments and logs |
| `plan` | the missing searches, and the size of chunks |
| `worker` | the work of a worker on a chunk |
| `pools` | executors and pools of processes |
| `clusters` | Ray and Dask, as executors |
| `execution` | chunks under way, results, and lost workers |
| `tables` | rows with names as CSV or Parquet |
| `export` | a batch as a table, a contact sheet and meshes |
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
