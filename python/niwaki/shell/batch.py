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
from niwaki.shell import batch_files, folders, results, writing
from niwaki.shell.app import Runs, app
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

#: What can be written, and the names in a folder.
FORMATS = {"csv": "results.csv", "parquet": "results.parquet", "png": "sheet.png", "glb": "meshes"}


@group.command()
def run(
    spec: Annotated[
        Path, typer.Argument(metavar="SPEC", help="A TOML file: the model, seeds, and what varies.")
    ],
    output: Annotated[str | None, folders.output("a folder with SPEC's name")] = None,
    processes: Annotated[
        int | None,
        typer.Option("--processes", metavar="N", help="How many. Default: the processors of the machine."),
    ] = None,
    shard: Annotated[
        str | None, typer.Option("--shard", metavar="I/N", help="Only this part of the batch, such as 3/16.")
    ] = None,
    engine: Annotated[
        str | None,
        typer.Option("--engine", metavar="local|ray|dask", help="Where searches run. Default: local."),
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option("--cluster", metavar="URL", help="One that runs. Default: processes of this machine."),
    ] = None,
    chunk: Annotated[
        float, typer.Option("--chunk", metavar="SECONDS", help="Searches that a worker gets at once.")
    ] = pools.TARGET,
) -> None:
    """Do the searches of SPEC that its folder does not have; the same command goes on after Ctrl-C or a kill."""
    if engine is not None and engine not in ("local", *clusters.ENGINES):
        raise bad("--engine", engine, f"one of local, {', '.join(clusters.ENGINES)}", "local")
    if cluster is not None and engine not in clusters.ENGINES:
        raise InputError(
            "flag-alone",
            flag="--cluster",
            other="`--engine ray` or `--engine dask`",
            reason="it is where the engine runs",
        )
    part = plan.shard_of(shard)
    found = batch_files.load(spec)
    asked = found.table.spec(found.seeds)
    folders.one_file(output, (), False)
    folder = Path(found.name if output is None else output)
    if not batches.is_batch(folder):
        folders.taken(results.present(folder), False, "one where a batch is, or nothing")
    store = batches.Store(folder, asked)
    workers = count("--processes", batches.cores() if processes is None else processes, most=100_000)
    last: batches.Standing | None = None
    try:
        with ExitStack() as stack:
            executor = None
            if engine in clusters.ENGINES:
                executor = stack.enter_context(clusters.ENGINES[engine](workers, cluster))
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
    formats: Annotated[
        str | None,
        typer.Option(
            "--format",
            metavar="LIST",
            help=f"Which files, with commas: {', '.join(FORMATS)}; tables of all, a sheet and meshes of the best.",
        ),
    ] = None,
    runs: Runs = BEST,
    choices: Annotated[
        bool, typer.Option("--choices", help="In the table, the choices of each best run, as JSON.")
    ] = False,
    model: Annotated[
        list[Path] | None,
        typer.Option(
            "--model", metavar="FILE", help="The Python file with the model's host functions; it is run."
        ),
    ] = None,
    output: Annotated[str | None, folders.output("FOLDER")] = None,
    force: folders.Force = False,
) -> None:
    """Write the results of FOLDER as files, and say how many there are, with a hash of all."""
    count("--runs", runs, most=10_000)
    alone = folders.one_file(output, ("csv", "parquet", "png"), force, format=formats)
    wanted = alone.suffix if alone else formats
    chosen = () if wanted is None else writing.listed(wanted, FORMATS)
    store = batches.Store(folder)
    if not store:
        raise InputError("no-batch", path=folder)
    modules = tuple(Path(place).stem for place in model or ())
    for place in model or ():
        run_file(place.resolve())
    there = folder if alone or output is None else ensure_folder(Path(output))
    places = {one: alone or there / FORMATS[one] for one in chosen}
    folders.taken([] if alone else places.values(), force)
    written: list[Path] = []
    if "csv" in places:
        written.append(export.write_csv(places["csv"], store, modules, choices))
    if "parquet" in places:
        written.append(export.write_parquet(places["parquet"], store, modules, choices))
    best = export.best_of(store, runs, modules) if {"png", "glb"} & set(places) else []
    if "png" in places:
        written.append(export.write_sheet(places["png"], best))
    if "glb" in places:
        written += export.write_meshes(places["glb"], best)
    for place in written:
        print(place)
    print(f"{len(store):,} of {len(store.whole):,} searches, hash {store.hash()}")
