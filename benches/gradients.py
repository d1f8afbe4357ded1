"""Chains that follow the gradient, beside JAX, NumPyro and nutpie (the peers) and gradients by hand (the limit).

    make bench-hmc                      # QUICK=1 for a run that shows no more than that everything runs
    .venv/bin/python benches/gradients.py [--quick] [--only answers,rates,starts,effective] [--out FOLDER]

Three densities (`hmc/densities.py`): a point near a curve, colours of 20 regions, a stack of blocks. All systems run on
one processor, in one process or a child of it, and take turns. Rates are by wall: run it where nothing else runs; rates
by CPU time stand beside them. Answers are checked before anything is timed. The target of each figure is printed
beside it. A speed below its target is reported; a wrong answer fails. Peers that are not installed are named.

Every measurement is a line of `gradients.jsonl` in the folder (`benches/.cache/gradients`).
"""

import argparse
import os
import sys
import time
from pathlib import Path

# One thread for all: XLA, BLAS and our chains share one processor, and JAX computes in double precision.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false")
os.environ.setdefault("JAX_ENABLE_X64", "1")
os.environ.setdefault("JAX_PLATFORMS", "cpu")

import numpy as np
from chains.report import Report
from hmc import densities, effective, peers, rates, starts
from hmc.ours import Programs
from machine import CACHE, machine

PARTS = ("answers", "rates", "starts", "effective")
#: Largest relative error of a value or a gradient against what is known.
ALLOWED = 1e-9


def main() -> int:
    """Measure the selected parts; 1 when an answer is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", default=os.environ.get("QUICK", "0") not in ("", "0"))
    parser.add_argument("--only", default=",".join(PARTS))
    parser.add_argument("--out", type=Path, default=CACHE / "gradients")
    options = parser.parse_args()
    parts, quick = options.only.split(","), options.quick
    report, programs = Report(options.out, "gradients"), Programs.prepared()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    versions = peers.versions()
    missing = [name for name in peers.NAMES if name not in versions]
    report.note(**machine(), load=os.getloadavg()[0], quick=quick, **versions)
    report.console.print(
        f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors; one of them is used; "
        + ", ".join(f"{name} {version}" for name, version in versions.items())
        + (f"; not installed, so left out: {', '.join(missing)}" if missing else "")
    )
    started = time.monotonic()
    models = ("ring", "coloring") if quick else ("ring", "coloring", "stack")
    share = 0.1 if quick else 1.0
    points = {model: rates.settled(programs, model) for model in models}
    compiling: dict[str, float] = {}
    for part in PARTS:
        if part not in parts:
            continue
        match part:
            case "answers":
                check(report, programs, versions)
                effective.moments(report, programs, points["ring"], 3_000 if quick else 10_000)
            case "rates":
                compiling = rates.measure(report, programs, points, 2 if quick else 5, share)
            case "starts":
                starts.measure(report, programs, 1 if quick else 5, compiling)
            case "effective":
                effective.measure(report, programs, models[:1] if quick else models, share)
        report.console.print(f"[dim]{part}: {time.monotonic() - started:.0f} s since the start[/dim]")
    return report.close()


def check(report: Report, programs: Programs, versions: dict[str, str]) -> None:
    """Values and gradients at points where they are known."""
    for model in densities.DIMS:
        for system, off in programs.check(model):
            report.answer(f"{model} by {system}: value, relative error", off["value"], ALLOWED)
            report.answer(f"{model} by {system}: gradient, relative error", off["gradient"], ALLOWED)
        if "jax" not in versions:
            continue
        import jax

        both = jax.value_and_grad(peers.log_density(model))
        worst = np.zeros(2)
        for x, value, gradient in densities.known(model):
            there, slope = both(x)
            apart = np.abs(np.asarray(slope) - gradient).max() / np.abs(gradient).max()
            worst = np.maximum(worst, (abs(float(there) / value - 1.0), apart))
        for quantity, error in zip(("value", "gradient"), worst, strict=True):
            report.answer(f"{model} by JAX: {quantity}, relative error", error, ALLOWED)


if __name__ == "__main__":
    sys.exit(main())
