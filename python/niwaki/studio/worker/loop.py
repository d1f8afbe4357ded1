"""A worker's loop: jobs arrive as frames on standard input, reports leave as frames on standard output.

A thread reads, so that `stop` is seen while a job runs. When the pipe closes the process ends: no worker outlives its
server. What a model prints goes to standard error.
"""

from __future__ import annotations

import os
import queue
import sys
import threading
import warnings
from collections.abc import Callable
from typing import Any, BinaryIO

import msgspec

from niwaki.studio import messages
from niwaki.studio.frames import LENGTH, LONGEST, frame, opened
from niwaki.studio.refused import problem
from niwaki.studio.worker import (
    allowed,
    differences,
    drag,
    kinds,
    loading,
    offers,
    rewriting,
    structures,
    values,
)

#: Sends a report, with the bytes of a mesh where it has one.
Send = Callable[..., None]


class Stopped:
    """Whether the present job is to stop; set by the thread that reads."""

    def __init__(self) -> None:
        self.job: int | None = None
        self.stopping: set[int] = set()

    def check(self) -> None:
        """Stop a search that shows its progress; what it has found is kept."""
        if self.job in self.stopping:
            raise KeyboardInterrupt


def main() -> None:
    """Serve until the pipe closes; the words of the command line say what may be run."""
    allowed.take(sys.argv[1:])
    source, sink = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    warnings.simplefilter("ignore")
    waiting: queue.SimpleQueue[messages.AnyJob] = queue.SimpleQueue()
    stopped = Stopped()
    threading.Thread(target=_read, args=(source, waiting, stopped), daemon=True).start()
    lock = threading.Lock()

    def send(report: messages.AnyReport, payload: bytes = b"") -> None:
        data = frame(msgspec.json.encode(report), payload)
        with lock:
            sink.write(LENGTH.pack(len(data)) + data)
            sink.flush()

    loading.send = send
    while True:
        job = waiting.get()
        stopped.job = job.id
        try:
            answer = done(job, send, stopped)
        except BaseException as error:
            # Only who asked for it stops a search: a host function that raises the same has failed.
            is_stopped = isinstance(error, KeyboardInterrupt) and job.id in stopped.stopping
            answer = (
                messages.Answer(interrupted=True) if is_stopped else messages.Answer(problem=problem(error))
            )
        answer.id = job.id
        stopped.job = None
        send(answer)


def _read(source: BinaryIO, waiting: queue.SimpleQueue[Any], stopped: Stopped) -> None:
    decode = msgspec.json.Decoder(messages.AnyJob).decode
    while True:
        head = source.read(LENGTH.size)
        if len(head) < LENGTH.size:
            os._exit(0)
        (length,) = LENGTH.unpack(head)
        assert length <= LONGEST
        header, _ = opened(source.read(length))
        if header.startswith(b'{"stop"'):
            stopped.stopping.add(msgspec.json.decode(header)["stop"])
        else:
            waiting.put(decode(header))


def done(job: messages.AnyJob, send: Send, stopped: Stopped) -> messages.Answer:
    """The work of one job."""
    found: messages.Answer = _done(job, send, stopped)
    return found


def _done(job: messages.AnyJob, send: Send, stopped: Stopped) -> Any:
    match job:
        case messages.ListModels():
            return offers.listed(job)
        case messages.Load():
            return offers.loaded(job)
        case messages.Ghost():
            return kinds.asked(job.question).ghost(job, send)
        case messages.Grow():
            return kinds.asked(job.question).grow(job, send, stopped.check)
        case messages.GrowValues():
            return values.grow(job, send, stopped.check)
        case messages.GrowAgain():
            return values.again(job, send, stopped.check)
        case messages.Regrow():
            return kinds.asked(job.question).regrow(job, send)
        case messages.Change():
            return kinds.asked(job.question).change(job, send)
        case messages.DragPart():
            return drag.drag(job, send)
        case messages.ProposeDefaults():
            return rewriting.propose(job, send)
        case messages.RewriteFile():
            return rewriting.rewrite(job)
        case messages.Hold():
            return kinds.stored(job.source).hold(job)
        case messages.DescribeRun():
            return kinds.stored(job.source).describe(job, send)
        case messages.ShowRun():
            return kinds.stored(job.source).show(job, send)
        case messages.JudgeRun():
            return structures.judge(job, send)
        case messages.FindDifference():
            return differences.find(job, send)
        case messages.WriteFile():
            return kinds.written(job.source, job.number).write(job)
