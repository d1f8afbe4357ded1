"""`niwaki batch`: many searches into one folder, which a later call resumes; and its results as files."""

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
from niwaki.shell import batch_files, folders, formats, results
from niwaki.shell.app import Runs, app
from niwaki.shell.progress import batch_line, batch_progress


class _Group(typer.core.TyperGroup):
    """A group of commands in which any other word is a batch file to run."""

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        if args and args[0] not in (*self.commands, "--help"):
            args = ["run", *args]
        return super().parse_args(ctx, args)


group = typer.Typer(
    cls=_Group,
    help="Run a batch of many searches, on all processors or many machines: niwaki batch SPEC.toml.",
    no_args_is_help=True,
    rich_markup_mode=None,
)
app.add_typer(group, name="batch")

#: Number of best results that are drawn and written by default.
BEST = 24

#: The formats, and the names of their files in a folder.
FORMATS = {"csv": "results.csv", "parquet": "results.parquet", "png": "sheet.png", "glb": "meshes"}


@group.command()
def run(
    spec: Annotated[
        Path,
        typer.Argument(
            metavar="SPEC", help="A TOML file with the model, the seeds, and the settings that vary."
        ),
    ],
    output: Annotated[str | None, folders.output("a folder with SPEC's name")] = None,
    processes: Annotated[
        int | None,
        typer.Option(
            "--processes",
            metavar="N",
            help="Number of worker processes. Default: the processors of the machine.",
        ),
    ] = None,
    shard: Annotated[
        str | None, typer.Option("--shard", metavar="I/N", help="Run only a part of the batch, such as 3/16.")
    ] = None,
    engine: Annotated[
        str | None,
        typer.Option(
            "--engine", metavar="local|ray|dask", help="Engine that runs the searches. Default: local."
        ),
    ] = None,
    cluster: Annotated[
        str | None,
        typer.Option(
            "--cluster",
            metavar="URL",
            help="Address of a running cluster. Default: processes of this machine.",
        ),
    ] = None,
    chunk: Annotated[
        float,
        typer.Option("--chunk", metavar="SECONDS", help="Seconds of searches that a worker gets at once."),
    ] = pools.TARGET,
) -> None:
    """Run the searches of SPEC that its folder lacks. The same command resumes after Ctrl-C or a kill."""
    if engine is not None and engine not in ("local", *clusters.ENGINES):
        raise bad("--engine", engine, f"one of local, {', '.join(clusters.ENGINES)}", "local")
    if cluster is not None and engine not in clusters.ENGINES:
        raise InputError(
            "flag-alone",
            flag="--cluster",
            other="`--engine ray` or `--engine dask`",
            reason="only these engines run on a cluster",
        )
    shard_part = plan.shard_of(shard)
    batch = batch_files.load(spec)
    table_spec = batch.table.spec(batch.seeds)
    folders.one_file(output, (), False)
    folder = Path(batch.name if output is None else output)
    if not batches.is_batch(folder):
        folders.refuse_existing(results.present(folder), False, "an empty folder, or a folder of a batch")
    store = batches.Store(folder, table_spec)
    workers = count("--processes", batches.cores() if processes is None else processes, most=100_000)
    last: batches.BatchProgress | None = None
    try:
        with ExitStack() as stack:
            executor = None
            if engine in clusters.ENGINES:
                executor = stack.enter_context(clusters.ENGINES[engine](workers, cluster))
            show = stack.enter_context(batch_line(batch.name))

            def watch(now: batches.BatchProgress) -> None:
                nonlocal last
                last = now
                show(now)

            done = failed = 0
            pool = batches.Workers(executor, workers, chunk)
            for outcome in batch.table.run(store, shard_part, pool, watch):
                done += 1
                failed += outcome.fault is not None
                if outcome.fault is not None and failed == 1:
                    print(
                        f"warning: case {outcome.case}, seed {outcome.seed}: {outcome.message}",
                        file=sys.stderr,
                    )
    except KeyboardInterrupt:
        again = " ".join(sys.argv[1:]) if sys.argv[1:2] == ["batch"] else f"batch {spec}"
        print(f"interrupted; resume with: niwaki {again}", file=sys.stderr)
        raise typer.Exit(130) from None
    if last is not None:
        print(batch_progress(last))
    faults = f" ({failed} failed)" if failed else ""
    print(f"{done:,} search{'' if done == 1 else 'es'}{faults}; files in {folder}")


@group.command("export")
def export_(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="The folder of a batch.")],
    file_formats: Annotated[
        str | None,
        typer.Option(
            "--format",
            metavar="LIST",
            help=f"Formats, with commas: {', '.join(FORMATS)}. Tables have all results, sheet and meshes the best.",
        ),
    ] = None,
    runs: Runs = BEST,
    choices: Annotated[
        bool,
        typer.Option(
            "--choices", help="Add a column to the table with the choices of each best run, as JSON."
        ),
    ] = False,
    model: Annotated[
        list[Path] | None,
        typer.Option(
            "--model", metavar="FILE", help="The Python file with the model's host functions. It is run."
        ),
    ] = None,
    output: Annotated[str | None, folders.output("FOLDER")] = None,
    force: folders.Force = False,
) -> None:
    """Write the results of FOLDER as files, and print their number and their hash."""
    count("--runs", runs, most=10_000)
    single_file = folders.one_file(output, ("csv", "parquet", "png"), force, format=file_formats)
    format_text = single_file.suffix if single_file else file_formats
    selected = () if format_text is None else formats.parse(format_text, FORMATS)
    store = batches.Store(folder)
    if not store:
        raise InputError("no-batch", path=folder)
    modules = tuple(Path(place).stem for place in model or ())
    for place in model or ():
        run_file(place.resolve())
    destination = folder if single_file or output is None else ensure_folder(Path(output))
    places = {name: single_file or destination / FORMATS[name] for name in selected}
    folders.refuse_existing([] if single_file else places.values(), force)
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
