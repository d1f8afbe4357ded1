"""The errors of a scene, as a vector: the differences between a scene and its target that an emulator can learn.

A score is one number of a scene. The differences are hundreds: cells of the target's grid summed in blocks, slices and
silhouettes; pixels in blocks; lengths outside of a box; numbers in units of their tolerance. A scene that matches has
differences of zero.

Each kind of sketch has its differences in the same unit, nats: the square of their length is twice the score that the
empty scene loses, for the empty scene. So a product of sketches puts them side by side.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.targets.sketches import Score, SketchCall, View

#: Blocks along the longest side of a grid of cells, and pixels along the longest side of a picture in blocks.
BLOCKS, PIXELS = 9, 24

#: Weights of a volume's blocks, slices and silhouettes.
BLOCK, SLICE, SHADOW = 0.7, 0.15, 0.35

#: The length of the differences of a scene that covers a whole obstacle, or reaches below the floor by its own height.
FORBIDDEN = 10.0


#: Lengths further outside of a box than this many deviations are all as wrong.
FARTHEST = 200.0


class Differences(Protocol):
    """The errors of a scene by one sketch."""

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the differences, (n,) float64; n is the same for all scenes."""
        ...


def differences(score: Score) -> tuple[list[Differences], list[str]]:
    """Return the differences of the sketches of a score, and the names of sketches that have none."""
    parts: list[Differences] = []
    without: list[str] = []
    views = iter(score.views)
    for call in score.asks:
        view = next(views) if call.function in VIEWED else None
        make = MAKERS.get(call.function)
        if make is not None:
            parts.append(make(call, view))
            continue
        without.append(call.function)
        if _engine.SKETCHES[call.function] is None:
            parts.append(ScoreDifference(call))
    return parts, without


class ScoreDifference:
    """The one difference of a sketch that has no across: how far its similarity is from 1, in standard deviations."""

    def __init__(self, call: SketchCall, _: View | None = None) -> None:
        self.spec, self.sigma = call.spec, float(call.arguments["sigma"])

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the difference."""
        measures = _measures(self.spec, scene)
        similarity = measures.get("similarity", measures.get("score", 0.0))
        return np.array([(1.0 - similarity) / self.sigma])


class VolumeDifferences:
    """The cells of a scene less those of its target, in blocks, slices and silhouettes, and the sides of its box."""

    #: The weight of the blocks, which come first.
    weight = BLOCK

    def __init__(self, call: SketchCall, _: View | None = None) -> None:
        assert call.grid is not None
        self.grid = call.grid
        dims = self.grid.dims
        step = max(dims) / BLOCKS
        self.cuts = [_cuts(count, step) for count in dims]
        self.pairs = [np.arange(0, count, 2) for count in dims]
        want = self.grid.cells()
        self.low, self.high = call.arguments["target"].bounds
        self.length = float((self.high - self.low).max())
        self.want = self.sums(want)
        self.ends = self._ends(want)
        empty = float(np.sqrt((self.want**2).sum()))
        self.unit = _lost(call) / empty

    def sums(self, cells: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return the sums of cells, each kind with its weight."""
        filled = cells.astype(np.float32)
        blocks = filled
        for axis, cuts in enumerate(self.cuts):
            blocks = np.add.reduceat(blocks, cuts, axis=axis)
        out = [BLOCK * blocks.ravel()]
        for axis in range(3):
            along = filled.sum(axis)
            across = [k for k in range(3) if k != axis]
            # The slices of two axes are sums of this silhouette.
            if axis != 2:
                out.append(SLICE * along.sum(0 if axis == 0 else 1))
            if axis == 1:
                out.append(SLICE * along.sum(0))
            for place, other in enumerate(across):
                along = np.add.reduceat(along, self.pairs[other], axis=place)
            out.append(SHADOW * along.ravel())
        return np.concatenate(out).astype(np.float64)

    def blocks(self) -> NDArray[np.float64]:
        """Return the cells of the target in each block, (x, y, z)."""
        shape = tuple(len(cuts) for cuts in self.cuts)
        blocks: NDArray[np.float64] = self.want[: int(np.prod(shape))].reshape(shape) / BLOCK
        return blocks

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the differences."""
        sums = self.sums(self.grid.mask(list(shapes))) - self.want
        if shapes:
            low, high = scene.bounds
            box = np.concatenate([low - self.low, high - self.high])
        else:
            middle = 0.5 * (self.low + self.high)
            box = np.concatenate([middle - self.low, middle - self.high])
        # A scene that is far too large is not much more wrong than one that is twice as long.
        return np.concatenate([sums, self.ends * box / (1.0 + np.abs(box) / self.length)]) * self.unit

    def _ends(self, want: NDArray[np.bool_]) -> NDArray[np.float64]:
        """The weights of the six sides of the box, for each unit of length.

        What sticks out of the grid has no cells there. It weighs as if the target went on at this end: as the blocks
        of a further layer of cells.
        """
        low, high = self.grid.domain
        voxel = float(np.mean((np.asarray(high) - low) / self.grid.dims))
        places = np.argwhere(want)
        weights = []
        for side in (0, 1):
            for axis in range(3):
                first, last = (
                    (int(places[:, axis].min()), int(places[:, axis].max())) if len(places) else (0, 0)
                )
                thick = max(1, round(max(self.grid.dims) / BLOCKS))
                slab = slice(first, first + thick) if side == 0 else slice(last + 1 - thick, last + 1)
                layers = np.take(want, range(*slab.indices(want.shape[axis])), axis).sum(axis) / thick
                for place, other in enumerate(k for k in range(3) if k != axis):
                    layers = np.add.reduceat(layers, self.cuts[other], axis=place)
                weights.append(BLOCK * float(np.sqrt((layers**2).sum())) / voxel)
        return np.array(weights)


class PixelDifferences:
    """The pixels of a picture that are on less those that should be, in blocks, rows and columns."""

    def __init__(self, call: SketchCall, view: View | None) -> None:
        assert view is not None
        self.picture = view.picture
        want = view.image
        if isinstance(view.picture, _engine.Picture):
            want = want & view.picture.seen()
        rows, columns = want.shape
        step = max(max(rows, columns) / PIXELS, 1.0)
        self.cuts = [_cuts(rows, step), _cuts(columns, step)]
        self.want = self.sums(want)
        empty = float(np.sqrt((self.want**2).sum()))
        self.unit = _lost(call) / max(empty, 1.0)

    def sums(self, pixels: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return the sums of pixels, each kind with its weight."""
        on = pixels.astype(np.float32)
        blocks = np.add.reduceat(np.add.reduceat(on, self.cuts[0], axis=0), self.cuts[1], axis=1)
        return np.concatenate([blocks.ravel(), SHADOW * on.sum(0), SHADOW * on.sum(1)]).astype(np.float64)

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the differences."""
        return (self.sums(self.picture.mask(list(shapes))) - self.want) * self.unit


class ObstacleDifferences:
    """The cells of an obstacle that a scene fills, in blocks."""

    def __init__(self, call: SketchCall, _: View | None = None) -> None:
        assert call.grid is not None
        self.grid, self.solid = call.grid, call.grid.cells()
        self.cuts = [_cuts(count, max(self.grid.dims) / BLOCKS) for count in self.grid.dims]
        self.unit = FORBIDDEN / max(float(np.sqrt((self.sums(self.solid) ** 2).sum())), 1.0)

    def sums(self, cells: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return the sums of cells in blocks."""
        blocks = cells.astype(np.float32)
        for axis, cuts in enumerate(self.cuts):
            blocks = np.add.reduceat(blocks, cuts, axis=axis)
        return blocks.ravel().astype(np.float64)

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the differences."""
        return self.sums(self.grid.mask(list(shapes)) & self.solid) * self.unit


class FloorDifferences:
    """How far a scene reaches below a height, as a share of its own height."""

    def __init__(self, call: SketchCall, _: View | None = None) -> None:
        self.height = float(call.arguments["y"])

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the difference."""
        if not shapes:
            return np.zeros(1)
        low, high = scene.bounds
        below = max(0.0, self.height - float(low[1])) / max(float(high[1] - low[1]), 1e-9)
        return np.array([FORBIDDEN * min(below, 3.0)])


