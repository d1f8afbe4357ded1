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
    from niwaki.draw.scene import Scene
    from niwaki.errors import InputError, ModelError, ModelFault, NiwakiError
    from niwaki.lang.constraints import Residuals, residuals
    from niwaki.lang.plain import run_python
    from niwaki.methods import (
        enumerate_all,
        explore,
        forward,
        hmc,
        importance,
        kernels,
        mh,
        nuts,
        particle_gibbs,
        pimh,
        rejection,
        smc,
    )
    from niwaki.result import Result, Sample, diagnostics
    from niwaki.result.gradient import LogDensity, log_density
    from niwaki.search import Progress, Search, grow, run
    from niwaki.targets.camera import Camera
    from niwaki.targets.outline import load_polygon
    from niwaki.targets.sketches import (
        Score,
        avoid,
        floor,
        match_image,
        match_shadow,
        no_self_intersection,
        overshoot,
        volume_match,
    )
    from niwaki.targets.target import Receiver, Target

#: Where the names live that are imported when they are used.
_HOMES = {
    "niwaki.targets.camera": ("Camera",),
    "niwaki.errors": ("InputError", "ModelError", "ModelFault", "NiwakiError"),
    "niwaki.result.gradient": ("LogDensity", "log_density"),
    "niwaki.search": ("Progress", "Search", "grow", "run"),
    "niwaki.lang.plain": ("run_python",),
    "niwaki.methods": (
        "enumerate_all",
        "explore",
        "forward",
        "hmc",
        "importance",
        "mh",
        "nuts",
        "particle_gibbs",
        "pimh",
        "rejection",
        "smc",
    ),
    "niwaki.lang.constraints": ("Residuals", "residuals"),
    "niwaki.targets.outline": ("load_polygon",),
    "niwaki.result": ("Result", "Sample"),
    "niwaki.draw.scene": ("Scene",),
    "niwaki.targets.sketches": (
        "Score",
        "avoid",
        "floor",
        "match_image",
        "match_shadow",
        "no_self_intersection",
        "overshoot",
        "volume_match",
    ),
    "niwaki.targets.target": ("Receiver", "Target"),
}
#: Modules that are used by name.
_MODULES = {"diagnostics": "niwaki.result.diagnostics", "kernels": "niwaki.methods.kernels"}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [  # noqa: PLE0604
    "__version__",
    *words.__all__,
    "Camera",
    "InputError",
    "LogDensity",
    "ModelError",
    "ModelFault",
    "NiwakiError",
    "Progress",
    "Residuals",
    "Receiver",
    "Result",
    "Sample",
    "Scene",
    "Score",
    "Search",
    "Target",
    "avoid",
    "diagnostics",
    "enumerate_all",
    "explore",
    "forward",
    "floor",
    "grow",
    "hmc",
    "importance",
    "kernels",
    "load_polygon",
    "mh",
    "match_image",
    "match_shadow",
    "log_density",
    "no_self_intersection",
    "nuts",
    "overshoot",
    "particle_gibbs",
    "pimh",
    "rejection",
    "residuals",
    "run",
    "run_python",
    "smc",
    "volume_match",
]


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return import_module(_MODULES[name])
    if name not in _HOME:
        raise AttributeError(f"module 'niwaki' has no attribute {name!r}")
    found = getattr(import_module(_HOME[name]), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
