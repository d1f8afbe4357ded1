"""The figures and the tables of dissertation chapter 4, drawn again.

    make figures-hmc                              # or: .venv/bin/python benches/figures_hmc [FOLDER] [PART ...]
    QUICK=1 make figures-hmc                      # a smoke run: few draws
    make figures-hmc PARTS="structures"           # some of the parts

Parts, in order: `point` (figures 4.2 and 4.3); `colors` (figures 4.4, 4.5 and the table of 4.6); `exploration` (our
default sampler beside the original's settings); `structures` (figures 4.8, 4.9, 4.11 to 4.13 and the table of 4.10).
Each leaves pictures and one line of JSON for each measurement in FOLDER, out/figures-hmc unless named.
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import colors
import exploration
import point
import structures
from parts import main

PARTS = {
    "point": point.draw,
    "colors": colors.draw,
    "exploration": exploration.draw,
    "structures": structures.draw,
}

if __name__ == "__main__":
    main(PARTS, "out/figures-hmc")
