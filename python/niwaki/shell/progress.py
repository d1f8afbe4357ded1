"""Progress of a search on stderr: one changing line on a terminal, elsewhere a new line every few seconds."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress

from rich.console import Console

from niwaki import batches, result
from niwaki.shell.evaluations import Evaluations

#: Seconds between two lines where stderr is a file or a pipe; a short run prints nothing.
EVERY = 5.0


@contextmanager
def status_line(title: str, keeps_best: bool = True) -> Iterator[Callable[[str], None]]:
    """Yield a function that shows a text after the title; `keeps_best` tells whether Ctrl-C keeps the best so far."""
    console = Console(stderr=True)
    if console.is_terminal:
        end = "   (Ctrl-C keeps the best so far)" if keeps_best else ""
        with console.status(title) as status:
            yield lambda text: status.update(f"{title}: {text}{end}")
        return
    last = time.monotonic()

    def show(text: str) -> None:
        nonlocal last
        if time.monotonic() - last >= EVERY:
            last = time.monotonic()
            # A search does not end because its progress cannot be printed.
            with suppress(OSError):
                print(f"{title}: {text}", file=sys.stderr, flush=True)

    yield show


@contextmanager
def progress_line(
    name: str, verbose: bool, evaluations: Evaluations | None = None
) -> Iterator[Callable[[result.Progress], None]]:
    """Show the progress of `grow`: the fit of the best so far, and with `verbose` its log score.

    With `evaluations`, the line counts runs of the model by calls of its host functions, and changes with each call.
    """
    best, fit, latest = -math.inf, "", None

    def update(now: result.Progress) -> None:
        nonlocal best, fit, latest
        latest = now
        if now.sample is not None and now.best > best:
            best, fit = now.best, str(now.sample.fit or "")
        show(text())

    def text() -> str:
        now = latest
        if evaluations is not None and evaluations.calls:
            number = f"run {now.run + 1} of {now.runs}, " if now is not None and now.runs > 1 else ""
            steps, left = f"{number}{evaluations}", evaluations.seconds_left
        elif now is not None:
            steps, left = f"run {now.run + 1} of {now.runs}, step {now.done}, {now.ended} ended", None
        else:
            return "the first run"
        is_scored = now is not None and (now.sample is not None and not fit or (verbose and now.ended > 0))
        parts = [steps, fit, f"best {_best(now)}" if now is not None and is_scored else ""]
        parts.append("" if left is None else f"about {duration(left)} left")
        return ", ".join(part for part in parts if part)

    with status_line(f"growing {name}") as show:
        counted = nullcontext() if evaluations is None else evaluations.counted(lambda: show(text()))
        with counted:
            yield update


@contextmanager
def sampling_line(name: str, proposals: int) -> Iterator[Callable[[result.Progress], None]]:
    """Show the progress of `sample`."""
    with status_line(f"sampling {name}") as show:
        yield lambda now: show(f"{now.done} of {proposals} proposals, best {_best(now)}")


@contextmanager
def coloring_line(name: str) -> Iterator[Callable[[result.Progress], None]]:
    """Show the progress of `color`."""
    with status_line(f"coloring {name}", keeps_best=False) as show:
        yield lambda now: show(f"{now.done} proposals, best {_best(now)}")


@contextmanager
def batch_line(name: str) -> Iterator[Callable[[batches.BatchProgress], None]]:
    """Show the progress of `batch`, over all its workers."""
    with status_line(f"batch {name}", keeps_best=False) as show:
        yield lambda now: show(batch_progress(now))


def batch_progress(now: batches.BatchProgress) -> str:
    """Describe the progress of a batch: searches, their rate, processor time, and the time that is left."""
    faults = f", {now.faults} failed" if now.faults else ""
    left = "" if now.seconds_left is None else f", {duration(now.seconds_left)} left"
    return (
        f"{now.done:,} of {now.total:,} searches{faults}, {now.rate:.3g} a second, "
        f"{duration(now.cpu_seconds)} of processors{left}"
    )


def duration(seconds: float) -> str:
    """Format seconds in a unit of their size: 43 s, 12 min, 3.4 h."""
    if seconds < 120.0:
        return f"{seconds:.0f} s" if seconds >= 10.0 else f"{seconds:.1f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 7200.0 else f"{seconds / 3600.0:.1f} h"


def _best(now: result.Progress) -> str:
    return f"{now.best:.2f}" if math.isfinite(now.best) else "-"
