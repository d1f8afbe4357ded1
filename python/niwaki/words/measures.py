"""What the words for shapes take, how the engine makes a shape of it, and what an `emit` adds to a shape's look."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from niwaki import _engine
from niwaki.words.vectors import VecLike

__all__ = ["Bark", "Frame"]

Rotation = Sequence[Sequence[float]]
Color = Sequence[float]
Axis = str | VecLike


class Frame(NamedTuple):
    """Where a `segment` begins, splits or ends; a tuple of four will do.

    Attributes
    ----------
    center
        The middle of the ring.
    forward
        Unit direction towards the tip.
    up
        Unit direction at right angles to `forward`: the rotation of the ring.
    radius
        Greater than 0.
    """

    center: VecLike
    forward: VecLike
    up: VecLike
    radius: float


class Bark(NamedTuple):
    """The piece of a parent's cone that the base of a `segment` lies on; a tuple of four will do.

    Attributes
    ----------
    low, high
        Points of the parent's axis, below and above the branch.
    low_radius, high_radius
        The parent's radius there.
    """

    low: VecLike
    low_radius: float
    high: VecLike
    high_radius: float


def make(word: str, *arguments: Any) -> Any:
    """The shape of a word with these arguments, in order."""
    if word == "mesh":
        vertices, faces, *rest = arguments
        arguments = (np.asarray(vertices, dtype=np.float64), np.asarray(faces, dtype=np.int64), *rest)
    return _engine.shape(word, *arguments)


#: What an `emit` gives to those of its shapes that do not have it: colours to all, the others to solids.
LOOKS = ("color", "metalness", "roughness")


def worn(shape: Any, look: Mapping[str, Any], over: bool = False) -> Any:
    """A shape with a look, where it has none of its own or `over` is given; what is no shape is given back."""
    if not isinstance(shape, _engine.Shape):
        return shape
    names = LOOKS if shape.flat() is None else LOOKS[:1]
    given = {
        name: value
        for name, value in look.items()
        if value is not None and name in names and (over or getattr(shape, name) is None)
    }
    if not given:
        return shape
    # Checked as the words check them.
    named = _engine.shape("box", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), **given)
    checked = {name: getattr(named, name) for name in given}
    return _engine.Shape.of_data(json.dumps({**json.loads(shape.data()), **checked}))
