"""Predictions of the boxes and the violations of a script with other numbers, without a run of it.

The box of each part is a linear function of the numbers, about a run whose boxes are known. Its derivatives come from a
few runs with all numbers changed by tiny random amounts (`derivatives`): each coordinate depends on few numbers, so the
numbers are found that explain its changes. What will be violated is predicted from the boxes, by rules that are learnt
from the violations of all runs so far:

- two parts overlap, if overlaps have been violations, and these two have not been seen to overlap without one;
- a part asks for room around it (a door), as wide as violations without an overlap say;
- a part leaves the room: the box of all parts that were violated by nothing of their own;
- a part that stood on another, or on the ground, does so no more;
- all else stays as it is.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from niwaki.requirements.boxes import TOUCHING, Array, depths, overlaps
from niwaki.requirements.rows import Violation

#: Changes of numbers for derivatives, as shares of the widths of their priors; the runs with them; the most of them.
TINY, RUNS, MOST_RUNS = 1e-6, 6, 12
#: A coordinate is explained by numbers that leave this share of its changes.
EXPLAINED = 1e-4
#: Sets of numbers that are extended side by side.
KEPT = 40
#: Two parts that overlap by less than this share of the scene's size only touch.
CLOSE = 1e-8
#: The room that a part asks for grows by this share of its size with each violation that it does not explain.
ROOM = 0.15


def changes(keys: int, runs: int, seed: int = 0) -> Array:
    """Return random changes of numbers, in units of `TINY` widths: rows are runs."""
    draws = np.random.default_rng(seed).uniform(0.4, 1.6, (runs, keys))
    signs = np.random.default_rng(seed + 1).integers(0, 2, (runs, keys)) * 2 - 1
    return np.asarray(draws * signs)


def derivatives(steps: Array, moved: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Explain changes of coordinates by few numbers each.

    Parameters
    ----------
    steps
        The changes of the numbers, (runs, n).
    moved
        The changes of the coordinates, (runs, c).

    Returns
    -------
    slopes : (n, c)
        Derivatives of the coordinates.
    explained : (c,) bool
        The coordinates that few numbers explain.
    """
    runs, count = steps.shape
    slopes = np.zeros((count, moved.shape[1]))
    explained = np.ones(moved.shape[1], bool)
    scale = np.linalg.norm(moved, axis=0)
    active = np.flatnonzero(scale > 1e-3 * np.abs(steps).min(initial=1.0))
    known: dict[bytes, tuple[list[int], Array, bool]] = {}
    gram = steps.T @ steps
    for column in active:
        target = moved[:, column]
        key = np.round(target / scale[column] * 1e6).astype(np.int64).tobytes()
        if key not in known:
            known[key] = _explanation(steps, gram, target / scale[column])
        chosen, weights, is_exact = known[key]
        slopes[chosen, column] = weights * scale[column]
        explained[column] = is_exact
    return slopes, explained


def _explanation(steps: Array, gram: Array, target: Array) -> tuple[list[int], Array, bool]:
    """Return the fewest numbers that explain a change of unit length, with their weights."""
    runs, count = steps.shape
    dots = steps.T @ target
    norms = np.diag(gram)
    single = int(np.argmax(dots**2 / norms))
    if 1.0 - dots[single] ** 2 / norms[single] < EXPLAINED**2:
        return [single], np.array([dots[single] / norms[single]]), True
    # All pairs at once, by the normal equations of each.
    determinant = norms[:, None] * norms[None] - gram**2
    np.fill_diagonal(determinant, np.inf)
    first = (norms[None] * dots[:, None] - gram * dots[None]) / determinant
    share = first * dots[:, None] + first.T * dots[None]
    a, b = np.unravel_index(int(np.argmax(share)), share.shape)
    best: list[int] = [int(a), int(b)]
    if 1.0 - share[a, b] < EXPLAINED**2:
        return best, np.array([first[a, b], first[b, a]]), True
    # More: the best pairs are extended by the number that explains most of the rest.
    order = np.argsort(-share, axis=None)[: 2 * KEPT]
    supports = {tuple(sorted(map(int, np.unravel_index(int(place), share.shape)))) for place in order}
    weights: Array = np.zeros(2)
    for _ in range(3, runs - 1):
        extended: dict[tuple[int, ...], float] = {}
        for support in supports:
            basis, _ = np.linalg.qr(steps[:, list(support)])
            rest = target - basis @ (basis.T @ target)
            remaining = steps - basis @ (basis.T @ steps)
            length = np.maximum(np.einsum("ij,ij->j", remaining, remaining), 1e-12)
            gain = (remaining.T @ rest) ** 2 / length
            gain[list(support)] = 0.0
            for k in np.argsort(-gain)[:4]:
                extended[tuple(sorted((*support, int(k))))] = float(rest @ rest - gain[k])
        nearest = sorted(extended, key=lambda support: extended[support])
        best = list(nearest[0])
        weights = np.asarray(np.linalg.lstsq(steps[:, best], target, rcond=None)[0], dtype=np.float64)
        if extended[nearest[0]] < EXPLAINED**2:
            return best, weights, True
        supports = set(nearest[:KEPT])
    return best, weights, False


