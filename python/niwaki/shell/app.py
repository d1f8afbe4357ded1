"""The application, and what the commands share.

Results go to files and stdout, progress and warnings to stderr.
"""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Annotated, Any

import typer

#: The commands and what they do. The module of a command is loaded when the command is used.
COMMANDS = {
    "models": "List the gallery: name, how to run it, target, title.",
    "show": "Draw runs of a model side by side, with no target.",
    "grow": "Grow a model into its target.",
    "batch": "Do many searches on all processors or many machines, and go on with them.",
    "replay": "Write the best result of a search again, in any format.",
    "check": "Compile a model and report what it is made of, with advice.",
    "sample": "Sample a model by Markov chains.",
    "color": "Colour a drawing in ways that differ.",
    "letters": "Write a text in vines or lightning.",
    "guide": "Train guides, and show what they see.",
    "studio": "Open a page to search, hold parts and grow the rest again.",
    "explain": "Draw what each strategy runs again for one proposal.",
    "doctor": "Report what is installed, what works, and what is missing for what.",
}


class _Commands(typer.core.TyperGroup):
    """The commands, each loaded from the module of its name when it is used."""

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
    str, typer.Argument(metavar="MODEL", help="A gallery name, or file.py:function; the file is run.")
]
#: What several commands have is one option, so that it means the same everywhere.
Runs = Annotated[int, typer.Option("-n", "--runs", metavar="N", help="How many results.")]
Seed = Annotated[
    int | None,
    typer.Option("--seed", metavar="N", help="The random stream. Default: a new one, which is printed."),
]
Threads = Annotated[
    int | None,
    typer.Option("--threads", metavar="N", help="Default: all cores. Results do not depend on it."),
]
Json = Annotated[bool, typer.Option("--json", help="Print JSON; files are written only with -o.")]

Megabytes = Annotated[
    int,
    typer.Option(
        "--max-memory", metavar="MB", min=1, help="Most memory of a run or a population, megabytes."
    ),
]


def counted(number: int, what: str) -> str:
    """A number of things, as a sentence has it."""
    return f"{number} {what}{'' if number == 1 else 's'}"
