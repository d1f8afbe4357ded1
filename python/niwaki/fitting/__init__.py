"""Fitting models that somebody else wrote: functions, files and programs of which only parameters and a mesh are known.

| module | contents |
| --- | --- |
| `space` | parameters: their ranges, and the conditions under which they are used |
| `goals` | what a scene is scored by: sketches of the package, and numbers with a tolerance |
| `features` | what a scene gets wrong, as a vector: the differences that the emulator learns |
| `loop` | `FitLoop`: asks for points, and takes what came of them |
| `answers` | the answers of a search: the best, a table, variants, intervals, what moves what |
| `effects` | a picture of what moves what |

The engine's proposer (`crates/fit`) decides which point is asked next. Nothing here runs a model: who asks evaluates.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
