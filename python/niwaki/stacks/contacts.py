"""Contacts and equilibrium: latent forces at the corners of each contact, and a soft balance of each block.

Dissertation 4.5 and appendix B.2. A contact is the overlap of two rectangles. At each of its four corners there is a
force of three latent numbers, so a contact has twelve. The unit of forces is the structure's mean weight, and the unit
of torques is the mean weight times the cube root of the mean volume, so that neither size nor density matters.

Differences from the original: friction is a true cone (`friction="pyramid"` is the original's square pyramid). The
centre of mass is exact. A push has an exponential prior with a mean of ten mean weights; the original's prior is flat
in newtons, which favours heavy structures. A light block balances within a share of its own weight, because the
tolerance of a heavier block would let it fall. Latent forces leave out a share of each contact and of its friction.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from niwaki import (
    condition,
    cross,
    dot,
    exponential,
    factor,
    norm,
    softeq,
    student_t,
    uniform,
    vec,
)
from niwaki.stacks.blocks import volume_and_centre

#: The body that does not move.
GROUND = -1

DOWN = vec(0.0, 0.0, -1.0)

#: The default share of a contact and of its friction that latent forces leave out.
SAFETY = 0.15

#: A share of the mean weight; the tolerance of lighter blocks does not get narrower.
LIGHTEST = 0.01

#: Mean of the prior of a push, in mean weights.
PUSH = 10.0


class Contact(NamedTuple):
    """A contact of two faces.

    Attributes
    ----------
    first, second : int
        Numbers of the two bodies; `GROUND` is the ground.
    points : four vectors
        The corners of the common part of the faces.
    normal, along, across : vector
        The outward normal of the first body's face, and the directions of its edges. A force acts on the second body,
        and the opposite force on the first.
    """

    first: Any
    second: Any
    points: Any
    normal: Any
    along: Any
    across: Any


class Tolerance(NamedTuple):
    """The tolerance of balance.

    Attributes
    ----------
    width : float
        The standard deviation of a net force in mean weights, and of a net torque in mean weights times the cube root
        of the mean volume; for a block that is lighter than the mean, in units of its own weight.
    cone : bool
        Whether friction stays in Coulomb's cone; else in the original's pyramid, which is up to 1.4 times too strong.
    safety : float
        The share of a contact that is left out: latent forces move towards its middle by this share, and friction is
        lower by it. With 0, as in the original, a draw may balance on an edge, or only within the tolerance.
    """

    width: Any
    cone: Any
    safety: Any


class StackValue(NamedTuple):
    """The value of a model of stacks.

    Attributes
    ----------
    blocks : tuple of blocks
        Blocks of eight corners, metres, z up.
    contacts : tuple of Contact
        The contacts of the blocks.
    friction : float
        Coulomb's coefficient.
    downs : tuple of vectors
        The directions of gravity in which the structure should stand.
    prefixes : tuple of int
        The number of blocks at each step of construction that should stand.
    """

    blocks: Any
    contacts: Any
    friction: Any
    downs: Any
    prefixes: Any


def contact(first, face, second, other):
    """Return the contact of two rectangles of four points: `face` of body `first`, and `other` of body `second`.

    The rectangles are compared in the frame of the first. A run in which they do not overlap is impossible.
    """
    origin = face[0]
    along, across = face[1] - origin, face[3] - origin
    wide, deep = norm(along), norm(across)
    along, across = along / wide, across / deep
    xs = [dot(p - origin, along) for p in other]
    ys = [dot(p - origin, across) for p in other]
    low_x, high_x = max(0.0, min(xs)), min(wide, max(xs))
    low_y, high_y = max(0.0, min(ys)), min(deep, max(ys))
    condition(low_x < high_x and low_y < high_y)
    points = (
        origin + low_x * along + low_y * across,
        origin + high_x * along + low_y * across,
        origin + high_x * along + high_y * across,
        origin + low_x * along + high_y * across,
    )
    return Contact(first, second, points, cross(along, across), along, across)


def corners(block, face):
    """Return the corners of a block's face."""
    return tuple([block[i] for i in face])


