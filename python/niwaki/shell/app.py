"""The application, and the options that commands share.

Results go to files and stdout, progress and warnings to stderr.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Annotated, Any

import typer

#: The commands and their help. The module of a command is loaded when the command is used.
COMMANDS = {
    "init": "Write a folder to begin with: a model, its target, requirements, a test.",
    "models": "List the gallery: name, how to run it, target, title.",
    "show": "Draw runs of a model side by side, with no target.",
    "grow": "Grow a model into its target.",
    "fit": "Fit the parameters of a function that returns a mesh, or of an OpenSCAD or Blender file, to a target.",
    "repair": "Change few numbers of a script so that what it makes keeps requirements.",
    "batch": "Run a batch of many searches, on all processors or many machines; a stopped batch resumes.",
    "replay": "Write a stored result again, in any format.",
    "check": "Compile a model; report its functions and choices, with advice.",
    "sample": "Sample a model by Markov chains.",
    "color": "Colour a drawing, in several ways that differ.",
    "letters": "Write a text in vines or lightning.",
    "guide": "Train a guide for a model, or show what a guide sees.",
    "studio": "Open a page in the browser: search, hold parts, grow the rest again.",
    "mcp": "Serve the studio's messages as tools (MCP) to a program that writes models.",
    "explain": "Draw which calls of a model each strategy runs again for one proposal.",
    "doctor": "Report versions, the machine and optional packages, and test the core.",
}


class _Commands(typer.core.TyperGroup):
    """A group of commands, each of which is loaded from the module of its name when it is used."""

    def list_commands(self, ctx: Any) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        if cmd_name not in COMMANDS:
            return None
        import_module(f"niwaki.shell.{cmd_name}")
        return typer.main.get_group(app).commands[cmd_name]

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            print("stopped", file=sys.stderr)
            raise typer.Exit(130) from None

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


app = typer.Typer(
    name="niwaki",
    cls=_Commands,
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


@app.callback()
def niwaki() -> None:
    """Grow procedural models into given shapes."""


ModelName = Annotated[
    str, typer.Argument(metavar="MODEL", help="A gallery name, or file.py:function. The Python file is run.")
]
#: An option that several commands share is defined once, so that it means the same everywhere.
Runs = Annotated[int, typer.Option("-n", "--runs", metavar="N", help="Number of results.")]
Seed = Annotated[
    int | None,
    typer.Option(
        "--seed", metavar="N", help="Seed of the random stream. Default: a new seed, which is printed."
    ),
]
Threads = Annotated[
    int | None,
    typer.Option(
        "--threads", metavar="N", help="Number of threads; results do not depend on it. Default: all cores."
    ),
]
Verbose = Annotated[
    bool, typer.Option("--verbose", help="Print log scores and the steps of the search, too.")
]
Json = Annotated[bool, typer.Option("--json", help="Print JSON. Files are then written only with -o.")]

Workers = Annotated[
    int | None,
    typer.Option("--workers", metavar="N", help="Processes that evaluate. Default: one for each processor."),
]
Limit = Annotated[
    float,
    typer.Option(
        "--limit", metavar="S", help="Seconds of one evaluation, until ten are known: then ten medians."
    ),
]

Megabytes = Annotated[
    int,
    typer.Option(
        "--max-memory", metavar="MB", min=1, help="Memory limit of a run or a population, in megabytes."
    ),
]


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, in the plural where needed: `3 primitives`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"
