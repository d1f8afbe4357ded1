"""The word `look`, which sets the frame from which a guide sees the scene."""

from __future__ import annotations

from niwaki.words.measures import Frame
from niwaki.words.vectors import Vec, VecLike, dot, norm

__all__ = ["look"]

#: Cosine to the y axis above which a direction is too close to it for the y axis to be up.
STEEP = 0.9

#: Sine below which two directions are parallel.
ALONG = 1e-9


def look(position: VecLike, forward: VecLike, up: VecLike | None = None) -> Frame:
    """Set the frame from which guides see the target and the scene at the next choices.

    The model's values and scores do not change. As a statement, a `look` lasts up to the next `look` of the function.
    The frame can also be assigned to a variable; the last assigned variable counts.

    Parameters
    ----------
    position
        The start of the next part: two numbers in the plane (then z is 0), or three.
    forward
        The direction of the next part, of any length but 0.
    up
        A direction that is not parallel to `forward`; it is made perpendicular. By default, the z axis in the plane,
        and in space the y axis, or the z axis if `forward` is close to the y axis.

    Returns
    -------
    A `Frame` with unit directions and the radius 1.
    """
    center, ahead = _triple(position), _unit(_triple(forward))
    if up is not None:
        above = _unit(_triple(up))
    elif len(forward) == 2 or abs(ahead.y) > STEEP:
        above = Vec((0.0, 0.0, 1.0))
    else:
        above = Vec((0.0, 1.0, 0.0))
    across = above - dot(above, ahead) * ahead
    if norm(across) < ALONG:
        raise ValueError("`look`: `up` lies along `forward`")
    return Frame(center, ahead, _unit(across), 1.0)


def _triple(value: VecLike) -> Vec:
    sequence = isinstance(value, (Vec, list, tuple))
    numbers = sequence and all(isinstance(part, (int, float)) for part in value)
    if not numbers or len(value) not in (2, 3):
        raise TypeError(f"`look` takes points and directions of 2 or 3 numbers, found {value!r}")
    return Vec((*(float(part) for part in value), 0.0)[:3])


def _unit(v: Vec) -> Vec:
    length = norm(v)
    if length == 0.0:
        raise ValueError("`look`: a direction has the length 0")
    return v / length
