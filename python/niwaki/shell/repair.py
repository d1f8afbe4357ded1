"""`niwaki repair`: a script that breaks requirements, repaired by few of its own numbers; written when accepted."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

import niwaki as nw
from niwaki.errors import InputError
from niwaki.repairing.result import Patch, Repair
from niwaki.repairing.search import Trial
from niwaki.shell.app import Json, Limit, Workers, app, counted
from niwaki.shell.progress import status_line
from niwaki.shell.requirements import NAME

Names = list[str] | None


@app.command()
def repair(
    script: Annotated[
        str,
        typer.Argument(
            metavar="SCRIPT", help="A Python script, file.py:function, or an OpenSCAD file. It is run."
        ),
    ],
    keep: Annotated[
        Path | None,
        typer.Option(
            "--keep", metavar="FILE", help="Requirements to keep. Default: requirements.toml beside it."
        ),
    ] = None,
    free: Annotated[
        Names,
        typer.Option(
            "--free",
            metavar="NAME",
            help="Sizes and counts that may change, too: of an argument, a variable, a called function, or a line.",
        ),
    ] = None,
    fix: Annotated[
        Names,
        typer.Option("--fix", metavar="NAME", help="Literals that stay, by a name or a line."),
    ] = None,
    words: Annotated[
        Names,
        typer.Option(
            "--words", metavar="A,B,...", help="Names that may replace one another in the script: LEFT,RIGHT."
        ),
    ] = None,
    patches: Annotated[
        int, typer.Option("--patches", metavar="N", help="Number of patches, which differ in what changes.")
    ] = 1,
    write: Annotated[
        int | None,
        typer.Option(
            "--write", metavar="N", help="Accept patch N, and write it without a question. The best is 1."
        ),
    ] = None,
    evaluations: Annotated[
        int, typer.Option("--evaluations", metavar="N", help="The most runs of the script.")
    ] = 100,
    workers: Workers = None,
    limit: Limit = 60.0,
    up: Annotated[
        str | None,
        typer.Option("--up", metavar="y|z", help="The axis that points up. Default: z for OpenSCAD, else y."),
    ] = None,
    target: Annotated[
        Path | None,
        typer.Option(
            "--target", metavar="FILE", help="A mesh to fill, of which `covered` and `outside` are shares."
        ),
    ] = None,
    as_json: Json = False,
) -> None:
    """Repair SCRIPT by few of its own numbers, so that it keeps its requirements. Shows a patch; writes it if accepted.

    Exit code 1: no patch repairs it; the reasons are printed.
    """
    with status_line(f"repairing {Path(script).name}") as show:
        result = nw.repair(
            script,
            requirements_of(script, keep),
            free=_names(free),
            fix=_names(fix),
            words=[entry.split(",") for entry in words or ()],
            patches=patches,
            evaluations=evaluations,
            workers=workers,
            limit=limit,
            up=up,
            target=target,
            progress=lambda trial: show(progress_text(trial)),
        )
    if as_json:
        print(json.dumps(result.report()))
    else:
        _print(result)
    chosen = write if write is not None or as_json else _choice(result)
    if chosen is not None:
        if not 1 <= chosen <= len(result.patches):
            raise InputError(
                "bad-setting",
                name="--write",
                found=str(chosen),
                expected=f"a patch, 1 to {len(result.patches)}"
                if result.patches
                else "no number: there is no patch",
                suggestion="1" if result.patches else "nothing",
            )
        result.patches[chosen - 1].apply()
        if not as_json:
            print(f"wrote {result.path}")
    if result.interrupted:
        print("stopped", file=sys.stderr)
        raise typer.Exit(130)
    if not result.repaired:
        raise typer.Exit(1)


def requirements_of(script: str, keep: Path | None) -> Path:
    """Return the file of the requirements: the one that is named, or the one beside the script.

    Raises
    ------
    InputError
        `bad-requirements`: there is none.
    """
    if keep is not None:
        return keep
    place = Path(script.rpartition(":")[0] or script).parent / NAME
    if not place.is_file():
        reason = f"there is no such file beside {script}; write it, or name another by --keep"
        raise InputError("bad-requirements", path=place, reason=reason)
    return place


def progress_text(trial: Trial) -> str:
    """Describe a run of the script."""
    state = trial.failed or f"{counted(len(trial.violations), 'violation')}"
    return f"run {trial.number + 1}: {state}"


def _names(words: Names) -> list[str | int]:
    """Return names and lines."""
    entries = [entry for word in words or () for entry in word.split(",") if entry]
    return [int(entry) if entry.isdigit() else entry for entry in entries]


def _print(result: Repair) -> None:
    if not result.before:
        print("nothing is violated")
        return
    for row in result.before:
        print(f"violated: {row}")
    for number, patch in enumerate(result.patches, start=1):
        print(f"\n{_title(number, patch)}\n{patch.difference()}", end="")
        for row in patch.violations:
            print(f"still violated: {row}")
    for conflict in result.conflicts:
        print(f"cannot be repaired: {conflict.reason}")
    print(f"\n{counted(result.evaluations, 'run')} of the script")
    for text, number in list(result.failures.items())[:3]:
        print(f"failed {number} times: {text}")


def _title(number: int, patch: Patch) -> str:
    state = "" if patch.repairs else ", repairs a part"
    far = f"parts move {100 * patch.moved:.2g} % of the scene"
    return f"patch {number}: {counted(patch.numbers, 'literal')}, {far}{state}"


def _choice(result: Repair) -> int | None:
    """Ask which patch is written; None if nobody can answer, or none is accepted."""
    if not result.patches or not (sys.stdin.isatty() and sys.stdout.isatty()):
        return None
    most = len(result.patches)
    answer = typer.prompt(
        "write it? (y/n)" if most == 1 else f"which is written? (1 to {most}, n)", default="n"
    )
    if answer.strip().lower() in ("y", "yes") and most == 1:
        return 1
    return int(answer) if answer.strip().isdigit() else None
