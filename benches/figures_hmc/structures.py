"""Figures 4.8, 4.9, 4.11 to 4.13 and the table of 4.10: structures of blocks."""

from collections.abc import Callable
from pathlib import Path

import niwaki as nw
from niwaki import stacks
from niwaki.draw.sheet import sheet


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Draw what a chain can start from: three towers."""
    found = []
    for seed in range(1 if quick else 3):
        density, x = stacks.start(stacks.stack, seed=seed, width=0.005)
        sample = nw.run(stacks.stack, choices=density.values(x)).best
        balance = stacks.balanced(stacks.Structure.of(sample))
        tell({"model": "stack", "seed": seed, "residual": balance.residual, "margin": balance.margin})
        found.append(sample.scene)
    sheet(found, size=(480, 480), azimuth=32.0, elevation=14.0).save(folder / "figure-4-8.png")
