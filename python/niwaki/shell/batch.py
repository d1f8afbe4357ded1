"""`niwaki batch`: many searches into one folder, which goes on; and its results as files."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated, Any

import typer

from niwaki import batches
from niwaki.batches import clusters, export, plan, pools
from niwaki.errors import InputError
from niwaki.errors.files import ensure_folder
from niwaki.errors.settings import bad, count
from niwaki.inputs.modules import run_file
from niwaki.shell import batch_files, results
from niwaki.shell.app import app
from niwaki.shell.progress import batch_line, standing


class _Group(typer.core.TyperGroup):
    """What is no command is a file to run."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        if args and args[0] not in (*self.commands, "--help"):
            args = ["run", *args]
        return super().parse_args(ctx, args)


group = typer.Typer(
    cls=_Group,
    help="Do many searches on all processors or many machines, and go on with them: niwaki batch SPEC.toml.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.add_typer(group, name="batch")

#: How many of the best are drawn and written, when nothing is said.
BEST = 24


@group.command()
def run(
    spec: Annotated[
        Path, typer.Argument(metavar="SPEC", help="A TOML file: the model, seeds, and what varies.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FOLDER", help="Where results are; default: SPEC's name."),
    ] = None,
    processes: Annotated[
        int | None, typer.Option("--processes", help="How many; default: the processors of the machine.")
    ] = None,
    shard: Annotated[
        str | None, typer.Option("--shard", metavar="I/N", help="Only this part of the batch, such as 3/16.")
    ] = None,
    engine: Annotated[
        str | None,
        typer.Option(
            "--engine", metavar="NAME", help="Where searches run: local, ray, dask. Default: local."
        ),
    ] = None,
    address: Annotated[
        str | None,
        typer.Option("--address", help="Of a cluster that runs; default: processes of this machine."),
    ] = None,
    chunk: Annotated[
        float, typer.Option("--chunk", metavar="SECONDS", help="Searches that a worker gets at once.")
    ] = pools.TARGET,
) -> None:
    """Do the searches of SPEC that its folder does not have; the same command goes on after Ctrl-C or a kill."""
    if engine is not None and engine not in ("local", *clusters.ENGINES):
        raise bad("--engine", engine, f"one of local, {', '.join(clusters.ENGINES)}", "local")
    if address is not None and engine not in clusters.ENGINES:
        raise InputError(
            "flag-alone",
            flag="--address",
            other="`--engine ray` or `--engine dask`",
            reason="it is a cluster's",
        )
    part = plan.shard_of(shard)
    found = batch_files.load(spec)
    asked = found.table.spec(found.seeds)
    folder = Path(found.name) if output is None else output
    there = results.present(folder)
    if there and not batches.is_batch(folder):
        raise InputError("folder-has-results", path=folder, found=there)
    store = batches.Store(folder, asked)
    workers = count("--processes", batches.cores() if processes is None else processes, most=100_000)
    last: batches.Standing | None = None
    try:
        with ExitStack() as stack:
            executor = None
            if engine in clusters.ENGINES:
                executor = stack.enter_context(clusters.ENGINES[engine](workers, address))
            show = stack.enter_context(batch_line(found.name))

            def watch(now: batches.Standing) -> None:
                nonlocal last
                last = now
                show(now)

            done = failed = 0
            own = batches.Workers(executor, workers, chunk)
            for one in found.table.run(store, part, own, watch):
                done += 1
                failed += one.fault is not None
                if one.fault is not None and failed == 1:
                    print(f"warning: case {one.case}, seed {one.seed}: {one.message}", file=sys.stderr)
    except KeyboardInterrupt:
        again = " ".join(sys.argv[1:]) if sys.argv[1:2] == ["batch"] else f"batch {spec}"
        print(f"interrupted; go on with: niwaki {again}", file=sys.stderr)
        raise typer.Exit(130) from None
    if last is not None:
        print(standing(last))
    faults = f", {failed} of which failed" if failed else ""
    print(f"{done:,} search{'' if done == 1 else 'es'}{faults}; in {folder}")


@group.command("export")
def export_(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="The folder of a batch.")],
    as_csv: Annotated[bool, typer.Option("--csv", help="results.csv: a line for each search.")] = False,
    as_parquet: Annotated[
        bool, typer.Option("--parquet", help="results.parquet: the same (the extra parquet).")
    ] = False,
    sheet: Annotated[bool, typer.Option("--sheet", help="sheet.png: pictures of the best.")] = False,
    meshes: Annotated[bool, typer.Option("--glb", help="meshes/: the best as GLB files.")] = False,
    best: Annotated[
        int, typer.Option("--best", help="How many of the best are drawn, and written as GLB.")
    ] = BEST,
    choices: Annotated[
        bool, typer.Option("--choices", help="In the table, the choices of each best run, as JSON.")
    ] = False,
    trust: Annotated[
        list[Path] | None,
        typer.Option("--trust", metavar="FILE", help="Run this file: its host functions may be called."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Where to; default: FOLDER.")
    ] = None,
) -> None:
    """Write the results of FOLDER as files, and say how many there are, with a hash of all."""
    count("--best", best, most=10_000)
    store = batches.Store(folder)
    if not store:
        raise InputError("no-batch", path=folder)
    modules = tuple(Path(place).stem for place in trust or ())
    for place in trust or ():
        run_file(place.resolve())
    there = folder if output is None else ensure_folder(output)
    written: list[Path] = []
    if as_csv:
        written.append(export.write_csv(there / "results.csv", store, modules, choices))
    if as_parquet:
        written.append(export.write_parquet(there / "results.parquet", store, modules, choices))
    if sheet or meshes:
        found = export.best_of(store, best, modules)
        if sheet:
            written.append(export.write_sheet(there / "sheet.png", found))
        if meshes:
            written += export.write_meshes(there / "meshes", found)
    for place in written:
        print(place)
    print(f"{len(store):,} of {len(store.whole):,} searches, hash {store.hash()}")
