"""Arguments of the words for shapes, the maker of shapes, and the look that an `emit` gives to shapes."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from niwaki import _engine
from niwaki.words.vectors import VecLike

__all__ = ["Bark", "Frame"]

Rotation = Sequence[Sequence[float]]
Color = Sequence[float] | str
Axis = str | VecLike
#: Points of three numbers.
Points = Sequence[VecLike]
#: Points of two numbers.
Pairs = Sequence[VecLike]


class Frame(NamedTuple):
    """A ring where a `segment` starts, splits or ends; a tuple of four values can replace it.

    Attributes
    ----------
    center
        The ring's centre.
    forward
        Unit direction towards the tip.
    up
        Unit direction at right angles to `forward`, which sets the ring's rotation.
    radius
        The ring's radius, greater than 0.
    """

    center: VecLike
    forward: VecLike
    up: VecLike
    radius: float


class Bark(NamedTuple):
    """The piece of a parent's cone under the base of a `segment`; a tuple of four values can replace it.

    Attributes
    ----------
    low, high
        Points of the parent's axis, below and above the branch.
    low_radius, high_radius
        The parent's radii at these points.
    """

    low: VecLike
    low_radius: float
    high: VecLike
    high_radius: float


def make(word: str, *arguments: Any) -> Any:
    """Make the shape of a word from its arguments, in order."""
    if word == "mesh":
        vertices, faces, *rest = arguments
        arguments = (np.asarray(vertices, dtype=np.float64), np.asarray(faces, dtype=np.int64), *rest)
    return _engine.shape(word, *arguments)


#: Options of an `emit` for shapes that do not have them: a colour for all shapes, the others for solids.
LOOKS = ("color", "metalness", "roughness", "material")


def worn(shape: Any, look: Mapping[str, Any], over: bool = False) -> Any:
    """Return a shape with a look, which replaces an existing look only if `over`; return other values as they are."""
    if not isinstance(shape, _engine.Shape):
        return shape
    names = LOOKS if shape.flat() is None else LOOKS[:1]
    options = {
        name: value
        for name, value in look.items()
        if value is not None and name in names and (over or getattr(shape, name) is None)
    }
    if not options:
        return shape
    # A box with this look has it checked and converted as any word does.
    named = _engine.shape("box", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), **options)
    checked = {name: getattr(named, name) for name in options}
    return _engine.Shape.of_data(json.dumps({**json.loads(shape.data()), **checked}))
