"""The guides that come with the package: one file each, named like the gallery's model that it is for.

`make guides` trains them again, by `benches/shipped_guides.py`.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from niwaki.lang.models import Model
from niwaki.methods import Guide

#: Where they are.
FOLDER = Path(__file__).parent / "shipped"


def shipped(model: Model[..., Any]) -> Guide | None:
    """The guide that comes with a model of the gallery; None where there is none.

    Examples
    --------
    >>> from niwaki.gallery.vines import vines
    >>> from niwaki.guides import shipped
    >>> shipped(vines)
    <guide of vines: 8 choices, 6751 weights>
    """
    home, _, name = getattr(getattr(model, "function", None), "__module__", "").rpartition(".")
    return _read(name) if home == "niwaki.gallery" else None


def names() -> list[str]:
    """Models of the gallery that a guide comes with."""
    return sorted(place.stem for place in FOLDER.glob("*.guide"))


@cache
def _read(name: str) -> Guide | None:
    place = FOLDER / f"{name}.guide"
    return Guide.load(place) if place.is_file() else None
