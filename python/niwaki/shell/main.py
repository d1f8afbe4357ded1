"""The command line as a program: errors without a traceback, the streams, and the exit codes.

Exit codes: 0 done, 1 a model that does not compile (`check`), 2 an error with a message, 130 stopped by Ctrl-C (after
results are written).
"""

from __future__ import annotations

import errno
import gc
import io
import os
import sys
import warnings
from contextlib import suppress
from typing import Any, NoReturn

from niwaki.errors import FileError, NiwakiError
from niwaki.shell.app import app
from niwaki.shell.clock import Clock

__all__ = ["app", "main"]


def main() -> NoReturn:
    """Run the command line; errors that we raise on purpose have no traceback."""
    _open_closed()
    Clock.of_process = True
    # What is loaded stays: looking for garbage among it takes a tenth of the time to load it.
    gc.set_threshold(50_000)
    for stream in (sys.stdout, sys.stderr):
        make_lenient(stream)
    warnings.showwarning = _warned  # type: ignore[assignment]
    try:
        code = _ended()
        sys.stdout.flush()
    except OSError as error:
        code = _refused(error)
    raise SystemExit(code)


def _ended() -> Any:
    """Run the command line; its exit code."""
    try:
        app(standalone_mode=True)
    except SystemExit as ended:
        return ended.code
    except NiwakiError as error:
        _say(str(error))
        return 2
    except KeyboardInterrupt:
        _say("stopped")
        return 130
    return 0


def _refused(error: OSError) -> int:
    """Say what the system refused: to write to stdout, or what no command has turned into a message of its own."""
    place = error.filename or "standard output"
    try:
        sys.stdout.flush()
    except OSError:
        # What is left of the output would be tried once more, and fail, at the end of Python.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if error.errno != errno.EPIPE:
        _say(str(FileError("system-refused", place, reason=error.strerror or str(error))))
    return 2


def _say(text: str) -> None:
    with suppress(OSError):
        print(text, file=sys.stderr)


def make_lenient(stream: Any) -> None:
    r"""Let a stream write characters that its encoding lacks as escapes, such as `\u2713`.

    A redirect on Windows is in cp1252, a pipe in the C locale in ASCII; what was computed must not end in an error.
    """
    if isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "surrogateescape"):
        stream.reconfigure(errors="backslashreplace")


def _warned(message: Warning | str, category: type[Warning], *_: Any) -> None:
    _say(f"warning: {message}")


def _open_closed() -> None:
    """Streams that were closed when the program began lead nowhere, and no file gets their numbers."""
    for number, (name, mode) in enumerate((("stdin", "r"), ("stdout", "w"), ("stderr", "w"))):
        if getattr(sys, name) is None:
            os.dup2(os.open(os.devnull, os.O_RDWR), number)
            setattr(sys, name, os.fdopen(number, mode))


if __name__ == "__main__":
    main()
