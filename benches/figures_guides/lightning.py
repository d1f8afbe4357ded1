"""Figure 6.7: letters of lightning by ten guided particles, with the CPU time of each; and a sheet of all letters."""

import time

from judging import grown, held_out
from niwaki.gallery import lightning
from niwaki.targets import drawings
from places import Places
from school import ours
from sheets import cell, saved, sheet, wrapped

WORD = "ELECTRIC"


def draw(places: Places) -> None:
    """Draw both."""
    guide = ours(places, lightning)
    letters = [drawings.drawing(f"letters/{letter}") for letter in WORD]
    grown(lightning, letters[0], 10, "tempered", guide, 1)
    cells, texts = [], []
    for number, drawing in enumerate(letters):
        start = time.process_time()
        run = grown(lightning, drawing, 10, "tempered", guide, 1 + number)
        texts.append(f"{1000.0 * (time.process_time() - start):.0f} ms")
        cells.append(cell(lightning, drawing, run, 200))
    saved(places, "figure-6-7.png", sheet(wrapped(cells, 4), below=wrapped(texts, 4)))
    every = held_out("letters", places.quick)
    cells = [
        cell(lightning, drawing, grown(lightning, drawing, 10, "tempered", guide, 1), 110)
        for drawing in every
    ]
    saved(places, "lightning-letters.png", sheet(wrapped(cells, 9), gap=2))
