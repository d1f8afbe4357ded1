"""An uploaded mesh or drawing, read in a separate process with limits of memory and time.

`python -m niwaki.studio.worker.uploads FILE.SUFFIX OUT` reads a mesh as `niwaki.Target` does and writes it as binary
STL (float32), the only format that other processes read. A drawing to colour (SVG, an image) is read as `niwaki.color`
does and stored unchanged: later readers keep the limits of `niwaki.inputs`. A line of JSON on standard output describes
the upload, or tells why it cannot be used.
"""

from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path
from typing import Any

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
#: The most triangles of a mesh: with more, the search would take minutes to fill their cells.
TRIANGLES = 3_000_000


def main(source: str, sink: str) -> None:
    """Read an upload, check it, and write it."""
    bound(cpu=SECONDS, core=0, **{"as": MEMORY})
    try:
        if Path(source).suffix.lower() not in MESHES:
            print(json.dumps(_store_drawing(source, sink)))
            return
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            target = nw.Target.load(source)
        if len(target.faces) > TRIANGLES:
            print(
                json.dumps(
                    {
                        "error": f"the mesh has {len(target.faces):,} triangles; at most {TRIANGLES:,} can be used"
                    }
                )
            )
            return
        write_whole(Path(sink), stl(target.vertices, target.faces))
        if len(target.faces) > GHOST_TRIANGLES:
            Ghost.of(target).save(Path(sink))
        report = {
            "triangles": len(target.faces),
            "size": [float(side) for side in target.size],
            "notes": [str(warning.message).partition(": ")[2] for warning in warned],
        }
        print(json.dumps(report))
    except NiwakiError as error:
        # The user knows the file by another name than this place.
        lines = [line for line in str(error).splitlines() if not line.lstrip().startswith("-->")]
        print(json.dumps({"error": "\n".join(lines), "code": error.code}))
    except MemoryError:
        print(
            json.dumps(
                {"error": "the mesh is too large for the memory of the reader", "code": "mesh-too-large"}
            )
        )


def _store_drawing(source: str, sink: str) -> dict[str, Any]:
    """Store a drawing to colour unchanged, if it can be read."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        drawing = Drawing.load(source)
    write_whole(Path(sink), bytes_of(source, "image"))
    hidden = [f"no pixel shows {', '.join(drawing.hidden)}"] if drawing.hidden else []
    return {"regions": len(drawing.names), "notes": hidden}


if __name__ == "__main__":
    main(*sys.argv[1:3])
