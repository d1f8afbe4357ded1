"""Figures 4.2 and 4.3: a point near a curve, by MH and by HMC, and the autocorrelation of their draws.

The original's settings: 2000 draws of HMC with 100 steps; 2000 of MH, every 200th of a random walk with a fixed width
of 1.2 where the curve is wide (0.1) and of 0.04 where it is narrow (0.005). Each chain's autocorrelation is by its
own mean and variance; the dissertation takes those of HMC for both.
"""

import time
from collections.abc import Callable
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import niwaki as nw
import numpy as np
import original
from niwaki import diagnostics
from niwaki.gallery.point import point

WIDE, NARROW = 0.1, 0.005
WALK = {WIDE: 1.2, NARROW: 0.04}
BOUNDS, EDGE, GRID = (-1.5, 1.5), 1.15, 0.005
DRAWS, STEPS, LAGS = 2000, 100, 200


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Both figures, and each chain's effective sample size."""
    draws = 100 if quick else DRAWS
    results = {}
    for width in (WIDE, NARROW):
        density = nw.log_density(nw.run(point, width, seed=1).best)
        walk = WALK[width]
        results["MH", width] = timed(
            tell,
            f"MH, width {width}",
            2 * STEPS * draws,
            lambda density=density, walk=walk: original.mh(
                density.value_and_gradient,
                density.start,
                2 * STEPS * draws,
                2,
                BOUNDS,
                walk,
                2 * STEPS,
                adapts=False,
            ),
        )
    density = nw.log_density(nw.run(point, NARROW, seed=1).best)
    results["HMC", NARROW] = timed(
        tell,
        f"HMC, width {NARROW}",
        STEPS * draws,
        lambda: original.hmc(density.value_and_gradient, density.start, draws, STEPS, 2),
    )
    start = time.process_time()
    ours = nw.run(point, NARROW, method=nw.nuts(draws, chains=1), seed=2, threads=1)
    xy = np.stack([ours.draws[name][0] for name in ours.draws], axis=1)
    row(tell, f"NUTS, width {NARROW}", xy, ours.gradients, time.process_time() - start, None)
    results["NUTS", NARROW] = xy
    samples(results).savefig(folder / "figure-4-2.png", dpi=110)
    correlations(results).savefig(folder / "figure-4-3.png", dpi=110)
    plt.close("all")


def timed(tell: Callable[[dict], None], name: str, evaluations: int, sampler: Callable) -> np.ndarray:
    """Values of a chain's draws, (draws, 2), reported."""
    start = time.process_time()
    coordinates, accepted = sampler()
    spent = time.process_time() - start
    low, high = BOUNDS
    xy = low + (high - low) / (1.0 + np.exp(-coordinates))
    row(tell, name, xy, evaluations, spent, accepted)
    return xy


def row(
    tell: Callable[[dict], None], name: str, xy: np.ndarray, evaluations: int, spent: float, accepted
) -> None:
    """The effective sample size of a chain."""
    effective = diagnostics.ess_vector(xy)
    tell(
        {
            "chain": name,
            "draws": len(xy),
            "evaluations": evaluations,
            "cpu": round(spent, 3),
            "accepted": accepted,
            "effective": round(effective, 1),
        }
    )
    print(f"{name:22} {evaluations:8} evaluations, {effective:7.1f} effective draws", flush=True)


def samples(results: dict) -> plt.Figure:
    """Figure 4.2: densities on the left, draws coloured by time on the right."""
    grid = np.arange(-EDGE, EDGE + GRID, GRID)
    x, y = np.meshgrid(grid, grid)
    figure, axes = plt.subplots(2, 4, figsize=(11.2, 5.9), layout="constrained")
    for axis in axes.flat:
        axis.set(xticks=[], yticks=[], aspect="equal", xlim=(-EDGE, EDGE), ylim=(-EDGE, EDGE))
    for line, width in enumerate((WIDE, NARROW)):
        away = (y**4 - y**2 + x**2 - 0.25) / width
        extent = (-EDGE, EDGE, -EDGE, EDGE)
        axes[line, 0].imshow(np.exp(-0.5 * away**2), cmap="Greys", extent=extent, origin="lower")
        axes[line, 0].set_title(f"density, width {width}")
        for column, name in enumerate(("MH", "HMC", "NUTS"), 1):
            if (name, width) not in results:
                axes[line, column].set_axis_off()
                continue
            xy = results[name, width]
            axes[line, column].scatter(*xy.T, c=np.arange(len(xy)), cmap="turbo", s=4, linewidths=0)
            axes[line, column].set_title(f"{name}, {len(xy)} draws")
    return figure


def correlations(results: dict) -> plt.Figure:
    """Figure 4.3: autocorrelations for the narrow curve."""
    figure, axes = plt.subplots(figsize=(6.4, 3.4), layout="constrained")
    axes.axhline(0.0, color="0.6", linewidth=0.8)
    for name, color in (("MH", "#3a923a"), ("HMC", "#3274a1"), ("NUTS", "#c03d3e")):
        lags = diagnostics.autocorrelation(results[name, NARROW])[:LAGS]
        axes.plot(lags, color=color, label=name)
    axes.set(xlabel="lag, draws", ylabel="autocorrelation", ylim=(-0.4, 1.05))
    axes.legend(frameon=False)
    return figure
