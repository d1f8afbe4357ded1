"""A mesh or a drawing that a user sent, read in a process of its own with little memory and time.

`python -m niwaki.studio.worker.uploads FILE.SUFFIX OUT` reads a mesh as `niwaki.Target` does and writes it again as
binary STL (float32), which is all that other processes read. A drawing to colour (SVG, an image) is read as
`niwaki.color` does, and kept as it came: whatever reads it later keeps the limits of `niwaki.inputs`. One line of JSON
on standard output says what it is, or why it cannot be used.
"""

from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path
from typing import Any

import trimesh

import niwaki as nw
from niwaki.color import Drawing
from niwaki.errors import NiwakiError
from niwaki.errors.files import write_whole
from niwaki.inputs import bytes_of
from niwaki.inputs.child import bound
from niwaki.studio.worker.thinning import GHOST_TRIANGLES, Ghost, stl

MESHES = (".obj", ".stl", ".ply", ".glb", ".gltf")
#: Bytes of memory and seconds of processor time that reading a mesh may take.
MEMORY, SECONDS = 3 << 30, 60
#: More triangles than this are refused: the search would take minutes to fill their cells.
TRIANGLES = 3_000_000


def main(source: str, sink: str) -> None:
    """Read, check, and write again."""
    bound(cpu=SECONDS, core=0, **{"as": MEMORY})
    try:
        if Path(source).suffix.lower() not in MESHES:
            print(json.dumps(_drawing(source, sink)))
            return
        with warnings.catch_warnings(record=True) as noted:
            warnings.simplefilter("always")
            target = nw.Target.load(source)
        if len(target.faces) > TRIANGLES:
            print(
                json.dumps({"error": f"{len(target.faces):,} triangles; at most {TRIANGLES:,} can be used"})
            )
            return
        mesh = trimesh.Trimesh(target.vertices, target.faces, process=False)
        write_whole(Path(sink), stl(mesh))
        if len(target.faces) > GHOST_TRIANGLES:
            Ghost.of(target).save(Path(sink))
        found = {
            "triangles": len(target.faces),
            "size": [float(side) for side in target.size],
            "notes": [str(one.message).partition(": ")[2] for one in noted],
        }
        print(json.dumps(found))
    except NiwakiError as error:
        # The place is ours; the user knows the file by another name.
        lines = [line for line in str(error).splitlines() if not line.lstrip().startswith("-->")]
        print(json.dumps({"error": "\n".join(lines), "code": error.code}))
    except MemoryError:
        print(json.dumps({"error": "the mesh is too large to be read here", "code": "mesh-too-large"}))


def _drawing(source: str, sink: str) -> dict[str, Any]:
    """A drawing to colour: kept as it came, once it can be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = Drawing.load(source)
    write_whole(Path(sink), bytes_of(source, "image"))
    hidden = [f"no pixel shows {', '.join(found.hidden)}"] if found.hidden else []
    return {"regions": len(found.names), "notes": hidden}


if __name__ == "__main__":
    main(*sys.argv[1:3])
