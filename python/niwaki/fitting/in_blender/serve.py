"""A worker process inside of Blender: `blender --background --python serve.py`, or a Python that has `bpy`.

It speaks as `niwaki.fitting.worker` does: requests are lines of JSON on the standard input; an answer on the standard
output is a line of JSON, then the bytes of a mesh. The first request names the file, the object and the modifier. With
`describe` the answer has the sockets, and the mesh at some values of them; the process then ends.
"""

import importlib.util
import json
import os
import queue
import sys
import threading
from pathlib import Path

import bpy
import numpy as np


def _module(name):
    """Load a file beside this one, also where the package is missing."""
    spec = importlib.util.spec_from_file_location(f"niwaki_{name}", Path(__file__).with_name(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


sockets, stage = _module("sockets"), _module("stage")


class Model:
    """A modifier of an object in a file."""

    def __init__(self, recipe):
        # Scripts and drivers of the file do not run.
        bpy.ops.wm.open_mainfile(filepath=recipe["path"], load_ui=False, use_scripts=False)
        self.object, self.modifier = sockets.find(bpy.data.objects, recipe["object"], recipe["modifier"])
        self.modifier.show_viewport = True
        frame = bpy.context.scene.frame_current
        self.scene = stage.stage(bpy.data, self.object, "niwaki")
        self.scene.frame_set(frame)
        self.rows = sockets.sockets(self.modifier)
        self.up = recipe["up"]

    def mesh(self, values):
        """Return the mesh for values of sockets by their keys."""
        sockets.write_all(self.modifier, self.rows, values)
        vertices, faces = stage.mesh(self.scene, self.object)
        # The rotation of Blender's exporters of glTF and OBJ.
        return (vertices[:, [0, 2, 1]] * (1.0, 1.0, -1.0) if self.up == "y" else vertices), faces

    def about(self):
        """Describe the modifier."""
        return {
            "object": self.object.name,
            "modifier": self.modifier.name,
            "sockets": [vars(row) for row in self.rows],
            "libraries": [bpy.path.abspath(library.filepath) for library in bpy.data.libraries],
            "blender": bpy.app.version_string,
        }


def serve():
    """Serve the requests of the parent process, and end with it."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    # Blender neither reads requests nor writes between answers.
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    recipe = json.loads(requests.readline())
    try:
        model = Model(recipe)
        if "describe" in recipe:
            _write(answers, *_mesh(model, _values(recipe, recipe["describe"]), model.about()))
            _end(0)
    except sockets.NodeTreeError as error:
        _write(answers, {"unloadable": str(error), "reason": error.reason, "cure": error.cure})
        _end(1)
    except BaseException as error:
        _write(answers, {"unloadable": " ".join(str(error).split()), "type": type(error).__name__})
        _end(1)
    _write(answers, {"ready": True})
    waiting = queue.Queue()
    threading.Thread(target=_follow, args=(requests, waiting), daemon=True).start()
    while True:
        request = waiting.get()
        _write(answers, *_mesh(model, _values(recipe, request["numbers"]), {"key": request["key"]}))


def _values(recipe, numbers):
    """Return values by the keys of sockets: of a choice by its place, of a number the number itself."""
    out = dict(recipe["kept"])
    for name, number in numbers.items():
        row = recipe["parameters"][name]
        out[row["key"]] = row["values"][int(number)] if row["values"] else number
    return out


def _mesh(model, values, head):
    """Return the head and the bytes of an answer: a mesh, or the text of a failure."""
    try:
        vertices, faces = model.mesh(values)
    except stage.NoMeshError as error:
        return {**head, "failed": str(error)}, b""
    except Exception as error:
        return {**head, "failed": f"{type(error).__name__}: {' '.join(str(error).split())}"}, b""
    body = np.ascontiguousarray(vertices, "<f8").tobytes() + np.ascontiguousarray(faces, "<i8").tobytes()
    return {**head, "vertices": len(vertices), "faces": len(faces)}, body


def _write(answers, head, body=b""):
    answers.write(json.dumps({**head, "bytes": len(body)}).encode() + b"\n" + body)
    try:
        answers.flush()
    except BrokenPipeError:
        pass


def _follow(requests, waiting):
    """Hand requests over; end this process with the parent process."""
    for line in requests:
        waiting.put(json.loads(line))
    _end(0)


def _end(code):
    # Blender's own end takes seconds, and asks nothing that matters here.
    os._exit(code)


serve()
