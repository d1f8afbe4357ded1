"""The cost of a primitive in a scene of many: the gnarly tree, made larger by its arguments.

The tree's least radius, and the coins for a side branch and for continuing, are arguments: SIZES makes trees of about
50, 200, 800 and 3200 segments. A population grows each, with a score of the volume that hardly selects, so that all
sizes cost what their segments cost. (Trees of thousands of segments all intersect themselves, so intersections are not
excluded; `controls.py` measures what those cost.) Reported are microseconds of one thread for each segment of the final
population. Then the memory of a thousand particles of a thousand primitives: how much the largest resident set of a
process grows over that of the same process with one particle.
"""

import os
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import niwaki as nw
from niwaki.gallery.gnarly_tree import ahead, behind_the_bend, gnarly_tree, on_the_bark
from niwaki.targets import examples as targets
from niwaki.words import Frame

#: By number of segments: least radius as a share of the trunk's, probability of a side branch, decay of continuing.
SIZES = {50: (0.12, 0.5, 0.1), 200: (0.04, 0.5, 0.1), 800: (0.016, 0.5, 0.1), 3200: (0.006, 0.5, 0.1)}
PARTICLES, SEEDS = 30, (1, 2, 3)
FLAT = 1.5
#: Particles and primitives of the largest population, and the megabytes that they may take.
LARGEST, MEGABYTES = (1000, 1000), 1000


@nw.model
def tower(n):
    """Pile up `n` turned boxes: every particle has as many primitives, all different."""
    for k in range(n):
        turn = nw.uniform(0.0, 1.5)
        size = (nw.uniform(0.5, 2.0), 0.1, nw.uniform(0.5, 2.0))
        nw.emit(nw.box((0.0, 0.05 + 0.1 * k, 0.0), size, rotation=nw.rotation(UP, turn)))


@nw.model
def pole(n):
    """Put up `n` tapering segments: a swaying stem, and on each of its segments a twig that is welded to its bark."""
    climb(0, n, Frame(nw.vec(0.0, 0.0, 0.0), UP, AWAY, 1.0))


@nw.model
def climb(k, n, start):
    """Grow from the `k`-th segment to the `n`-th."""
    if k < n:
        lean = nw.rotate(
            nw.rotate(UP, AWAY, nw.gaussian(0.0, 0.05)), nw.vec(1.0, 0.0, 0.0), nw.gaussian(0.0, 0.05)
        )
        side = nw.normalize(nw.cross(lean, AWAY))
        end = Frame(
            start.center + nw.uniform(3.0, 5.0) * lean, lean, nw.cross(side, lean), nw.uniform(0.8, 1.0)
        )
        split = behind_the_bend(start, end)
        nw.emit(nw.segment(start, split, end))
        base, bark = on_the_bark(split, end, nw.uniform(0.0, 6.0), nw.uniform(0.2, 0.3))
        tip = ahead(base, nw.gaussian(0.0, 0.1), nw.gaussian(0.0, 0.1), nw.uniform(1.0, 2.0), 0.1)
        nw.emit(nw.segment(base, behind_the_bend(base, tip), tip, bark))
        climb(k + 2, n, end)


UP, AWAY = nw.vec(0.0, 1.0, 0.0), nw.vec(0.0, 0.0, -1.0)
MODELS = {"turned boxes": tower, "welded segments": pole}


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Measure and print; the folder gets no picture of its own."""
    costs = []
    for size, habit in list(SIZES.items())[: 1 if quick else None]:
        grown, spent = [], 0.0
        for seed in SEEDS[: 1 if quick else None]:
            result = nw.run(
                gnarly_tree, *habit, method=nw.smc(PARTICLES), score=score(), seed=seed, threads=1
            )
            grown += [sample.primitives for sample in result]
            spent += result.cpu_seconds
        costs.append(1e6 * spent / sum(grown))
        mean = sum(grown) / len(grown)
        tell({"segments wanted": size, "mean segments": mean, "microseconds a segment": costs[-1]})
        print(
            f"trees of about {size:>5}: {mean:7.0f} segments, {costs[-1]:6.1f} us of CPU for each",
            flush=True,
        )
    print(f"largest over smallest: {max(costs) / min(costs):.2f}, target: at most {FLAT}")
    particles, primitives = (50, 50) if quick else LARGEST
    for solids in MODELS:
        for sigma, name in ((0.02, "selected as in a search"), (1e3, "none like another")):
            few, many = (resident(solids, count, primitives, sigma) for count in (1, particles))
            kept = {"particles": particles, "primitives": primitives, "solids": solids, "sigma": sigma}
            tell(kept | {"megabytes": many - few})
            text = f"{particles} particles of {primitives} {solids}, {name}: {many - few:.0f} MB"
            print(f"{text}, target: under {MEGABYTES}", flush=True)


def score() -> nw.Score:
    """Volume alone, so wide that it hardly selects: nearly everything that grows is still there in the end."""
    return nw.match_volume(targets.umbrella(), 0.4, 0.5)


def resident(solids: str, particles: int, primitives: int, sigma: float) -> float:
    """Largest resident set, megabytes, of a process that grows such a population."""
    program = f"import growth; growth.populate({solids!r}, {particles}, {primitives}, {sigma})"
    here = os.fspath(Path(__file__).parent)
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=here, check=True, capture_output=True, text=True
    )
    return float(done.stdout)


def populate(solids: str, particles: int, primitives: int, sigma: float) -> None:
    """Grow a population of such solids and print this process's largest resident set, megabytes."""
    score = nw.no_self_intersection() * nw.match_volume(targets.gem(), 0.4, sigma)
    method = nw.smc(particles)
    result = nw.run(
        MODELS[solids], primitives, method=method, score=score, seed=1, threads=1, max_memory=1 << 34
    )
    assert min(sample.primitives for sample in result) == primitives
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0)
