"""The figures and the table of dissertation chapter 5, drawn again, and what they cost.

    make figures-sosmc                                      # or: .venv/bin/python benches/figures_sosmc [FOLDER]
    NIWAKI_REFERENCE_TARGETS=folder make figures-sosmc      # figure 5.9 on the original's meshes as well
    QUICK=1 make figures-sosmc                              # a smoke run: small populations, one run of each
    make figures-sosmc PARTS="examples growth"              # some of the parts

Parts, in order: `examples` (figures 5.1 to 5.8 and table 5.1), `comparison` (figure 5.9), `growth` (what a primitive
costs), `threads` (what a second thread saves). Each leaves pictures and one line of JSON for each measurement in
FOLDER, out/figures-sosmc unless named.
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import comparison
import examples
import growth
import threads
from parts import main

PARTS = {
    "examples": examples.draw,
    "comparison": comparison.draw,
    "growth": growth.draw,
    "threads": threads.draw,
}

if __name__ == "__main__":
    main(PARTS, "out/figures-sosmc")
