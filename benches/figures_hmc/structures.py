"""Figures 4.8, 4.9, 4.11, 4.12, 4.13 and the table of 4.10: structures of blocks.

Chains come from `benches/stacks.py`, which keeps them beside the figures in FOLDER/stacks (STACKS names another
folder, such as the out/stacks of an earlier run) and continues where it stopped. The figures show draws chosen by a
rule, not by eye: those farthest apart among the draws that both judges pass.
"""

import os
from collections.abc import Callable
from pathlib import Path

import towers_and_arches as pages
from failures import failures
from stacking.kinds import KINDS
from stacking.table import HEAD, line, summary
from stacks import FOLLOWING, measure

#: Seconds of figure 4.10: burn-in and sampling, HMC and then MH, on a Core i7-3840QM of 2012, one thread.
PUBLISHED = {
    "stack": (36.30, 148.76, 30.57, 65.22),
    "lean": (27.90, 118.86, 24.10, 48.39),
    "top_heavy": (38.04, 186.62, 33.35, 58.48),
    "platforms": (62.54, 279.9, 62.52, 118.75),
    "wheel": (98.04, 729.54, 93.76, 688.70),
    "tri_arch": (95.5, 700.0, 94.90, 191.25),
}
#: Figures 4.8 and 4.9 compare with chains that do not follow the gradient.
COMPARED = tuple(PUBLISHED)
FOLLOWED = (
    *COMPARED,
    "symmetric_arch",
    "symmetric_tri_arch",
    "tilt_stack",
    "tilt_arch",
    "every_step",
    "cut_lean",
)


def draw(folder: Path, tell: Callable[[dict], None], quick: bool) -> None:
    """Draw and judge what is missing, then the pages and the table."""
    chains = Path(os.environ.get("STACKS") or folder / "stacks")
    draws, count, names = (3, 2, 1) if quick else (50, 4, None)
    for name in FOLLOWED[:names]:
        measure(name, FOLLOWING, chains, draws, range(count), 30 if quick else None)
    for sampler in ("mh-original", "mh-adaptive"):
        for name in COMPARED[:names]:
            measure(name, sampler, chains, count * draws, range(1), 200 if quick else None)
    print("\n".join(HEAD), flush=True)
    for sampler in (FOLLOWING, "mh-original", "mh-adaptive"):
        for name in FOLLOWED:
            row = summary(KINDS[name], sampler, chains)
            if row:
                tell(row)
                print(line(row), flush=True)
    seconds(folder, chains)
    pages.overview(folder / "structures.png", chains)
    pages.compared(folder / "figure-4-8.png", chains, ("stack", "lean", "top_heavy"))
    pages.compared(folder / "figure-4-9.png", chains, ("platforms", "wheel", "tri_arch"))
    pages.gallery(folder / "figure-4-11.png", chains, ("symmetric_arch", "symmetric_tri_arch"), azimuth=0.0)
    pages.tilted(folder / "figure-4-12.png", chains)
    pages.gallery(folder / "figure-4-13.png", chains, ("every_step",))
    failures(folder / "failures.png", chains)


def seconds(folder: Path, chains: Path) -> None:
    """The table of figure 4.10, with accepted and effective draws per CPU second."""
    lines = [
        "| program | choices | warm-up s | theirs | sampling s | theirs | acceptance | accepted /s | effective /s |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name, published in PUBLISHED.items():
        for sampler, (burn_in, sampling) in {
            FOLLOWING: published[:2],
            "mh-original": published[2:],
            "mh-adaptive": published[2:],
        }.items():
            numbers = summary(KINDS[name], sampler, chains)
            if numbers:
                spent = max(numbers["seconds"], 1e-9)
                before = numbers["start_seconds"] + numbers["warmup_seconds"]
                lines.append(
                    f"| {name} ({sampler}) | {numbers['choices']} | {before:.1f} "
                    f"| {burn_in} | {numbers['seconds']:.1f} | {sampling} | {numbers['acceptance']:.2f} "
                    f"| {numbers['acceptance'] * numbers['draws'] / spent:.2f} | {numbers['effective'] / spent:.2f} |"
                )
    (folder / "figure-4-10.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines), flush=True)
