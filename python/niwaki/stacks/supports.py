"""Forces that hold a structure up: a force for each contact, and the unbalanced rest of each block.

Many sets of forces can balance a structure (an arch can press itself together). A linear program finds the set with the
least total. Without balance it finds forces that leave a rest on as few blocks as possible.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from niwaki.stacks.judges import BALANCE, loads_of, need, program, solved
from niwaki.stacks.structure import Floats, Structure

#: The cost of a force relative to an unbalanced rest; it is small, so that balance comes first.
PRICE = 1e-3


@dataclass(frozen=True)
class Carried:
    """Forces that hold a structure, for its first direction of gravity.

    Attributes
    ----------
    points : array of shape (contacts, 3)
        The points at which forces act, in metres: means of the contacts' corners, weighted by their loads.
    forces : array of shape (contacts, 3)
        Forces on the second body of each contact, in mean weights; the first body gets the opposite force.
    weights : array of shape (blocks, 3)
        The weight of each block, in mean weights.
    left : array of shape (blocks,)
        The largest unbalanced force or torque, in mean weights and mean weights times the cube root of the mean
        volume.
    """

    points: Floats
    forces: Floats
    weights: Floats
    left: Floats

    @property
    def loose(self) -> tuple[int, ...]:
        """The numbers of the blocks without balance."""
        return tuple(int(number) for number in np.flatnonzero(self.left > BALANCE))


def carried(structure: Structure) -> Carried:
    """Find the forces that hold a structure, or as many of its blocks as can be held.

    Raises
    ------
    FileError
        SciPy is missing (extra `stacks`).
    """
    sparse, optimize = need("scipy.sparse"), need("scipy.optimize")
    down = structure.downs[0]
    rays, weights = program(structure, True)
    loads = loads_of(weights, down)
    rows, columns = rays.shape
    each = sparse.identity(rows, format="csc")
    cost = np.concatenate([np.full(columns, PRICE), np.ones(2 * rows)])
    every = sparse.hstack([rays, each, -each]).tocsc()
    # The simplex method ends at a corner of the program, where unnecessary forces are exactly 0.
    sizes = solved(optimize.linprog(cost, A_eq=every, b_eq=-loads, method="highs-ds")).x[:columns]
    left = np.abs(rays @ sizes + loads).reshape(len(structure), 6).max(axis=1)
    points, forces = [], []
    for touch, part in zip(structure.touches, sizes.reshape(len(structure.touches), 4, -1), strict=True):
        normal, along, across = touch.frame
        angles = 2.0 * np.pi * np.arange(part.shape[1]) / part.shape[1]
        tangents = np.cos(angles)[:, None] * along + np.sin(angles)[:, None] * across
        pushes = part.sum(axis=1)
        total = float(pushes.sum())
        points.append(pushes @ touch.points / total if total > 0.0 else touch.points.mean(axis=0))
        forces.append(total * normal + structure.friction * (part.sum(axis=0) @ tangents))
    return Carried(np.array(points), np.array(forces), weights[:, None] * down, left)
