"""The parts of `c3.py`, one file each.

programs   the four programs of appendix A, each with the kernel that makes the same proposals as the peers
ours       our rates: proposals, CPU seconds, counters
peers      the same of WebPPL and of the limit written by hand
answers    checks of what is timed: marginals, scores, local differences
sizes      the programs at sizes 1, 4, 10 in every system
forms      variants of one program; global choices; the first thousand proposals; long chains
tree       the tree that should fit a bent tube (figure 3.5)
figures    the dissertation's figures, drawn again
report     tables, and targets beside the figures
"""
