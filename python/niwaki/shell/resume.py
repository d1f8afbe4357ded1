"""`--resume DIR`: resume a search that was stopped or killed.

While a search runs, its folder has a checkpoint, which contains the search: resuming runs no Python file. The
checkpoint is removed when all files of the result are written.
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

#: The flags that are allowed beside `--resume`, because they do not change the result.
BESIDE = ("resume", "threads", "as_json")

Resume = Annotated[
    Path | None,
    typer.Option(
        "--resume",
        metavar="PATH",
        help="Resume the stopped or killed search in this folder. It stands in place of MODEL and its flags.",
    ),
]
Model = Annotated[
    str | None,
    typer.Argument(
        metavar="MODEL",
        help="A gallery name, or file.py:function. The Python file is run.",
        show_default=False,
    ),
]


@dataclass(frozen=True)
class Source:
    """The source of a search: a model with its arguments, or the folder of a stopped search."""

    model: Model = None
    values: arguments.Arguments = None
    preset: arguments.Preset = None
    resume: Resume = None


#: The flags about files of a command.
Flags = TypeVar("Flags")


class ShellNote(Struct):
    """The note of the shell in a checkpoint: the command and its flags."""

    command: str
    model: str
    file_hash: str | None
    flags: dict[str, Any]


class Note(Struct):
    """The note of a checkpoint: the search, and the note of the shell under the name `own`."""

    own: ShellNote | None
    search: dict[str, Any]


def model_of(context: typer.Context, source: Source) -> tuple[ModelReference, dict[str, Any]]:
    """Return the model on the command line and its arguments; without a model the command ends with an error."""
    if source.model is None:
        context.fail("Missing argument 'MODEL'.")
    reference = references.find(source.model)
    return reference, arguments.read(reference.model, source.values, source.preset)


def new_checkpoint(folder: Path, command: str, reference: ModelReference, **flags: Any) -> Checkpoint:
    """Return the checkpoint of a new search; the checkpoint of an earlier search is removed, with a warning.

    Parameters
    ----------
    folder
        The folder of the result.
    command
        The name of the command.
    reference
        The model.
    flags
        Flags that select files, as plain data.
    """
    place = folder / NAME
    if place.exists():
        place.unlink()
        print(f"warning: replacing {place}, the checkpoint of an unfinished search", file=sys.stderr)
    note = {
        "command": command,
        "model": reference.name,
        "file_hash": reference.file_hash,
        "flags": flags,
    }
    return Checkpoint(place, note=note)


def stopped_search(
    context: typer.Context, folder: Path, command: str, read: Callable[[dict[str, Any]], Flags]
) -> tuple[Search, ModelReference, Flags, Checkpoint]:
    """Return the stopped search of a folder: the search, its model, its flags about files, and the checkpoint.

    Parameters
    ----------
    context
        The context of the command.
    folder
        The folder of the search.
    command
        The name of the command.
    read
        Reads the flags about files from the checkpoint's data.

    Raises
    ------
    InputError
        Other flags beside `--resume`; no checkpoint in the folder, a damaged checkpoint, or a checkpoint of another
        command.
    """
    for parameter in context.command.params:
        source = context.get_parameter_source(parameter.name or "")
        if parameter.name not in BESIDE and source is not None and source.name == "COMMANDLINE":
            raise InputError(
                "flags-exclude",
                flag="--resume",
                other="MODEL" if parameter.name == "model" else parameter.opts[-1],
                reason="the search in the folder has its own settings",
                cure=f"`niwaki {command} --resume {folder}`, or start a new search without `--resume`",
            )
    place = folder / NAME
    if not place.is_file():
        raise InputError("no-checkpoint", path=place)
    with reading(place):
        note = fitted(Stored.read(place).note, Note)
        shell_note = note.own
        if shell_note is None or shell_note.command != command:
            other = f"niwaki {shell_note.command}" if shell_note else "Python"
            raise InputError(
                "bad-checkpoint", detail=f"{other} wrote `{place}`, and niwaki {command} cannot resume it"
            )
        search = Search.of_data(note.search)
        entry = gallery.entry(shell_note.model)
        reference = ModelReference(shell_note.model, search.model, entry, shell_note.file_hash)
        return search, reference, read(shell_note.flags), Checkpoint(place, note=asdict(shell_note))


@contextmanager
def report_interrupt(checkpoint: Checkpoint | None, command: str) -> Iterator[None]:
    """Print the command that resumes the search when Ctrl-C comes before there is a result."""
    try:
        yield
    except KeyboardInterrupt:
        if checkpoint is None or not Path(checkpoint.path).exists():
            raise
        print(interrupt_message(Path(checkpoint.path).parent, command), file=sys.stderr)
        raise typer.Exit(130) from None


def interrupt_message(folder: Path, command: str) -> str:
    """Return the last line of a search that was stopped."""
    return f"interrupted; resume with: niwaki {command} --resume {folder}"


@contextmanager
def remove_when_done(result: Result, checkpoint: Checkpoint | None) -> Iterator[None]:
    """Remove the checkpoint of a complete search after its files are written.

    The checkpoint also goes if a file cannot be written: run.json comes first, and `niwaki replay` writes the other
    files from it.
    """
    try:
        yield
    finally:
        if checkpoint is not None and not result.interrupted:
            Path(checkpoint.path).unlink(missing_ok=True)
