"""Niwaki grows procedural models into the shapes you ask for.

What a model may say comes from `niwaki.words`; the rest is imported when it is used, so that `import niwaki` loads
NumPy and the engine only.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from niwaki import words
from niwaki._engine import __version__
from niwaki.words import *  # noqa: F403

if TYPE_CHECKING:
    from niwaki.errors import InputError, ModelError, ModelFault, NiwakiError
    from niwaki.gradient import LogDensity, log_density
    from niwaki.infer import Progress, grow, run
    from niwaki.lang.plain import run_python
    from niwaki.methods import enumerate_all, forward, importance, rejection, smc
    from niwaki.result import Result, Sample
    from niwaki.scene import Scene
    from niwaki.sketches import Score, no_self_intersection, volume_match
    from niwaki.target import Target

#: Where the names live that are imported when they are used.
_HOMES = {
    "niwaki.errors": ("InputError", "ModelError", "ModelFault", "NiwakiError"),
    "niwaki.gradient": ("LogDensity", "log_density"),
    "niwaki.infer": ("Progress", "grow", "run"),
    "niwaki.lang.plain": ("run_python",),
    "niwaki.methods": ("enumerate_all", "forward", "importance", "rejection", "smc"),
    "niwaki.result": ("Result", "Sample"),
    "niwaki.scene": ("Scene",),
    "niwaki.sketches": ("Score", "no_self_intersection", "volume_match"),
    "niwaki.target": ("Target",),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [  # noqa: PLE0604
    "__version__",
    *words.__all__,
    "InputError",
    "LogDensity",
    "ModelError",
    "ModelFault",
    "NiwakiError",
    "Progress",
    "Result",
    "Sample",
    "Scene",
    "Score",
    "Target",
    "enumerate_all",
    "forward",
    "grow",
    "importance",
    "log_density",
    "no_self_intersection",
    "rejection",
    "run",
    "run_python",
    "smc",
    "volume_match",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'niwaki' has no attribute {name!r}")
    found = getattr(import_module(_HOME[name]), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
