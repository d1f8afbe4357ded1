"""The guides of the package: a file for each, with the name of its model in the gallery.

`make guides` trains them again (`benches/shipped_guides.py`).
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from niwaki.lang.models import Model
from niwaki.methods import Guide

#: The folder of the guides.
FOLDER = Path(__file__).parent / "shipped"


def shipped(model: Model[..., Any]) -> Guide | None:
    """Return the guide that is shipped with a model of the gallery, or None.

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
    """Return the names of the models with a shipped guide."""
    return sorted(place.stem for place in FOLDER.glob("*.guide"))


@cache
def _read(name: str) -> Guide | None:
    place = FOLDER / f"{name}.guide"
    return Guide.load(place) if place.is_file() else None
