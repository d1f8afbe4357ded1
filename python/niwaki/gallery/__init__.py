"""Models to look at and start from: one model, one file, one picture.

A module of this folder is an entry of the gallery when it has MODEL (the model), and, where they make sense, TITLE (one
line), TARGET (the name of a function of `niwaki.targets.examples`), VOXEL (the cell size that suits both), PARTICLES
(how many a good result takes) and RESAMPLING (the rule that suits it). A model that draws in the plane has DRAWS (the
style of its pictures) and WINDOW (the part of the plane in which it draws), and DRAWING (the name of a drawing to
follow) or SCORE (what it draws without one).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from typing import Any

import niwaki as nw
from niwaki import draw, targets
from niwaki.targets.sketches import Ask, Window

#: Modules of this folder that hold no model; they are not imported to find that out.
NOT_MODELS = ("data", "furnishings")

#: The default size of a population.
PARTICLES = 300


@dataclass(frozen=True)
class Entry:
    """One model of the gallery.

    Attributes
    ----------
    name : str
        As the shell calls it.
    title : str
        What it makes.
    model : Model
        The model.
    target_name : str or None
        The target that it is usually grown into.
    voxel : float or None
        The cell size that suits both.
    usual : dict
        Settings of `smc` that do it well: how many particles, and perhaps the rule of resampling.
    draws : str or None
        The style of its drawings; None for models in space.
    window : tuple or None
        The part of the plane in which it draws.
    drawing_name : str or None
        The drawing that it usually follows, from its arguments x, y and ahead on.
    score : callable or None
        Makes the score of a drawing that follows no other.
    """

    name: str
    title: str
    model: nw.Model[..., Any]
    target_name: str | None
    voxel: float | None
    usual: dict[str, Any]
    draws: str | None = None
    window: Window | None = None
    drawing_name: str | None = None
    score: Callable[[], nw.Score] | None = None

    @property
    def particles(self) -> int:
        """How many particles do it well."""
        return int(self.usual["particles"])

    def _repr_html_(self) -> str:
        rows = {
            "name": self.name,
            "target": self.target_name,
            "voxel": self.voxel,
            "particles": self.particles,
        }
        return draw.card.card(self.title, {**rows, "drawing": self.drawing_name})

    @property
    def asks(self) -> list[Ask]:
        """What is asked of it when nothing else is: its target, its drawing, or its score."""
        if self.target_name is not None:
            return [("match_volume", {"target": f"gallery:{self.target_name}", "voxel": self.voxel})]
        if self.drawing_name is not None:
            drawing = targets.drawings.find(self.drawing_name)
            return [("match_drawing", {"image": drawing, "window": self.window})]
        score = nw.Score() if self.score is None else self.score()
        return [(one.function, dict(one.given)) for one in score.asks]

    def target(self) -> nw.Target | None:
        """Make the usual target."""
        return named_target(self.target_name) if self.target_name is not None else None


def named_target(name: str) -> nw.Target:
    """Make one of the gallery's own targets."""
    value: nw.Target = getattr(targets.examples, name)()
    return value


def entries() -> list[Entry]:
    """Every model of the gallery, by name."""
    found = (entry(module.name) for module in iter_modules(__path__))
    return sorted((one for one in found if one is not None), key=lambda one: one.name)


def entry(name: str) -> Entry | None:
    """Find the entry of that name; `spaceship`, `niwaki-tree` or `niwaki_tree`."""
    stem = name.replace("-", "_")
    if not stem.isidentifier() or not any(module.name == stem for module in iter_modules(__path__)):
        return None
    if stem in NOT_MODELS:
        return None
    module = import_module(f"{__name__}.{stem}")
    if not hasattr(module, "MODEL"):
        return None
    usual = {"particles": getattr(module, "PARTICLES", PARTICLES)}
    if hasattr(module, "RESAMPLING"):
        usual["resampling"] = module.RESAMPLING
    title = getattr(module, "TITLE", (module.__doc__ or "").partition("\n")[0])
    value = Entry(
        stem.replace("_", "-"),
        title,
        module.MODEL,
        getattr(module, "TARGET", None),
        getattr(module, "VOXEL", None),
        usual,
        getattr(module, "DRAWS", None),
        getattr(module, "WINDOW", None),
        getattr(module, "DRAWING", None),
        getattr(module, "SCORE", None),
    )
    return value
