"""The picture of the manual's page: normals of each family on a correlated and on a bent density, and their bounds.

.venv/bin/python benches/normals/picture.py [FILE]            # docs/pictures/vi.png
"""

import math
import sys
import warnings
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import niwaki as nw
import numpy as np
from niwaki import model
from niwaki.result.hmc import GradientWarning

FAMILIES = {"mean-field": "tab:orange", "full-rank": "tab:blue", "pathfinder": "tab:green"}


@model
def tilted():
    x = nw.gaussian(0.0, 1.0)
    y = nw.gaussian(0.0, 1.0)
    nw.factor(-6.0 * (x - y) ** 2)
    return x


@model
def funnel():
    x = nw.gaussian(0.0, 1.5)
    nw.gaussian(0.0, math.exp(1.7 * x))
    return x


def main() -> None:
    file = Path(
        sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2] / "docs" / "pictures" / "vi.png"
    )
    figure, axes = plt.subplots(1, 3, figsize=(10.0, 3.4), layout="constrained")
    for axis, density, reach in ((axes[0], tilted, 2.2), (axes[1], funnel, 4.0)):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", GradientWarning)
            results = {
                family: nw.run(density, method=nw.vi(family, paths=1, draws=4000), seed=1)
                for family in FAMILIES
            }
        contours(axis, density, reach)
        for family, result in results.items():
            mean, cover = result.means[0], result.covariances[0]
            cover = np.diag(cover) if cover.ndim == 1 else cover
            turn = np.linspace(0.0, 2.0 * np.pi, 200)
            ring = 2.0 * np.linalg.cholesky(cover) @ np.array([np.cos(turn), np.sin(turn)])
            axis.plot(
                *(mean[:, None] + ring), color=FAMILIES[family], label=f"{family}, k-hat {result.k_hat:.2f}"
            )
        axis.set(xlim=(-reach, reach), ylim=(-reach, reach), title=density.name)
        axis.legend(fontsize=7, loc="upper left")
        if density is tilted:
            for family in ("mean-field", "full-rank"):
                bounds = results[family].bounds[0]
                axes[2].plot(bounds, color=FAMILIES[family], lw=0.8, label=family)
            axes[2].axhline(-0.5 * math.log(25.0), color="black", lw=0.8, ls="--", label="log evidence")
            axes[2].set(title="bound by step, tilted, nats", xlabel="step")
            axes[2].legend(fontsize=7, loc="lower right")
    figure.savefig(file, dpi=72)
    print(f"{file}: {file.stat().st_size} bytes")


def contours(axis: plt.Axes, density: object, reach: float) -> None:
    """The density over its two coordinates."""
    log = nw.log_density(nw.run(density, seed=1).best)
    grid = np.linspace(-reach, reach, 120)
    height = np.array([[log(np.array([x, y])) for x in grid] for y in grid])
    axis.contourf(grid, grid, np.exp(height - height.max()), levels=8, cmap="Greys")


if __name__ == "__main__":
    main()
