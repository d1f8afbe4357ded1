"""Networks of arches: blocks along curves that stand on the ground or on one another (dissertation figures 4.8, 4.11).

A curve is a cubic Bezier curve in the plane of x and z, given by its ends and their tangents. Block i lies between the
curve's points i/n and (i+1)/n. Each block then slides along the face below and changes height and shear, and the bottom
of the next block follows. A curve on another curve starts at a block's face with the face's normal, so it follows the
random shape of its base. Front is the inside of an arch, back its outside. Numbers are the original's; lengths are
metres.
"""

from __future__ import annotations

from niwaki import factor, model, norm, softeq, uniform, vec
from niwaki.stacks.blocks import (
    BACK,
    BOTTOM,
    FRONT,
    TOP,
    drawn,
    edges,
    middle,
    moved,
    outward,
    raise_top,
    shear_x,
    standing,
    top_shear_x,
    welded,
)
from niwaki.stacks.clearance import clear
from niwaki.stacks.contacts import (
    DOWN,
    GROUND,
    SAFETY,
    StackValue,
    balance,
    contact,
    corners,
    positive_volume,
    tolerance_of,
)
from niwaki.stacks.towers import OAK, PAINTS, UP, slope

GROUND_TOP = 0.005
FLOOR = (
    vec(-0.5, -0.5, GROUND_TOP),
    vec(0.5, -0.5, GROUND_TOP),
    vec(0.5, 0.5, GROUND_TOP),
    vec(-0.5, 0.5, GROUND_TOP),
)
LEAST_VOLUME = 0.0005**3
MARGIN = 0.01
#: Widths and depths of blocks.
THICK = (0.02, 0.06)


def ground_at(t, pull=0.9):
    """Return a point of the ground, a curve from x = -0.5 to 0.5 with tangents of `pull` metres at its ends."""
    a, b, c, d = (1.0 - t) ** 3, 3.0 * (1.0 - t) ** 2 * t, 3.0 * (1.0 - t) * t**2, t**3
    return vec(-0.5 * a + (pull - 0.5) * b + (0.5 - pull) * c + 0.5 * d, 0.0, GROUND_TOP)


def point_of(ends, t):
    """Return a point of the curve with ends (start, start tangent, end, end tangent)."""
    p, u, q, v = ends
    s = 1.0 - t
    return s**3 * p + 3.0 * s * s * t * (p + u) + 3.0 * s * t * t * (q + v) + t**3 * q


def outside_of(ends, t):
    """Return the direction to the outside of an arch: a quarter turn from the direction of the curve."""
    p, u, q, v = ends
    s = 1.0 - t
    along = s * s * u + 2.0 * s * t * (q + v - p - u) - t * t * v
    across = vec(-along.z, 0.0, along.x)
    return across / norm(across)


def face_at(ends, t, width, depth):
    """Return the four corners of a block's end."""
    at, out, side = point_of(ends, t), 0.5 * width * outside_of(ends, t), vec(0.0, 0.5 * depth, 0.0)
    return (at - out - side, at - out + side, at + out + side, at + out - side)


def size_of(thick, depth):
    """Return the width and the depth of a block."""
    width = uniform(thick[0], thick[1])
    return width, uniform(thick[0], thick[1]) if depth is None else depth


def curve(ends, count, thick=THICK, depth=None, margin=MARGIN):
    """Return blocks along a curve, reshaped from start to end and welded to both ends; without `depth` it is random."""
    sizes = [size_of(thick, depth) for _ in range(count)]
    pieces = [
        face_at(ends, i / count, sizes[i][0], sizes[i][1])
        + face_at(ends, (i + 1) / count, sizes[i][0], sizes[i][1])
        for i in range(count)
    ]
    first = welded(pieces[0], BOTTOM, ends[0], ends[1] / norm(ends[1]))
    return followed([first] + pieces[1:], 0, ends, margin)


def followed(pieces, i, ends, margin):
    """Reshape the blocks from number `i`."""
    if i == len(pieces):
        return pieces
    block = pieces[i] if i == 0 else slid_out(pieces[i], pieces[i - 1], margin)
    block = raise_top(block, uniform(-0.3, 0.3))
    block = top_shear_x(shear_x(block, slope()), slope())
    if i == len(pieces) - 1:
        block = welded(block, TOP, ends[2], ends[3] / norm(ends[3]))
        rest = []
    else:
        follower = welded(pieces[i + 1], BOTTOM, middle(block, TOP), outward(block, TOP))
        rest = [follower] + pieces[i + 2 :]
    positive_volume(block, LEAST_VOLUME)
    return followed(pieces[:i] + [block] + rest, i + 1, ends, margin)


def slid_out(block, below, margin):
    """Put a block on another; it slides towards the outside or inside of the arch, and `margin` of contact remains."""
    block = standing(block, middle(below, TOP), outward(below, TOP))
    _, out = edges(below, TOP)
    _, mine = edges(block, (0, 1, 2, 3))
    reach = 0.5 * (norm(out) + norm(mine)) - margin
    return moved(block, (uniform(-1.0, 1.0) * reach / norm(out)) * out)


def on_face(block, face, tangent):
    """Return a point and a tangent for a curve that starts or ends on a face."""
    return middle(block, face), tangent * outward(block, face)


