"""Figures 6.1 and 6.6, and sheets of all held-out drawings: what ten particles grow.

Of the two guides the dissertation's has its own rule of resampling (residual), ours the tempered one.
"""

from curves import dissertation
from judging import grown, held_out
from niwaki.gallery import vines
from niwaki.targets import drawings
from places import Places
from school import ours
from sheets import cell, saved, sheet, wrapped

WORD = (
    "glyphs/lobster-N",
    "glyphs/lobster-I",
    "glyphs/lobster-W",
    "glyphs/lobster-K",
    "glyphs/lobster-T",
    "glyphs/lobster-S",
)
#: Chosen by name and not by result.
SHOWN = ("scribbles/165", "scribbles/190", "glyphs/lobster-E", "glyphs/lobster-S", "silhouettes/cat")
#: Side of a cell and cells in a row, of the sheets.
SIDES = {"glyphs": (76, 15), "scribbles": (112, 10), "silhouettes": (130, 7)}
#: How many particles without a guide take as long as ten of ours: see figure 6.8.
SAME_TIME = 50


def draw(places: Places) -> None:
    """Draw all."""
    guides = dissertation(places)
    our_guide, theirs = ours(places, vines), guides["full"]
    letters = [drawings.drawing(name) for name in WORD if name in drawings.table()]
    kinds = [
        (10, "tempered", our_guide),
        (10, "residual", theirs),
        (10, "residual", None),
        (SAME_TIME, "residual", None),
    ]
    rows = [
        [cell(vines, drawing, grown(vines, drawing, n, resampling, guide, 1), 190) for drawing in letters]
        for n, resampling, guide in kinds
    ]
    saved(places, "figure-6-1.png", sheet(rows))
    shown = [drawings.drawing(name) for name in SHOWN if name in drawings.table()]
    titles = (
        "drawing",
        "unguided, N = 600",
        "ours, N = 10",
        "dissertation's, N = 10",
        "unguided, N = 10",
        "unguided, N = 50",
    )
    lines, below = [], []
    for drawing in shown:
        runs = [
            grown(vines, drawing, n, resampling, guide, 1)
            for n, resampling, guide in [(600, "residual", None), *kinds]
        ]
        lines.append([cell(vines, drawing, None, 170), *(cell(vines, drawing, run, 170) for run in runs)])
        below.append(["", *(f"similarity {run.similarity:.2f}" for run in runs)])
    saved(places, "figure-6-6.png", sheet(lines, titles=titles, below=below))
    for collection, (side, across) in SIDES.items():
        every = held_out(collection, places.quick)
        cells = [
            cell(vines, drawing, grown(vines, drawing, 10, "tempered", our_guide, 1), side)
            for drawing in every
        ]
        saved(places, f"vines-{collection}.png", sheet(wrapped(cells, across), gap=2))
