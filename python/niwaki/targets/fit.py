"""The fit of a scene to its target, in two shares. No empty or huge scene is good in both.

    covered   share of the target that the scene fills
    outside   share of the scene that is outside of the target

Volumes are compared cell by cell, pictures and drawings pixel by pixel. The usual score counts the cells that agree.
This share is high for an empty scene, because most cells around a thin target are empty in both.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine
from niwaki.shares import coverage

if TYPE_CHECKING:
    from niwaki.draw.scene import Scene
    from niwaki.targets.sketches import Score

#: The largest number of cells of a grid that measures a scene beyond its target; a larger scene has larger cells.
MAX_CELLS = 2_000_000


@dataclass(frozen=True)
class Fit:
    """The fit of a scene to a target.

    Attributes
    ----------
    covered : float
        Share of the target that the scene fills.
    outside : float
        Share of the scene outside of the target; 0 for an empty scene.
    """

    covered: float
    outside: float

    @classmethod
    def of_masks(cls, target: NDArray[np.bool_], scene: NDArray[np.bool_]) -> Fit:
        """Compare pixels of a target and of a scene."""
        both, filled = int((target & scene).sum()), int(scene.sum())
        return cls(both / max(int(target.sum()), 1), (filled - both) / max(filled, 1))

    def __str__(self) -> str:
        return coverage(self.covered, self.outside)


def fit(score: Score, scene: Scene) -> Fit | None:
    """Compare a scene with the first target of a score: its volume, else its image, shadow or drawing, else None."""
    for call in score.asks:
        if call.function == "match_volume" and call.grid is not None:
            return _of_volume(call.grid, float(call.arguments["voxel"]), scene)
    for view in score.views:
        return Fit.of_masks(view.image, view.mask(scene))
    return None


def _of_volume(grid: _engine.Target, voxel: float, scene: Scene) -> Fit:
    low, high = np.asarray(grid.domain)
    cells = prod(grid.dims)
    cell = float(np.prod(high - low)) / cells
    measures = _measured(grid, scene)
    # Cells differ if the target fills them and the scene does not, or the other way round.
    differ = round((1.0 - measures["similarity"]) * cells)
    inside = 0.5 * (grid.filled + measures["filled"] - differ)
    filled = measures["filled"] * cell
    bounds = scene.bounds
    if len(scene) and ((bounds[0] < low).any() or (bounds[1] > high).any()):
        filled = max(filled, _volume(scene, voxel))
    return Fit(inside / grid.filled, max(0.0, 1.0 - inside * cell / filled) if filled > 0.0 else 0.0)


def _volume(scene: Scene, voxel: float) -> float:
    """Measure the volume of a scene in cells of a box around it, cubic scene units. Overlapping parts count once."""
    low, high = scene.bounds
    extent = np.maximum(high - low, voxel)
    block = _engine.shape("box", ((low + high) / 2.0).tolist(), extent.tolist())
    size = max(voxel, float((extent.prod() / MAX_CELLS) ** (1.0 / 3.0)))
    grid = _engine.Target(block.vertices(), block.faces(), size)
    domain_low, domain_high = np.asarray(grid.domain)
    return _measured(grid, scene)["filled"] * float(np.prod(domain_high - domain_low)) / prod(grid.dims)


def _measured(grid: _engine.Target, scene: Scene) -> dict[str, float]:
    """Return the measures of a scene where all cells of a grid count."""
    sketch = _engine.Sketch([_engine.SketchSpec(json.dumps({"match_volume": {"sigma": 1.0}}), grid)])
    for part in scene:
        sketch.add(list(part.shapes))
    return sketch.measures()


def cells(score: Score, scene: Scene) -> Cells | None:
    """Return the cells of a scene and its target, as the first `match_volume` counts them, or None without it."""
    for call in score.asks:
        if call.function == "match_volume" and call.grid is not None:
            low, high = np.asarray(call.grid.domain)
            filled = call.grid.mask([shape for part in scene for shape in part.shapes])
            return Cells(low, high, call.grid.cells(), filled)
    return None


@dataclass(frozen=True)
class Cells:
    """The cells of a target's grid, (x, y, z).

    Attributes
    ----------
    low, high : (3,) float64
        Corners of the grid, scene units.
    target, scene : bool
        Masks of the cells that the target fills, and the scene.
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    target: NDArray[np.bool_]
    scene: NDArray[np.bool_]
