"""Answers of worker processes: a line of JSON, then as many bytes as it says."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from typing import IO, Any


def write_answer(answers: IO[bytes], head: Mapping[str, Any], body: bytes = b"") -> None:
    """Write an answer; a parent process that has gone is no error."""
    answers.write(json.dumps({**head, "bytes": len(body)}).encode() + b"\n" + body)
    with suppress(BrokenPipeError):
        answers.flush()


def read_answer(answers: IO[bytes]) -> tuple[dict[str, Any], bytes] | None:
    """Read an answer in the parent process; None at the end.

    What another program prints at its start is skipped: an answer begins with a brace.
    """
    line = answers.readline()
    while line.endswith(b"\n") and not line.startswith(b"{"):
        line = answers.readline()
    if not line.endswith(b"\n"):
        return None
    head = json.loads(line)
    body = answers.read(head["bytes"])
    return (head, body) if len(body) == head["bytes"] else None
