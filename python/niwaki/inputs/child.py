"""A reader in a process of its own, with limits of memory and time, for libraries that keep none.

The child gets the file's bytes and the name of one of our functions, and sends plain arrays back; nothing is
unpickled. A limit of memory needs the module `resource`: Windows has none, and macOS keeps no such limit. The limit of
time needs only a clock. Where Python cannot be started again, as in a program frozen into one file, the reader runs in
this process.
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
#: Arrays have only these types: numbers and truth values.
_KINDS = "buif"


def read_apart(
    reader: Reader,
    data: bytes,
    place: str | PathLike[str] | None,
    what: str,
    memory: int | None = None,
    **settings: Any,
) -> dict[str, NDArray[Any]]:
    """Call `reader(data, **settings)` in a process of its own.

    Parameters
    ----------
    reader
        A function of a module of this package; it returns arrays of numbers by name.
    data
        The file's bytes.
    place, what
        The file and what it should be, for messages.
    memory
        Bytes that the process may use; the limit `memory` when left out.
    settings
        Of JSON.

    Raises
    ------
    FileError
        What the reader raises; `file-limit` where it needs too much time or memory; `file-unreadable` where the
        process ends in any other way.
    """
    if getattr(sys, "frozen", False) or not sys.executable:
        with library(place, what):
            return dict(reader(data, **settings))
    memory = limit("memory") if memory is None else memory
    seconds = limit("seconds")
    asked = {
        "module": reader.__module__,
        "name": reader.__name__,
        "settings": settings,
        "seconds": seconds,
        "memory": memory,
    }
    # A person's folder, which is the first one while a file of it is run, has nothing that the child needs.
    paths = os.pathsep.join(sorted(filter(None, sys.path), key=folders().__contains__))
    environment = {**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    # -P: the folder that we are in holds no modules of the child.
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
        reason = f"no process could be started to read it: {error.strerror or error}"
        raise FileError("file-unreadable", place, suffix=what, reason=reason) from error
    with child:
        try:
            answer, _ = child.communicate(json.dumps(asked).encode() + b"\n" + data, timeout=seconds + 5)
        except subprocess.TimeoutExpired:
            child.kill()
            raise beyond("seconds", f"reading it takes more than {seconds} seconds", place) from None
        except BaseException:
            child.kill()
            raise
    return _received(answer, child.returncode, seconds, place, what)


def _received(
    answer: bytes, code: int, seconds: int, place: str | PathLike[str] | None, what: str
) -> dict[str, NDArray[Any]]:
    head, _, body = answer.partition(b"\n")
    if code != 0 or not head:
        if -code == getattr(signal, "SIGXCPU", None):
            raise beyond("seconds", f"reading it takes more than {seconds} seconds", place)
        if -code == getattr(signal, "SIGKILL", None):
            raise beyond("memory", "the system ended the process that read it", place)
        reason = f"the process that read it ended with code {code}"
        raise FileError("file-unreadable", place, suffix=what, reason=reason)
    told = json.loads(head)
    if "fault" in told:
        raise RuntimeError(f"a reader of ours failed in a process of its own:\n{told['fault']}")
    if told.get("code") in FILE_MESSAGES:
        raise FileError(told["code"], place, **told["values"])
    if "code" in told:
        raise InputError(told["code"], **told["values"])
    found, start = {}, 0
    for name, kind, shape in told["arrays"]:
        dtype = np.dtype(kind)
        size = dtype.itemsize * int(np.prod(shape, dtype=np.int64))
        found[name] = np.frombuffer(body[start : start + size], dtype=dtype).reshape(shape).copy()
        start += size
    return found


def serve() -> None:
    """What the child does: read a request and a file, answer with arrays or with an error's code and values."""
    # What a library prints is not a part of the answer.
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    asked = json.loads(sys.stdin.buffer.readline())
    # It cannot write into files.
    bound(cpu=int(asked["seconds"]), fsize=0, core=0, **{"as": int(asked["memory"])})
    data = sys.stdin.buffer.read()
    try:
        found = getattr(import_module(asked["module"]), asked["name"])(data, **asked["settings"])
        _answer(out, found)
    except (FileError, InputError) as error:
        _refuse(out, error)
    except MemoryError:
        _refuse(out, beyond("memory", "reading it takes more", None))
    except Exception:
        out.write(json.dumps({"fault": format_exc()}).encode() + b"\n")
    out.flush()
    # Without the time that libraries take to leave.
    os._exit(0)


def _refuse(out: IO[bytes], error: FileError | InputError) -> None:
    values = {name: str(value) for name, value in error.values.items()}
    out.write(json.dumps({"code": error.code, "values": values}).encode() + b"\n")


def _answer(out: IO[bytes], found: Arrays) -> None:
    arrays = {name: np.ascontiguousarray(value) for name, value in found.items()}
    if wrong := [name for name, value in arrays.items() if value.dtype.kind not in _KINDS]:
        raise TypeError(f"`{wrong[0]}` is no array of numbers")
    heads = [(name, value.dtype.str, value.shape) for name, value in arrays.items()]
    out.write(json.dumps({"arrays": heads}).encode() + b"\n")
    for value in arrays.values():
        out.write(value.tobytes())


def bound(**limits: int) -> None:
    """Limit what this process may take, by the names of limits of the system: `cpu=60` for RLIMIT_CPU."""
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
                # Some systems refuse some limits; the clock of the parent remains.
                continue
