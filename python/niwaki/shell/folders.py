"""Where a command writes: a folder or one file, so that nothing is replaced without a word.

`-o` names a folder or, with a suffix, one file: the one of the command's files that has this suffix. What a command
would replace is refused before its work, unless `--force` is given. Without `-o` the first of `out`, `out-2`, `out-3`,
... is taken that has no results; of a command that writes one file, the first of `show.png`, `show-2.png`, ... that is
not there.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from itertools import chain, count
from pathlib import Path
from typing import Annotated, Any, TextIO

import typer

from niwaki.errors import FileError, InputError
from niwaki.errors.files import check_place, ensure_folder
from niwaki.errors.folders import held_folder
from niwaki.shell import results, resuming
from niwaki.shell.app import Json


def output(usual: str) -> Any:
    """The option `-o` of a command; `usual` is where it writes when nothing is said."""
    what = f"Where to: a folder or, with a suffix, a file. Default: {usual}."
    return typer.Option("-o", "--output", metavar="PATH", help=what)


#: The folder when none is named.
USUAL = "out"

Output = Annotated[str | None, output(USUAL)]
Force = Annotated[bool, typer.Option("--force", help="Replace what is there.")]


@dataclass(frozen=True)
class Out:
    """Where results go."""

    output: Output = None
    force: Force = False
    as_json: Json = False

    def alone(self, suffixes: Iterable[str], **others: Any) -> Path | None:
        """The one file that is named, as of `one_file`."""
        return one_file(self.output, suffixes, self.force, **others)

    def folder(self, alone: Path | None) -> AbstractContextManager[Path | None]:
        """A folder for the results, held for them; none where one file is written, or only the numbers are printed."""
        if alone is not None or (self.output is None and self.as_json):
            return nullcontext()
        return own_folder(self.output, self.force)

    @property
    def stream(self) -> TextIO:
        """Where words go that must not be among the numbers."""
        return sys.stderr if self.as_json else sys.stdout


def taken(places: Iterable[Path], force: bool, cure: str = "add `--force` to replace it") -> None:
    """Refuse to replace files.

    Raises
    ------
    InputError
        `already-there`: one of them is, and `force` is not given.
    """
    there = [] if force else [place for place in places if os.path.exists(place)]
    if there:
        raise InputError("already-there", path=there[0], count=len(there), cure=cure)


def one_file(output: str | None, suffixes: Iterable[str], force: bool, **others: Any) -> Path | None:
    """The file that `-o` names, where a file can be written; None where it names a folder, or nothing.

    Parameters
    ----------
    output, force
        As they were given.
    suffixes
        Of the files that the command can write alone, without dots.
    others
        Flags that say which files are written to a folder, by their names; None where they were not given.

    Raises
    ------
    InputError
        `bad-setting`: the command writes no such file; `flags-exclude`: one of the `others` was given for a file;
        `already-there`.
    FileError
        `file-unwritable`.
    """
    place = Path(output or ".")
    if output is None or not place.suffix or output.endswith(("/", "\\")) or os.path.isdir(place):
        return None
    if place.suffix[1:].lower() not in suffixes:
        raise InputError(
            "bad-setting",
            name="-o",
            found=repr(output),
            expected=" or ".join(["a folder", *(f".{one}" for one in suffixes)]),
            suggestion=f"such a place; the name of a folder with a dot ends in a slash: {output}/",
        )
    for flag in (flag for flag, given in others.items() if given is not None):
        raise InputError(
            "flags-exclude",
            flag=f"-o {output}",
            other=f"--{flag}",
            reason="one file is written, and its suffix says which",
            cure=f"name a folder with `-o`, or leave `--{flag}` out",
        )
    taken([place], force)
    return check_place(ensure_folder(place.parent) / place.name)


def own_file(output: str | None, usual: str, suffixes: Iterable[str], force: bool) -> Path:
    """The place of the one file that a command writes; `usual` is its name where only a folder is named.

    Raises
    ------
    InputError, FileError
        As `one_file`.
    """
    if found := one_file(output, suffixes, force):
        return found
    place = Path(output or ".", usual)
    if output is not None:
        taken([place], force)
    elif not force:
        names = (place.with_stem(f"{place.stem}-{number}") for number in count(2))
        place = next(one for one in chain([place], names) if not os.path.exists(one))
    return check_place(ensure_folder(place.parent) / place.name)


@contextmanager
def own_folder(
    output: str | None, force: bool = False, joins: Callable[[Path], bool] = lambda _: False
) -> Iterator[Path]:
    """A folder for the results of one run, held for it.

    Parameters
    ----------
    output
        What was named with `-o`.
    force
        Whether results that are there may be replaced.
    joins
        Whether the results of a folder are of the same run, so that others may join them.

    Raises
    ------
    InputError
        `already-there`.
    FileError
        `folder-in-use`: another process writes there.
    """
    for number in count(1):
        place = Path(output or (USUAL if number == 1 else f"{USUAL}-{number}"))
        with ExitStack() as stack:
            try:
                folder = stack.enter_context(held_folder(place))
            except FileError as error:
                if output is not None or error.code != "folder-in-use":
                    raise
                continue
            there = [] if joins(folder) else present(folder)
            if output is not None:
                taken(there, force)
            if output is not None or force or not there:
                yield folder
                return


def said(place: Path) -> str:
    """Where the files are, for the last line of a command."""
    return f"files in {place}" if place.is_dir() else str(place)


def present(folder: Path) -> list[Path]:
    """What a folder has of another run."""
    left = folder / resuming.NAME
    return [*([left] if left.exists() else []), *results.present(folder)]
