"""Figures 6.8 to 6.10: similarity against particles and time, components and traces."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from judging import judged, summary
from matplotlib.ticker import ScalarFormatter
from niwaki.gallery import vines
from niwaki.methods import Guide
from places import Places, Row
from school import ABLATIONS, COMPONENTS, SEEDS, SIZES, TRACES, ours, taught

#: The original's medians (figure 6.8a, read from the author's plot).
PUBLISHED = {
    "full": (0.21, 0.35, 0.47, 0.54, 0.58, 0.62, 0.63, 0.64, 0.67, 0.685),
    "target": (0.11, 0.23, 0.30, 0.36, 0.43, 0.45, 0.52, 0.59, 0.61, 0.61),
    "local": (0.05, 0.16, 0.24, 0.26, 0.29, 0.33, 0.35, 0.43, 0.43, 0.43),
    "constants": (0.02, 0.03, 0.05, 0.08, 0.10, 0.10, 0.12, 0.16, 0.16, 0.17),
}
#: The original's figure 6.10, likewise.
PUBLISHED_TRACES = {12: 0.09, 25: 0.13, 50: 0.20, 100: 0.50, 200: 0.55, 400: 0.68}
#: Numbers of particles.
GUIDED = (1, 2, 3, 5, 7, 10)
UNGUIDED = (1, 11, 21, 51, 101, 201)
FEW = (1, 2, 5, 10)
#: Fewest traces of the dissertation's network: that of 12 never ends a plant in some glyphs.
LEAST = 25

NAMES = {
    "full": "dissertation, full",
    "averaged": "dissertation, averaged weights",
    "target": "dissertation, place and target",
    "local": "dissertation, place",
    "constants": "dissertation, constants",
    "ours": "ours, tempered resampling",
    "unguided": "without a guide",
    "unguided, tempered": "without a guide, tempered resampling",
}
COLORS = {
    "full": "#1b4965",
    "averaged": "#4d8fbf",
    "target": "#5a9a8f",
    "local": "#b08d3e",
    "constants": "#9a9a96",
    "ours": "#9b2226",
    "unguided": "#ca6702",
    "unguided, tempered": "#e8a44c",
}


def dissertation(places: Places) -> dict[str, Guide]:
    """The dissertation's guides of figure 6.8, and one of the same training with averaged weights."""
    return {name: taught(places, name) for name in (*ABLATIONS, "averaged")}


def particles(places: Places) -> None:
    """Figure 6.8: against the number of particles, and against time."""
    guides = dissertation(places)
    rows: dict[str, list[list[Row]]] = {}

    def add(name: str, guide: Guide | None, counts: Sequence[int], resampling: str) -> None:
        rows[name] = [
            [judged(places, vines, name, guide, n, resampling=resampling, seed=s) for s in seeds_of(places)]
            for n in (counts[:3] if places.quick else counts)
        ]

    for name in ABLATIONS:
        add(name, guides[name], GUIDED, "residual")
    add("ours", ours(places, vines), GUIDED, "tempered")
    add("unguided", None, UNGUIDED, "residual")
    add("unguided, tempered", None, UNGUIDED[1:], "tempered")
    figure, panels = plt.subplots(2, 2, figsize=(11, 8.6), layout="constrained")
    for row, (measure, text) in enumerate((("median", "median similarity"), ("mean", "mean similarity"))):
        for column, axis in enumerate(("particles", "ms")):
            panel = panels[row, column]
            for name, of_name in rows.items():
                line(panel, name, of_name, axis, measure)
            if (row, column) == (0, 0):
                for name, medians in PUBLISHED.items():
                    panel.plot(range(1, 11), medians, ":", color=COLORS[name], linewidth=1.2)
            panel.set(ylim=(-0.02, 0.9), ylabel=text)
            panel.grid(alpha=0.3)
            panel.set(xscale="log", xlabel="particles" if axis == "particles" else "CPU time of a search, ms")
            panel.set(xticks=(1, 2, 5, 10, 20, 50))
            if axis == "particles":
                panel.set(xlim=(0.9, 55))
            plain(panel)
    panels[0, 0].plot([], [], ":", color="#444444", label="published, other drawings")
    figure.legend(
        *panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False
    )
    saved(figure, places, "figure-6-8.png")


def plain(panel: Any) -> None:
    """Numbers at the marks of a logarithmic axis, and no marks between them."""
    panel.get_xaxis().set_major_formatter(ScalarFormatter())
    panel.minorticks_off()


