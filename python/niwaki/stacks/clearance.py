"""Clearance: factors for a least thickness of blocks and a least gap between them (not in the dissertation).

Equilibrium considers blocks one by one: two blocks may overlap, and a shear may push a corner through the opposite
face. These factors ask for a least thickness between opposite faces, which keeps a block convex, and for a gap between
bodies that touch the same third body but not each other. A factor is flat where its condition holds, and falls like a
normal density where it does not, so it acts on a chain only near the limit. Lengths are metres.
"""

from __future__ import annotations

from niwaki import dot, factor, soft_at_least
from niwaki.stacks.blocks import BOTTOM, SIDES, TOP, outward

#: Least distance of a corner from the opposite face.
LEAST = 0.008
#: Least distance of blocks that do not touch.
GAP = 0.003
#: Standard deviation of both factors below their limits.
SOFT = 0.001

FACES = (BOTTOM, TOP, *SIDES)
#: The corners opposite to each face.
OPPOSITE = (TOP, BOTTOM, (2, 3, 6, 7), (0, 3, 4, 7), (0, 1, 4, 5), (1, 2, 5, 6))


def clear(blocks, contacts, ground):
    """Score thickness of blocks and gaps between them; the top of the ground is at height `ground`."""
    supports = [thick(block) for block in blocks]
    for upper, lower in neighbours(contacts):
        if lower < 0:
            factor(soft_at_least(min([p.z for p in blocks[upper]]) - ground, GAP, SOFT))
        else:
            apart(blocks[upper], supports[upper], blocks[lower], supports[lower])


def thick(block):
    """Score the thickness behind each face; return the normals of the faces and the block's reach along them."""
    return [behind(block, k) for k in range(6)]


def behind(block, k):
    """Score the thickness behind face `k`; return its normal and the block's reach along it."""
    normal = outward(block, FACES[k])
    heights = [dot(normal, p) for p in block]
    a, b, c, d = FACES[k]
    front = 0.25 * (heights[a] + heights[b] + heights[c] + heights[d])
    factor(soft_at_least(front - max([heights[i] for i in OPPOSITE[k]]), LEAST, SOFT))
    return normal, max(heights)


def apart(block, support, other, other_support):
    """Score the widest gap between two blocks, over planes along their faces."""
    gaps = [min([dot(normal, p) for p in other]) - reach for normal, reach in support] + [
        min([dot(normal, p) for p in block]) - reach for normal, reach in other_support
    ]
    factor(soft_at_least(max(gaps), GAP, SOFT))


def neighbours(contacts):
    """Return pairs of bodies that touch the same third body but not each other; the ground comes second in a pair."""
    sides = [(touch.first, touch.second) for touch in contacts] + [
        (touch.second, touch.first) for touch in contacts
    ]
    pairs = sides[:0]
    for upper, third in sides:
        for lower, shared in sides:
            if (
                shared == third
                and upper > lower
                and not met(sides, upper, lower)
                and not met(pairs, upper, lower)
            ):
                pairs = pairs + [(upper, lower)]
    return pairs


def met(pairs, first, second):
    """Return whether a pair is in a list of pairs."""
    return any([a == first and b == second for a, b in pairs])
