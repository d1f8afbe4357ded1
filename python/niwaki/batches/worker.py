"""The work of a worker on a chunk of searches, in any process on any machine.

A chunk names its engine and the bits of its machine. A worker with another engine or other bits refuses the chunk,
because its results could differ. Errors of Niwaki are not raised across processes: they come back as data.
"""

from __future__ import annotations

import json
import os
import socket
import sys
import time
import traceback
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from niwaki import _engine
from niwaki.batches.body import body_of, fault_of
from niwaki.errors import FileError, NiwakiError
from niwaki.inputs.modules import run_files
from niwaki.search import Search
from niwaki.search.request import engine_hash

#: Errors of the machine, which tell nothing about the search.
OF_MACHINE = ("memory-full", "no-room", "untrusted-function")

#: Number of compiled cases in the cache of a worker.
READY = 32


@dataclass(frozen=True)
class Chunk:
    """Searches for one worker, which runs them one after the other.

    Attributes
    ----------
    engine, bits
        Engine and bits of the batch; see `Spec`.
    searches
        The cases as JSON, by number.
    jobs
        The number of a case, and a seed, for each search.
    trust, folders, files
        Modules whose host functions may be called, the folders of these modules, and the files of modules by name.
    suspected
        How often a pool broke while the chunk was under way.
    """

    engine: str
    bits: str
    searches: Mapping[int, str]
    jobs: Sequence[tuple[int, int]]
    trust: tuple[str, ...] = ()
    folders: tuple[str, ...] = ()
    suspected: int = 0
    files: tuple[tuple[str, Path], ...] = ()


@dataclass
class ChunkResult:
    """The answer of a worker to a chunk.

    Attributes
    ----------
    bodies
        Bytes of results, in the order of the chunk; after trouble fewer than the chunk has jobs.
    notes
        A note for the log for each result.
    seconds, cpu_seconds
        Wall-clock and processor seconds of the searches alone.
    trouble, trace
        An error of the machine or of Niwaki that stopped the worker at the next job, in one line and with the
        traceback. It tells nothing about the search.
    refused
        The reason why the worker refused the chunk.
    """

    bodies: list[bytes] = field(default_factory=list)
    notes: list[dict[str, Any]] = field(default_factory=list)
    seconds: float = 0.0
    cpu_seconds: float = 0.0
    trouble: str = ""
    trace: str = ""
    refused: str = ""


def work(chunk: Chunk) -> ChunkResult:
    """Run the searches of a chunk."""
    done = ChunkResult(refused=_mismatch(chunk))
    if done.refused:
        return done
    for folder in chunk.folders:
        if folder not in sys.path:
            sys.path.append(folder)
    for case, seed in chunk.jobs:
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            run_files(chunk.files)
            body, note = _search(chunk.searches[case], chunk.trust, seed)
        except (Exception, KeyboardInterrupt) as error:
            done.trouble = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
            done.trace = traceback.format_exc(limit=-5)
            break
        spent = time.perf_counter() - wall, time.process_time() - cpu
        done.bodies.append(body)
        done.notes.append({**note, "seconds": round(spent[0], 6), "cpu_seconds": round(spent[1], 6)})
        done.seconds += spent[0]
        done.cpu_seconds += spent[1]
    for note in done.notes:
        note |= {"host": _host(), "process": os.getpid()}
    return done


def _search(text: str, trust: tuple[str, ...], seed: int) -> tuple[bytes, dict[str, Any]]:
    """Run one search; return the bytes of its result and its note for the log."""
    note: dict[str, Any] = {}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            body = body_of(_ready(text, trust).with_seed(seed).run(threads=1).to_its_end())
        except FileError:
            raise
        except NiwakiError as error:
            if error.code in OF_MACHINE:
                raise
            body, note = fault_of(error), {"error": str(error)}
    if caught:
        note["warnings"] = [str(warning.message) for warning in caught]
    return body, note


@lru_cache(READY)
def _ready(text: str, trust: tuple[str, ...]) -> Search:
    """Return a compiled case."""
    return Search.of_json(text, trust)


@lru_cache
def _host() -> str:
    return socket.gethostname()


def _mismatch(chunk: Chunk) -> str:
    """Describe the difference between this worker and the chunk's engine and bits; empty if there is none."""
    if engine_hash() != chunk.engine:
        return f"`{_host()}` has another engine of Niwaki"
    if _engine.fingerprint() != chunk.bits:
        return f"`{_host()}` computes other bits with the same engine: its processor or C library differs"
    return ""


def line(key: bytes, note: Mapping[str, Any], attempt: int) -> str:
    """Return a line of the log."""
    return json.dumps({"key": key.hex(), "attempt": attempt, **note})
