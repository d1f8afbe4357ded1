"""Where a command writes: a folder of its own, so that no result is replaced without a word.

A folder that a person named with `-o` is refused where it has results or a search that did not end, unless `--force` is
given. Without `-o` the first of `out`, `out-2`, `out-3`, ... that has none is taken.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from itertools import count
from pathlib import Path
from typing import Annotated

import typer

from niwaki.errors import FileError, InputError
from niwaki.errors.folders import held_folder
from niwaki.shell import results, resuming

Force = Annotated[
    bool, typer.Option("--force", help="Replace the results that the folder of -o has from another run.")
]

#: The folder when none is named.
USUAL = "out"


@contextmanager
def own_folder(output: Path | None, force: bool = False) -> Iterator[Path]:
    """A folder for the results of one run, held for it.

    Parameters
    ----------
    output
        What was named with `-o`.
    force
        Whether results that are there may be replaced.

    Raises
    ------
    InputError
        `folder-has-results`.
    FileError
        `folder-in-use`: another process writes there.
    """
    if output is not None:
        with held_folder(output) as folder:
            found = _present(folder)
            if found and not force:
                raise InputError("folder-has-results", path=output, found=found)
            yield folder
        return
    for number in count(1):
        place = Path(USUAL if number == 1 else f"{USUAL}-{number}")
        with ExitStack() as stack:
            try:
                folder = stack.enter_context(held_folder(place))
            except FileError as error:
                if error.code != "folder-in-use":
                    raise
                continue
            if force or not _present(folder):
                yield folder
                return


def _present(folder: Path) -> str:
    """What a folder has of another run, for people; empty where it has nothing."""
    return resuming.NAME if (folder / resuming.NAME).exists() else results.present(folder)
