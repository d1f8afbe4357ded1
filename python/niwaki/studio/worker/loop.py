"""A worker's loop: jobs arrive as frames on standard input, reports leave as frames on standard output.

A thread reads, so that `stop` works while a job runs. The process ends when the pipe closes: no worker outlives its
server. The output of models goes to standard error.
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
from niwaki.studio.frames import LENGTH, LONGEST, frame, unpack
from niwaki.studio.problems import problem
from niwaki.studio.worker import (
    differences,
    drag,
    kinds,
    loading,
    offers,
    permissions,
    reports,
    rewriting,
    structures,
    values,
)

#: Sends a report, with the bytes of a mesh if there is a mesh.
Send = Callable[..., None]


class StopFlag:
    """Requests to stop a job; the thread that reads sets them."""

    def __init__(self) -> None:
        self.job: int | None = None
        self.requests: set[int] = set()

    def check(self) -> None:
        """Stop a search that reports its progress; its results so far are kept."""
        if self.job in self.requests:
            raise KeyboardInterrupt


def main() -> None:
    """Serve until the pipe closes; the words of the command line set the permissions."""
    permissions.configure(sys.argv[1:])
    source, sink = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    warnings.simplefilter("ignore")
    waiting: queue.SimpleQueue[messages.AnyJob] = queue.SimpleQueue()
    flag = StopFlag()
    threading.Thread(target=_read, args=(source, waiting, flag), daemon=True).start()
    lock = threading.Lock()

    def send(report: messages.AnyReport, payload: bytes = b"") -> None:
        data = frame(msgspec.json.encode(report), payload)
        with lock:
            sink.write(LENGTH.pack(len(data)) + data)
            sink.flush()

    loading.send = send
    while True:
        job = waiting.get()
        flag.job = job.id
        try:
            answer = do(job, send, flag)
        except BaseException as error:
            # Only a request stops a search: a host function that raises `KeyboardInterrupt` has failed.
            is_stopped = isinstance(error, KeyboardInterrupt) and job.id in flag.requests
            answer = (
                messages.Answer(interrupted=True) if is_stopped else messages.Answer(problem=problem(error))
            )
        answer.id = job.id
        flag.job = None
        send(answer)


def _read(source: BinaryIO, waiting: queue.SimpleQueue[Any], flag: StopFlag) -> None:
    decode = msgspec.json.Decoder(messages.AnyJob).decode
    while True:
        head = source.read(LENGTH.size)
        if len(head) < LENGTH.size:
            os._exit(0)
        (length,) = LENGTH.unpack(head)
        assert length <= LONGEST
        header, _ = unpack(source.read(length))
        if header.startswith(b'{"stop"'):
            flag.requests.add(msgspec.json.decode(header)["stop"])
        else:
            waiting.put(decode(header))


def do(job: messages.AnyJob, send: Send, flag: StopFlag) -> messages.Answer:
    """Do a job."""
    answer: messages.Answer = _dispatch(job, send, flag)
    return answer


def _dispatch(job: messages.AnyJob, send: Send, flag: StopFlag) -> Any:
    match job:
        case messages.ListModels():
            return offers.listed(job)
        case messages.Load():
            return offers.loaded(job)
        case messages.CheckModel():
            return reports.check(job, send)
        case messages.PreviewRuns():
            return reports.preview(job, send)
        case messages.ExplainChange():
            return reports.explain(job, send)
        case messages.FitParameters():
            return reports.fit(job, send, flag.check)
        case messages.Ghost():
            return kinds.of_question(job.question).ghost(job, send)
        case messages.Glimpse():
            return kinds.of_model(job.reference).glimpse(job, send)
        case messages.Grow():
            return kinds.of_question(job.question).grow(job, send, flag.check)
        case messages.GrowValues():
            return values.grow(job, send, flag.check)
        case messages.GrowAgain():
            return values.repeat(job, send, flag.check)
        case messages.Regrow():
            return kinds.of_question(job.question).regrow(job, send)
        case messages.Change():
            return kinds.of_question(job.question).change(job, send)
        case messages.DragPart():
            return drag.drag(job, send)
        case messages.ProposeDefaults():
            return rewriting.propose(job, send)
        case messages.RewriteFile():
            return rewriting.rewrite(job)
        case messages.Hold():
            return kinds.of_run(job.source).hold(job)
        case messages.DescribeRun():
            return kinds.of_run(job.source).describe(job, send)
        case messages.ShowRun():
            return kinds.of_run(job.source).show(job, send)
        case messages.JudgeRun():
            return structures.judge(job, send)
        case messages.FindDifference():
            return differences.find(job, send)
        case messages.WriteFile():
            return kinds.of_file(job.source, job.number).write(job)
