"""Figures 6.11 and 6.12: circuits, and their score against particles and against time."""

import statistics
import time
from collections.abc import Sequence

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import niwaki as nw
import numpy as np
from curves import COLORS, plain
from curves import saved as saved_figure
from judging import likeliest
from niwaki import _engine
from niwaki.draw.flat.drawing import drawing
from niwaki.gallery import circuit
from niwaki.guides import train_guide
from niwaki.methods import Guide
from niwaki.result import Sample
from PIL import Image
from places import Places, Row
from sheets import saved, sheet

#: Searches for each point; the dissertation has 50.
SEARCHES = 50
#: Particles of the lines.
GUIDED = (5, 10, 20, 50, 100)
UNGUIDED = (20, 50, 100, 200, 400, 600)
#: A trace that scores worse does not show how a board is filled, nats.
WORST = -400.0
#: Resampling of the lines.
LINES = (
    ("guided", "tempered", "ours", "guided, tempered"),
    ("guided", "systematic", "full", "guided, systematic"),
    ("unguided", "systematic", "unguided", "without a guide, systematic"),
    ("unguided", "tempered", "unguided, tempered", "without a guide, tempered"),
)


def guide_of(places: Places) -> Guide:
    """A guide of circuits. There is no target: only the seeds of the traces differ."""
    return places.guide(
        "ours-circuit",
        lambda: train_guide(
            circuit.MODEL,
            range(16),
            lambda _: circuit.SCORE(),
            held_out=range(8),
            rounds=(10, 10) if places.quick else (80, 200),
            searches=(nw.smc(600), nw.smc(60)),
            judge=nw.smc(20, resampling="tempered"),
            keep=lambda run: run.log_score > WORST,
            seed=1,
        ),
    )


def grown(particles: int, resampling: str, guide: Guide | None, seed: int) -> Sample:
    """The result of one search: the run with the highest prior and score."""
    method = nw.smc(particles, resampling=resampling, guide=guide)
    result = nw.run(circuit.MODEL, score=circuit.SCORE(), method=method, seed=seed, threads=1)
    return likeliest(result)


def filled(run: Sample) -> float:
    """The score that is 1 at best: argument of the normal density."""
    sketch = _engine.Sketch(circuit.SCORE().specs)
    for part in run.scene.parts:
        sketch.add(part.shapes)
    return sketch.measures()["score"]


def measured(places: Places, name: str, guide: Guide | None, particles: int, resampling: str) -> Row:
    """Scores of searches, and CPU seconds of one."""
    key = {"model": "circuit", "guide": name, "particles": particles, "resampling": resampling}

    def measure() -> Row:
        grown(particles, resampling, guide, 1)
        start = time.process_time()
        runs = [grown(particles, resampling, guide, seed) for seed in range(3 if places.quick else SEARCHES)]
        seconds = (time.process_time() - start) / len(runs)
        return {
            "cpu": round(seconds, 6),
            "scores": [round(filled(run), 4) for run in runs],
            "logs": [round(run.log_score, 2) for run in runs],
        }

    row = places.row("circuits", key, measure)
    print(
        f"{name:<10}N={particles:<4}{resampling:<11}median score {statistics.median(row['scores']):.3f}  "
        f"mean {np.mean(row['scores']):.3f}  p10 {np.quantile(row['scores'], 0.1):.3f}  {1000 * row['cpu']:.1f} ms",
        flush=True,
    )
    return row


def draw(places: Places) -> None:
    """Measure, and draw both figures."""
    guide = guide_of(places)
    figure, panels = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained", sharey=True)
    for name, resampling, color, text in LINES:
        counts: Sequence[int] = GUIDED if name == "guided" else UNGUIDED
        guide_of_kind = guide if name == "guided" else None
        rows = [
            measured(places, name, guide_of_kind, n, resampling)
            for n in (counts[:2] if places.quick else counts)
        ]
        middles = [statistics.median(row["scores"]) for row in rows]
        low, high = ([np.quantile(row["scores"], q) for row in rows] for q in (0.1, 0.9))
        for panel, at in zip(
            panels, ([row["particles"] for row in rows], [1000 * row["cpu"] for row in rows]), strict=True
        ):
            panel.plot(at, middles, "o-", color=COLORS[color], label=text, markersize=3)
            panel.fill_between(at, low, high, color=COLORS[color], alpha=0.1, linewidth=0)
    for panel, text in zip(panels, ("particles", "CPU time of a search, ms"), strict=True):
        panel.set(xscale="log", xlabel=text, ylim=(0.4, 1.01))
        panel.set(xticks=(5, 10, 20, 50, 100, 200, 600))
        panel.grid(alpha=0.3)
        plain(panel)
    panels[0].set(ylabel="score (1: as asked)")
    panels[0].legend(frameon=False, fontsize=8, loc="lower right")
    saved_figure(figure, places, "figure-6-12.png")
    few, many = (3, 3) if places.quick else (50, 600)
    rows = [
        [board(grown(few, "tempered", guide, seed)) for seed in range(1, 5)],
        [board(grown(few, "systematic", None, seed)) for seed in range(1, 5)],
        [board(grown(many, "systematic", None, seed)) for seed in range(1, 5)],
    ]
    saved(places, "figure-6-11.png", sheet(rows))


def board(run: Sample) -> Image.Image:
    """A picture of a circuit."""
    return drawing(run.scene, size=(210, 210), style=circuit.DRAWS, window=circuit.WINDOW).convert("RGB")
