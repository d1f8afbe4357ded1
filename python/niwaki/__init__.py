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
    from niwaki import kernels
    from niwaki.camera import Camera
    from niwaki.constraints import Residuals, residuals
    from niwaki.errors import InputError, ModelError, ModelFault, NiwakiError
    from niwaki.gradient import LogDensity, log_density
    from niwaki.hmc_result import HmcResult
    from niwaki.lang.plain import run_python
    from niwaki.methods import (
        enumerate_all,
        explore,
        forward,
        hmc,
        importance,
        mh,
        nuts,
        particle_gibbs,
        pimh,
        rejection,
        smc,
    )
    from niwaki.mh_result import ChainResult
    from niwaki.outline import load_polygon
    from niwaki.result import Result, Sample
    from niwaki.scene import Scene
    from niwaki.search import Progress, Search, grow, run
    from niwaki.sketches import (
        Score,
        avoid,
        floor,
        match_image,
        match_shadow,
        no_self_intersection,
        overshoot,
        volume_match,
    )
    from niwaki.target import Receiver, Target

#: Where the names live that are imported when they are used.
_HOMES = {
    "niwaki.camera": ("Camera",),
    "niwaki.errors": ("InputError", "ModelError", "ModelFault", "NiwakiError"),
    "niwaki.gradient": ("LogDensity", "log_density"),
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
    "niwaki.mh_result": ("ChainResult",),
    "niwaki.hmc_result": ("HmcResult",),
    "niwaki.constraints": ("Residuals", "residuals"),
    "niwaki.outline": ("load_polygon",),
    "niwaki.result": ("Result", "Sample"),
    "niwaki.scene": ("Scene",),
    "niwaki.sketches": (
        "Score",
        "avoid",
        "floor",
        "match_image",
        "match_shadow",
        "no_self_intersection",
        "overshoot",
        "volume_match",
    ),
    "niwaki.target": ("Receiver", "Target"),
}
#: Modules that are used by name.
_MODULES = ("kernels",)
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [  # noqa: PLE0604
    "__version__",
    *words.__all__,
    "ChainResult",
    "Camera",
    "HmcResult",
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
        return import_module(f"niwaki.{name}")
    if name not in _HOME:
        raise AttributeError(f"module 'niwaki' has no attribute {name!r}")
    found = getattr(import_module(_HOME[name]), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
