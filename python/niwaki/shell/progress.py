"""A line that says how a search goes on."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console

from niwaki import result


@contextmanager
def progress_line(name: str) -> Iterator[Callable[[result.Progress], None]]:
    """A line of progress on stderr; nothing where stderr is not a terminal."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield lambda _: None
        return
    with console.status(f"growing {name}") as status:

        def show(now: result.Progress) -> None:
            best = f"{now.best:.2f}" if math.isfinite(now.best) else "-"
            status.update(
                f"growing {name}: run {now.run + 1} of {now.runs}, step {now.done}, "
                f"{now.ended} ended, best {best}   (Ctrl-C keeps the best so far)"
            )

        yield show
