"""Searches by `grow` into furniture of other people: by cells of all the box, and as thin targets are scored now.

    NIWAKI_FURNITURE=FOLDER .venv/bin/python benches/thin.py [SEEDS] [ROUNDS] [NAME ...]

The folder has meshes `NAME/NAME.obj`: those of Debian's `sweethome3d-furniture`, of which the part BlendSwap-CC-0 is
free of rights (unpack `usr/share/sweethome3d/furniture/BlendSwap-CC-0.sh3f`). Without the folder nothing runs.

One model of boards, posts and blocks is grown into each piece. The four forms are cells of the automatic size and of
half of it, both by `weight="cells"` and by `weight="balanced"`. Searches with smaller cells have half the rounds,
because a part costs up to twice as much there. The judge is none of the scores: the intersection over the union, in a
grid of a million cells.
"""

import os
import statistics
import sys
import warnings
from pathlib import Path

import niwaki as nw
import numpy as np
from niwaki import _engine, box, choose, discrete_uniform, emit, future, model, uniform
from niwaki.draw.scene import Scene
from niwaki.targets.sketches import automatic_voxel, volume_score
from niwaki.targets.thin import is_thin

#: Pieces by which the rule was chosen, and pieces that were met afterwards.
CHOSEN = ("table", "oakTable", "bed3", "chair2", "oakChair", "shelves", "verticalShelves")
MET = (
    "stool2",
    "bench",
    "technicalTable1",
    "upperShelves",
    "pallet",
    "sillaBlanca",
    "osakaChair",
    "televisionCabinet",
)
#: Share of the automatic size, weight, and share of the rounds.
FORMS = {
    "cells": (1.0, "cells", 1.0),
    "balanced": (1.0, "balanced", 1.0),
    "half, cells": (0.5, "cells", 0.5),
    "half, balanced": (0.5, "balanced", 0.5),
}


@model
def furniture(x: float, y: float, z: float) -> None:
    """Build up to twelve boards, posts and blocks inside of a box."""
    for _ in range(discrete_uniform(2, 12)):
        future(piece, x, y, z)


@model
def piece(x: float, y: float, z: float) -> None:
    """Build a lying board, a standing one across or along, a post, or a block."""
    kind = choose(["lying", "across", "along", "post", "block"])
    a, b = uniform(0.0, 1.0), uniform(0.0, 1.0)
    c, d = uniform(0.0, 1.0), uniform(0.0, 1.0)
    if kind == "lying":
        slab(x, y, z, (a, uniform(0.0, 1.0), c), (b, uniform(0.02, 0.15), d))
    elif kind == "across":
        slab(x, y, z, (a, uniform(0.0, 1.0), c), (uniform(0.02, 0.15), b, d))
    elif kind == "along":
        slab(x, y, z, (a, uniform(0.0, 1.0), c), (b, d, uniform(0.02, 0.15)))
    elif kind == "post":
        slab(x, y, z, (a, uniform(0.0, 1.0), c), (uniform(0.02, 0.15), b, uniform(0.02, 0.15)))
    else:
        slab(x, y, z, (a, uniform(0.0, 1.0), c), (b, uniform(0.1, 1.0), d))


@model
def slab(x, y, z, at, size):
    """Emit a box by shares of the box around it: the place of its low corner in what is left, and its size."""
    w, h, d = max(0.02, size[0]) * x, max(0.02, size[1]) * y, max(0.02, size[2]) * z
    center = (
        -0.5 * x + 0.5 * w + at[0] * (x - w),
        0.5 * h + at[1] * (y - h),
        -0.5 * z + 0.5 * d + at[2] * (z - d),
    )
    emit(box(center, (w, h, d), bevel=0.0))


def loaded(folder: Path, name: str) -> nw.Target:
    """A piece, ten units long, on the floor."""
    mesh = nw.Target.load(folder / name / f"{name}.obj")
    low, high = mesh.bounds
    middle = np.array([0.5 * (low[0] + high[0]), low[1], 0.5 * (low[2] + high[2])])
    return nw.Target((mesh.vertices - middle) * (10.0 / (high - low).max()), mesh.faces, name)


def judged(target: nw.Target) -> _engine.Target:
    """The grid of a million cells."""
    return _engine.Target(target.vertices, target.faces, float(np.prod(target.size) / 1e6) ** (1 / 3))


def index(grid: _engine.Target, scene: Scene) -> float:
    """The intersection of a scene and the target over their union."""
    want, filled = grid.cells(), grid.mask([shape for part in scene for shape in part.shapes])
    return float((want & filled).sum() / (want | filled).sum())


def grown(target: nw.Target, form: str, rounds: int, seed: int) -> nw.Result:
    """A search by one of the forms."""
    share, weight, of_rounds = FORMS[form]
    score = volume_score(target, share * automatic_voxel(target), weight=weight)
    x, y, z = map(float, target.size)
    return nw.grow(
        furniture, None, x, y, z, score=score, seed=seed, rounds=round(of_rounds * rounds), threads=1
    )


def main() -> int:
    """Print a line for each piece and form, and write a sheet of the best of both usual forms."""
    folder = os.environ.get("NIWAKI_FURNITURE")
    if folder is None:
        print("skipped: NIWAKI_FURNITURE names no folder of meshes")
        return 0
    warnings.simplefilter("ignore")
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    seeds, rounds = (*numbers, *(10, 600)[len(numbers) :])
    names = [word for word in sys.argv[1:] if not word.isdigit()] or [*CHOSEN, *MET]
    out = Path("out/thin")
    out.mkdir(parents=True, exist_ok=True)
    print("piece, thin by the rule, form: mean IoU, lowest, mean change against cells and its standard error")
    for name in names:
        target = loaded(Path(folder), name)
        grid, base = judged(target), []
        for form in FORMS:
            results = [grown(target, form, rounds, seed) for seed in range(seeds)]
            values = [index(grid, result.best.scene) for result in results]
            base = base or values
            change = [a - b for a, b in zip(values, base, strict=True)]
            error = statistics.stdev(change) / seeds**0.5 if seeds > 1 else 0.0
            print(
                f"{name:18s} {is_thin(target, automatic_voxel(target))!s:6s} {form:15s} {statistics.mean(values):.3f}"
                f" {min(values):.3f} {statistics.mean(change):+.3f} +- {error:.3f}",
                flush=True,
            )
            middle = sorted(range(seeds), key=values.__getitem__)[seeds // 2]
            results[middle].best.save(out / f"{name} {form}.png", size=(480, 360))
        target.picture(size=(480, 360)).save(out / f"{name}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
