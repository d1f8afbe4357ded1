"""`--resume DIR`: a search goes on that was stopped or killed.

While a search runs, its folder holds a checkpoint with the search itself: going on runs no file of Python. It is
removed when all files of the result are written.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar

import typer
from msgspec import Struct
from msgspec.structs import asdict

from niwaki import Checkpoint, Result, Search, gallery
from niwaki.errors import InputError
from niwaki.errors.schema import fitted
from niwaki.search.checkpoint import Stored, reading
from niwaki.shell import arguments, references
from niwaki.shell.references import ModelReference

#: The checkpoint's name in the folder.
NAME = "search.checkpoint"

#: The flags that `--resume` takes beside it: they do not change the result.
BESIDE = ("resume", "threads", "as_json")

Resume = Annotated[
    Path | None,
    typer.Option(
        "--resume",
        metavar="PATH",
        help="Go on with what was stopped or killed: the search in this folder, in place of MODEL and its flags.",
    ),
]
Model = Annotated[
    str | None,
    typer.Argument(
        metavar="MODEL", help="A gallery name, or file.py:function; the file is run.", show_default=False
    ),
]


@dataclass(frozen=True)
class What:
    """What a command searches: a model with its arguments, or the search that goes on."""

    model: Model = None
    values: arguments.Arguments = None
    preset: arguments.Preset = None
    resume: Resume = None


#: The flags about files, as a command has them.
Flags = TypeVar("Flags")


class Own(Struct):
    """What the shell notes in a checkpoint."""

    command: str
    model: str
    file_hash: str | None
    flags: dict[str, Any]


class Note(Struct):
    """The note of a checkpoint: what the command that searches has noted, and the search."""

    own: Own | None
    search: dict[str, Any]


def model_of(context: typer.Context, what: What) -> tuple[ModelReference, dict[str, Any]]:
    """The model, which is named unless a search is resumed, and the arguments that are given."""
    if what.model is None:
        context.fail("Missing argument 'MODEL'.")
    found = references.find(what.model)
    return found, arguments.read(found.model, what.values, what.preset)


def begun(folder: Path, command: str, found: ModelReference, **flags: Any) -> Checkpoint:
    """The checkpoint of a search that begins; one of an earlier search is removed, with a warning.

    Parameters
    ----------
    folder
        Where the result will be.
    command
        The command that searches.
    found
        Its model.
    flags
        Those that say which files to write, as plain data.
    """
    place = folder / NAME
    if place.exists():
        place.unlink()
        print(f"warning: {place}, of a search that did not end, is replaced", file=sys.stderr)
    own = {
        "command": command,
        "model": found.reference,
        "file_hash": found.file_hash,
        "flags": flags,
    }
    return Checkpoint(place, note=own)


def left(
    context: typer.Context, folder: Path, command: str, read: Callable[[dict[str, Any]], Flags]
) -> tuple[Search, ModelReference, Flags, Checkpoint]:
    """The search that a folder holds, its model, the flags about files as `read` gives them, and the checkpoint.

    Raises
    ------
    InputError
        Other flags beside `--resume`; no checkpoint in the folder, a damaged one, or one of another command.
    """
    for parameter in context.command.params:
        source = context.get_parameter_source(parameter.name or "")
        if parameter.name not in BESIDE and source is not None and source.name == "COMMANDLINE":
            raise InputError(
                "flags-exclude",
                flag="--resume",
                other="MODEL" if parameter.name == "model" else parameter.opts[-1],
                reason="the search in the folder has its settings, and goes on with them",
                cure=f"`niwaki {command} --resume {folder}`, or begin anew without `--resume`",
            )
    place = folder / NAME
    if not place.is_file():
        raise InputError("no-checkpoint", path=place)
    with reading(place):
        note: Note = fitted(Stored.read(place).note, Note)
        own = note.own
        if own is None or own.command != command:
            other = f"niwaki {own.command}" if own else "Python"
            raise InputError(
                "bad-checkpoint", detail=f"`{place}` was written by {other}, not by niwaki {command}"
            )
        search = Search.of_data(note.search)
        known = ModelReference(own.model, search.model, gallery.entry(own.model), own.file_hash)
        return search, known, read(own.flags), Checkpoint(place, note=asdict(own))


@contextmanager
def told(checkpoint: Checkpoint | None, command: str) -> Iterator[None]:
    """Where Ctrl-C comes before there is a result, the last line says how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        if checkpoint is None or not Path(checkpoint.path).exists():
            raise
        print(interrupted(Path(checkpoint.path).parent, command), file=sys.stderr)
        raise typer.Exit(130) from None


def interrupted(folder: Path, command: str) -> str:
    """The last line of a search that was stopped."""
    return f"interrupted; go on with: niwaki {command} --resume {folder}"


@contextmanager
def ended(result: Result, checkpoint: Checkpoint | None) -> Iterator[None]:
    """Around the writing of a result's files: when it is over, a search that is done has nothing left to go on from.

    Also where a file cannot be written: run.json is the first, and gives the others again.
    """
    try:
        yield
    finally:
        if checkpoint is not None and not result.interrupted:
            Path(checkpoint.path).unlink(missing_ok=True)
