"""A worker process as the server sees it: one job at a time, reports while it runs, stopped or killed."""

from __future__ import annotations

import asyncio
import contextlib
import sys
from collections.abc import Callable, Mapping
from itertools import count

import msgspec

from niwaki.studio.frames import LENGTH, LONGEST, frame, opened
from niwaki.studio.messages import Answer, AnyJob, AnyReport, Problem

#: What is reported before a job has ended, with the bytes of a mesh or of a picture.
Report = Callable[[AnyReport, bytes], None]
#: Seconds in which a job has to end after it was asked to; then its process is killed.
GRACE = 2.0

_decode = msgspec.json.Decoder(AnyReport).decode


class Worker:
    """A process that does jobs, started when there is one, and again after it has ended.

    Parameters
    ----------
    words
        Of its command line: see `niwaki.studio.worker.allowed`.
    environment
        Of the process; that of this one when left out.
    """

    def __init__(self, *words: str, environment: Mapping[str, str] | None = None) -> None:
        self._words, self._environment = words, environment
        self._process: asyncio.subprocess.Process | None = None
        self._one = asyncio.Lock()
        self._ids = count(1)
        self._job: int | None = None
        self._killed = False

    @property
    def pid(self) -> int | None:
        """Of the process, while there is one."""
        return None if self._process is None else self._process.pid

    async def do(self, job: AnyJob, report: Report | None = None) -> Answer:
        """Do a job: after those that were given before it. A failure is an answer with a problem."""
        async with self._one:
            self._job = job.id = next(self._ids)
            self._killed = False
            try:
                return await self._done(job, report)
            except (asyncio.IncompleteReadError, OSError):
                await self.kill()
                if self._killed:
                    return Answer(interrupted=True)
                text = "the process that did this has ended, perhaps for want of memory; a fresh one takes its place"
                return Answer(problem=Problem("worker-ended", text))
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
            if report is not None:
                report(found, bytes(payload))

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
            with contextlib.suppress(ProcessLookupError):
                process.kill()
            await process.wait()


def _put(pipe: asyncio.StreamWriter, header: bytes) -> None:
    data = frame(header)
    pipe.write(LENGTH.pack(len(data)) + data)
