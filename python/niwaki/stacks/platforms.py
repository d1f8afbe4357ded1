"""Platforms: two bars, each on two towers, one bar's tower standing on the other bar (dissertation figure 4.8).

A tower reaches from one point to another. Its blocks start as boxes; the top of the last block is welded to the bar.
Then the blocks below change height and shear, and the bottom of the next block follows; the last block takes the rest.
Blocks shear and slide along x only, so that edges stay aligned. Numbers are the original's; lengths are metres.
"""

from __future__ import annotations

from niwaki import dot, model, norm, rotate, uniform, vec
from niwaki.stacks.blocks import (
    BOTTOM,
    TOP,
    box_corners,
    drawn,
    edges,
    middle,
    moved,
    outward,
    shear_x,
    standing,
    top_shear_x,
    welded,
)
from niwaki.stacks.clearance import clear
from niwaki.stacks.contacts import DOWN, GROUND, SAFETY, StackValue, balance, contact, corners, tolerance_of
from niwaki.stacks.towers import GROUND_TOP, OAK, PAINTS, UP, WIDEST, slope
from niwaki.words import lerp

HALF = 0.65
MARGIN = 0.003
FLOOR = (
    vec(-HALF, -HALF, GROUND_TOP),
    vec(HALF, -HALF, GROUND_TOP),
    vec(HALF, HALF, GROUND_TOP),
    vec(-HALF, HALF, GROUND_TOP),
)
Y = vec(0.0, 1.0, 0.0)
BAR = (0.42, 0.30, 0.22)


def bar_at(centre, width):
    """Return a flat bar, turned about the direction of its long sides."""
    angle = uniform(-WIDEST, WIDEST)
    return tuple([centre + rotate(p - centre, Y, angle) for p in box_corners(centre, width, 0.1, 0.01)])


def on_ground(share):
    """Return a point of the ground, from left to right."""
    return vec(lerp(-HALF, HALF, share), 0.0, GROUND_TOP)


def above(bar, share):
    """Return a point of a bar's top, from left to right."""
    return lerp_points(bar[4] + bar[7], bar[5] + bar[6], share)


def under(bar, share):
    """Return a point of a bar's bottom, from right to left."""
    return lerp_points(bar[1] + bar[2], bar[0] + bar[3], share)


def lerp_points(left, right, share):
    """Return a point between the middles of two edges; an edge is the sum of its ends."""
    return 0.5 * left + (0.5 * share) * (right - left)


def tower(count, start, normal, end, bar):
    """Return blocks from `start`, on a surface with normal `normal`, up to `end` on the underside of a bar."""
    height = (end.z - start.z) / count
    pieces = upright([standing(plain(height), start, normal)], 1, count, height)
    seats = [seat(pieces[i], pieces[i - 1]) for i in range(1, count)]
    last = welded(pieces[count - 1], TOP, end, outward(bar, BOTTOM))
    return reshaped(pieces[: count - 1] + [last], seats, 0)


def plain(height):
    """Return a box of random width and depth."""
    width, depth = uniform(0.02, 0.08), uniform(0.02, 0.08)
    return box_corners(vec(0.0, 0.0, 0.0), width, depth, height)


def upright(pieces, i, count, height):
    """Add the boxes from number `i`, which slide along x."""
    if i == count:
        return pieces
    below = pieces[i - 1]
    block = standing(plain(height), middle(below, TOP), outward(below, TOP))
    along, _ = edges(below, TOP)
    mine, _ = edges(block, (0, 1, 2, 3))
    reach = 0.5 * (norm(along) + norm(mine)) - MARGIN
    block = moved(block, (uniform(-1.0, 1.0) * reach / norm(along)) * along)
    return upright(pieces + [block], i + 1, count, height)


def seat(block, below):
    """Return the place of a block on the block below: distances along the edges of its top, from its first corner."""
    along, across = edges(below, TOP)
    off = middle(block, BOTTOM) - below[4]
    return dot(off, along) / norm(along), dot(off, across) / norm(across)


def reshaped(pieces, seats, i):
    """Change height and shear of the blocks from number `i` to the last but one; the block above follows each time."""
    if i == len(pieces) - 1:
        return pieces
    block = pieces[i]
    by = uniform(-0.3, 0.3) * (block[4] - block[0])
    block = block[:4] + tuple([p + by for p in block[4:]])
    block = shear_x(top_shear_x(block, slope()), slope())
    along, across = edges(block, TOP)
    x, y = seats[i]
    point = block[4] + (x / norm(along)) * along + (y / norm(across)) * across
    follower = welded(pieces[i + 1], BOTTOM, point, outward(block, TOP))
    return reshaped(pieces[:i] + [block, follower] + pieces[i + 2 :], seats, i + 1)


def joined(first, count, base, face, bar, pieces):
    """Return the contacts of a tower whose blocks start at number `first`: with its base, within, and with its bar."""
    touches = [contact(first, corners(pieces[first], BOTTOM), base, face)]
    for i in range(first + 1, first + count):
        touches = touches + [contact(i, corners(pieces[i], BOTTOM), i - 1, corners(pieces[i - 1], TOP))]
    top = first + count - 1
    return touches + [contact(top, corners(pieces[top], TOP), bar, corners(pieces[bar], BOTTOM))]


@model
def platforms(width=0.01, friction="cone", safety=SAFETY):
    """Two bars on four towers: 330 continuous choices."""
    low = bar_at(vec(0.0, 0.0, 0.2), 0.3)
    a = tower(4, on_ground(uniform(0.3, 0.4)), UP, under(low, uniform(0.75, 0.95)), low)
    b = tower(4, on_ground(uniform(0.6, 0.7)), UP, under(low, uniform(0.05, 0.25)), low)
    high = bar_at(vec(0.15, 0.0, 0.3), 0.35)
    c = tower(2, above(low, uniform(0.4, 0.6)), outward(low, TOP), under(high, uniform(0.75, 0.95)), high)
    d = tower(6, on_ground(uniform(0.83, 0.9)), UP, under(high, uniform(0.05, 0.25)), high)
    pieces = a + b + [low] + c + d + [high]
    touches = tuple(
        joined(0, 4, GROUND, FLOOR, 8, pieces)
        + joined(4, 4, GROUND, FLOOR, 8, pieces)
        + joined(9, 2, 8, corners(low, TOP), 17, pieces)
        + joined(11, 6, GROUND, FLOOR, 17, pieces)
    )
    balance(pieces, touches, OAK, tolerance_of(width, friction, safety), DOWN)
    clear(pieces, touches, GROUND_TOP)
    for i in range(len(pieces)):
        drawn(pieces[i], BAR if i == 8 or i == 17 else PAINTS[i % 5])
    return StackValue(tuple(pieces), touches, OAK, (DOWN,), (18,))
