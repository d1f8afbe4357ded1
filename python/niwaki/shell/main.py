"""The command line as a program: errors without a traceback, and the exit codes.

Exit codes: 0 done, 1 a model that does not compile (`check`), 2 an error with a message, 130 stopped by Ctrl-C (after
results are written).
"""

from __future__ import annotations

import gc
import io
import sys
import warnings
from typing import Any, NoReturn

from niwaki.errors import NiwakiError
from niwaki.shell.app import app
from niwaki.shell.clock import Clock

__all__ = ["app", "main"]


def main() -> NoReturn:
    """Run the command line; errors that we raise on purpose have no traceback."""
    Clock.of_process = True
    # What is loaded stays: looking for garbage among it takes a tenth of the time to load it.
    gc.set_threshold(50_000)
    for stream in (sys.stdout, sys.stderr):
        make_lenient(stream)
    warnings.showwarning = _warned  # type: ignore[assignment]
    try:
        app(standalone_mode=True)
    except NiwakiError as error:
        print(error, file=sys.stderr)
        raise SystemExit(2) from None
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        raise SystemExit(130) from None
    raise SystemExit(0)


def make_lenient(stream: Any) -> None:
    r"""Let a stream write characters that its encoding lacks as escapes, such as `\u2713`.

    A redirect on Windows is in cp1252, a pipe in the C locale in ASCII; what was computed must not end in an error.
    """
    if isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "surrogateescape"):
        stream.reconfigure(errors="backslashreplace")


def _warned(message: Warning | str, category: type[Warning], *_: Any) -> None:
    print(f"warning: {message}", file=sys.stderr)


if __name__ == "__main__":
    main()
