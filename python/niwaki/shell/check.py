"""`niwaki check`: functions and choices of a model, with advice."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from niwaki import lang, shell, targets
from niwaki.errors import InputError, ModelError, NiwakiError
from niwaki.inputs.modules import modules
from niwaki.requirements.rows import RequirementRow
from niwaki.result import Sample
from niwaki.shell import arguments, compare, controls, reports, run_files, trust
from niwaki.shell.app import Json, ModelName, app
from niwaki.shell.references import ModelReference

#: Runs without a target that are held against requirements, and the seed of the first.
RUNS, SEED = 20, 1


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
    result: Annotated[
        Path | None,
        typer.Option(
            "--result",
            metavar="RUN.JSON",
            help="A result of the model; its best run is held against requirements.toml beside the model.",
        ),
    ] = None,
    as_json: Json = False,
) -> None:
    """Compile MODEL and report its functions and choices, with advice and the requirements beside it.

    Exit code 1: the model does not compile, or the result of --result does not keep its requirements.
    """
    reference = shell.references.find(model)
    start = time.perf_counter()
    named = arguments.read(reference.model, values, preset)
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
        described = report(reference, None if result is None else _run_of(result), named)
        print(reports.as_json(described))
        if any(row.holds is False for row in described.requirements):
            raise typer.Exit(1)
        return
    described = report(reference, None if result is None else _run_of(result), named)
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
    for row in described.requirements:
        state = {True: "holds", False: "does not hold", None: ""}[row.holds]
        print(f"  requires    {row.text}: {' '.join(filter(None, (state, f'({row.value})')))}")
    for advice in described.advice:
        print(f"\n{advice.text}")
    if any(row.holds is False for row in described.requirements):
        raise typer.Exit(1)


def _run_of(place: Path) -> Sample:
    """Replay the best run of a run.json; modules that this command has run may be called."""
    data = run_files.load(place)
    loaded = {module for module, _, _ in trust.hosts(data["search"]) if modules(module)}
    return run_files.replayed(data, None, tuple(sorted(loaded)), place)


def report(
    reference: ModelReference, sample: Sample | None = None, values: Mapping[str, Any] | None = None
) -> reports.CheckReport:
    """Compile a model, and report on it.

    Parameters
    ----------
    reference
        The model.
    sample
        The run to hold against the requirements beside the model; when left out, runs without a target tell how
        often each requirement holds.
    values
        Arguments of the model for these runs.

    Raises
    ------
    ModelError
        The model does not compile.
    InputError
        `bad-requirements`.
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
        _requirements(reference, sample, values or {}),
    )


def _requirements(
    reference: ModelReference, sample: Sample | None, values: Mapping[str, Any]
) -> list[RequirementRow]:
    """Hold a run against the requirements beside a model, or runs without a target."""
    rules = shell.requirements.beside(reference)
    if rules is None:
        return []
    if sample is not None:
        return rules.judged(sample)
    try:
        runs = shell.show.prior_runs(reference.model, {**shell.show.start(reference), **values}, RUNS, SEED)
    except NiwakiError:
        # The model needs arguments, or no run is possible.
        return rules.rows()
    return rules.over(runs)
