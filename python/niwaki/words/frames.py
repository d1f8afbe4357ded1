"""Places to look from: what a search that sees the scene looks at."""

from __future__ import annotations

from niwaki.words.measures import Frame
from niwaki.words.vectors import Vec, VecLike, dot, norm

__all__ = ["look"]

#: Above this cosine a direction is too close to the y axis for that axis to be up.
STEEP = 0.9

#: Below this sine two directions lie along one line.
ALONG = 1e-9


def look(position: VecLike, forward: VecLike, up: VecLike | None = None) -> Frame:
    """Say from where the next choices should be seen; it changes nothing in the model.

    Guides see the target and the scene from there. As a statement of its own it holds up to the next `look` of the
    function; its value can be assigned too, and then it is the variable assigned last that counts.

    Parameters
    ----------
    position
        Where the next part begins; two numbers in the plane (then z is 0), or three.
    forward
        The direction in which it would go, of any length but 0.
    up
        A direction that is not along `forward`; it is made perpendicular. When left out: the z axis in the plane, in
        space the y axis, or the z axis where `forward` is close to that.

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
