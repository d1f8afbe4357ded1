"""The command line as a program: errors without a traceback, the streams, and the exit codes.

Exit codes: 0 done, 1 a model that does not compile (`check`) or that does not keep its requirements (`check`, `grow`),
2 an error with a message, 130 stopped by Ctrl-C (after results are written).
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
    """Run the command line; Niwaki's own errors have no traceback."""
    _reopen_closed_streams()
    Clock.of_process = True
    # Loaded modules stay: looking for garbage among them takes a tenth of the time to load them.
    gc.set_threshold(50_000)
    for stream in (sys.stdout, sys.stderr):
        make_lenient(stream)
    warnings.showwarning = _show_warning  # type: ignore[assignment]
    try:
        exit_code = _run()
        sys.stdout.flush()
    except OSError as error:
        exit_code = _report_refusal(error)
    raise SystemExit(exit_code)


def _run() -> Any:
    """Run the command line and return its exit code."""
    try:
        app(standalone_mode=True)
    except SystemExit as error:
        return error.code
    except NiwakiError as error:
        _say(str(error))
        return 2
    except KeyboardInterrupt:
        _say("stopped")
        return 130
    return 0


def _report_refusal(error: OSError) -> int:
    """Print an error of the system that no command has turned into a message, such as a stdout that is closed."""
    place = error.filename or "standard output"
    try:
        sys.stdout.flush()
    except OSError:
        # Python would try to write the rest of the output at its end, and fail.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if error.errno != errno.EPIPE:
        _say(str(FileError("system-refused", place, reason=error.strerror or str(error))))
    return 2


def _say(text: str) -> None:
    with suppress(OSError):
        print(text, file=sys.stderr)


def make_lenient(stream: Any) -> None:
    r"""Make a stream write characters that its encoding lacks as escapes, such as `\u2713`.

    A redirect on Windows is in cp1252, a pipe in the C locale in ASCII; printing a result must not end in an error.
    """
    if isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "surrogateescape"):
        stream.reconfigure(errors="backslashreplace")


def _show_warning(message: Warning | str, category: type[Warning], *_: Any) -> None:
    _say(f"warning: {message}")


def _reopen_closed_streams() -> None:
    """Open closed standard streams on the null device, so that no file gets their numbers."""
    for number, (name, mode) in enumerate((("stdin", "r"), ("stdout", "w"), ("stderr", "w"))):
        if getattr(sys, name) is None:
            os.dup2(os.open(os.devnull, os.O_RDWR), number)
            setattr(sys, name, os.fdopen(number, mode))


if __name__ == "__main__":
    main()
