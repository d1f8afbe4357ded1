"""Files of each word that makes a solid, checked by the programs that read them: `make check-files`.

Each solid is written as .glb, .obj, .ply, .stl and .3mf. Trimesh finds each closed and oriented, and its volume is that
of the others. Admesh, which repairs files before slicing, has nothing to repair in an .stl; it is in Debian's package
`admesh`. The validator of Khronos finds no fault in a .glb; it is npm's package `gltf-validator`, and
`NIWAKI_GLTF_VALIDATOR` is the folder in which it was installed. Programs that are missing are named. `volumes.json` has
the volumes, for a check in Blender (`make test-blender`).
"""

from __future__ import annotations

import itertools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import niwaki as nw
import numpy as np
import trimesh
from niwaki.draw.scene import Scene
from niwaki.errors.files import write_whole

SUFFIXES = (".glb", ".obj", ".ply", ".stl", ".3mf")

#: A line from the foot of a vase over its rim into it: radii and heights.
OUTSIDE = [(0.0, 0.0), (0.4, 0.0), (0.7, 0.5), (0.6, 1.1), (0.35, 1.4), (0.35, 1.5), (0.5, 1.8)]
INSIDE = [(0.42, 1.8), (0.27, 1.5), (0.27, 1.4), (0.52, 1.1), (0.62, 0.6), (0.0, 0.2)]
#: A flat bar.
BAR = [(-0.2, -0.07), (0.2, -0.07), (0.2, 0.07), (-0.2, 0.07)]

#: Runs the validator of Khronos on the files that the arguments name, and prints one line of JSON for each.
VALIDATE = """
const validator = require(process.argv[1] + '/node_modules/gltf-validator'), fs = require('fs');
(async () => { for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
  console.log(JSON.stringify(report.issues));
} })();
"""


def star() -> list[tuple[float, float]]:
    """The outline of a star of five points."""
    radii = [0.9, 0.4] * 5
    return [(r * math.sin(k * math.pi / 5), r * math.cos(k * math.pi / 5)) for k, r in enumerate(radii)]


def words() -> dict[str, nw.Shape]:
    """One of each word that makes a solid; a word with two looks is there twice."""
    origin = (0.0, 0.0, 0.0)
    low, middle, high = ((0.0, y, 0.0) for y in (-1.0, 0.2, 1.0))
    forward, up = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
    turned = nw.rotation((1.0, 0.0, 0.0), -math.pi / 2)
    coil = [
        (0.8 * math.cos(t), 0.25 * t - 0.8, 0.8 * math.sin(t)) for t in np.linspace(0.0, 7.0, 36).tolist()
    ]
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1.4]])
    return {
        "box": nw.box(origin, (1.6, 1.2, 1.0)),
        "tapered box": nw.box(origin, (1.6, 1.2, 1.6), taper=0.4, taper_axis="y"),
        "wedge": nw.wedge(origin, (2.0, 1.0, 1.4)),
        "cylinder": nw.cylinder(origin, 0.7, 1.4),
        "tapered cylinder": nw.cylinder(origin, 0.8, 1.4, top_radius=0.4),
        "cone": nw.cone(origin, 0.8, 1.5),
        "sphere": nw.sphere(origin, 0.8),
        "ellipsoid": nw.ellipsoid(origin, (2.0, 1.0, 1.2)),
        "torus": nw.torus(origin, 0.8, 0.25),
        "arch": nw.arch(origin, (1.8, 1.7, 0.6), 0.35),
        "extrude": nw.extrude(star(), 0.7, (0.0, -0.3, 0.0)),
        "twisted extrude": nw.extrude(star(), 1.8, (0.0, -0.9, 0.0), twist=0.9, taper=0.5),
        "revolve": nw.revolve(OUTSIDE + INSIDE, (0.0, -0.9, 0.0)),
        "sweep": nw.sweep(BAR, coil, scale=0.3),
        "hull": nw.hull(
            [*itertools.product((-0.7, 0.7), (-0.7,), (-0.5, 0.5)), (-0.2, 0.7, 0.0), (0.7, 0.3, 0.5)]
        ),
        "limb": nw.limb(low, high, 0.5, 0.3, end_normal=(0.5, 1.0, 0.0)),
        "segment": nw.segment(
            *((at, forward, up, radius) for at, radius in ((low, 0.5), (middle, 0.4), (high, 0.3)))
        ),
        "mesh": nw.mesh(
            square, [[0, 3, 2], [0, 2, 1], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]], rotation=turned
        ),
    }


def cuts() -> dict[str, nw.Shape]:
    """A wall with arched windows; a sphere and a box, cut in three ways."""
    stone, blue = (0.82, 0.78, 0.7), (0.3, 0.42, 0.6)
    wall = nw.box((0.0, 1.0, 0.0), (4.0, 2.0, 0.4), color=stone)
    for x in (-1.2, 0.0, 1.2):
        opening = nw.box((x, 0.8, 0.0), (0.6, 0.8, 1.0)), nw.cylinder((x, 1.2, 0.0), 0.3, 1.0, axis="z")
        wall = wall - (opening[0] | opening[1])
    ball = nw.sphere((0.0, 0.0, 0.0), 1.0, color=stone)
    block = nw.box((0.5, 0.4, 0.6), (1.2, 1.2, 1.2), color=blue)
    return {"wall": wall, "difference": ball - block, "intersection": ball & block, "union": ball | block}


