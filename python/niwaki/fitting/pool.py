"""Calls of a generator in worker processes, each of which has loaded it once; or in this process.

A worker that dies or takes too long is replaced. A point that ends its worker is tried once more; a point that takes
too long is not. Loading the generator does not count as a part of a call.
"""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from niwaki.errors import InputError
from niwaki.errors.processes import end_group
from niwaki.fitting.draws import Drawn
from niwaki.fitting.generator import Generator, Numbers
from niwaki.fitting.meshes import defects
from niwaki.fitting.protocol import read_answer
from niwaki.fitting.worker import answer

#: Calls that must be known before the limit of time follows from them; the limit in medians of their seconds.
KNOWN, MEDIANS = 10, 10.0

#: The least limit that follows, as a share of the first limit: a short call must not fail because the machine is busy.
LEAST = 0.1

#: How often a point may end its worker.
DEATHS = 2

#: How often workers may end before one of them is ready.
STARTS = 2

_START = "from niwaki.fitting.worker import serve; serve()"


@dataclass(frozen=True)
class Reply:
    """The outcome of a call.

    Attributes
    ----------
    vertices, faces : arrays
        The mesh; None if the call failed.
    failed : str
        The text of a failure; empty for a mesh.
    kind : str
        "" for a mesh; "raised", "died" or "time-out" for a failure.
    defects : tuple of str
        See `niwaki.fitting.meshes.defects`.
    drawn : tuple of Drawn
        The draws of a function that is defined by run.
    seconds : float
        Wall time of the call.
    parts : tuple
        Name, vertices and faces of each part, for a generator with parts.
    facts : tuple
        What the generator says about the result.
    """

    vertices: NDArray[np.float64] | None = None
    faces: NDArray[np.int64] | None = None
    failed: str = ""
    kind: str = ""
    defects: tuple[str, ...] = ()
    drawn: tuple[Drawn, ...] = ()
    seconds: float = 0.0
    parts: tuple[tuple[str, NDArray[np.float64], NDArray[np.int64]], ...] = ()
    facts: tuple[Any, ...] = ()

    @classmethod
    def of_answer(cls, head: Mapping[str, Any], body: bytes, seconds: float) -> Reply:
        """Read the answer of a worker."""
        drawn = tuple(Drawn(**{**row, "labels": tuple(row["labels"])}) for row in head.get("drawn", ()))
        if "failed" in head:
            return cls(failed=head["failed"], kind="raised", drawn=drawn, seconds=seconds)
        cut = 24 * head["vertices"]
        vertices = np.frombuffer(body[:cut], "<f8").reshape(-1, 3)
        faces = np.frombuffer(body[cut:], "<i8").reshape(-1, 3)
        parts, at, corner = [], 0, 0
        for name, points, triangles in head.get("parts", ()):
            corners = faces[corner : corner + triangles] - at
            parts.append((name, vertices[at : at + points], corners))
            at, corner = at + points, corner + triangles
        return cls(
            vertices,
            faces,
            defects=tuple(head["defects"] if "defects" in head else defects(vertices, faces)),
            drawn=drawn,
            seconds=seconds,
            parts=tuple(parts),
            facts=tuple(head.get("facts", ())),
        )


class Limit:
    """The limit of time of a call: fixed until ten calls are known, then ten times their median.

    Parameters
    ----------
    first
        Seconds until ten are known. Afterwards the limit is at least a tenth of it.
    """

    def __init__(self, first: float) -> None:
        self.first = first
        self._seconds: list[float] = []

    def note(self, reply: Reply) -> None:
        """Note the seconds of a call that returned."""
        if reply.kind in ("", "raised"):
            self._seconds.append(reply.seconds)

    @property
    def median(self) -> float | None:
        """The median of the seconds that are known."""
        return float(np.median(self._seconds)) if self._seconds else None

    @property
    def seconds(self) -> float:
        """The limit of the next call."""
        if len(self._seconds) < KNOWN:
            return self.first
        return max(MEDIANS * float(np.median(self._seconds)), LEAST * self.first)


class Caller(Protocol):
    """Calls of a generator."""

    def call(self, points: Sequence[Numbers]) -> Iterator[tuple[int, Reply]]:
        """Call it for each point; yield the number of a point with its reply, in the order in which they come."""

    def close(self) -> None:
        """End what was started."""


class Here:
    """Calls in this process: no limit of time, and a crash ends the program."""

    def __init__(self, generator: Generator, limit: Limit) -> None:
        self._generator, self._limit = generator, limit

    def call(self, points: Sequence[Numbers]) -> Iterator[tuple[int, Reply]]:
        """Call it for each point in order."""
        for number, numbers in enumerate(points):
            started = time.monotonic()
            head, body = answer(self._generator, numbers)
            if head.get("failed") == "KeyboardInterrupt":
                raise KeyboardInterrupt
            reply = Reply.of_answer(head, body, time.monotonic() - started)
            self._limit.note(reply)
            yield number, reply

    def close(self) -> None:
        """Nothing was started."""


@dataclass(eq=False)
class _Worker:
    process: subprocess.Popen[bytes]
    number: int
    ready: bool = False
    task: int | None = None
    deadline: float = float("inf")
    started: float = 0.0


