"""Repairing scripts: few of the numbers that a person wrote are changed, so that the result keeps requirements.

| module | contents |
| --- | --- |
| `literals` | the literals of a text: kinds, priors, and which may change |
| `writing` | values rounded as a person writes them, and written back into the text |
| `scripts`, `csg` | a script as a generator of parts; the parts of an OpenSCAD file |
| `prediction` | the boxes of parts with other numbers, and what will be violated, from few runs |
| `search` | plans of few changes, and the runs that correct them |
| `result`, `conflicts` | patches; or which requirement stands against which |
| `entry` | `repair` |

Requirements are those of `niwaki.requirements`.
Runs are those of `niwaki.fitting.pool`: worker processes with a limit of time.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
