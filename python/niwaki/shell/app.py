"""The application, and what the commands share.

Results go to files and stdout, progress and warnings to stderr.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from niwaki import result
from niwaki.errors import FileError

app = typer.Typer(
    name="niwaki",
    help="Grow procedural models into given shapes.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

ModelName = Annotated[
    str, typer.Argument(metavar="MODEL", help="A gallery name, or file.py:function; the file is run.")
]
Folder = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="DIR", help="The folder for files; default: out.")
]


def ensure_folder(place: Path) -> Path:
    """The folder, created if it does not exist."""
    try:
        place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError("file-unwritable", place, reason=error.strerror or str(error)) from error
    return place


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