class Workers:
    """Worker processes.

    Parameters
    ----------
    recipe
        The data from which a worker makes the generator.
    count
        The number of processes; they start when there is work for them.
    limit
        The limit of time of a call.
    program
        The words that start a process of another program; see `Generator.worker_command`.
    """

    def __init__(
        self, recipe: Mapping[str, Any], count: int, limit: Limit, program: Sequence[str] | None = None
    ) -> None:
        self._recipe, self._count, self._limit, self._program = recipe, count, limit, program
        self._workers: list[_Worker] = []
        self._news: queue.Queue[tuple[_Worker, Any]] = queue.Queue()
        self._deaths = self._started = 0
        self._has_been_ready = False

    def call(self, points: Sequence[Numbers]) -> Iterator[tuple[int, Reply]]:
        """Call the generator for each point; yield replies as they come."""
        waiting = list(range(len(points)))[::-1]
        deaths = [0] * len(points)
        left = len(points)
        while left:
            for worker in self._idle(len(waiting)):
                if waiting:
                    self._give(worker, waiting.pop(), points)
            worker, message = self._next()
            task = worker.task
            if message == "late":
                self._end(worker)
                assert task is not None
                text = f"it took more than {self._limit.seconds:.3g} s"
                seconds = time.monotonic() - worker.started
                yield task, Reply(failed=text, kind="time-out", seconds=seconds)
                left -= 1
            elif message is None:
                code = self._end(worker)
                if not worker.ready:
                    self._deaths += 1
                    if self._deaths >= STARTS:
                        raise InputError("fit-worker-ended", reason=_ended(code))
                elif task is not None:
                    deaths[task] += 1
                    if deaths[task] < DEATHS:
                        waiting.append(task)
                    else:
                        yield task, Reply(failed=_ended(code), kind="died")
                        left -= 1
            elif "unloadable" in message[0]:
                raise InputError("fit-worker-ended", reason=message[0]["unloadable"])
            elif "ready" in message[0]:
                worker.ready, self._deaths = True, 0
            elif task is not None:
                worker.task, worker.deadline = None, float("inf")
                head, body = message
                reply = Reply.of_answer(head, body, time.monotonic() - worker.started)
                self._limit.note(reply)
                yield task, reply
                left -= 1

    def close(self) -> None:
        """End all processes, with what they have started."""
        for worker in list(self._workers):
            self._end(worker)

    def _idle(self, needed: int) -> list[_Worker]:
        """Return the workers that wait for a point; start more where points wait and processes lack."""
        busy = sum(worker.task is not None for worker in self._workers)
        while len(self._workers) < min(self._count, busy + needed):
            self._workers.append(self._start())
        return [worker for worker in self._workers if worker.ready and worker.task is None]

    def _start(self) -> _Worker:
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        if self._program is None:
            environment["PYTHONPATH"] = os.pathsep.join(filter(None, sys.path))
        else:
            # Its Python may be another one.
            environment.pop("PYTHONPATH", None)
        # The worker's own session does not get the terminal's Ctrl-C.
        process = subprocess.Popen(
            self._program or [sys.executable, "-c", _START],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=None if self._program is None else subprocess.DEVNULL,
            env=environment,
            start_new_session=sys.platform != "win32",
        )
        worker = _Worker(process, self._started)
        self._started += 1
        assert process.stdin is not None
        with suppress(OSError):
            process.stdin.write(json.dumps(self._recipe).encode() + b"\n")
            process.stdin.flush()
        threading.Thread(target=self._listen, args=(worker,), daemon=True).start()
        return worker

    def _listen(self, worker: _Worker) -> None:
        """Put the answers of a worker into the queue; None when it ends."""
        assert worker.process.stdout is not None
        message: Any = True
        while message is not None:
            try:
                message = read_answer(worker.process.stdout)
            except (OSError, ValueError):
                message = None
            self._news.put((worker, message))

    def _give(self, worker: _Worker, task: int, points: Sequence[Numbers]) -> None:
        worker.task, worker.started = task, time.monotonic()
        worker.deadline = worker.started + self._limit.seconds
        assert worker.process.stdin is not None
        with suppress(OSError):
            line = json.dumps({"key": task, "numbers": dict(points[task])})
            worker.process.stdin.write(line.encode() + b"\n")
            worker.process.stdin.flush()

    def _next(self) -> tuple[_Worker, Any]:
        """Wait for the next message of a worker that is still there; "late" when its time is over."""
        while True:
            deadline = min((worker.deadline for worker in self._workers), default=float("inf"))
            left = deadline - time.monotonic()
            try:
                worker, message = self._news.get(timeout=max(0.0, min(left, 1.0)))
            except queue.Empty:
                if time.monotonic() >= deadline:
                    return next(w for w in self._workers if w.deadline == deadline), "late"
                continue
            if worker in self._workers:
                return worker, message

    def _end(self, worker: _Worker) -> int:
        """End a worker, and return its exit code."""
        self._workers.remove(worker)
        end_group(worker.process.pid)
        with suppress(OSError):
            worker.process.kill()
        code = worker.process.wait()
        for stream in (worker.process.stdin, worker.process.stdout):
            with suppress(OSError, AttributeError):
                stream.close()  # type: ignore[union-attr]
        return code


def _ended(code: int) -> str:
    """Describe the end of a process."""
    if code >= 0:
        return f"its process ended with code {code}"
    try:
        name = signal.Signals(-code).name
    except ValueError:
        name = f"signal {-code}"
    return f"its process was ended by {name}"
