"""The guides of the package: a file for each, with the name of its model in the gallery.

`make guides` trains them again (`benches/shipped_guides.py`).
"""

from __future__ import annotations

from collections.abc import Collection
from functools import cache
from pathlib import Path
from typing import Any

from niwaki.lang.models import Model
from niwaki.methods.guide import Guide

#: The folder of the guides.
FOLDER = Path(__file__).parents[1] / "guides" / "shipped"

#: The models whose usual search is better with the guide in the same time.
USUAL = frozenset({"gnarly_tree", "lightning", "vines"})


def shipped(model: Model[..., Any]) -> Guide | None:
    """Return the guide that is shipped with a model of the gallery, or None.

    Examples
    --------
    >>> from niwaki.gallery.vines import vines
    >>> from niwaki.guides import shipped
    >>> shipped(vines)
    <guide of vines: 8 choices, 6751 weights>
    """
    name = _name(model)
    return None if name is None else _read(name)


def usual(model: Model[..., Any], sketches: Collection[str]) -> Guide | None:
    """Return the guide by which the usual search draws where no other is asked for, or None.

    Parameters
    ----------
    model
        A model.
    sketches
        Names of the sketches of the score, such as "match_volume". The guide must have windows of no others.
    """
    guide = shipped(model) if _name(model) in USUAL else None
    if guide is None or not {window for window, _ in guide.form["windows"]} <= set(sketches):
        return None
    return guide


def names() -> list[str]:
    """Return the names of the models with a shipped guide."""
    return sorted(place.stem for place in FOLDER.glob("*.guide"))


def _name(model: Model[..., Any]) -> str | None:
    """Return the name of a model of the gallery, None for any other model."""
    home, _, name = getattr(getattr(model, "function", None), "__module__", "").rpartition(".")
    return name if home == "niwaki.gallery" else None


@cache
def _read(name: str) -> Guide | None:
    place = FOLDER / f"{name}.guide"
    return Guide.load(place) if place.is_file() else None
