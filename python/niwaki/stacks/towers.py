"""Towers: piles of six blocks that shear and slide; straight, leaning, or top-heavy (dissertation figure 4.8).

Another tower stands at each step of its construction.
Numbers are the original's; lengths are metres.
"""

from __future__ import annotations

from math import cos, pi, radians, sin, tan

from niwaki import cross, dot, factor, model, norm, normalize, softeq, uniform, vec
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
    shear_y,
    standing,
    swung_block,
    top_shear_x,
    top_shear_y,
    volume_and_centre,
)
from niwaki.stacks.clearance import clear
from niwaki.stacks.contacts import DOWN, GROUND, SAFETY, StackValue, balance, contact, corners, tolerance_of

GROUND_TOP = -0.03
FLOOR = (
    vec(-0.5, -0.5, GROUND_TOP),
    vec(0.5, -0.5, GROUND_TOP),
    vec(0.5, 0.5, GROUND_TOP),
    vec(-0.5, 0.5, GROUND_TOP),
)
FEET = vec(0.0, 0.0, GROUND_TOP)
UP = vec(0.0, 0.0, 1.0)
WIDEST = radians(30.0)

#: Friction of oak, as in the original, and of poplar, the material of pieces to cut.
OAK, POPLAR = 0.5, 0.3
#: The direction of the line that `lean` scores, 20 degrees from upright.
LEANING = vec(
    -sin(radians(20.0)) * cos(radians(45.0)), -sin(radians(20.0)) * sin(radians(45.0)), cos(radians(20.0))
)

PAINTS = ((0.79, 0.52, 0.27), (0.86, 0.66, 0.40), (0.66, 0.41, 0.22), (0.91, 0.75, 0.52), (0.72, 0.50, 0.33))
TURN = 2.0 * pi


def slope():
    """Draw the tangent of an angle within 30 degrees."""
    return tan(uniform(-WIDEST, WIDEST))


def sheared(i):
    """Return block `i` in its start position; the order of the shears keeps its top a rectangle."""
    width, depth, height = uniform(0.02, 0.08), uniform(0.02, 0.08), uniform(0.02, 0.08)
    block = box_corners(vec(0.0, 0.0, 0.0), width, depth, height)
    if i % 2 == 0:
        return shear_x(top_shear_x(shear_y(block, slope()), slope()), slope())
    return shear_y(top_shear_y(shear_x(block, slope()), slope()), slope())


def slid(block, below, margin):
    """Put a block on another with aligned edges; it slides in both directions, and `margin` of contact remains."""
    normal, at = outward(below, TOP), middle(below, TOP)
    block = standing(block, at, normal)
    along, across = edges(below, TOP)
    mine, other = edges(block, BOTTOM_BY_X)
    long, deep = norm(along), norm(across)
    along, across = along / long, across / deep
    if dot(mine, along) ** 2 * dot(other, other) >= dot(other, along) ** 2 * dot(mine, mine):
        x, y = norm(mine), norm(other)
    else:
        x, y = norm(other), norm(mine)
    u = uniform(-1.0, 1.0) * (0.5 * (long + x) - margin)
    v = uniform(-1.0, 1.0) * (0.5 * (deep + y) - margin)
    return aligned(moved(block, u * along + v * across), along, across)


#: The corners of the bottom, in an order whose first edge is the front edge.
BOTTOM_BY_X = (0, 1, 2, 3)


def aligned(block, along, across):
    """Turn a block about its bottom's middle, so that its front edge is parallel to the nearer of two directions."""
    front = normalize(block[1] - block[0])
    x, y = dot(front, along), dot(front, across)
    if x * x >= y * y:
        goal = along if x >= 0.0 else -along
    else:
        goal = across if y >= 0.0 else -across
    return swung_block(block, middle(block, BOTTOM), front, goal)


def pile(count, margin):
    """Return a pile of blocks; each block has its own address."""
    first = standing(sheared(0), FEET, UP)
    return raised([first], 1, count, margin)


def raised(blocks, i, count, margin):
    """Add the blocks from number `i` to the pile."""
    if i == count:
        return blocks
    return raised(blocks + [slid(sheared(i), blocks[i - 1], margin)], i + 1, count, margin)


def touching(blocks):
    """Return the contacts of a pile: the bottom of each block with the top of the block below."""
    touches = [contact(0, corners(blocks[0], BOTTOM), GROUND, FLOOR)]
    for i in range(1, len(blocks)):
        touches = touches + [contact(i, corners(blocks[i], BOTTOM), i - 1, corners(blocks[i - 1], TOP))]
    return tuple(touches)


def show(blocks):
    """Emit the blocks."""
    for i in range(len(blocks)):
        drawn(blocks[i], PAINTS[i % 5])


@model
def stack(width=0.005, blocks=6, friction="cone", safety=SAFETY):
    """A tower of random blocks that balances: 118 continuous choices."""
    pieces = pile(blocks, 0.01)
    touches = touching(pieces)
    balance(pieces, touches, OAK, tolerance_of(width, friction, safety), DOWN)
    clear(pieces, touches, GROUND_TOP)
    show(pieces)
    return StackValue(tuple(pieces), touches, OAK, (DOWN,), (blocks,))


@model
def lean(width=0.005, blocks=6, friction="cone", safety=SAFETY, astray=0.01):
    """A tower whose blocks have their centres of mass on a leaning line, within `astray` metres."""
    made = stack(width, blocks, friction, safety)
    lean_on(made.blocks, astray)
    return made


def lean_on(blocks, astray):
    """Score centres of mass on the leaning line through the first block's foot."""
    foot = middle(blocks[0], BOTTOM)
    for block in blocks:
        _, centre = volume_and_centre(block)
        off = cross(centre - foot, LEANING)
        # The normal density of a distance needs only its square, which is smooth on the line.
        factor(softeq(off.x, 0.0, astray) + softeq(off.y, 0.0, astray) + softeq(off.z, 0.0, astray))


@model
def top_heavy(width=0.005, blocks=6, friction="cone", safety=SAFETY, ratio=2.0):
    """A tower in which each block has twice the volume of the block below."""
    made = stack(width, blocks, friction, safety)
    grow_by(made.blocks, ratio)
    return made


def grow_by(blocks, ratio):
    """Score volumes that grow from block to block."""
    volumes = [volume for volume, _ in [volume_and_centre(block) for block in blocks]]
    for i in range(1, len(volumes)):
        factor(softeq(volumes[i] / volumes[i - 1], ratio, 0.1))


@model
def every_step(width=0.005, blocks=5, friction="cone", safety=SAFETY):
    """A tower that balances after each block of its construction: 198 continuous choices with five blocks."""
    pieces = centred([standing(sheared(0), FEET, UP)], 1, blocks)
    touches = touching(pieces)
    for built in range(2, blocks + 1):
        balance(pieces[:built], touches[:built], OAK, tolerance_of(width, friction, safety), DOWN)
    clear(pieces, touches, GROUND_TOP)
    show(pieces)
    return StackValue(tuple(pieces), touches, OAK, (DOWN,), tuple([built for built in range(2, blocks + 1)]))


def centred(blocks, i, count):
    """Add the blocks from number `i` to the pile, each on the middle of the block below."""
    if i == count:
        return blocks
    below = blocks[i - 1]
    block = standing(sheared(i), middle(below, TOP), outward(below, TOP))
    along, across = edges(below, TOP)
    block = aligned(block, normalize(along), normalize(across))
    return centred(blocks + [block], i + 1, count)