def write(folder: Path) -> dict[str, list[Path]]:
    """Write a file of each solid in each format; the names of the files are those of the solids."""
    folder.mkdir(parents=True, exist_ok=True)
    files: dict[str, list[Path]] = {}
    for name, shape in {**words(), **cuts()}.items():
        scene = Scene([(name, [shape])])
        files[name] = [scene.export(folder / (name.replace(" ", "-") + suffix)) for suffix in SUFFIXES]
    return files


def read_package(file: Path) -> trimesh.Trimesh:
    """Read the mesh of a .3mf; trimesh needs two more libraries for these."""
    with zipfile.ZipFile(file) as package:
        model = ElementTree.fromstring(package.read("3D/3dmodel.model"))
    rows = {
        tag: [[float(row.attrib[name]) for name in names] for row in model.iterfind(f".//{{*}}{tag}")]
        for tag, names in (("vertex", "xyz"), ("triangle", ("v1", "v2", "v3")))
    }
    return trimesh.Trimesh(rows["vertex"], np.array(rows["triangle"], int))


def faults_of(files: list[Path]) -> tuple[float, list[str]]:
    """The volume of a solid in cubic metres, and what is wrong with its files."""
    faults, volumes = [], {}
    for file in files:
        mesh = read_package(file) if file.suffix == ".3mf" else trimesh.load_mesh(file)
        printed = file.suffix in (".stl", ".3mf")
        mesh.merge_vertices(merge_tex=True, merge_norm=True)
        volumes[file.suffix] = mesh.volume / (1e9 if printed else 1.0)
        if not (mesh.is_watertight and mesh.is_winding_consistent):
            faults.append(f"{file.name}: not closed or not oriented")
    # A print file joins shapes that touch: it is a little larger. The other files have the same triangles.
    volume = volumes[".glb"]
    for suffix, other in volumes.items():
        if not (volume > 0 and abs(other / volume - 1) < 2e-3):
            faults.append(f"{suffix}: volume {other:.6f}, of .glb {volume:.6f}")
    return volume, faults


def admesh_faults(file: Path) -> list[str]:
    """The repairs that admesh would make in an .stl."""
    report = subprocess.run(["admesh", str(file)], capture_output=True, text=True, check=True).stdout
    names = ("Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges")
    counts = {word: re.search(rf"{word}\s*:\s*(\d+)", report) for word in names}
    assert all(counts.values()), report
    faults = [
        f"{file.name}: {word} {count[1]}" for word, count in counts.items() if count and count[1] != "0"
    ]
    bodies = re.search(r"Number of parts\s*:\s*(\d+)", report)
    assert bodies, report
    return faults if bodies[1] == "1" else [*faults, f"{file.name}: {bodies[1]} bodies"]


def validator_faults(files: list[Path], folder: str) -> list[str]:
    """The errors and warnings of the validator of Khronos for .glb files."""
    report = subprocess.run(
        ["node", "-e", VALIDATE, folder, *map(str, files)], capture_output=True, text=True, check=True
    ).stdout
    issues = [json.loads(line) for line in report.splitlines()]
    assert len(issues) == len(files)
    return [
        f"{file.name}: {message['code']} {message['pointer']}"
        for file, issue in zip(files, issues, strict=True)
        for message in issue["messages"]
        if message["severity"] <= 1
    ]


def main(folder: Path) -> int:
    """Write and check all files; the exit status is 1 where there is a fault."""
    files = write(folder)
    admesh, validator = shutil.which("admesh"), os.environ.get("NIWAKI_GLTF_VALIDATOR")
    volumes, faults = {}, []
    for name, paths in files.items():
        volumes[name.replace(" ", "-")], wrong = faults_of(paths)
        faults += wrong
        if admesh:
            faults += admesh_faults(next(path for path in paths if path.suffix == ".stl"))
    if validator:
        glbs = [path for paths in files.values() for path in paths if path.suffix == ".glb"]
        faults += validator_faults(glbs, validator)
    write_whole(folder / "volumes.json", json.dumps(volumes, indent=1).encode())
    readers = [
        "trimesh",
        *(["admesh"] if admesh else []),
        *(["the validator of Khronos"] if validator else []),
    ]
    print(
        f"{len(files)} solids in {len(SUFFIXES)} formats, read by {', '.join(readers)}: {len(faults)} faults"
    )
    for missing, present in (("admesh", admesh), ("NIWAKI_GLTF_VALIDATOR", validator)):
        if not present:
            print(f"not checked: {missing} is not there")
    for fault in faults:
        print(f"  {fault}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/solids")))