def force_at(touch, friction, cone):
    """Draw a latent force in its friction cone (uniform over the disc), or in the original's square pyramid."""
    push = exponential(1.0 / PUSH)
    if cone:
        # Two draws of Student's t make a plane's bivariate t with two degrees of freedom, scaled so that
        # (x, y) / sqrt(1 + x^2 + y^2) is uniform over the unit disc: smooth, and without a bound to hit.
        x = student_t(2.0, 0.0, 0.5**0.5)
        y = student_t(3.0, 0.0, ((1.0 + x * x) / 3.0) ** 0.5)
        shrink = (1.0 + x * x + y * y) ** -0.5
        x, y = x * shrink, y * shrink
    else:
        x = uniform(-1.0, 1.0)
        y = uniform(-1.0, 1.0)
    slide = friction * push
    return push * touch.normal + slide * x * touch.along + slide * y * touch.across


def forces(touch, friction, cone):
    """Draw latent forces at the four corners of a contact."""
    return [force_at(touch, friction, cone) for _ in touch.points]


def force_balance(total, width):
    """Score a net force of zero, in mean weights."""
    factor(softeq(total.x, 0.0, width) + softeq(total.y, 0.0, width) + softeq(total.z, 0.0, width))


def torque_balance(total, width):
    """Score a net torque of zero, in mean weights times the mean size."""
    factor(softeq(total.x, 0.0, width) + softeq(total.y, 0.0, width) + softeq(total.z, 0.0, width))


def tolerance_of(width, friction, safety):
    """Return the tolerance of a model; friction is "cone" or "pyramid"."""
    assert friction == "cone" or friction == "pyramid"
    return Tolerance(width, friction == "cone", safety)


def balance(blocks, contacts, friction, tolerance, down=DOWN):
    """Score equilibrium under latent forces: a force and a torque factor for each block.

    `down` is the direction of gravity. Each call has its own forces. The normal densities contain their widths, so
    they do not favour heavier blocks.
    """
    safety = tolerance.safety
    spared = [drawn_in(touch, safety) for touch in contacts]
    solids = [volume_and_centre(block) for block in blocks]
    mean_volume = sum([volume for volume, _ in solids]) / len(solids)
    size = mean_volume ** (1.0 / 3.0)
    pushes = [forces(touch, (1.0 - safety) * friction, tolerance.cone) for touch in spared]
    for body in range(len(blocks)):
        volume, centre = solids[body]
        total = (volume / mean_volume) * down
        torque = vec(0.0, 0.0, 0.0)
        for touch, push in zip(spared, pushes):  # noqa: B905
            if touch.second == body:
                total = total + added(push)
                torque = torque + turned(touch.points, push, centre)
            elif touch.first == body:
                total = total - added(push)
                torque = torque - turned(touch.points, push, centre)
        width = tolerance.width * max(LIGHTEST, min(1.0, volume / mean_volume))
        force_balance(total, width)
        torque_balance(torque / size, width)


def drawn_in(touch, safety):
    """Return a contact whose corners are moved towards its middle by a share of the distance."""
    a, b, c, d = touch.points
    middle = 0.25 * (a + b + c + d)
    points = tuple([p + safety * (middle - p) for p in touch.points])
    return Contact(touch.first, touch.second, points, touch.normal, touch.along, touch.across)


def added(push):
    """Return the sum of four forces."""
    return push[0] + push[1] + push[2] + push[3]


def turned(points, push, centre):
    """Return the torque of four forces about a centre."""
    torque = vec(0.0, 0.0, 0.0)
    for point, force in zip(points, push):  # noqa: B905
        torque = torque + cross(point - centre, force)
    return torque


def positive_volume(block, least):
    """Score a barrier against blocks that turn inside out; it rises as the volume falls to `least` cubic metres."""
    volume, _ = volume_and_centre(block)
    condition(volume > 0.0)
    factor(-least / volume)
