"""Metropolis-Hastings that runs again only what changed, beside WebPPL (the peer) and chains by hand (the limit).

    make bench-c3                       # QUICK=1 for two minutes that show no more than that everything runs
    .venv/bin/python benches/c3.py [--quick] [--only answers,sizes,forms,tree,figures] [--out FOLDER]

Hidden Markov model, topics, mixture, regression (dissertation, appendix A) at sizes 1, 4, 10: proposals per CPU second
of our four strategies, of WebPPL's MH and incrementalMH, and of the limit, on one thread, taking turns, with the same
proposals; then variants of a program, global choices, long chains, a tree, and the figures of section 3.4.
Answers are checked before anything is timed. The target of each figure is printed beside it; a speed below its target
is reported, a wrong answer fails.

Every measurement is a line of `c3.jsonl` in the folder (`benches/.cache/c3`), which also takes the figures.
"""

import argparse
import os
import sys
import time
from pathlib import Path

# A pool of threads that spins for matrices would count as ours.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")

from chains import answers, forms, sizes, tree
from chains.peers import Peers
from chains.report import Report
from machine import CACHE, machine

PARTS = ("answers", "sizes", "forms", "tree", "figures")


def main() -> int:
    """Measure the selected parts; 1 when an answer is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", default=os.environ.get("QUICK", "0") not in ("", "0"))
    parser.add_argument("--only", default=",".join(PARTS))
    parser.add_argument("--out", type=Path, default=CACHE / "c3")
    options = parser.parse_args()
    parts, quick = options.only.split(","), options.quick
    report, peers = Report(options.out), Peers.prepared()
    report.note(**machine(), load=os.getloadavg()[0], quick=quick)
    report.console.print(
        f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors; CPU time of one thread"
    )
    started = time.monotonic()
    for part in PARTS:
        if part in parts:
            run(part, report, peers, quick)
            report.console.print(f"[dim]{part}: {time.monotonic() - started:.0f} s since the start[/dim]")
    return report.close()


def run(part: str, report: Report, peers: Peers, quick: bool) -> None:
    """One part."""
    match part:
        case "answers":
            answers.check(report, peers, CACHE / "data", quick)
        case "sizes":
            sizes.measure(report, peers, (1, 10) if quick else (1, 4, 10), *((1, 0.5) if quick else (3, 2.0)))
        case "forms":
            forms.measure(report, peers, quick, rounds=3 if quick else 7, seconds=0.1 if quick else 0.4)
        case "tree":
            draw_tree(report, quick)
        case "figures":
            from chains import figures

            runs = 3 if quick else 20
            figures.four_strategies(report.folder / "four-strategies.png", report, runs)
            figures.speedups(report.folder / "speedups.png", report, runs)


def draw_tree(report: Report, quick: bool) -> None:
    """Figure 3.5 and what it shows."""
    from chains import figures
    from niwaki.draw.picture import picture
    from niwaki.targets.examples import bent_tube

    rows = tree.measure(report, 2 if quick else 20, quick)
    best = tree.fitted(report.folder, 5_000 if quick else 150_000)
    shown = {"size": (420, 620), "backdrop": "white", "azimuth": 75.0, "elevation": 8.0}
    figures.tree(
        report.folder / "tree-strategies.png",
        rows,
        picture(tree.scene_of(bent_tube()), None, **shown),
        best.picture(target=False, **shown),
    )


if __name__ == "__main__":
    sys.exit(main())
