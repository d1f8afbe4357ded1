"""What a worker does with a chunk of searches, in whatever process and on whatever machine it runs.

A chunk names the engine and the bits for which it was made. A worker with others refuses it, because its results could
be others. Nothing of ours is raised across processes: errors come back as data.
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

#: Errors that say something about the machine, and nothing about the search.
OF_MACHINE = ("memory-full", "no-room", "untrusted-function")

#: So many cases are kept ready in a worker.
READY = 32


@dataclass(frozen=True)
class Chunk:
    """Searches that one worker does, one after the other.

    Attributes
    ----------
    engine, bits
        Of the batch; see `Spec`.
    searches
        The cases as JSON, by number.
    items
        Number of a case, and a seed, for each search.
    trust, folders, files
        Modules whose host functions may be called, where they are looked for, and those that are files, by name.
    suspected
        How often a pool broke while it was under way.
    """

    engine: str
    bits: str
    searches: Mapping[int, str]
    items: Sequence[tuple[int, int]]
    trust: tuple[str, ...] = ()
    folders: tuple[str, ...] = ()
    suspected: int = 0
    files: tuple[tuple[str, Path], ...] = ()


@dataclass
class Done:
    """What a worker gives back.

    Attributes
    ----------
    bodies
        Bytes of results, in the order of the chunk; fewer than it has items where there was trouble.
    notes
        For the log, one for each of these.
    seconds, cpu_seconds
        Of the searches alone.
    trouble, trace
        What stopped it at the next item, which says nothing about that search: an error of the machine, or of ours; in
        one line, and with the lines of Python that led there.
    refused
        Why it did nothing.
    """

    bodies: list[bytes] = field(default_factory=list)
    notes: list[dict[str, Any]] = field(default_factory=list)
    seconds: float = 0.0
    cpu_seconds: float = 0.0
    trouble: str = ""
    trace: str = ""
    refused: str = ""


def work(chunk: Chunk) -> Done:
    """Do the searches of a chunk."""
    done = Done(refused=_unequal(chunk))
    if done.refused:
        return done
    for folder in chunk.folders:
        if folder not in sys.path:
            sys.path.append(folder)
    for case, seed in chunk.items:
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            run_files(chunk.files)
            body, said = _searched(chunk.searches[case], chunk.trust, seed)
        except (Exception, KeyboardInterrupt) as error:
            done.trouble = f"{type(error).__name__}: {str(error).partition(chr(10))[0]}"
            done.trace = traceback.format_exc(limit=-5)
            break
        spent = time.perf_counter() - wall, time.process_time() - cpu
        done.bodies.append(body)
        done.notes.append({**said, "seconds": round(spent[0], 6), "cpu_seconds": round(spent[1], 6)})
        done.seconds += spent[0]
        done.cpu_seconds += spent[1]
    for note in done.notes:
        note |= {"host": _host(), "process": os.getpid()}
    return done


def _searched(text: str, trust: tuple[str, ...], seed: int) -> tuple[bytes, dict[str, Any]]:
    """One search: the bytes of its result, and what only its log should have."""
    said: dict[str, Any] = {}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            body = body_of(_ready(text, trust).with_seed(seed).run(threads=1).to_its_end())
        except FileError:
            raise
        except NiwakiError as error:
            if error.code in OF_MACHINE:
                raise
            body, said = fault_of(error), {"error": str(error)}
    if caught:
        said["warnings"] = [str(one.message) for one in caught]
    return body, said


@lru_cache(READY)
def _ready(text: str, trust: tuple[str, ...]) -> Search:
    """A case, compiled."""
    return Search.of_json(text, trust)


@lru_cache
def _host() -> str:
    return socket.gethostname()


def _unequal(chunk: Chunk) -> str:
    """What makes this worker unfit for a chunk; empty where nothing does."""
    if engine_hash() != chunk.engine:
        return f"`{_host()}` has another engine of Niwaki"
    if _engine.fingerprint() != chunk.bits:
        return f"`{_host()}` computes other bits with the same engine: its processor or its C library differ"
    return ""


def line(key: bytes, note: Mapping[str, Any], attempt: int) -> str:
    """A line of the log."""
    return json.dumps({"key": key.hex(), "attempt": attempt, **note})
