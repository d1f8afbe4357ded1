"""Variational inference beside NumPyro's AutoNormal and AutoMultivariateNormal, and BlackJAX's Pathfinder.

    make bench-vi                       # QUICK=1: ring and coloring, one run each
    .venv/bin/python benches/vi.py [--quick] [--models ring,coloring,stack] [--out FOLDER]

The three densities of `hmc/densities.py`. All systems run on one processor, in one process or a child of it. For each
family the bound is computed of the normals that a system has after more and more steps, by the same number of draws
of the same density. The bound to reach is that of our own default search. Printed are the bound at the end, and the
seconds until a normal is within 0.1 nat of the bound to reach: with compilation (for ours: recording) and without.
NumPyro starts at the point where ours starts, and takes the best of four learning rates.

Every measurement is a line of `vi.jsonl` in the folder (`benches/.cache/vi`).
"""

import argparse
import importlib.metadata
import math
import os
import statistics
import sys
import time
from pathlib import Path

# One thread for all: XLA, BLAS and our search share one processor, and JAX computes in double precision.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")
os.environ.setdefault("JAX_ENABLE_X64", "1")
os.environ.setdefault("JAX_PLATFORMS", "cpu")

from chains.report import Report, short
from hmc import densities
from hmc.ours import Programs, read, written
from machine import CACHE, machine
from normals import peers

FAMILIES = ("mean-field", "full-rank", "pathfinder")
#: Draws by which a bound is computed.
DRAWS = 20_000
#: How near a bound must be, nats.
NEAR = 0.1
#: Times faster than the peer, compilation included.
FASTER = 5.0
#: Steps after which normals are looked at.
LOOKS = [int(50 * 2 ** (k / 2)) for k in range(18)]
NAMES = ("jax", "numpyro", "blackjax")


def main() -> int:
    """Measure; 1 when an answer is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", default=os.environ.get("QUICK", "0") not in ("", "0"))
    parser.add_argument("--models", default="ring,coloring,stack")
    parser.add_argument("--out", type=Path, default=CACHE / "vi")
    options = parser.parse_args()
    report, programs = Report(options.out, "vi"), Programs.prepared()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    versions = {}
    for name in NAMES:
        try:
            versions[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
    report.note(**machine(), load=os.getloadavg()[0], quick=options.quick, **versions)
    missing = [name for name in NAMES if name not in versions]
    report.console.print(
        f"load average {os.getloadavg()[0]:.1f}; {versions}; not installed: {missing or 'none'}"
    )
    models = [model for model in options.models.split(",") if not (options.quick and model == "stack")]
    repeats = 1 if options.quick else 3
    table = report.table(
        "evidence bounds, and seconds to within 0.1 nat of ours",
        *("model", "family", "system", "bound", "steps", "seconds", "with compilation"),
    )
    for model in models:
        for family in FAMILIES:
            measure(report, table, programs, model, family, repeats, versions)
    report.show(table)
    return report.close()


def measure(
    report: Report,
    table: object,
    programs: Programs,
    model: str,
    family: str,
    repeats: int,
    found: dict[str, str],
) -> None:
    """One family on one model, by all systems."""
    start = densities.start(model)
    runs = [ours(programs, model, family, seed) for seed in range(1, repeats + 1)]
    bound = statistics.median(run["bound"] for run in runs)
    # What a person waits for is our whole search: it ends by itself.
    seconds = statistics.median(run["seconds"] for run in runs)
    whole = statistics.median(run["seconds"] + run["record_seconds"] for run in runs)
    for run in runs:
        report.note(model=model, family=family, system="niwaki", **run)
    steps = f"{statistics.median(run['steps'] for run in runs):.0f}"
    table.add_row(model, family, "niwaki", f"{bound:.2f}", steps, short(seconds), short(whole))
    systems = []
    if family == "pathfinder" and "blackjax" in found:
        systems.append(("BlackJAX", peers.pathfinder(model, start, DRAWS)))
    if family != "pathfinder" and "numpyro" in found:
        systems.append(("NumPyro", peers.autoguide(model, family, start, LOOKS, bound, NEAR, DRAWS)))
    for name, peer in systems:
        report.note(model=model, family=family, system=name, **peer)
        reached = peer["bound"] >= bound - NEAR
        rate = peer.get("rate")
        table.add_row(
            model,
            family,
            name if rate is None else f"{name}, rate {rate}",
            f"{peer['bound']:.2f}",
            str(peer["steps"]),
            short(peer["seconds"]) if reached else f"not in {short(peer['seconds'])}",
            short(peer["seconds"] + peer["compile_seconds"]),
        )
        report.ask(
            f"{model}, {family}: times faster than {name}, with compilation",
            (peer["seconds"] + peer["compile_seconds"]) / whole,
            least=FASTER,
        )
        report.ask(
            f"{model}, {family}: times faster than {name}, without", peer["seconds"] / seconds, least=1.0
        )
        report.ask(f"{model}, {family}: bound above {name}'s, nats", bound - peer["bound"], least=-NEAR)


def ours(programs: Programs, model: str, family: str, seed: int) -> dict[str, float]:
    """Our search, in a process of its own."""
    point = written(densities.start(model))
    found = read(programs.chains, "vi", model, point, family, 20_000, DRAWS, seed)
    assert math.isfinite(found["bound"]), found
    return found


if __name__ == "__main__":
    started = time.perf_counter()
    code = main()
    print(f"{time.perf_counter() - started:.0f} s")
    sys.exit(code)
