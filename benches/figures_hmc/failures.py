"""A page of draws that a judge does not pass, each with the reason; the table leaves none out, the page shows some."""

from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from stacking.files import Verdicts, chains
from stacking.judging import passes
from stacking.kinds import KINDS
from towers_and_arches import framed, scene_of

#: Of each kind at most.
SHOWN = 2
COLUMNS = 4


def failures(path: Path, folder: Path) -> None:
    """Draw the first failures of each kind; no page where there are none."""
    rows = [
        (name, row)
        for name in KINDS
        for row in [row for row in Verdicts(folder, name, "nuts") if not passes(row)][:SHOWN]
    ]
    if not rows:
        return
    columns = min(COLUMNS, len(rows))
    down = -(-len(rows) // columns)
    figure, axes = plt.subplots(down, columns, figsize=(3.5 * columns, 4.0 * down), squeeze=False)
    for cell in axes.flat:
        cell.axis("off")
    for cell, (name, row) in zip(axes.flat, rows, strict=False):
        scene = scene_of(KINDS[name], chains(folder, name, "nuts"), (row["chain"], row["draw"]))
        cell.imshow(framed(scene, None))
        cell.set_title(f"{name.replace('_', ' ')}: {why(row)}", fontsize=9)
    figure.tight_layout()
    # The layout leaves no room for titles of cells without axes.
    figure.savefig(path, dpi=75, bbox_inches="tight")
    plt.close(figure)


def why(row: dict[str, Any]) -> str:
    """Return the faults that the judges find in a draw."""
    if "refused" in row:
        text = row["refused"].replace("-", " ")
    else:
        program = "balances" if row["holds"] else f"lacks {100 * row['residual']:.2g} % of a weight"
        drop = "stands" if row["stands"] else f"block {row['block'] + 1} moves {100 * row['moved']:.0f} %"
        text = f"{program},\n{drop}"
    if "polished" in row:
        text += "; polished it passes" if passes(row["polished"]) else "; polished it does not either"
    return text