class BoxDifferences:
    """How far a scene reaches out of the six sides of a box, in standard deviations."""

    def __init__(self, call: SketchCall, _: View | None = None) -> None:
        low, high = call.arguments["domain"]
        self.low, self.high = np.asarray(low), np.asarray(high)
        self.unit = 1.0 / (float(call.arguments["sigma"]) * (self.high - self.low))

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the differences."""
        if not shapes:
            return np.zeros(6)
        low, high = scene.bounds
        out = np.concatenate([(self.low - low) * self.unit, (high - self.high) * self.unit])
        # The engine scores the sum of the six lengths; far outside, more is not more wrong.
        clipped: NDArray[np.float64] = np.clip(out, 0.0, FARTHEST)
        return clipped


class LimitDifferences:
    """How far a scene is beyond its limits, in standard deviations."""

    def __init__(self, call: SketchCall, _: View | None = None) -> None:
        self.spec, self.sigma = call.spec, float(call.arguments["sigma"])

    def __call__(self, shapes: Sequence[_engine.Shape], scene: Scene) -> NDArray[np.float64]:
        """Return the difference."""
        return np.array([min(_measures(self.spec, scene)["excess"] / self.sigma, FARTHEST)])


def _measures(spec: _engine.SketchSpec, scene: Scene) -> dict[str, float]:
    """Return the measures of a sketch of a scene."""
    sketch = _engine.Sketch([spec])
    for part in scene.parts:
        sketch.add(list(part.shapes))
    return sketch.measures()


def _cuts(count: int, step: float) -> NDArray[np.int64]:
    starts = np.unique(np.round(np.arange(0, count, max(step, 1.0))).astype(np.int64))
    return starts[starts < count]


def _lost(call: SketchCall) -> float:
    """The root of twice the score that the empty scene loses against a perfect one, nats: its error in deviations."""
    sketch = _engine.Sketch([call.spec])
    similarity = sketch.similarity()
    deviation = float(call.arguments["sigma"])
    if call.arguments.get("weight") == "balanced":
        deviation *= _engine.BALANCED_DEVIATIONS
    wrong = 1.0 if similarity is None else 1.0 - similarity
    return max(wrong / deviation, 1.0)


Make = Callable[[SketchCall, View | None], Differences]

#: The differences of sketches, by the function that makes the sketch.
MAKERS: dict[str, Make] = {
    "match_volume": VolumeDifferences,
    "match_image": PixelDifferences,
    "match_shadow": PixelDifferences,
    "match_drawing": PixelDifferences,
    "avoid": ObstacleDifferences,
    "floor": FloorDifferences,
    "overshoot": BoxDifferences,
    "limits": LimitDifferences,
}

#: Sketches with a view, in the order of the views of a score.
VIEWED = ("match_image", "match_shadow", "match_drawing")


def log_score(score: Score, scene: Scene) -> tuple[float, dict[str, Any]]:
    """Return the log score of a scene, minus infinity if it is forbidden, and the measures of its sketches."""
    sketch = _engine.Sketch(score.specs)
    for part in scene.parts:
        if sketch.add(list(part.shapes)) is not None:
            return -np.inf, {}
    return float(sketch.log_score()), dict(sketch.measures())
