"""`niwaki check`: functions and choices of a model, with advice."""

from __future__ import annotations

import sys
import time
from collections import Counter
from typing import Annotated

import typer

from niwaki import lang, shell, targets
from niwaki.errors import InputError, ModelError
from niwaki.shell import arguments, compare, controls
from niwaki.shell.app import ModelName, app


@app.command()
def check(
    model: ModelName,
    values: arguments.Arguments = None,
    preset: arguments.Preset = None,
    core: Annotated[bool, typer.Option("--core", help="Print the core form.")] = False,
    bytecode: Annotated[bool, typer.Option("--bytecode", help="Print the bytecode.")] = False,
    other: Annotated[
        str | None,
        typer.Option(
            "--try",
            metavar="MODEL",
            help="Another version of the model; short searches tell which one is better.",
        ),
    ] = None,
    target: Annotated[
        str | None,
        typer.Option(
            "--target", metavar="FILE", help="A mesh to fill, with --try. Default: the model's target."
        ),
    ] = None,
) -> None:
    """Compile MODEL and report its functions and choices, with advice. Exit code 1: the model does not compile."""
    reference = shell.references.find(model)
    start = time.perf_counter()
    arguments.read(reference.model, values, preset)
    try:
        compiled = reference.model.core()
    except ModelError as error:
        print(error, file=sys.stderr)
        raise typer.Exit(1) from None
    lowered = time.perf_counter() - start
    program = reference.model.program()
    if core:
        print(compiled.text, end="")
    if bytecode:
        print(program.disassemble(), end="")
    if core or bytecode:
        return
    functions = [row for row in program.functions if "/" not in row[0]]
    print(f"{reference.name}: compiled in {1e3 * (lowered + program.seconds):.1f} ms")
    print(f"  arguments   {arguments.described(reference.model) or 'none'}")
    print(f"  constants   {len(compiled.constants)}")
    print(f"  functions   {len(functions)}")
    width = max(len(name) for name, _, _ in functions)
    inner: Counter[str] = Counter()
    for name, _, sites in program.functions:
        outer, _, part = name.partition("/")
        inner[outer] += sites if part else 0
    for name, kind, sites in functions:
        total = sites + inner[name]
        sites_text = "pure" if kind == "pure" else f"{total} site{'' if total == 1 else 's'}"
        print(f"    {name:<{width}}  {sites_text}")
    print(f"  choices     {len(program.choices)}")
    for name, component, line in program.choices:
        print(f"    {name.split('/')[0]:<{width}}  {component:<20} line {line}")
    if other is not None:
        score = targets.asks.score(controls.terms({"target": target}, reference))
        if score.target is None:
            raise InputError("no-target", name=reference.name)
        print(compare.compare(reference, shell.references.find(other), score))
        return
    if target is not None:
        reason = "it is the target of both versions"
        raise InputError("flag-alone", flag="--target", other="`--try`", reason=reason)
    for advice in lang.advice.advise(reference.model.function):
        print(f"\n{advice}")
