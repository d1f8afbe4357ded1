"""A mesh that a user sent, read in a process of its own with little memory and time.

`python -m niwaki.studio.worker.uploads FILE.SUFFIX OUT.stl` reads the file as `niwaki.Target` does and writes it again
as binary STL (float32), which is all that other processes read. One line of JSON on standard output says what it is,
or why it cannot be used.
"""

from __future__ import annotations

import json
import resource
import sys
import warnings
from pathlib import Path

import trimesh

import niwaki as nw
from niwaki.errors import NiwakiError
from niwaki.studio.worker.thinning import GHOST_TRIANGLES, Ghost

#: Bytes of memory and seconds of processor time that reading a mesh may take.
MEMORY, SECONDS = 3 << 30, 60
#: More triangles than this are refused: the search would take minutes to fill their cells.
TRIANGLES = 3_000_000


def main(source: str, sink: str) -> None:
    """Read, check, and write again."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        with warnings.catch_warnings(record=True) as noted:
            warnings.simplefilter("always")
            target = nw.Target.load(source)
        if len(target.faces) > TRIANGLES:
            print(
                json.dumps({"error": f"{len(target.faces):,} triangles; at most {TRIANGLES:,} can be used"})
            )
            return
        mesh = trimesh.Trimesh(target.vertices, target.faces, process=False)
        mesh.export(sink, file_type="stl")
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


if __name__ == "__main__":
    main(*sys.argv[1:3])