def line(panel: Any, name: str, of_name: Sequence[Sequence[Row]], axis: str, measure: str) -> None:
    """One method's line, with its band."""
    ends = [summary(rows) for rows in of_name]
    at = [
        rows[0]["particles"] if axis == "particles" else end["ms"]
        for rows, end in zip(of_name, ends, strict=True)
    ]
    middle, band = (np.array([end[key] for end in ends]) for key in (measure, "band"))
    panel.plot(at, middle, "o-", color=COLORS[name], label=NAMES[name], markersize=3)
    panel.fill_between(at, middle - band, middle + band, color=COLORS[name], alpha=0.12, linewidth=0)


def mixtures(places: Places) -> None:
    """Figure 6.9: mixtures of one, two and four components."""
    # Four components are the full network of figure 6.8.
    theirs = {
        name: taught(places, name) for name in (*(f"full-{count}" for count in COMPONENTS[:-1]), "full")
    }
    guides_by_name = {
        f"ours, {count} of 4": ours(places, vines, components=count) for count in COMPONENTS[:-1]
    }
    guides_by_name["ours"] = ours(places, vines)
    figure, panels = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
    kinds = (
        ("the dissertation's network", theirs, "residual"),
        ("ours, tempered resampling", guides_by_name, "tempered"),
    )
    for panel, (title, guides, resampling) in zip(panels, kinds, strict=True):
        for (name, guide), color, count in zip(
            guides.items(), ("#9a9a96", "#5a9a8f", "#1b4965"), COMPONENTS, strict=True
        ):
            ends = [
                summary(
                    [judged(places, vines, name, guide, n, resampling=resampling, seed=s) for s in SEEDS[:1]]
                )
                for n in (FEW[:2] if places.quick else FEW)
            ]
            text = f"{count} component{'s' * (count > 1)}"
            at = FEW[: len(ends)]
            panel.plot(at, [end["median"] for end in ends], "o-", color=color, label=text, markersize=3)
            panel.plot(at, [end["mean"] for end in ends], "--", color=color, linewidth=1)
        panel.plot([], [], "--", color="#444444", linewidth=1, label="mean")
        panel.set(title=title, xlabel="particles", ylim=(-0.02, 0.9))
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("median similarity")
    panels[0].legend(frameon=False, fontsize=8)
    saved(figure, places, "figure-6-9.png")


def traces(places: Places) -> None:
    """Figure 6.10: the number of traces that a guide learned from."""
    sizes = SIZES[:2] if places.quick else SIZES
    theirs = [count for count in sizes if count >= LEAST]
    figure, panel = plt.subplots(figsize=(6.5, 4.2), layout="constrained")
    lines: Mapping[str, list[list[Row]]] = {
        "full": [
            [one(places, f"full-of-{count}" if count < TRACES else "full", "residual")] for count in theirs
        ],
        "ours": [
            [one(places, f"ours-of-{count}-{seed}", "tempered") for seed in seeds_of(places)]
            for count in sizes
        ],
    }
    for (name, rows), at in zip(lines.items(), (theirs, sizes), strict=True):
        ends = [summary(group) for group in rows]
        panel.plot(
            at, [end["median"] for end in ends], "o-", color=COLORS[name], label=NAMES[name], markersize=4
        )
        panel.plot(at, [end["mean"] for end in ends], "--", color=COLORS[name], linewidth=1)
    panel.plot([], [], "--", color="#444444", linewidth=1, label="mean")
    panel.plot(
        list(PUBLISHED_TRACES),
        list(PUBLISHED_TRACES.values()),
        ":",
        color="#444444",
        label="published, other drawings",
    )
    panel.set(
        xscale="log",
        xlabel="traces",
        ylabel="median similarity, 10 particles",
        ylim=(-0.02, 0.9),
        xticks=sizes,
    )
    plain(panel)
    panel.grid(alpha=0.3)
    panel.legend(frameon=False, fontsize=8, loc="lower right")
    saved(figure, places, "figure-6-10.png")


def one(places: Places, name: str, resampling: str) -> Row:
    """A guide at ten particles."""
    return judged(places, vines, name, taught(places, name), 10, resampling=resampling)


def seeds_of(places: Places) -> tuple[int, ...]:
    """Seeds of searches."""
    return SEEDS[:1] if places.quick else SEEDS


def saved(figure: Any, places: Places, name: str) -> None:
    """Write a figure."""
    figure.savefig(places.pictures / name, dpi=90)
    plt.close(figure)
