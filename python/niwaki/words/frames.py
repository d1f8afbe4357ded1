"""Frames: `look`, from where a guide sees the scene; `place`, `mirrored` and `arrayed`, which put calls into frames."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from niwaki.words.measures import Frame
from niwaki.words.running import runner
from niwaki.words.vectors import Rotation, Vec, VecLike, dot, norm

__all__ = ["arrayed", "look", "mirrored", "place"]

T = TypeVar("T")

#: What a call can be placed in: a point, a rotation about the origin, both, or a frame.
Placing = VecLike | Rotation | tuple[VecLike, Rotation] | Frame

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


def place(frame: Placing, function: Callable[..., T], *args: Any, label: str | None = None) -> T:
    """Call a function so that all shapes that it emits, also in calls below it, are in a frame.

    The function draws, scores and returns as in any call; its points and directions are those of the frame. A `place`
    inside of the function is relative to this frame. Calls of memoised functions belong to no caller, and are not
    placed.

    Parameters
    ----------
    frame
        A point, which becomes the origin; a rotation about the origin; a pair of a point and a rotation, which turns
        first; or a `Frame`, such as `look` returns: z goes forward and y up.
    function
        A model function.
    args
        The function's arguments, by position.
    label
        The call's name for people, a constant text; by default the function's.

    Returns
    -------
    The function's value.
    """
    value: T = runner("place").place(frame, function, args)
    return value


def mirrored(
    axis: str | VecLike, function: Callable[..., T], *args: Any, label: str | None = None
) -> list[T]:
    """Call a function twice, the second time with its shapes reflected at the plane through the origin across `axis`.

    Each call draws its own choices. For two equal halves, draw before, and pass the values as arguments.

    Parameters
    ----------
    axis
        "x", "y", "z" or a direction: the normal of the mirror.
    function
        A model function.
    args
        The function's arguments, by position.
    label
        The name of the calls for people, a constant text; they are numbered. By default the function's.

    Returns
    -------
    The values of both calls.
    """
    values: list[T] = runner("mirrored").mirrored(axis, function, args)
    return values


def arrayed(
    frames: Iterable[Placing], function: Callable[..., T], *args: Any, label: str | None = None
) -> list[T]:
    """Call a function once in each frame of a list, as `place` does.

    Each call draws its own choices. For equal copies, draw before, and pass the values as arguments.

    Parameters
    ----------
    frames
        Points, rotations, pairs of both, or frames.
    function
        A model function.
    args
        The function's arguments, by position.
    label
        The name of the calls for people, a constant text; they are numbered. By default the function's.

    Returns
    -------
    The values of all calls, in order.
    """
    values: list[T] = runner("arrayed").arrayed(frames, function, args)
    return values


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
