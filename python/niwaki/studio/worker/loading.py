"""Files of models that are run: the server is told, since a file that does not end ends this process.

A thread says where the file is while it runs, so that the message about one that loops names its line.
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

#: Seconds between two looks at a file that runs.
LOOK = 0.5


def send(report: Any) -> None:
    """Tell the server; the worker's loop puts its own function here."""


@contextmanager
def loading(place: Path) -> Iterator[None]:
    """Inside, a file of models is run.

    Raises
    ------
    InputError
        `model-file-failed`: it raises what ends a program. Nobody has pressed a key here.
    """
    path, runs = str(place.resolve()), threading.get_ident()
    ended = threading.Event()

    def look() -> None:
        while not ended.wait(LOOK):
            send(Loading(path, _line(runs, path)))

    watching = threading.Thread(target=look, daemon=True)
    send(Loading(path))
    watching.start()
    try:
        yield
    except KeyboardInterrupt as error:
        reason = f"it raises {type(error).__name__}"
        raise InputError("model-file-failed", path=path, reason=reason) from error
    finally:
        ended.set()
        watching.join()
        send(Loading())


def _line(thread: int, path: str) -> int:
    """The line of the file at which a thread is; 0 where it is not in it."""
    frame = sys._current_frames().get(thread)
    while frame is not None and frame.f_code.co_filename != path:
        frame = frame.f_back
    return 0 if frame is None else frame.f_lineno
