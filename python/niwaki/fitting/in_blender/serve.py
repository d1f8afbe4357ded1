"""A worker process inside of Blender: `blender --background --python serve.py`, or a Python that has `bpy`.

It speaks as `niwaki.fitting.worker` does: requests are lines of JSON on the standard input; an answer on the standard
output is a line of JSON, then the bytes of a mesh. The first request names the file, the object and the modifier. With
`describe` the answer has the sockets, and the mesh at some values of them; the process then ends.
"""

from __future__ import annotations

import importlib
import importlib.util
import json
import os
import queue
import sys
import threading
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

import numpy as np


class Model:
    """A modifier of an object in a file.

    Parameters
    ----------
    bpy
        Blender's module.
    recipe
        The file, the names of the object and of the modifier, and which axis is up.
    """

    def __init__(self, bpy: Any, recipe: Mapping[str, Any]) -> None:
        self._bpy, self._up = bpy, recipe["up"]
        self._sockets, self._stage = module("sockets"), module("stage")
        # Scripts and drivers of the file do not run.
        bpy.ops.wm.open_mainfile(filepath=recipe["path"], load_ui=False, use_scripts=False)
        self.object, self.modifier = self._sockets.find(
            bpy.data.objects, recipe["object"], recipe["modifier"]
        )
        self.modifier.show_viewport = True
        frame = bpy.context.scene.frame_current
        self._scene = self._stage.stage(bpy.data, self.object, "niwaki")
        self._scene.frame_set(frame)
        self.rows = self._sockets.sockets(self.modifier)

    def mesh(self, values: Mapping[str, Any]) -> tuple[Any, Any]:
        """Return the mesh for values of sockets by their keys."""
        self._sockets.write_all(self.modifier, self.rows, values)
        vertices, faces = self._stage.mesh(self._scene, self.object)
        # The rotation of Blender's exporters of glTF and OBJ.
        return (vertices[:, [0, 2, 1]] * (1.0, 1.0, -1.0) if self._up == "y" else vertices), faces

    def answer(self, values: Mapping[str, Any]) -> tuple[dict[str, Any], bytes]:
        """Return the head and the bytes of an answer: a mesh, or the text of a failure."""
        try:
            vertices, faces = self.mesh(values)
        except self._stage.NoMeshError as error:
            return {"failed": str(error)}, b""
        except Exception as error:
            return {"failed": f"{type(error).__name__}: {line_of(error)}"}, b""
        body = np.ascontiguousarray(vertices, "<f8").tobytes() + np.ascontiguousarray(faces, "<i8").tobytes()
        return {"vertices": len(vertices), "faces": len(faces)}, body

    def about(self) -> dict[str, Any]:
        """Describe the modifier."""
        files = [self._bpy.path.abspath(library.filepath) for library in self._bpy.data.libraries]
        return {
            "object": self.object.name,
            "modifier": self.modifier.name,
            "sockets": [vars(row) for row in self.rows],
            "libraries": files,
            "blender": self._bpy.app.version_string,
            "blocked": self._bpy.app.autoexec_fail_message if self._bpy.app.autoexec_fail else "",
        }


def serve() -> None:
    """Serve the requests of the parent process, and end with it."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    # Blender neither reads requests nor writes between answers.
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    recipe = json.loads(requests.readline())
    try:
        model = Model(importlib.import_module("bpy"), recipe)
        if "describe" in recipe:
            head, body = model.answer(values_of(recipe, recipe["describe"]))
            write(answers, {**model.about(), **head}, body)
            os._exit(0)
    except BaseException as error:
        # What the person can change has a reason and a cure.
        row = {name: getattr(error, name) for name in ("reason", "cure") if hasattr(error, name)}
        write(answers, {"unloadable": line_of(error), **row})
        os._exit(1)
    write(answers, {"ready": True})
    waiting: queue.Queue[Mapping[str, Any]] = queue.Queue()
    threading.Thread(target=follow, args=(requests, waiting), daemon=True).start()
    while True:
        request = waiting.get()
        head, body = model.answer(values_of(recipe, request["numbers"]))
        write(answers, {"key": request["key"], **head}, body)


def values_of(recipe: Mapping[str, Any], numbers: Mapping[str, float]) -> dict[str, Any]:
    """Return values by the keys of sockets: of a choice by its place, of a number the number itself."""
    out = dict(recipe["kept"])
    for name, number in numbers.items():
        row = recipe["parameters"][name]
        out[row["key"]] = row["values"][int(number)] if row["values"] else number
    return out


def write(answers: IO[bytes], head: Mapping[str, Any], body: bytes = b"") -> None:
    """Write an answer as `niwaki.fitting.protocol` does."""
    answers.write(json.dumps({**head, "bytes": len(body)}).encode() + b"\n" + body)
    with suppress(BrokenPipeError):
        answers.flush()


def follow(requests: IO[bytes], waiting: queue.Queue[Mapping[str, Any]]) -> None:
    """Hand requests over; end this process with the parent process."""
    for line in requests:
        waiting.put(json.loads(line))
    # Blender's own end takes long, and does nothing that matters here.
    os._exit(0)


def line_of(error: BaseException) -> str:
    """Return the text of an error in one line."""
    return " ".join(str(error).split()) or type(error).__name__


def module(name: str) -> Any:
    """Load a file beside this one, also where the package is missing."""
    full = f"niwaki_{name}"
    if full not in sys.modules:
        spec = importlib.util.spec_from_file_location(full, Path(__file__).with_name(f"{name}.py"))
        assert spec is not None and spec.loader is not None
        loaded = importlib.util.module_from_spec(spec)
        sys.modules[full] = loaded
        spec.loader.exec_module(loaded)
    return sys.modules[full]


if __name__ == "__main__":
    serve()
