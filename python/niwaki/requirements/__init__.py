"""Requirements that results have to keep: one list of them, for searches of models and for repairs of scripts.

| module | contents |
| --- | --- |
| `keep` | `Keep`: requirements from a `requirements.toml` or from Python; the table of all requirements |
| `measures` | how far a form violates each requirement |
| `form` | what requirements are measured on: named parts, their boxes and solids |
| `boxes` | overlaps of boxes |
| `rows` | violations and requirements as values, for people and as JSON |
| `conflicts` | which requirement stands against which |
"""

from niwaki.requirements.keep import Keep
from niwaki.requirements.rows import Violation

__all__ = ["Keep", "Violation"]
