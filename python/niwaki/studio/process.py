"""A worker process as the server sees it: one job at a time, reports while it runs, stopped or killed.

A worker that says nothing more does not make the studio wait for ever: a file of models that loads for too long ends
its process, and so does a job that has a limit. The next job finds a fresh process.
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
from niwaki.studio.frames import LENGTH, LONGEST, frame, opened
from niwaki.studio.messages import Answer, AnyJob, AnyReport, Loading, Problem
from niwaki.studio.refused import problem

#: What is reported before a job has ended, with the bytes of a mesh or of a picture.
Report = Callable[[AnyReport, bytes], None]
#: Seconds in which a job has to end after it was asked to; then its process is killed.
GRACE = 2.0
#: Seconds that a file of models may run while it is loaded.
LOADING = 20.0

#: What tells one state of a file from another.
Stamp = tuple[int, int, int]

_decode = msgspec.json.Decoder(AnyReport).decode


class Worker:
    """A process that does jobs, started when there is one, and again after it has ended.

    Parameters
    ----------
    words
        Of its command line: see `niwaki.studio.worker.allowed`.
    environment
        Of the process; that of this one when left out.
    patience
        Seconds that a job may take; None for any.
    slow
        Files that took too long to load, in the state in which they did: they are not waited for again.
    """

    def __init__(
        self,
        *words: str,
        environment: Mapping[str, str] | None = None,
        patience: float | None = None,
        slow: dict[str, Stamp] | None = None,
    ) -> None:
        self._words, self._environment, self._patience = words, environment, patience
        self._slow = {} if slow is None else slow
        self._process: asyncio.subprocess.Process | None = None
        self._one = asyncio.Lock()
        self._ids = count(1)
        self._job: int | None = None
        self._killed = self._again = False
        self._loading = Loading()
        self._stamp: Stamp | None = None

    @property
    def pid(self) -> int | None:
        """Of the process, while there is one."""
        return None if self._process is None else self._process.pid

    async def do(self, job: AnyJob, report: Report | None = None) -> Answer:
        """Do a job: after those that were given before it. A failure is an answer with a problem."""
        async with self._one:
            self._job = job.id = next(self._ids)
            self._killed = self._again = False
            try:
                while True:
                    self._loading = Loading()
                    try:
                        return await self._done(job, report)
                    except (EOFError, OSError):
                        if not self._again:
                            raise
                        # The file that it loaded has changed: a fresh process loads the new one.
                        self._again = False
                        await self.kill()
            except TimeoutError:
                await self.kill()
                return Answer(problem=self._late())
            except (EOFError, OSError, ValueError):
                # It has ended, or says what is no report.
                await self.kill()
                return Answer(interrupted=True) if self._killed else Answer(problem=self._ended())
            except BaseException:
                # What it still says belongs to no other job.
                await self.kill()
                raise
            finally:
                self._job = None

    async def _done(self, job: AnyJob, report: Report | None) -> Answer:
        process = self._process
        if process is None or process.returncode is not None:
            command = (sys.executable, "-m", "niwaki.studio.worker", *self._words)
            pipe = asyncio.subprocess.PIPE
            process = await asyncio.create_subprocess_exec(
                *command, stdin=pipe, stdout=pipe, start_new_session=True, env=self._environment
            )
            self._process = process
        assert process.stdin is not None and process.stdout is not None
        async with asyncio.timeout(self._patience) as limit:
            end = limit.when()
            _put(process.stdin, msgspec.json.encode(job))
            await process.stdin.drain()
            while True:
                (length,) = LENGTH.unpack(await process.stdout.readexactly(LENGTH.size))
                if length > LONGEST:
                    raise OSError("a worker's message is too long")
                header, payload = opened(await process.stdout.readexactly(length))
                found: AnyReport = _decode(header)
                if isinstance(found, Answer):
                    return found
                if isinstance(found, Loading):
                    self._loads(found, limit, end)
                elif report is not None:
                    report(found, bytes(payload))

    def _loads(self, found: Loading, limit: asyncio.Timeout, end: float | None) -> None:
        """A file is run for its models, is still run, or no more."""
        is_new, self._loading = found.path != self._loading.path, found
        if not found.path:
            limit.reschedule(end)
        elif is_new:
            self._stamp = _stamp(found.path)
            if self._stamp is not None and self._slow.get(found.path) == self._stamp:
                raise TimeoutError
            late = asyncio.get_running_loop().time() + LOADING
            limit.reschedule(late if end is None else min(late, end))

    def _late(self) -> Problem:
        """Why a job was not waited for any longer."""
        if not self._loading.path:
            text = (
                f"this took more than {self._patience:.0f} s, and was ended; a fresh process takes its place"
            )
            return Problem("too-slow", text)
        if self._stamp is not None:
            self._slow[self._loading.path] = self._stamp
        line = f"at line {self._loading.line}, " if self._loading.line else ""
        reason = (
            f"it was ended {line}after {LOADING:.0f} s: a file of models has to be loaded within that time"
        )
        return self._failed(reason)

    def _ended(self) -> Problem:
        """Why a process has ended by itself."""
        if self._loading.path:
            return self._failed("the process that ran it has ended")
        text = "the process that did this has ended, perhaps for want of memory; a fresh one takes its place"
        return Problem("worker-ended", text)

    def _failed(self, reason: str) -> Problem:
        return problem(InputError("model-file-failed", path=self._loading.path, reason=reason))

    async def drop(self, paths: Iterable[Path]) -> None:
        """Restart the present job in a fresh process where it still loads one of these files, which has changed."""
        if self._job is not None and self._loading.path and Path(self._loading.path) in paths:
            self._again = True
            await self.kill()

    async def stop(self, grace: float = GRACE) -> None:
        """Ask the present job to end with what it has, and kill its process if it does not."""
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
                # It leads a group: what a file of models has started ends with it.
                end_group(process.pid)
            await process.wait()


def _put(pipe: asyncio.StreamWriter, header: bytes) -> None:
    data = frame(header)
    pipe.write(LENGTH.pack(len(data)) + data)


def _stamp(path: str) -> Stamp | None:
    """The present state of a file; None where there is none."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino
