"""Structures of blocks: draws of each kind, two judges, and the table of both.

kinds        the models, with the tolerances
following    chains that follow the gradient
metropolis   chains that do not: the original's, and a corrected one
files        the files between runs
judging      the linear program and the simulation, for each draw
effective    effective draws, by autocorrelation of all corners
table        the rows of the manual
"""
