"""`niwaki check`: functions and choices of a model, with advice."""

from __future__ import annotations

import sys
import time
from collections import Counter
from typing import Annotated

import typer

from niwaki import lang, shell, targets
from niwaki.errors import InputError, ModelError
from niwaki.shell import arguments, compare, controls, reports
from niwaki.shell.app import Json, ModelName, app
from niwaki.shell.references import ModelReference


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
    as_json: Json = False,
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
    if as_json:
        for flag, value in (("--try", other), ("--target", target)):
            if value is not None:
                raise InputError(
                    "flags-exclude",
                    flag="--json",
                    other=flag,
                    reason="a comparison of two versions is a text",
                    cure="leave out one of the two",
                )
        print(reports.as_json(report(reference)))
        return
    described = report(reference)
    print(f"{reference.name}: compiled in {1e3 * (lowered + program.seconds):.1f} ms")
    print(f"  arguments   {described.arguments or 'none'}")
    print(f"  constants   {described.constants}")
    print(f"  functions   {len(described.functions)}")
    width = max(len(row.name) for row in described.functions)
    for function in described.functions:
        sites = f"{function.sites} site{'' if function.sites == 1 else 's'}" if function.sites else "pure"
        print(f"    {function.name:<{width}}  {sites}")
    print(f"  choices     {len(described.choices)}")
    for choice in described.choices:
        print(f"    {choice.function:<{width}}  {choice.choice:<20} line {choice.line}")
    if other is not None:
        score = targets.asks.score(controls.terms({"target": target}, reference))
        if score.target is None:
            raise InputError("no-target", name=reference.name)
        print(compare.compare(reference, shell.references.find(other), score))
        return
    if target is not None:
        reason = "it is the target of both versions"
        raise InputError("flag-alone", flag="--target", other="`--try`", reason=reason)
    for advice in described.advice:
        print(f"\n{advice.text}")


def report(reference: ModelReference) -> reports.CheckReport:
    """Compile a model, and report on it.

    Raises
    ------
    ModelError
        The model does not compile.
    """
    compiled, program = reference.model.core(), reference.model.program()
    inner: Counter[str] = Counter()
    for name, _, sites in program.functions:
        outer, _, part = name.partition("/")
        inner[outer] += sites if part else 0
    return reports.CheckReport(
        reference.name,
        arguments.described(reference.model) or "",
        len(compiled.constants),
        [
            reports.FunctionRow(name, 0 if kind == "pure" else sites + inner[name])
            for name, kind, sites in program.functions
            if "/" not in name
        ],
        [reports.ChoiceRow(name.split("/")[0], component, line) for name, component, line in program.choices],
        [
            reports.AdviceRow(advice.code, advice.span.line, str(advice))
            for advice in lang.advice.advise(reference.model.function)
        ],
    )
