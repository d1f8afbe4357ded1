"""Blocks of some thickness that keep clear of one another (not in the dissertation).

Equilibrium looks at blocks one by one: it does not exclude that two of them overlap, nor that a corner is sheared
through the face opposite to it. Here each block must be thick between every two opposite faces, which keeps it
convex, and bodies that touch the same third one, but not each other, to leave a gap. Both are flat where they hold and
fall like a normal density where they do not, so that a chain is affected only near. Metres.
"""

from __future__ import annotations

from niwaki import dot, factor, soft_at_least
from niwaki.stacks.blocks import BOTTOM, SIDES, TOP, outward

#: How near a corner may come to a face that it is no part of.
LEAST = 0.008
#: How near blocks may come that do not touch.
GAP = 0.003
#: How far below either costs as much as one standard deviation.
SOFT = 0.001

FACES = (BOTTOM, TOP, *SIDES)
#: The corners that are no part of each face.
OPPOSITE = (TOP, BOTTOM, (2, 3, 6, 7), (0, 3, 4, 7), (0, 1, 4, 5), (1, 2, 5, 6))


def clear(blocks, contacts, ground):
    """Ask blocks to be thick and to keep their distance; the ground's top is at height `ground`."""
    supports = [thick(block) for block in blocks]
    for one, other in neighbours(contacts):
        if other < 0:
            factor(soft_at_least(min([p.z for p in blocks[one]]) - ground, GAP, SOFT))
        else:
            apart(blocks[one], supports[one], blocks[other], supports[other])


def thick(block):
    """Ask the corners opposite to each face to lie behind it; return the faces' normals and reaches."""
    return [behind(block, k) for k in range(6)]


def behind(block, k):
    """Ask the corners opposite to face `k` to lie behind it; return its normal and the block's reach along it."""
    normal = outward(block, FACES[k])
    heights = [dot(normal, p) for p in block]
    a, b, c, d = FACES[k]
    front = 0.25 * (heights[a] + heights[b] + heights[c] + heights[d])
    factor(soft_at_least(front - max([heights[i] for i in OPPOSITE[k]]), LEAST, SOFT))
    return normal, max(heights)


def apart(block, support, other, others):
    """Ask for a plane, along a face of one of two blocks, that leaves a gap between them."""
    gaps = [min([dot(normal, p) for p in other]) - reach for normal, reach in support] + [
        min([dot(normal, p) for p in block]) - reach for normal, reach in others
    ]
    factor(soft_at_least(max(gaps), GAP, SOFT))


def neighbours(contacts):
    """Pairs of bodies, the ground among them, that touch the same third one and not each other; the ground second."""
    sides = [(touch.first, touch.second) for touch in contacts] + [
        (touch.second, touch.first) for touch in contacts
    ]
    found = sides[:0]
    for one, third in sides:
        for other, shared in sides:
            if shared == third and one > other and not met(sides, one, other) and not met(found, one, other):
                found = found + [(one, other)]
    return found


def met(pairs, one, other):
    """Whether a pair is among these."""
    return any([a == one and b == other for a, b in pairs])
