"""The tree that should fit a bent tube with an egg-shaped crown: figure 3.5, on the gallery's gnarly tree.

A proposal to the trunk moves every segment above it, one to a twig moves one. So there is a bound on what skipping can
gain over running everything again: the number of segments over the mean number that a proposal moves, which the chain
counts as it shows them to its sketch of the volume. Each strategy makes the same proposals from the same state.
"""

import statistics
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from niwaki import _engine, kernels, match_volume, mh, run
from niwaki.draw.scene import Scene
from niwaki.gallery.gnarly_tree import gnarly_tree
from niwaki.targets.examples import bent_tube
from niwaki.targets.sketches import Score
from niwaki.targets.target import Target

from chains.ours import Timed
from chains.report import Report, middle, short

#: Radius at which branches end, as a share of the trunk's: the smaller, the larger the tree.
SMALLEST = (0.1, 0.06, 0.04)
STRATEGIES = ("c3", "resume", "cache", "rerun")
VOXEL = 0.4
#: The tree that is to be looked at: its limbs end while they are a quarter of the trunk, and most segments bear one.
LIMBS = (0.25, 0.8)
#: How strictly it is to fill the tube: a tenth of what the rates are measured with.
STRICT = 0.002


@dataclass(frozen=True)
class Measured:
    """One chain: mean number of segments, the bound, proposals per second by strategy."""

    smallest: float
    segments: float
    bound: float
    rates: dict[str, float]

    @property
    def gain(self) -> float:
        return self.rates["c3"] / self.rates["rerun"]


def score() -> Score:
    """How well a tree fills the tube."""
    return match_volume(bent_tube(), VOXEL)


def measured(smallest: float, seed: int, warmup: int, steps: int, windows: int = 4) -> Measured:
    """The four strategies after the same proposals, in turns; each makes the same ones."""
    target_score = score()
    chains = {
        strategy: Timed(gnarly_tree, smallest, strategy=strategy, seed=seed, score=target_score)
        for strategy in STRATEGIES
    }
    for chain in chains.values():
        chain.seconds(warmup)
    spent = dict.fromkeys(STRATEGIES, 0.0)
    segments = []
    before = chains["c3"].engine.counters()
    for _ in range(windows):
        for strategy, chain in chains.items():
            spent[strategy] += chain.seconds(steps // windows) - chain.floor
        segments.append(chains["c3"].engine.counters()["primitives"])
    after = chains["c3"].engine.counters()
    proposals = after["proposals"] - before["proposals"]
    # A moved segment is taken out and put in again.
    moved = (after["moved"] - before["moved"]) / 2 / proposals
    count = statistics.fmean(segments)
    rates = {strategy: proposals / seconds for strategy, seconds in spent.items()}
    return Measured(smallest, count, count / moved, rates)


def measure(report: Report, runs: int, quick: bool) -> list[Measured]:
    """Chains on trees of several sizes; answers what figure 3.5 shows."""
    warmup, steps = (200, 200) if quick else (300, 600)
    results = [
        measured(smallest, seed, warmup, steps) for smallest in SMALLEST for seed in range(1, runs + 1)
    ]
    columns = ("least radius", "segments", *STRATEGIES, "bound", "C3 / rerun", "of the bound")
    table = report.table(f"a tree in a bent tube: {steps} proposals after {warmup}, {runs} chains", *columns)
    for smallest in SMALLEST:
        rows = [result for result in results if result.smallest == smallest]
        table.add_row(
            short(smallest),
            middle([result.segments for result in rows]),
            *(middle([result.rates[strategy] for result in rows]) for strategy in STRATEGIES),
            middle([result.bound for result in rows]),
            middle([result.gain for result in rows]),
            middle([result.gain / result.bound for result in rows]),
        )
    report.show(table)
    for result in results:
        report.note(tree=result.smallest, segments=result.segments, bound=result.bound, rates=result.rates)
    report.ask(
        "tree: C3 over rerun, of the bound",
        statistics.median(result.gain / result.bound for result in results),
        least=0.7,
    )
    large = [result.gain for result in results if result.segments >= 150]
    if large:
        report.ask(
            f"tree of 150 segments or more ({len(large)} chains): C3 over rerun",
            statistics.median(large),
            least=10,
        )
    return results


def scene_of(target: Target) -> Scene:
    """A target as something to look at."""
    return Scene([("target", (_engine.shape("mesh", target.vertices, target.faces),))])


def fitted(folder: Path, proposals: int, chains: int = 4) -> Any:
    """The best tree of some long chains that cool down: hot ones find the bend, cold ones fill the crown."""
    moves = kernels.mixture(kernels.prior(), kernels.drift(0.3), kernels.regenerate(), weights=[3, 3, 1])
    kernel = kernels.anneal(moves, 4 * proposals // 5, 0.01, 1.0)
    method = mh(steps=proposals, chains=chains, keep=0, kernel=kernel, warmup=proposals // 10)
    target_score = match_volume(bent_tube(), VOXEL, STRICT)
    result = run(gnarly_tree, *LIMBS, method=method, score=target_score, seed=4, threads=1)
    best = result.best
    best.save(folder / "tree.png", size=(480, 640))
    return best
