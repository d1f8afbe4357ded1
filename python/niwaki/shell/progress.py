"""How a search goes on, on stderr: a line that changes on a terminal, and elsewhere a line every few seconds."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

from rich.console import Console

from niwaki import batches, result

#: Seconds between two lines where stderr is a file or a pipe: short runs say nothing, long ones show that they live.
EVERY = 5.0


@contextmanager
def said(title: str, keeps: bool = True) -> Iterator[Callable[[str], None]]:
    """Inside, a function that shows what it is given after the title; `keeps` where Ctrl-C keeps what there is."""
    console = Console(stderr=True)
    if console.is_terminal:
        end = "   (Ctrl-C keeps the best so far)" if keeps else ""
        with console.status(title) as status:
            yield lambda text: status.update(f"{title}: {text}{end}")
        return
    last = time.monotonic()

    def show(text: str) -> None:
        nonlocal last
        if time.monotonic() - last >= EVERY:
            last = time.monotonic()
            # A search does not end because nobody can be told how far it is.
            with suppress(OSError):
                print(f"{title}: {text}", file=sys.stderr, flush=True)

    yield show


@contextmanager
def progress_line(name: str) -> Iterator[Callable[[result.Progress], None]]:
    """Progress of `grow`."""
    with said(f"growing {name}") as show:
        yield lambda now: show(
            f"run {now.run + 1} of {now.runs}, step {now.done}, {now.ended} ended, best {_best(now)}"
        )


@contextmanager
def sampling_line(name: str, proposals: int) -> Iterator[Callable[[result.Progress], None]]:
    """Progress of `sample`."""
    with said(f"sampling {name}") as show:
        yield lambda now: show(f"{now.done} of {proposals} proposals, best {_best(now)}")


@contextmanager
def coloring_line(name: str) -> Iterator[Callable[[result.Progress], None]]:
    """Progress of `color`."""
    with said(f"coloring {name}", keeps=False) as show:
        yield lambda now: show(f"{now.done} proposals, best {_best(now)}")


@contextmanager
def batch_line(name: str) -> Iterator[Callable[[batches.Standing], None]]:
    """Progress of `batch`, over all its workers."""
    with said(f"batch {name}", keeps=False) as show:
        yield lambda now: show(standing(now))


def standing(now: batches.Standing) -> str:
    """How far a batch is: searches, their rate, what they cost, and the time that is left."""
    faults = f", {now.faults} failed" if now.faults else ""
    left = "" if now.seconds_left is None else f", {duration(now.seconds_left)} left"
    return (
        f"{now.done:,} of {now.total:,} searches{faults}, {now.rate:.3g} a second, "
        f"{duration(now.cpu_seconds)} of processors{left}"
    )


def duration(seconds: float) -> str:
    """Seconds as people say them: 43 s, 12 min, 3.4 h."""
    if seconds < 120.0:
        return f"{seconds:.0f} s" if seconds >= 10.0 else f"{seconds:.1f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 7200.0 else f"{seconds / 3600.0:.1f} h"


def _best(now: result.Progress) -> str:
    return f"{now.best:.2f}" if math.isfinite(now.best) else "-"
