"""A worker process: it loads one generator, and calls it point by point.

Requests come over the standard input, one line of JSON each; answers go to what was the standard output: a line of
JSON, then the bytes of the mesh. What the generator prints goes to the standard error. Nothing is unpickled.
"""

from __future__ import annotations

import json
import os
import queue
import threading
import warnings
from collections.abc import Mapping
from dataclasses import asdict
from typing import IO, Any

import numpy as np

from niwaki.errors import NiwakiError
from niwaki.errors.processes import end_group, lead
from niwaki.fitting.functions import FailedRun
from niwaki.fitting.generator import Generator
from niwaki.fitting.loading import generator_of_recipe
from niwaki.fitting.meshes import defects, mesh_of
from niwaki.fitting.protocol import write_answer
from niwaki.inputs.guard import reason_of
from niwaki.targets.pieces import joined

#: Whether this process is a worker, in which `fit` does nothing.
ACTIVE = False


def serve() -> None:
    """Serve the requests of the parent process, and end with it."""
    global ACTIVE
    ACTIVE = True
    lead()
    warnings.simplefilter("ignore")
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    # The generator neither reads requests nor writes between answers.
    number = os.open(os.devnull, os.O_RDONLY)
    os.dup2(number, 0)
    os.dup2(2, 1)
    waiting: queue.Queue[Mapping[str, Any]] = queue.Queue()
    recipe = json.loads(requests.readline())
    threading.Thread(target=_follow, args=(requests, waiting), daemon=True).start()
    try:
        generator = generator_of_recipe(recipe)
    except BaseException as error:
        write_answer(answers, {"unloadable": text_of(error)})
        os._exit(1)
    write_answer(answers, {"ready": True})
    while True:
        request = waiting.get()
        head, body = answer(generator, request["numbers"])
        write_answer(answers, {"key": request["key"], **head}, body)


def _follow(requests: IO[bytes], waiting: queue.Queue[Mapping[str, Any]]) -> None:
    """Hand requests over; end this process, and all that it has started, with the parent process."""
    for line in requests:
        waiting.put(json.loads(line))
    end_group(os.getpid())
    os._exit(0)


def answer(generator: Generator, numbers: Mapping[str, float]) -> tuple[dict[str, Any], bytes]:
    """Call a generator; return what came of it: the sizes of a mesh with its bytes, or the text of a failure."""
    try:
        called = generator.call(numbers)
        meshes = None if called.parts is None else [mesh_of(part) for part in called.parts.values()]
        vertices, faces = mesh_of(called.mesh) if meshes is None else joined(meshes)
    except (KeyboardInterrupt, MemoryError) as error:
        return {"failed": type(error).__name__}, b""
    except FailedRun as run:
        assert run.__cause__ is not None
        return {"failed": text_of(run.__cause__), "drawn": [asdict(row) for row in run.drawn]}, b""
    except BaseException as error:
        # Also SystemExit, and a panic of a library in Rust.
        return {"failed": text_of(error)}, b""
    head = {
        "vertices": len(vertices),
        "faces": len(faces),
        "defects": defects(vertices, faces) if meshes is None else [],
        "drawn": [asdict(row) for row in called.drawn],
    }
    if called.parts is not None and meshes is not None:
        head["parts"] = [[name, *map(len, mesh)] for name, mesh in zip(called.parts, meshes, strict=True)]
        head["facts"] = called.facts
    body = np.ascontiguousarray(vertices, "<f8").tobytes() + np.ascontiguousarray(faces, "<i8").tobytes()
    return head, body


def text_of(error: BaseException) -> str:
    """Return an error in one line: its type, its message, and the last line of the model's file."""
    if isinstance(error, NiwakiError):
        return str(error).splitlines()[0]
    trace, where = error.__traceback__, ""
    while trace is not None:
        place = trace.tb_frame.f_code.co_filename
        if not place.startswith(os.path.dirname(os.path.dirname(__file__))) and "site-packages" not in place:
            where = f" ({os.path.basename(place)}:{trace.tb_lineno})"
        trace = trace.tb_next
    return f"{type(error).__name__}: {reason_of(error)}{where}"