@dataclass
class Rules:
    """Rules that predict violations from boxes, learnt from the runs.

    Attributes
    ----------
    names : tuple of str
        The parts.
    up : int
        The axis that points up.
    size : float
        The longest side of the first scene.
    """

    names: tuple[str, ...]
    base: Array
    up: int
    size: float
    collide: bool = False
    scale: float = 1.0
    room: Array = field(default_factory=lambda: np.array([[np.inf] * 3, [-np.inf] * 3]))
    walls: Array | None = None
    allowed: NDArray[np.bool_] = field(init=False)
    zones: dict[tuple[str, int], Array] = field(default_factory=dict)
    support: NDArray[np.int64] = field(init=False)
    _ratios: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        count = len(self.names)
        self.index = {name: number for number, name in enumerate(self.names)}
        self.allowed = np.eye(count, dtype=bool)
        self.support = self._supports(self.base)

    @property
    def touch(self) -> float:
        """The distance within which parts touch."""
        return TOUCHING * self.size

    def places(self, parts: Sequence[str]) -> list[int]:
        """Return the places of parts; a violation without parts is one of all."""
        known = [self.index[name] for name in dict.fromkeys(parts) if name in self.index]
        return known if parts else list(range(len(self.names)))

    def _supports(self, boxes: Array) -> NDArray[np.int64]:
        """Return what each part stands on: a part, -1 the ground, -2 nothing."""
        up, flat = self.up, [axis for axis in range(3) if axis != self.up]
        bottom, top = boxes[:, 0, up], boxes[:, 1, up]
        middle = boxes.mean(axis=1)[:, flat]
        out = np.full(len(boxes), -2)
        for number in range(len(boxes)):
            over = (
                (middle[number] >= boxes[:, 0, flat] - self.touch)
                & (middle[number] <= boxes[:, 1, flat] + self.touch)
            ).all(axis=1)
            near = over & (np.abs(bottom[number] - top) <= 10 * self.touch)
            near[number] = False
            if bottom[number] <= bottom.min() + self.touch:
                out[number] = -1
            elif near.any():
                out[number] = int(np.flatnonzero(near)[0])
        return out

    def learn(self, boxes: Array, violations: Sequence[Violation]) -> None:
        """Learn from a run."""
        overlap = overlaps(boxes[:, None], boxes[None])
        deep = depths(boxes[:, None], boxes[None])
        violated = np.zeros_like(self.allowed)
        alone = np.zeros(len(self.names), bool)
        # What most parts violate alone is not that they are outside of the room.
        common = {
            name
            for name, count in Counter(
                row.requirement for row in violations if len(set(row.parts)) == 1
            ).items()
            if count > len(self.names) / 2
        }
        for row in violations:
            places = self.places(row.parts) if row.parts else []
            if len(places) == 1 and row.requirement not in common:
                alone[places[0]] = True
            if len(places) != 2:
                continue
            a, b = places
            violated[a, b] = violated[b, a] = True
            if deep[a, b] > 0.0:
                self.collide = True
                self._ratios.append(row.amount / max(overlap[a, b], 1e-9))
            else:
                gaps = np.maximum(gaps_of(boxes[a], boxes[b]), 0.0)
                extent = float((boxes[a, 1] - boxes[a, 0]).max())
                wide = np.where(gaps > 0.0, gaps + ROOM * extent, 0.0)
                before = self.zones.get((row.requirement, a), np.zeros(3))
                self.zones[(row.requirement, a)] = np.maximum(before, wide)
        if self._ratios:
            self.scale = float(np.median(self._ratios))
        # Parts that overlap without a violation may do so: a rug below a table.
        self.allowed |= (deep > self.touch) & ~violated
        good = boxes[~alone]
        if self.walls is not None:
            self.room = self.walls
        elif len(good):
            low, high = good[:, 0].min(axis=0), good[:, 1].max(axis=0)
            self.room = np.stack([np.minimum(self.room[0], low), np.maximum(self.room[1], high)])

    def pairs(self, first: Array, second: Array, rows: NDArray[np.int64]) -> Array:
        """Return what overlaps of parts cost: (..., rows, parts)."""
        if not self.collide:
            return np.zeros((*first.shape[:-2], len(self.names)))
        cost = overlaps(first[..., :, None, :, :], second[..., None, :, :, :], CLOSE * self.size)
        cost[..., self.allowed[rows]] = 0.0
        return np.asarray(cost * self.scale)

    def alone(self, boxes: Array) -> Array:
        """Return what each part costs alone: outside of the room, off what it stood on. (..., parts)."""
        low, high = boxes[..., 0, :], boxes[..., 1, :]
        out = np.maximum(self.room[0] - low, 0.0).max(axis=-1) + np.maximum(high - self.room[1], 0.0).max(
            axis=-1
        )
        out = np.where(out > self.touch, out, 0.0)
        up, flat = self.up, [axis for axis in range(3) if axis != self.up]
        stands = np.flatnonzero(self.support >= 0)
        if len(stands):
            on = boxes[..., self.support[stands], :, :]
            gap = np.abs(low[..., stands, up] - on[..., 1, up])
            middle = 0.5 * (low + high)[..., stands, :][..., flat]
            beside = np.maximum(on[..., 0, :][..., flat] - middle, 0.0) + np.maximum(
                middle - on[..., 1, :][..., flat], 0.0
            )
            off = gap + beside.max(axis=-1)
            out[..., stands] += np.where(off > 10 * self.touch, off, 0.0)
        ground = np.flatnonzero(self.support == -1)
        off = np.abs(low[..., ground, up] - self.base[ground, 0, up])
        out[..., ground] += np.where(off > 10 * self.touch, off, 0.0)
        return np.asarray(out * self.scale)

    def rooms(self, boxes: Array) -> Array:
        """Return what parts in the room that remaining ask for cost: (..., zones, parts)."""
        out = []
        for (_, owner), wide in self.zones.items():
            zone = boxes[..., owner, :, :] + np.stack([-wide, wide])
            cost = overlaps(zone[..., None, :, :], boxes, CLOSE * self.size)
            cost[..., owner] = 0.0
            cost[..., self.allowed[owner]] = 0.0
            out.append(cost)
        if not out:
            return np.zeros((*boxes.shape[:-3], 0, len(self.names)))
        return np.stack(out, axis=-2) * self.scale


def gaps_of(first: Array, second: Array) -> Array:
    """Return the gaps between two boxes along the axes; below 0 where they overlap."""
    return np.asarray(np.maximum(first[0] - second[1], second[0] - first[1]))


def moved(before: Array, after: Array) -> float:
    """Return how far the parts moved, weighted by their volumes, as a share of the scene's size.

    The corner of a box that moved furthest counts, so a change of size costs as a move of the surface.
    """
    weights = np.prod(np.maximum(before[:, 1] - before[:, 0], 1e-9), axis=-1)
    far = np.linalg.norm(after - before, axis=-1).max(axis=-1)
    size = float((before[:, 1].max(axis=0) - before[:, 0].min(axis=0)).max())
    return float((weights * far).sum() / max(weights.sum() * size, 1e-300))
