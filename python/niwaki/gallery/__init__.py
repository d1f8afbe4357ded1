"""Models to look at and to start from, each in a file of this folder.

A module with the name MODEL, the model, is an entry of the gallery. Other names are optional:

| name       | value                                                                        |
| ---------- | ---------------------------------------------------------------------------- |
| TITLE      | a line of text                                                               |
| TARGET     | the name of a function of `niwaki.targets.examples`                          |
| VOXEL      | the cell size that suits model and target                                    |
| PARTICLES  | the number of particles for a good result                                    |
| RESAMPLING | the rule of resampling that suits the model                                  |
| DRAWS      | for a model that draws in the plane, the style of its pictures               |
| WINDOW     | the part of the plane in which it draws                                      |
| DRAWING    | the name of the drawing that it follows                                      |
| SCORE      | a function that returns its score, if it follows no drawing                  |
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

#: Modules of this folder without a model, which `entry` does not import.
NOT_MODELS = ("data", "furnishings")

#: The entries that lists name first.
FIRST = ("village-house", "castle", "chair", "bridge", "vase", "ivy")

#: The default size of a population.
PARTICLES = 300


@dataclass(frozen=True)
class Entry:
    """An entry of the gallery: a model with its usual target and settings.

    Attributes
    ----------
    name : str
        The model's name in the shell.
    title : str
        A short description of the scenes.
    model : Model
        The model.
    target_name : str or None
        The name of the usual target.
    voxel : float or None
        The cell size that suits model and target.
    usual : dict
        Settings of `smc` that suit the model: the number of particles, and sometimes the rule of resampling.
    draws : str or None
        The style of its drawings; None for models in space.
    window : tuple or None
        The part of the plane in which it draws.
    drawing_name : str or None
        The name of the drawing that the model usually follows, from its arguments x, y and ahead.
    score : callable or None
        A function that makes the score of a model that draws without a drawing to follow.
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
        """The number of particles that suits the model."""
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
        """The model's usual asks: its target, its drawing or its score."""
        if self.target_name is not None:
            return [("match_volume", {"target": f"gallery:{self.target_name}", "voxel": self.voxel})]
        if self.drawing_name is not None:
            drawing = targets.drawings.find(self.drawing_name)
            return [("match_drawing", {"image": drawing, "window": self.window})]
        score = nw.Score() if self.score is None else self.score()
        return [(ask.function, dict(ask.arguments)) for ask in score.asks]

    def target(self) -> nw.Target | None:
        """Make the usual target."""
        return named_target(self.target_name) if self.target_name is not None else None


def named_target(name: str) -> nw.Target:
    """Make a target of the gallery."""
    value: nw.Target = getattr(targets.examples, name)()
    return value


def entries() -> list[Entry]:
    """Return all entries of the gallery: those of `FIRST`, then the others by name."""
    candidates = (entry(module.name) for module in iter_modules(__path__))
    places = {name: place for place, name in enumerate(FIRST)}
    return sorted(
        (candidate for candidate in candidates if candidate is not None),
        key=lambda candidate: (places.get(candidate.name, len(places)), candidate.name),
    )


def entry(name: str) -> Entry | None:
    """Return the entry of a name, such as `spaceship`, `niwaki-tree` or `niwaki_tree`, or None."""
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
