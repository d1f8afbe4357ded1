"""A worker process as the server sees it: it does one job at a time, reports progress, and can be stopped or killed.

A worker that hangs does not block the studio: a file of models that loads for too long ends its process, and so does a
job that exceeds its limit. The next job starts a fresh process.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from itertools import count
from pathlib import Path

import msgspec

from niwaki.errors import InputError
from niwaki.errors.processes import end_group
from niwaki.studio.frames import LENGTH, LONGEST, frame, unpack
from niwaki.studio.messages import Answer, AnyJob, AnyReport, Loading, Problem
from niwaki.studio.problems import problem

#: Receives a report before a job has ended, with the bytes of a mesh or of a picture.
Report = Callable[[AnyReport, bytes], None]
#: Seconds in which a job has to end after a request to stop; then its process is killed.
GRACE = 2.0
#: Seconds that a file of models may take to load.
LOADING = 20.0

#: Time, size and number of a file: they differ after a change.
Stamp = tuple[int, int, int]

_decode = msgspec.json.Decoder(AnyReport).decode


class Worker:
    """A process that does jobs; it starts with the first job, and again after it has ended.

    Parameters
    ----------
    words
        The words of its command line: see `niwaki.studio.worker.permissions`.
    environment
        The environment of the process; the environment of this process when left out.
    patience
        Seconds that a job may take; None for no limit.
    slow
        Files that took too long to load, each with its state at that time: an unchanged file fails at once.
    """

    def __init__(
        self,
        *words: str,
        environment: Mapping[str, str] | None = None,
        patience: float | None = None,
        slow: dict[str, Stamp] | None = None,
    ) -> None:
        self._words, self._environment, self.patience = words, environment, patience
        self._slow = {} if slow is None else slow
        self._process: asyncio.subprocess.Process | None = None
        self._lock = asyncio.Lock()
        self._ids = count(1)
        self._job: int | None = None
        self._killed = self._again = False
        self._loading = Loading()
        self._stamp: Stamp | None = None

    @property
    def pid(self) -> int | None:
        """The number of the process; None while no process runs."""
        return None if self._process is None else self._process.pid

    async def do(self, job: AnyJob, report: Report | None = None) -> Answer:
        """Do a job, after all earlier jobs. A failure gives an answer with a problem."""
        async with self._lock:
            self._job = job.id = next(self._ids)
            self._killed = self._again = False
            try:
                while True:
                    self._loading = Loading()
                    try:
                        return await self._attempt(job, report)
                    except (EOFError, OSError):
                        if not self._again:
                            raise
                        # The file that was loading has changed: a fresh process loads the new state.
                        self._again = False
                        await self.kill()
            except TimeoutError:
                await self.kill()
                return Answer(problem=self._timeout())
            except (EOFError, OSError, ValueError):
                # The process has ended, or its message is not a report.
                await self.kill()
                return Answer(interrupted=True) if self._killed else Answer(problem=self._exit())
            except BaseException:
                # Its further reports must not reach another job.
                await self.kill()
                raise
            finally:
                self._job = None

    async def _attempt(self, job: AnyJob, report: Report | None) -> Answer:
        process = self._process
        if process is None or process.returncode is not None:
            command = (sys.executable, "-m", "niwaki.studio.worker", *self._words)
            pipe = asyncio.subprocess.PIPE
            process = await asyncio.create_subprocess_exec(
                *command, stdin=pipe, stdout=pipe, start_new_session=True, env=self._environment
            )
            self._process = process
        assert process.stdin is not None and process.stdout is not None
        async with asyncio.timeout(self.patience) as limit:
            end = limit.when()
            _put(process.stdin, msgspec.json.encode(job))
            await process.stdin.drain()
            while True:
                (length,) = LENGTH.unpack(await process.stdout.readexactly(LENGTH.size))
                if length > LONGEST:
                    raise OSError("a worker's message is too long")
                header, payload = unpack(await process.stdout.readexactly(length))
                message: AnyReport = _decode(header)
                if isinstance(message, Answer):
                    return message
                if isinstance(message, Loading):
                    self._note_loading(message, limit, end)
                elif report is not None:
                    report(message, bytes(payload))

    def _note_loading(self, loading: Loading, limit: asyncio.Timeout, end: float | None) -> None:
        """Note that a file of models begins to load, is still loading, or has been loaded."""
        is_new, self._loading = loading.path != self._loading.path, loading
        if not loading.path:
            limit.reschedule(end)
        elif is_new:
            self._stamp = _stamp(loading.path)
            if self._stamp is not None and self._slow.get(loading.path) == self._stamp:
                raise TimeoutError
            late = asyncio.get_running_loop().time() + LOADING
            limit.reschedule(late if end is None else min(late, end))

    def _timeout(self) -> Problem:
        """Report a job or a file that took too long."""
        if not self._loading.path:
            text = f"this took more than {self.patience:.0f} s and was ended; a fresh process takes its place"
            return Problem("too-slow", text)
        if self._stamp is not None:
            self._slow[self._loading.path] = self._stamp
        line = f"at line {self._loading.line}, " if self._loading.line else ""
        reason = f"it was ended {line}after {LOADING:.0f} s: a file of models has to load within that time"
        return self._failed(reason)

    def _exit(self) -> Problem:
        """Report a process that has ended by itself."""
        if self._loading.path:
            return self._failed("the process that ran it has ended")
        text = "the process of this command has ended, perhaps for lack of memory; a fresh process takes its place"
        return Problem("worker-ended", text)

    def _failed(self, reason: str) -> Problem:
        return problem(InputError("model-file-failed", path=self._loading.path, reason=reason))

    async def drop(self, paths: Iterable[Path]) -> None:
        """Restart the present job in a fresh process if it is loading one of these changed files."""
        if self._job is not None and self._loading.path and Path(self._loading.path) in paths:
            self._again = True
            await self.kill()

    async def stop(self, grace: float = GRACE) -> None:
        """Ask the present job to end with its results so far; kill its process if it does not."""
        job, process = self._job, self._process
        if job is None or process is None or process.stdin is None:
            return
        with contextlib.suppress(OSError):
            _put(process.stdin, msgspec.json.encode({"stop": job}))
        for _ in range(round(grace / 0.02)):
            await asyncio.sleep(0.02)
            if self._job != job:
                return
        self._killed = True
        await self.kill()

    async def kill(self) -> None:
        """End the process at once."""
        process, self._process = self._process, None
        if process is not None:
            if process.returncode is None:
                # The process leads a group: processes that a file of models has started end with it.
                end_group(process.pid)
            await process.wait()
            if process.stdout is not None:
                # The loop closes a pipe whose end has been read; a job that reads it at present reads its end.
                with contextlib.suppress(RuntimeError, TimeoutError):
                    async with asyncio.timeout(GRACE):
                        await process.stdout.read()


def _put(pipe: asyncio.StreamWriter, header: bytes) -> None:
    data = frame(header)
    pipe.write(LENGTH.pack(len(data)) + data)


def _stamp(path: str) -> Stamp | None:
    """Read the present state of a file; None without such a file."""
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
