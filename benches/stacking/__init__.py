"""Structures of blocks: draws of each kind, two judges, and the table of what stands.

kinds        what is drawn, with the tolerances
following    chains that follow the gradient
metropolis   chains that do not: the original's, and one that is put right
files        what is kept between runs
judging      the linear program and the simulation, for each draw
effective    effective draws, by autocorrelation of all corners
table        the rows of the manual
"""
