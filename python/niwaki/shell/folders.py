"""The output folder or file of a command; no file is replaced without `--force`.

`-o` names a folder or, with a suffix, one file of this suffix. A command that would replace a file ends before its
work, unless `--force` is set. Without `-o` the output is the first of `out`, `out-2`, `out-3`, ... that has no results.
A command that writes one file takes the first of `show.png`, `show-2.png`, ... that does not exist.
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
from niwaki.shell import results, resume
from niwaki.shell.app import Json


def output(default: str) -> Any:
    """Return the option `-o` of a command with its default output."""
    text = f"Output: a folder or, with a suffix, a file. Default: {default}."
    return typer.Option("-o", "--output", metavar="PATH", help=text)


#: The folder without `-o`.
DEFAULT = "out"

Output = Annotated[str | None, output(DEFAULT)]
Force = Annotated[bool, typer.Option("--force", help="Replace existing files.")]


@dataclass(frozen=True)
class Destination:
    """The output of a command."""

    output: Output = None
    force: Force = False
    as_json: Json = False

    def single_file(self, suffixes: Iterable[str], **folder_flags: Any) -> Path | None:
        """Return the file that `-o` names, or None (`one_file`)."""
        return one_file(self.output, suffixes, self.force, **folder_flags)

    def folder(self, single_file: Path | None) -> AbstractContextManager[Path | None]:
        """Return a locked folder for the results; None where a single file is written, or numbers are only printed."""
        if single_file is not None or (self.output is None and self.as_json):
            return nullcontext()
        return own_folder(self.output, self.force)

    @property
    def stream(self) -> TextIO:
        """The stream for messages that must not stand among the numbers of `--json`."""
        return sys.stderr if self.as_json else sys.stdout


def refuse_existing(places: Iterable[Path], force: bool, cure: str = "add `--force` to replace it") -> None:
    """Refuse to replace files.

    Raises
    ------
    InputError
        `already-there`: a file exists, and `force` is not set.
    """
    existing = [] if force else [place for place in places if os.path.exists(place)]
    if existing:
        raise InputError("already-there", path=existing[0], count=len(existing), cure=cure)


def one_file(output: str | None, suffixes: Iterable[str], force: bool, **folder_flags: Any) -> Path | None:
    """Return the file that `-o` names; None where it names a folder, or is left out.

    Parameters
    ----------
    output, force
        Values of `-o` and `--force`.
    suffixes
        Suffixes, without dots, of the files that the command can write alone.
    folder_flags
        Flags that select files in a folder, by their names; None for a flag that was left out.

    Raises
    ------
    InputError
        `bad-setting`: the command writes no such file; `flags-exclude`: one of the `folder_flags` stands beside a file;
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
            expected=" or ".join(["a folder", *(f".{suffix}" for suffix in suffixes)]),
            suggestion=f"such a path; end the name of a folder in a slash if it has a dot: {output}/",
        )
    for flag in (flag for flag, value in folder_flags.items() if value is not None):
        raise InputError(
            "flags-exclude",
            flag=f"-o {output}",
            other=f"--{flag}",
            reason="`-o` names one file, and its suffix selects the format",
            cure=f"name a folder with `-o`, or leave out `--{flag}`",
        )
    refuse_existing([place], force)
    return check_place(ensure_folder(place.parent) / place.name)


def own_file(output: str | None, default: str, suffixes: Iterable[str], force: bool) -> Path:
    """Return the path of the only file of a command; `default` is its name where `-o` names only a folder.

    Raises
    ------
    InputError, FileError
        See `one_file`.
    """
    if named := one_file(output, suffixes, force):
        return named
    place = Path(output or ".", default)
    if output is not None:
        refuse_existing([place], force)
    elif not force:
        alternatives = (place.with_stem(f"{place.stem}-{number}") for number in count(2))
        place = next(path for path in chain([place], alternatives) if not os.path.exists(path))
    return check_place(ensure_folder(place.parent) / place.name)


@contextmanager
def own_folder(
    output: str | None, force: bool = False, joins: Callable[[Path], bool] = lambda _: False
) -> Iterator[Path]:
    """Yield a folder for the results of one run, locked for it.

    Parameters
    ----------
    output
        The value of `-o`.
    force
        Whether existing results may be replaced.
    joins
        A function that tells whether a folder has results of the same run, so that more files may join them.

    Raises
    ------
    InputError
        `already-there`.
    FileError
        `folder-in-use`: another process writes there.
    """
    for number in count(1):
        place = Path(output or (DEFAULT if number == 1 else f"{DEFAULT}-{number}"))
        with ExitStack() as stack:
            try:
                folder = stack.enter_context(held_folder(place))
            except FileError as error:
                if output is not None or error.code != "folder-in-use":
                    raise
                continue
            existing = [] if joins(folder) else present(folder)
            if output is not None:
                refuse_existing(existing, force)
            if output is not None or force or not existing:
                yield folder
                return


def location(place: Path) -> str:
    """Describe the place of the files, for the last line of a command."""
    return f"files in {place}" if place.is_dir() else str(place)


def present(folder: Path) -> list[Path]:
    """Return the files of another run in a folder: its checkpoint and its results."""
    checkpoint = folder / resume.NAME
    return [*([checkpoint] if checkpoint.exists() else []), *results.present(folder)]
