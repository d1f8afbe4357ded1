"""What `c3.py` measures, a file for each part.

programs   the four programs of appendix A, each with the kernel that makes the same proposals as the peers
ours       our rates: proposals, CPU seconds, counters
peers      the same of WebPPL and of the limit written by hand
answers    that what is timed is right: marginals, scores, local differences
sizes      the programs at sizes 1, 4, 10 in every system
forms      ways of writing one program; global choices; the first thousand proposals; long chains
tree       the tree that is to fit a bent tube (figure 3.5)
figures    the dissertation's figures, drawn again
report     tables, and targets beside the figures
"""
