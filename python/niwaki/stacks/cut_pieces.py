"""Structures of pieces that are cut from a board: each block is a plane outline 38 mm deep (dissertation 4.5, 4.12).

Some structures also stand on ground that is tilted by ten degrees in either direction: each tilt has its own forces.
A tilt of the ground equals an opposite turn of gravity. Numbers are the original's; lengths are metres.
"""

from __future__ import annotations

from math import cos, radians, sin

from niwaki import model, norm, uniform, vec
from niwaki.stacks.arches import GROUND_TOP as ARCH_GROUND
from niwaki.stacks.arches import curve, feet, ground_at, links
from niwaki.stacks.blocks import (
    TOP,
    box_corners,
    edges,
    middle,
    moved,
    outward,
    shear_x,
    standing,
    top_shear_x,
)
from niwaki.stacks.clearance import clear
from niwaki.stacks.contacts import DOWN, SAFETY, StackValue, balance, tolerance_of
from niwaki.stacks.towers import (
    FEET,
    GROUND_TOP,
    POPLAR,
    UP,
    grow_by,
    lean_on,
    show,
    slid,
    slope,
    touching,
)

#: The board's thickness.
BOARD = 0.038
TILT = radians(10.0)
TILTED = (vec(-sin(TILT), 0.0, -cos(TILT)), vec(sin(TILT), 0.0, -cos(TILT)))


def piece(i, tall, wide, turned):
    """Return a sheared outline; with `turned`, odd outlines have a quarter turn about z."""
    height, width = uniform(tall[0], tall[1]), uniform(wide[0], wide[1])
    block = box_corners(vec(0.0, 0.0, 0.0), width, BOARD, height)
    block = shear_x(top_shear_x(block, slope()), slope())
    return tuple([vec(-p.y, p.x, p.z) for p in block]) if turned and i % 2 == 1 else block


def pile(count, tall, wide, margin, turned):
    """Return a pile of pieces that slide along x, or, with every other piece `turned`, along both axes."""
    return raised([standing(piece(0, tall, wide, turned), FEET, UP)], 1, count, tall, wide, margin, turned)


def raised(blocks, i, count, tall, wide, margin, turned):
    """Add the pieces from number `i` to the pile."""
    if i == count:
        return blocks
    below = blocks[i - 1]
    block = piece(i, tall, wide, turned)
    if turned:
        block = slid(block, below, margin)
    else:
        block = standing(block, middle(below, TOP), outward(below, TOP))
        along, _ = edges(below, TOP)
        mine, _ = edges(block, (0, 1, 2, 3))
        reach = 0.5 * (norm(along) + norm(mine)) - margin
        block = moved(block, (uniform(-1.0, 1.0) * reach / norm(along)) * along)
    return raised(blocks + [block], i + 1, count, tall, wide, margin, turned)


def finish(pieces, touches, downs, tolerance, ground):
    """Score balance for each direction of gravity, and emit the pieces."""
    for down in downs:
        balance(pieces, touches, POPLAR, tolerance, down)
    clear(pieces, touches, ground)
    show(pieces)
    return StackValue(tuple(pieces), touches, POPLAR, downs, (len(pieces),))


@model
def cut_stack(width=0.01, friction="cone", safety=SAFETY):
    """A tower of outlines in one plane: 101 continuous choices."""
    pieces = pile(6, (0.04, 0.075), (0.015, 0.075), 0.01, False)
    return finish(pieces, touching(pieces), (DOWN,), tolerance_of(width, friction, safety), GROUND_TOP)


@model
def cut_lean(width=0.01, friction="cone", safety=SAFETY, astray=0.01):
    """A leaning tower of outlines, of which every other one is turned: 106 continuous choices."""
    pieces = pile(6, (0.03, 0.07), (0.015, 0.07), 0.008, True)
    made = finish(pieces, touching(pieces), (DOWN,), tolerance_of(width, friction, safety), GROUND_TOP)
    lean_on(made.blocks, astray)
    return made


@model
def cut_top_heavy(width=0.01, friction="cone", safety=SAFETY, ratio=1.5):
    """A tower of outlines that grow from the bottom to the top: 106 continuous choices."""
    pieces = pile(6, (0.015, 0.07), (0.015, 0.07), 0.008, True)
    made = finish(pieces, touching(pieces), (DOWN,), tolerance_of(width, friction, safety), GROUND_TOP)
    grow_by(made.blocks, ratio)
    return made


@model
def tilt_stack(width=0.01, friction="cone", safety=SAFETY):
    """A tower that stands on ground tilted by ten degrees in either direction: 178 continuous choices."""
    pieces = pile(6, (0.015, 0.07), (0.015, 0.07), 0.008, True)
    return finish(pieces, touching(pieces), TILTED, tolerance_of(width, friction, safety), GROUND_TOP)


def cut_curve():
    """Return seven outlines along an arch."""
    return curve((ground_at(0.2), 0.3 * UP, ground_at(0.8), 0.3 * UP), 7, (0.015, 0.07), BOARD, 0.008)


@model
def cut_arch(width=0.01, friction="cone", safety=SAFETY):
    """An arch of outlines: 130 continuous choices."""
    pieces = cut_curve()
    return finish(
        pieces,
        tuple(links(0, 7, pieces) + feet(0, 7, pieces)),
        (DOWN,),
        tolerance_of(width, friction, safety),
        ARCH_GROUND,
    )


@model
def tilt_arch(width=0.01, friction="cone", safety=SAFETY):
    """An arch of outlines that stands on ground tilted by ten degrees in either direction: 226 continuous choices."""
    pieces = cut_curve()
    return finish(
        pieces,
        tuple(links(0, 7, pieces) + feet(0, 7, pieces)),
        TILTED,
        tolerance_of(width, friction, safety),
        ARCH_GROUND,
    )
