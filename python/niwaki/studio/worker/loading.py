"""Loading files of models: the worker reports it to the server, which ends the process if loading takes too long.

A thread reports the current line of the file while it runs, so that the message about an endless loop names its line.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from niwaki.errors import InputError
from niwaki.studio.messages import Loading

#: Seconds between two reports of the current line.
INTERVAL = 0.5


def send(report: Any) -> None:
    """Report to the server; the worker's loop replaces this function."""


@contextmanager
def loading(place: Path) -> Iterator[None]:
    """Report that a file of models is loading, inside the `with` block.

    Raises
    ------
    InputError
        `model-file-failed`: the file raises `KeyboardInterrupt`; a worker has no keyboard.
    """
    path, runs = str(place.resolve()), threading.get_ident()
    ended = threading.Event()

    def watch() -> None:
        while not ended.wait(INTERVAL):
            send(Loading(path, _line(runs, path)))

    watcher = threading.Thread(target=watch, daemon=True)
    send(Loading(path))
    watcher.start()
    try:
        yield
    except KeyboardInterrupt as error:
        reason = f"it raises {type(error).__name__}"
        raise InputError("model-file-failed", path=path, reason=reason) from error
    finally:
        ended.set()
        watcher.join()
        send(Loading())


def _line(thread: int, path: str) -> int:
    """Return the line of the file that a thread runs; 0 if it runs no line of the file."""
    frame = sys._current_frames().get(thread)
    while frame is not None and frame.f_code.co_filename != path:
        frame = frame.f_back
    return 0 if frame is None else frame.f_lineno
