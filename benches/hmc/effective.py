"""Effective samples per second: the no-U-turn samplers with their own warm-ups, counted in; and the point's moments."""

import numpy as np
from chains.report import Report, short
from niwaki import diagnostics

from hmc import densities, peers
from hmc.ours import Programs
from hmc.peers import Run

WARMUP, DRAWS = 500, 1000


def effective_size(draws: np.ndarray) -> float:
    """The smallest bulk effective size over coordinates of one chain, (draws, dim)."""
    return min(diagnostics.ess_bulk(draws[None, :, k]) for k in range(draws.shape[1]))


def measure(report: Report, programs: Programs, models: tuple[str, ...], share: float) -> None:
    """One run of each system on each model."""
    table = report.table(
        f"NUTS, one chain, {int(share * WARMUP)} + {int(share * DRAWS)} transitions: effective samples",
        *("model", "system", "gradients", "seconds", "effective", "per second", "acceptance", "compile, s"),
    )
    versions = peers.versions()
    for model in models:
        point, sizes = densities.start(model), (int(share * WARMUP), int(share * DRAWS))
        runs: dict[str, tuple[Run, float]] = {"niwaki": (programs.nuts(model, point, *sizes, seed=5), 0.0)}
        if "numpyro" in versions:
            run, first = peers.numpyro_nuts(model, point, *sizes, seed=5)
            runs["NumPyro"] = run, first - run.seconds
        # A Python call for each gradient: the small densities show what it costs.
        if "nutpie" in versions and model != "stack":
            runs["nutpie"] = peers.nutpie_nuts(model, point, *sizes, seed=5), 0.0
        for name, (run, compiling) in runs.items():
            size = effective_size(run.draws)
            table.add_row(
                model if name == "niwaki" else "",
                name,
                short(run.gradients),
                f"{run.seconds:.2f}",
                f"{size:.0f}",
                short(size / run.seconds),
                f"{run.accept:.2f}",
                f"{compiling:.1f}" if compiling else "",
            )
            report.note(nuts=model, system=name, gradients=run.gradients, seconds=run.seconds, effective=size)
    report.show(table)


def moments(report: Report, programs: Programs, point: np.ndarray, draws: int) -> None:
    """The point's `x^2` and `y^2` against sums over a grid, in standard errors.

    With steps a quarter as long as those that are timed, ten times as many: where the curve bends most the longer ones
    are not stable, so that a chain of them hardly comes there, ours or any.
    """
    timed = densities.STEP_SIZES["ring"], densities.STEPS["ring"]
    densities.STEP_SIZES["ring"], densities.STEPS["ring"] = 0.0015, 1000
    try:
        compare(report, programs, point, draws)
    finally:
        densities.STEP_SIZES["ring"], densities.STEPS["ring"] = timed


def compare(report: Report, programs: Programs, point: np.ndarray, draws: int) -> None:
    """Our chain's moments and JAX's beside the exact ones."""
    x, y = np.meshgrid(np.linspace(-1.4, 1.4, 2801), np.linspace(-1.4, 1.4, 2801))
    log = densities.ring(np, np.array([x, y]))
    weight = np.exp(log - log.max())
    exact = [float((weight * z * z).sum() / weight.sum()) for z in (x, y)]
    runs = {"niwaki": programs.chain("ring", point, draws, seed=9).draws}
    if "jax" in peers.versions():
        runs["JAX"] = peers.Chains("ring", draws, 1, peers.raw)(point, 9).draws
    for name, run in runs.items():
        for k, expected in enumerate(exact):
            squares = run[None, :, k] ** 2
            off = abs(squares.mean() - expected) / diagnostics.mcse_mean(squares)
            report.answer(f"ring by {name}: mean of {'xy'[k]}^2, standard errors off", off, 4.5)
