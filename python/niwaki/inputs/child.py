"""Readers in a separate process with limits of memory and time, for libraries that have no limits.

The child process gets the file's bytes and the name of a function of the package, and sends plain arrays back; nothing
is unpickled. The limit of memory needs the module `resource`, which Windows does not have, and macOS does not enforce
the limit. The limit of time needs only a clock. If Python cannot be started again, as in a program that is frozen into
one file, the reader runs in this process.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from os import PathLike
from traceback import format_exc
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import FileError, InputError
from niwaki.errors.files import FILE_MESSAGES
from niwaki.inputs.guard import library
from niwaki.inputs.limits import beyond, limit
from niwaki.inputs.modules import folders

resource: Any
try:
    import resource
except ImportError:
    resource = None

Arrays = Mapping[str, NDArray[Any]]
Reader = Callable[..., Arrays]

_START = "from niwaki.inputs.child import serve; serve()"
#: The types of arrays: numbers and truth values.
_KINDS = "buif"


def read_apart(
    reader: Reader,
    data: bytes,
    place: str | PathLike[str] | None,
    kind: str,
    memory: int | None = None,
    **settings: Any,
) -> dict[str, NDArray[Any]]:
    """Call `reader(data, **settings)` in a separate process.

    Parameters
    ----------
    reader
        A function of a module of this package; it returns arrays of numbers by name.
    data
        The file's bytes.
    place, kind
        The file and its expected kind, for messages.
    memory
        Bytes that the process may use; by default the limit `memory`.
    settings
        Settings of the reader, values of JSON.

    Raises
    ------
    FileError
        The reader's error; `file-limit`: reading needs too much time or memory; `file-unreadable`: the process ended
        for another reason.
    """
    if getattr(sys, "frozen", False) or not sys.executable:
        with library(place, kind):
            return dict(reader(data, **settings))
    memory = limit("memory") if memory is None else memory
    seconds = limit("seconds")
    request = {
        "module": reader.__module__,
        "name": reader.__name__,
        "settings": settings,
        "seconds": seconds,
        "memory": memory,
    }
    # Folders of the user's model files have nothing that the child needs, and come last.
    paths = os.pathsep.join(sorted(filter(None, sys.path), key=folders().__contains__))
    environment = {**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    # -P: the child imports nothing from the current folder.
    command = [sys.executable, "-P", "-W", "ignore", "-c", _START]
    try:
        child = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment,
        )
    except OSError as error:
        reason = f"the process that reads it cannot start: {error.strerror or error}"
        raise FileError("file-unreadable", place, suffix=kind, reason=reason) from error
    with child:
        try:
            answer, _ = child.communicate(json.dumps(request).encode() + b"\n" + data, timeout=seconds + 5)
        except subprocess.TimeoutExpired:
            child.kill()
            raise beyond("seconds", f"reading it takes more than {seconds} seconds", place) from None
        except BaseException:
            child.kill()
            raise
    return _received(answer, child.returncode, seconds, place, kind)


def _received(
    answer: bytes, code: int, seconds: int, place: str | PathLike[str] | None, kind: str
) -> dict[str, NDArray[Any]]:
    head, _, body = answer.partition(b"\n")
    if code != 0 or not head:
        if -code == getattr(signal, "SIGXCPU", None):
            raise beyond("seconds", f"reading it takes more than {seconds} seconds", place)
        if -code == getattr(signal, "SIGKILL", None):
            raise beyond("memory", "the system ended the process that read it", place)
        reason = f"the process that read it ended with code {code}"
        raise FileError("file-unreadable", place, suffix=kind, reason=reason)
    reply = json.loads(head)
    if "fault" in reply:
        raise RuntimeError(f"a reader of Niwaki failed in its process:\n{reply['fault']}")
    if reply.get("code") in FILE_MESSAGES:
        raise FileError(reply["code"], place, **reply["values"])
    if "code" in reply:
        raise InputError(reply["code"], **reply["values"])
    arrays, start = {}, 0
    for name, kind, shape in reply["arrays"]:
        dtype = np.dtype(kind)
        size = dtype.itemsize * int(np.prod(shape, dtype=np.int64))
        arrays[name] = np.frombuffer(body[start : start + size], dtype=dtype).reshape(shape).copy()
        start += size
    return arrays


def serve() -> None:
    """Read a request and a file in the child process, and answer with arrays, or with an error's code and values."""
    # The output of libraries is not a part of the answer.
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    request = json.loads(sys.stdin.buffer.readline())
    # `fsize=0`: the process cannot write files.
    bound(cpu=int(request["seconds"]), fsize=0, core=0, **{"as": int(request["memory"])})
    data = sys.stdin.buffer.read()
    try:
        arrays = getattr(import_module(request["module"]), request["name"])(data, **request["settings"])
        _answer(out, arrays)
    except (FileError, InputError) as error:
        _refuse(out, error)
    except MemoryError:
        _refuse(out, beyond("memory", "reading it takes more", None))
    except Exception:
        out.write(json.dumps({"fault": format_exc()}).encode() + b"\n")
    out.flush()
    # Skip the clean-up of libraries, which takes time.
    os._exit(0)


def _refuse(out: IO[bytes], error: FileError | InputError) -> None:
    values = {name: str(value) for name, value in error.values.items()}
    out.write(json.dumps({"code": error.code, "values": values}).encode() + b"\n")


def _answer(out: IO[bytes], values: Arrays) -> None:
    arrays = {name: np.ascontiguousarray(value) for name, value in values.items()}
    if wrong := [name for name, value in arrays.items() if value.dtype.kind not in _KINDS]:
        raise TypeError(f"`{wrong[0]}` is not an array of numbers")
    heads = [(name, value.dtype.str, value.shape) for name, value in arrays.items()]
    out.write(json.dumps({"arrays": heads}).encode() + b"\n")
    for value in arrays.values():
        out.write(value.tobytes())


def bound(**limits: int) -> None:
    """Limit this process by the names of the system's limits: `cpu=60` sets RLIMIT_CPU."""
    if resource is None:
        return
    for name, most in limits.items():
        kind = getattr(resource, f"RLIMIT_{name.upper()}", None)
        if kind is not None:
            _, hard = resource.getrlimit(kind)
            most = most if hard == resource.RLIM_INFINITY else min(most, hard)
            try:
                resource.setrlimit(kind, (most, hard))
            except (OSError, ValueError):
                # Some systems refuse some limits; the parent process still limits the time.
                continue
