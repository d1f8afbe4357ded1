"""Searches as values, and how the engine runs them.

entry       `run` and `grow`, which create a search and run it
archives    `archive`, the best of every kind as a table and a sheet
kinds       what tells results apart, in words for people
request     `Search`: all that decides a result, as JSON, with a hash
data        values as plain data, and back
schema      the form of a search as JSON
checks      checks before a search starts
checkpoint  the file from which a search resumes after its process was killed
keeper      checkpoints of running searches: when they are written, and their stages
execution   the runs of a search one after the other, resumed, polished, and with warnings
emulated    searches by an emulator: the choices of a model as a space, and whether they suit
engine_runs one run of a search on the engine, by its method
shipped     the guides of the package
collisions  parts of a scene that break its constraints
space       parameters of a model, as a row of the unit cube
drag        parts dragged to a point, by the derivatives of a place, or by a number of the source
warnings    warnings about poor results
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
