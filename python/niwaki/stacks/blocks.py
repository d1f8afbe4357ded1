"""Blocks: convex solids with eight corners that are sheared, stacked and welded (dissertation 4.5).

A block is a tuple of eight points: the corners of its bottom (front left, front right, back right, back left), then the
corners of its top in the same order. In its start position left is -x, front is -y and z is up. Lengths are metres.

The solid of a block is the convex hull of its corners. A side that is twisted by shears is not flat: the hull has the
outer one of its diagonals, and `volume_and_centre` follows it exactly, without a branch.

Everything here is in the modelling language, so that gradients flow through it.
"""

from __future__ import annotations

from math import sqrt

from niwaki import cross, dot, emit, mesh, normalize, vec

#: Corners of each face, counter-clockwise from outside.
BOTTOM = (0, 3, 2, 1)
TOP = (4, 5, 6, 7)
FRONT = (0, 1, 5, 4)
BACK = (2, 3, 7, 6)
LEFT = (0, 4, 7, 3)
RIGHT = (1, 2, 6, 5)
SIDES = (FRONT, RIGHT, BACK, LEFT)

#: Triangles of the faces without corner 0, each cut along its first diagonal. Faces with corner 0 need none.
FAR_TRIANGLES = ((4, 5, 6), (4, 6, 7), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6))

#: The square of a volume, in m^6, below which a drawn side counts as flat.
FLAT = 1e-30

#: Triangles of a drawn block; a side is a fan about the middle of its outer diagonal (corners 8 to 11).
DRAWN = (
    (0, 3, 2), (0, 2, 1), (4, 5, 6), (4, 6, 7),
    (0, 1, 8), (1, 5, 8), (5, 4, 8), (4, 0, 8),
    (1, 2, 9), (2, 6, 9), (6, 5, 9), (5, 1, 9),
    (2, 3, 10), (3, 7, 10), (7, 6, 10), (6, 2, 10),
    (3, 0, 11), (0, 4, 11), (4, 7, 11), (7, 3, 11),
)  # fmt: skip


def box_corners(centre, width, depth, height):
    """Return a box around a centre: `width` along x, `depth` along y, `height` along z."""
    x, y, z = 0.5 * width, 0.5 * depth, 0.5 * height
    return (
        centre + vec(-x, -y, -z),
        centre + vec(x, -y, -z),
        centre + vec(x, y, -z),
        centre + vec(-x, y, -z),
        centre + vec(-x, -y, z),
        centre + vec(x, -y, z),
        centre + vec(x, y, z),
        centre + vec(-x, y, z),
    )


def middle(block, face):
    """Return the mean of a face's corners."""
    a, b, c, d = face
    return 0.25 * (block[a] + block[b] + block[c] + block[d])


def outward(block, face):
    """Return the outward normal of a flat face."""
    a, b, c, d = face
    return normalize(cross(block[c] - block[a], block[d] - block[b]))


def shear_x(block, slope):
    """Push the top along x, by `slope` for each metre of height above the bottom's middle."""
    low = middle(block, BOTTOM).z
    return block[:4] + tuple([p + vec(slope * (p.z - low), 0.0, 0.0) for p in block[4:]])


def shear_y(block, slope):
    """Push the top along y, by `slope` for each metre of height above the bottom's middle."""
    low = middle(block, BOTTOM).z
    return block[:4] + tuple([p + vec(0.0, slope * (p.z - low), 0.0) for p in block[4:]])


def top_shear_x(block, slope):
    """Slant the top along x: it rises by `slope` for each metre from its middle."""
    at = middle(block, TOP).x
    return block[:4] + tuple([p + vec(0.0, 0.0, slope * (p.x - at)) for p in block[4:]])


def top_shear_y(block, slope):
    """Slant the top along y: it rises by `slope` for each metre from its middle."""
    at = middle(block, TOP).y
    return block[:4] + tuple([p + vec(0.0, 0.0, slope * (p.y - at)) for p in block[4:]])


def moved(block, by):
    """Move a block by a vector."""
    return tuple([p + by for p in block])


def raise_top(block, share):
    """Move the top along the line from the middle of the bottom to the middle of the top, by a share of its length."""
    by = share * (middle(block, TOP) - middle(block, BOTTOM))
    return block[:4] + tuple([p + by for p in block[4:]])


def swung(v, start, end):
    """Turn a vector by the smallest rotation from the unit vector `start` to `end`, which must not be its opposite."""
    axis = cross(start, end)
    once = cross(axis, v)
    return v + once + cross(axis, once) / (1.0 + dot(start, end))


def swung_block(block, about, start, end):
    """Turn a block about a point by the smallest rotation from `start` to `end`."""
    return tuple([about + swung(p - about, start, end) for p in block])


def standing(block, point, normal):
    """Put a block with the middle of its bottom at a point of a face with outward normal `normal`."""
    about = middle(block, BOTTOM)
    turned = swung_block(block, about, -outward(block, BOTTOM), normal)
    return moved(turned, point - about)


def welded(block, face, point, normal):
    """Move the corners of a face rigidly to `point`, so that it faces a surface with outward normal `normal`."""
    about = middle(block, face)
    facing = outward(block, face)
    return tuple(
        [
            point + swung(block[i] - about, facing, -normal) if i in face else block[i]
            for i in range(8)
        ]
    )  # fmt: skip


def edges(block, face):
    """Return the directions of the two edges of a rectangular face at its first corner."""
    a, b, _, d = face
    return block[b] - block[a], block[d] - block[a]


def volume_and_centre(block):
    """Return volume and centre of mass of a block's convex hull."""
    origin = block[0]
    volume, moment = 0.0, vec(0.0, 0.0, 0.0)
    for a, b, c in FAR_TRIANGLES:
        p, q, r = block[a] - origin, block[b] - origin, block[c] - origin
        part = dot(p, cross(q, r)) / 6.0
        volume = volume + part
        moment = moment + 0.25 * part * (p + q + r)
    for face in SIDES:
        part = max(bulge(block, face), 0.0)
        volume = volume + part
        moment = moment + part * (middle(block, face) - origin)
    return volume, origin + moment / volume


def bulge(block, face):
    """Return the volume between a face's diagonals; it is above 0 if the second diagonal lies outside of the first."""
    a, b, c, d = face
    at = block[a]
    return dot(block[b] - at, cross(block[c] - at, block[d] - at)) / 6.0


def drawn(block, color):
    """Emit a block; the scene has y up where blocks have z."""
    points = list(block)
    for face in SIDES:
        a, b, c, d = face
        first, second = 0.5 * (block[a] + block[c]), 0.5 * (block[b] + block[d])
        # Without a branch a gradient has only one path; a flat face takes the mean of both diagonals.
        twist = bulge(block, face)
        points = points + [first + (0.5 + 0.5 * twist / sqrt(twist * twist + FLAT)) * (second - first)]
    emit(mesh([(p.x, p.z, -p.y) for p in points], DRAWN, color=color))
