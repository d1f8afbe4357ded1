"""Generators of other people's kind, each a function from parameters to a mesh, and the search for hidden parameters.

    parameters.py   parameters of a generator: kinds, ranges, which are used
    solids.py       closed parts that the generators are made of
    furniture.py    table, shelf, chair
    machines.py     gear, bracket
    houses.py       stair, vase, building
    fresh.py        eight further generators, written before the search that they judge
    candle.py       a file of OpenSCAD by somebody else, read by its evaluator
    problems.py     a generator, a hidden target and a score; what a search has found after 100, 300, 1,000 evaluations
    ours.py         the search of `nw.fit`
    peers.py        cma, Optuna, Nevergrad, pymoo and a random search, with the same score and cache
    table.py        medians of what was measured

`benches/black_boxes.py` runs them.
"""
