"""The cost of a search: CPU seconds against particles and against primitives.

    .venv/bin/python benches/cost.py docs/pictures/cost.png [MEASUREMENTS.jsonl]

Two inputs. Ships of the gallery grown into their target, with 10 to 1000 particles. A spiral of n boxes grown into a
target that is made of one spiral, n = 20 to 2000: every box is one primitive and one barrier, so that everything a
search does for each primitive (copy, resample, voxelise, intersect) is done n times. Checks while it times: each spiral
has n primitives. Reports the exponent of a straight line through the logarithms: 1 is growth in proportion.
"""

import json
import sys
from math import cos, pi, sin
from pathlib import Path

import niwaki as nw
import numpy as np
from figures import cost
from machine import machine
from niwaki import box, emit, gaussian, model, uniform
from niwaki.gallery import entry
from niwaki.result import Result

SEEDS = (1, 2, 3)
PARTICLES = (10, 30, 100, 300, 1000)
PRIMITIVES = (20, 50, 100, 200, 500, 1000, 2000)

#: Population of the spirals, their radius, boxes in one turn, how far a turn rises, and the cell size.
POPULATION, RADIUS, TURN, RISE, VOXEL = 100, 8.0, 40, 1.5, 0.25

SHIP, SPIRAL = "a ship", f"a spiral of boxes, {POPULATION} particles"


@model
def spiral(n):
    """Put `n` boxes of uncertain size along a rising circle; neighbours never touch."""
    for k in range(n):
        angle = 2.0 * pi * k / TURN
        place = (
            RADIUS * cos(angle) + gaussian(0.0, 0.1),
            RISE * k / TURN,
            RADIUS * sin(angle) + gaussian(0.0, 0.1),
        )
        emit(box(place, (uniform(0.3, 0.7), uniform(0.3, 0.7), uniform(0.3, 0.7))))


def main(picture: Path, lines: Path | None) -> None:
    """Measure, draw, and print the exponents."""
    print(json.dumps(machine()))
    runs = [row for n in PRIMITIVES for row in spirals(n)] + ships()
    if lines is not None:
        lines.write_text("".join(json.dumps(run) + "\n" for run in runs))
    print(f"ships, particles {PARTICLES}: exponent {slope(runs, SHIP, 'particles'):.2f}")
    print(f"spirals, primitives {PRIMITIVES}: exponent {slope(runs, SPIRAL, 'primitives'):.2f}")
    cost(runs, picture, 80)


def ships() -> list[dict]:
    """The gallery's ship in its target."""
    ship = entry("spaceship")
    assert ship is not None
    target = ship.target()
    rows = []
    for particles in PARTICLES:
        for seed in SEEDS:
            result = nw.grow(ship.model, target, particles=particles, voxel=ship.voxel, seed=seed, threads=1)
            rows.append(row(SHIP, particles, result))
    return rows


def spirals(n: int) -> list[dict]:
    """A spiral of `n` boxes in a target that is another one."""
    vertices, faces = nw.run(spiral, n, seed=0).scene.merged(fine=False)
    target = nw.Target(vertices, faces, "spiral")
    rows = []
    for seed in SEEDS:
        result = nw.grow(spiral, target, n, particles=POPULATION, voxel=VOXEL, seed=seed, threads=1)
        assert result.best.primitives == n
        rows.append(row(SPIRAL, POPULATION, result))
    return rows


def row(series: str, particles: int, result: Result) -> dict:
    best = result.best
    return {
        "series": series,
        "particles": particles,
        "primitives": best.primitives,
        "cpu_seconds": best.cpu_seconds,
    }


def slope(runs: list[dict], series: str, size: str) -> float:
    """The exponent of the fit `cpu_seconds = constant * size ** exponent`."""
    chosen = [run for run in runs if run["series"] == series]
    sizes, seconds = (np.log([run[key] for run in chosen]) for key in (size, "cpu_seconds"))
    return float(np.polyfit(sizes, seconds, 1)[0])


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]) if len(sys.argv) > 2 else None)
