"""How a scene fits what it should be, in two shares that neither an empty nor a huge scene can win.

    covered   of what is wanted, the share that the scene fills
    outside   of the scene, the share that is where nothing is wanted

Volumes are compared cell by cell, pictures and drawings pixel by pixel. The share of cells that agree, which the score
looks at, is high for an empty scene: most cells around a thin target are empty in both.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from math import ceil, floor, prod
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine

if TYPE_CHECKING:
    from niwaki.draw.scene import Scene
    from niwaki.targets.sketches import Score, SketchCall

#: Cells of the grid that measures a scene beyond its target; a larger scene has larger cells.
MOST = 2_000_000


@dataclass(frozen=True)
class Fit:
    """How a scene fits a target.

    Attributes
    ----------
    covered : float
        Of the target, the share that the scene fills.
    outside : float
        Of the scene, the share outside of the target; 0 of an empty scene.
    """

    covered: float
    outside: float

    @classmethod
    def of_masks(cls, wanted: NDArray[np.bool_], made: NDArray[np.bool_]) -> Fit:
        """The fit of pixels."""
        both, filled = int((wanted & made).sum()), int(made.sum())
        return cls(both / max(int(wanted.sum()), 1), (filled - both) / max(filled, 1))

    def __str__(self) -> str:
        # Rounded to the worse side: only all is 100 %, and only nothing is 0 %.
        covered, outside = floor(1000 * self.covered + 1e-9), ceil(1000 * self.outside - 1e-9)
        return f"{covered / 10:.1f} % covered, {outside / 10:.1f} % outside"


def fit(score: Score, scene: Scene) -> Fit | None:
    """How a scene fits what a score wants first: its volume, else its image, shadow or drawing; None without one."""
    for call in score.asks:
        if call.function == "match_volume" and call.grid is not None:
            return _of_volume(call, call.grid, scene)
    for view in score.views:
        return Fit.of_masks(view.image, view.mask(scene))
    return None


def _of_volume(call: SketchCall, grid: _engine.Target, scene: Scene) -> Fit:
    low, high = np.asarray(grid.domain)
    cells = prod(grid.dims)
    cell = float(np.prod(high - low)) / cells
    measures = _measured(call.spec, scene)
    # Cells that differ are wanted and empty, or filled and not wanted.
    differ = round((1.0 - measures["similarity"]) * cells)
    inside = 0.5 * (grid.filled + measures["filled"] - differ)
    filled = measures["filled"] * cell
    bounds = scene.bounds
    if len(scene) and ((bounds[0] < low).any() or (bounds[1] > high).any()):
        filled = max(filled, _volume(scene, float(call.given["voxel"])))
    return Fit(inside / grid.filled, max(0.0, 1.0 - inside * cell / filled) if filled > 0.0 else 0.0)


def _volume(scene: Scene, voxel: float) -> float:
    """The volume of a scene, parts that overlap counted once: in cells of a box around it, cubic scene units."""
    low, high = scene.bounds
    extent = np.maximum(high - low, voxel)
    block = _engine.shape("box", ((low + high) / 2.0).tolist(), extent.tolist())
    size = max(voxel, float((extent.prod() / MOST) ** (1.0 / 3.0)))
    grid = _engine.Target(block.vertices(), block.faces(), size)
    spec = _engine.SketchSpec(json.dumps({"match_volume": {"sigma": 1.0}}), grid)
    domain_low, domain_high = np.asarray(grid.domain)
    return _measured(spec, scene)["filled"] * float(np.prod(domain_high - domain_low)) / prod(grid.dims)


def _measured(spec: _engine.SketchSpec, scene: Scene) -> dict[str, float]:
    sketch = _engine.Sketch([spec])
    for part in scene:
        sketch.add(list(part.shapes))
    return sketch.measures()


def cells(score: Score, scene: Scene) -> Cells | None:
    """Which cells of its target a scene fills, as its first `match_volume` counts them; None without one."""
    for call in score.asks:
        if call.function == "match_volume" and call.grid is not None:
            low, high = np.asarray(call.grid.domain)
            made = call.grid.mask([shape for part in scene for shape in part.shapes])
            return Cells(low, high, call.grid.cells(), made)
    return None


@dataclass(frozen=True)
class Cells:
    """The cells of a target's grid, (x, y, z).

    Attributes
    ----------
    low, high : (3,) float64
        Corners of the grid, scene units.
    wanted, made : bool
        Which of them the target fills, and the scene.
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    wanted: NDArray[np.bool_]
    made: NDArray[np.bool_]