def links(first, count, pieces):
    """Return the contacts within a curve."""
    return [
        contact(i, corners(pieces[i], TOP), i + 1, corners(pieces[i + 1], BOTTOM))
        for i in range(first, first + count - 1)
    ]


def feet(first, count, pieces):
    """Return the contacts of a curve's ends with the ground."""
    last = first + count - 1
    return [
        contact(first, corners(pieces[first], BOTTOM), GROUND, FLOOR),
        contact(last, corners(pieces[last], TOP), GROUND, FLOOR),
    ]


def show(pieces):
    """Emit the blocks."""
    for i in range(len(pieces)):
        drawn(pieces[i], PAINTS[i % 5])


@model
def arch(width=0.01, blocks=11, friction="cone", safety=SAFETY):
    """An arch: 209 continuous choices with eleven blocks."""
    pieces = curve((ground_at(0.2), 0.3 * UP, ground_at(0.8), 0.3 * UP), blocks)
    touches = tuple(links(0, blocks, pieces) + feet(0, blocks, pieces))
    balance(pieces, touches, OAK, tolerance_of(width, friction, safety), DOWN)
    clear(pieces, touches, GROUND_TOP)
    show(pieces)
    return StackValue(tuple(pieces), touches, OAK, (DOWN,), (blocks,))


@model
def symmetric_arch(width=0.01, blocks=11, friction="cone", safety=SAFETY, apart=0.002):
    """An arch that is nearly its own mirror image."""
    made = arch(width, blocks, friction, safety)
    mirrored(made.blocks, made.blocks, apart)
    return made


def three(starts, tolerance):
    """Build two arches on the ground and a third on their keystones."""
    a, b, c, d = starts
    left = curve((a, 0.3 * UP, b, 0.3 * UP), 9)
    right = curve((c, 0.3 * UP, d, 0.3 * UP), 9)
    start, rise = on_face(left[4], BACK, 0.3)
    end, fall = on_face(right[4], BACK, 0.3)
    top = curve((start, rise, end, fall), 11)
    pieces = left + right + top
    touches = tuple(
        links(0, 9, pieces)
        + links(9, 9, pieces)
        + links(18, 11, pieces)
        + feet(0, 9, pieces)
        + feet(9, 9, pieces)
        + [
            contact(18, corners(pieces[18], BOTTOM), 4, corners(pieces[4], BACK)),
            contact(28, corners(pieces[28], TOP), 13, corners(pieces[13], BACK)),
        ]
    )
    balance(pieces, touches, OAK, tolerance, DOWN)
    clear(pieces, touches, GROUND_TOP)
    show(pieces)
    return StackValue(tuple(pieces), touches, OAK, (DOWN,), (29,))


@model
def tri_arch(width=0.01, friction="cone", safety=SAFETY):
    """Two arches that carry a third: 555 continuous choices."""
    return three(
        (ground_at(0.05), ground_at(0.25), ground_at(0.6), ground_at(0.9)),
        tolerance_of(width, friction, safety),
    )


@model
def symmetric_tri_arch(width=0.01, friction="cone", safety=SAFETY, apart=0.002):
    """Two arches that carry a third, nearly their own mirror image: 555 continuous choices."""
    pull = 1.0 / 3.0
    made = three(
        (ground_at(0.18, pull), ground_at(0.43, pull), ground_at(0.57, pull), ground_at(0.82, pull)),
        tolerance_of(width, friction, safety),
    )
    mirrored(made.blocks[:9], made.blocks[9:18], apart)
    mirrored(made.blocks[18:], made.blocks[18:], apart)
    return made


def mirrored(blocks, other, apart):
    """Score a mirror image in x = 0, within `apart` metres; the image of an arch runs backwards."""
    for i in range(len(blocks)):
        image = other[len(other) - 1 - i]
        for k in range(8):
            p, q = blocks[i][k], image[(k + 4) % 8]
            factor(
                softeq(p.x, -q.x, apart) + softeq(p.y, q.y, apart) + softeq(p.z, q.z, apart)
            )  # fmt: skip


@model
def wheel(width=0.01, friction="cone", safety=SAFETY):
    """An arch over another, and a spoke between their keystones: 555 continuous choices."""
    inner = curve((ground_at(0.2), 0.3 * UP, ground_at(0.8), 0.3 * UP), 9)
    outer = curve((ground_at(0.1), 0.6 * UP, ground_at(0.9), 0.6 * UP), 17)
    start, rise = on_face(inner[4], BACK, 0.1)
    end, fall = on_face(outer[8], FRONT, 0.1)
    spoke = curve((start, rise, end, fall), 3)
    pieces = inner + outer + spoke
    touches = tuple(
        links(0, 9, pieces)
        + links(9, 17, pieces)
        + links(26, 3, pieces)
        + feet(0, 9, pieces)
        + feet(9, 17, pieces)
        + [
            contact(26, corners(pieces[26], BOTTOM), 4, corners(pieces[4], BACK)),
            contact(28, corners(pieces[28], TOP), 17, corners(pieces[17], FRONT)),
        ]
    )
    balance(pieces, touches, OAK, tolerance_of(width, friction, safety), DOWN)
    clear(pieces, touches, GROUND_TOP)
    show(pieces)
    return StackValue(tuple(pieces), touches, OAK, (DOWN,), (29,))
