"""The figures of dissertation chapter 6, drawn again with our drawings, and its numbers.

    make figures-guides                              # or: .venv/bin/python benches/figures_guides [FOLDER]
    QUICK=1 make figures-guides                      # a smoke run: few traces, few drawings
    make figures-guides PARTS="particles mixtures"   # some of the parts

Parts, in order: `guides` (all that learn from the same traces), `chain` (figures 6.2 and 6.3), `vines` (6.1, 6.6 and
sheets of all held-out drawings), `lightning` (6.7), `particles` (6.8), `mixtures` (6.9), `traces` (6.10), `circuits`
(6.11, 6.12), `bounds` (6.3: by examples, and by the evidence bound), `seeds` (ours by five training seeds, the
dissertation's network, and no guide), `tables` (docs/pictures/guides/measured.json and the tables of the manual,
from all that was measured).

What is measured is kept: FOLDER, out/figures-guides unless named, has a line of JSON for each measurement and a file
for each guide. A part that was interrupted goes on where it stopped; remove the folder to measure again. Pictures go to
docs/pictures/guides, those of a smoke run into FOLDER.

Guides learn from the training scribbles and their mirror images. Nothing here was tuned on what is held out.
"""

import os
import sys
import time
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import bounds
import chain
import circuits
import curves
import lightning
import seeds
import tables
import vines
from places import Places
from school import teach

PARTS = {
    "guides": teach,
    "chain": chain.draw,
    "vines": vines.draw,
    "lightning": lightning.draw,
    "particles": curves.particles,
    "mixtures": curves.mixtures,
    "traces": curves.traces,
    "circuits": circuits.draw,
    "bounds": bounds.draw,
    "seeds": seeds.draw,
    "tables": tables.draw,
}

if __name__ == "__main__":
    quick = bool(os.environ.get("QUICK"))
    places = Places(Path(sys.argv[1] if len(sys.argv) > 1 else "out/figures-guides"), quick)
    for name in sys.argv[2:] or list(PARTS):
        start = time.process_time()
        PARTS[name](places)
        print(f"{name}: {time.process_time() - start:.0f} s of CPU", flush=True)
