"""Discrete and continuous choices in one chain: the palettes of `niwaki.gallery.harmonies` by several kernels.

    python benches/mixed.py [SECONDS]

Each kernel has the same CPU time, 10 seconds by default. Printed are its proposals a second, gradients a
second, structures recorded, how often the scheme changed from one kept state to
the next, and effective samples a second of the main hue (its sine and cosine, the smaller) and of the log score.
"""

from __future__ import annotations

import itertools
import math
import sys

import niwaki as nw
import numpy as np
from niwaki import diagnostics, kernels
from niwaki.gallery.harmonies import BOTH, KERNEL, harmonies

RUNGS = tuple(4.0**-k for k in range(6))
LABELS = kernels.repeat(3, kernels.on(["scheme", "of"], kernels.prior()))
KERNELS = {
    "mh": kernels.prior(),
    "mh and hmc": BOTH,
    "mh, tempered": kernels.tempering(kernels.prior(), RUNGS, every=8),
    "mh and drift, tempered": kernels.tempering(
        kernels.cycle(LABELS, kernels.repeat(5, kernels.drift())), RUNGS, every=8
    ),
    "mh and hmc, tempered": KERNEL,
    "mh and nuts, tempered": kernels.tempering(
        kernels.cycle(LABELS, kernels.nuts_step(max_depth=6)), RUNGS, every=8
    ),
}
THIN = 10


def measured(kernel: kernels.Kernel, seconds: float) -> list[str]:
    """A row of the table."""
    trial = nw.run(harmonies, nw.mh(steps=4000, warmup=2000, kernel=kernel), seed=2)
    steps = max(8000, int(4000 * seconds / trial.cpu_seconds))
    result = nw.run(harmonies, nw.mh(steps=steps, warmup=steps // 5, thin=THIN, kernel=kernel), seed=1)
    schemes = [sample.value[0] for sample in result]
    hue = 2 * math.pi * np.array([nw.words.to_hsv(sample.value[1][0]).x for sample in result])
    score = np.array([sample.log_score for sample in result])
    hues = min(diagnostics.ess_bulk(wave(hue)[None]) for wave in (np.sin, np.cos))
    gradients = sum(trajectory.gradients for trajectory in result.trajectories)
    time = result.cpu_seconds
    changes = sum(a != b for a, b in itertools.pairwise(schemes))
    return [
        f"{steps / time:.0f}",
        f"{gradients / time:.0f}",
        f"{sum(trajectory.structures for trajectory in result.trajectories)}",
        f"{changes / time:.1f}",
        f"{hues / time:.1f}",
        f"{diagnostics.ess_bulk(score[None]) / time:.1f}",
    ]


def main(seconds: float) -> None:
    """Print the table."""
    heads = ["proposals/s", "gradients/s", "structures", "schemes/s", "ESS/s hue", "ESS/s score"]
    print(f"{'kernel':>24s} " + " ".join(f"{head:>15s}" for head in heads))
    for name, kernel in KERNELS.items():
        print(f"{name:>24s} " + " ".join(f"{cell:>15s}" for cell in measured(kernel, seconds)), flush=True)


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 10.0)
