"""Furniture by other people, fitted by one generator of chairs and one of shelves: IoU of each, and a sheet to look at.

    apt-get download sweethome3d-furniture
    FURNITURE=sweethome3d-furniture_1.8-1_all.deb make bench-fit-furniture

Reads the part of the Debian package that is in the public domain (CC0, BlendSwap-CC-0.sh3f; FURNITURE may name that
file). Each piece has the size that its catalogue says, stands on the floor, and is seen as a volume. No parameters
reach it: a generator has no curves, and many meshes are open. Leaves furniture.md and furniture.png in out/fit (OUT).
"""

import io
import os
import re
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

import niwaki as nw
import numpy as np
from fit import furniture, ours
from fit.parameters import Parameter, Values, canonical
from fit.solids import Part
from niwaki import draw
from niwaki.draw.scene import Scene
from niwaki.fitting.goals import scene_of
from niwaki.targets.pieces import joined

ARCHIVE = "BlendSwap-CC-0.sh3f"
EVALUATIONS = 300

#: Models of the catalogue: chairs and stools, and shelves.
CHAIRS = (
    "oakChair",
    "plasticChair",
    "sillaBlanca",
    "chair",
    "chairWithCushion",
    "chair2",
    "osakaChair",
    "stool",
)
SHELVES = ("bookcase", "shelves", "verticalShelves", "cupboard")

#: Ranges beside those of the bench's own generators, metres.
RANGES = {
    "seat_w": (0.25, 0.8),
    "seat_d": (0.25, 0.8),
    "seat_h": (0.3, 0.9),
    "width": (0.3, 2.0),
    "height": (0.5, 2.2),
}


def opened(place: Path) -> zipfile.ZipFile:
    """Open the archive of models, inside of the Debian package or by itself."""
    if place.suffix != ".deb":
        return zipfile.ZipFile(place)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["dpkg-deb", "-x", str(place), folder], check=True)
        (file,) = Path(folder).rglob(ARCHIVE)
        return zipfile.ZipFile(io.BytesIO(file.read_bytes()))


def pieces(models: zipfile.ZipFile) -> Iterator[tuple[str, str, nw.Target]]:
    """Yield the generator, the name and the mesh of each piece, as large as the catalogue says, on the floor."""
    rows: dict[str, dict[str, str]] = {}
    for line in models.read("PluginFurnitureCatalog.properties").decode("latin1").splitlines():
        if parts := re.match(r"(\w+)#(\d+)=(.*)", line):
            rows.setdefault(parts[2], {})[parts[1]] = parts[3]
    by_name = {Path(row["model"]).stem: row for row in rows.values()}
    with tempfile.TemporaryDirectory() as folder:
        for generator, names in (("chair", CHAIRS), ("shelf", SHELVES)):
            for name in names:
                row = by_name[name]
                mesh = nw.Target.of(models.extract(row["model"].lstrip("/"), folder))
                low, high = mesh.bounds
                size = np.array([float(row[side]) / 100 for side in ("width", "height", "depth")])
                middle = [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2]
                vertices = (mesh.vertices - middle) * (size / (high - low))
                yield generator, name, nw.Target(vertices, mesh.faces, name=name)


def ranged(parameters: list[Parameter]) -> list[Parameter]:
    return [
        replace(row, domain=RANGES[row.name]) if row.kind == "real" and row.name in RANGES else row
        for row in parameters
    ]


def turned(parts: list[Part], depth: float) -> list[Part]:
    """The bench's shelf is open at z = 0; here its front looks along z, and it stands in the middle."""
    return [(vertices * [-1, 1, -1] + [0, 0, depth / 2], faces) for vertices, faces in parts]


def fitted(generator: str, target: nw.Target) -> tuple[nw.fitting.Answer, Scene]:
    """Fit a piece; return the best answer and its scene."""
    parameters = ranged(furniture.CHAIR if generator == "chair" else furniture.SHELF)

    def scene(point: Values) -> Scene:
        raw = {row.name: point.get(row.name, row.unused) for row in parameters}
        _, values = canonical(parameters, raw)
        if generator == "chair":
            return scene_of(joined(furniture.chair(values)))
        return scene_of(joined(turned(furniture.shelf(values), values["depth"])))

    loop = nw.FitLoop(ours.ranges(parameters), nw.match_volume(target), seed=1)
    while loop.evaluated < EVALUATIONS:
        for point in loop.ask(8):
            loop.tell(point, scene(point.parameters))
    return loop.best, scene(loop.best.parameters)


def main() -> int:
    place = os.environ.get("FURNITURE", "")
    if not Path(place).is_file():
        raise SystemExit(f"no file {place!r}: name the Debian package or {ARCHIVE} by FURNITURE=")
    folder = Path(os.environ.get("OUT") or "out/fit")
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["| piece | generator | covered | outside | IoU |", "| --- | --- | --- | --- | --- |"]
    scenes, captions = [], []
    for generator, name, target in pieces(opened(Path(place))):
        best, scene = fitted(generator, target)
        lines.append(f"| {name} | {generator} | {best.covered:.2f} | {best.outside:.2f} | {best.iou:.2f} |")
        print(lines[-1], flush=True)
        scenes += [scene_of((target.vertices, target.faces)), scene]
        captions += [name, f"{generator}, IoU {best.iou:.2f}"]
    (folder / "furniture.md").write_text("\n".join(lines) + "\n")
    draw.sheet.sheet(scenes, captions, None, size=(220, 200), columns=6, samples=2).save(
        folder / "furniture.png"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
