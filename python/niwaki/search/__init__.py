"""Searches as values, and how the engine runs them.

entry       `run` and `grow`, which create a search and run it
request     `Search`: all that decides a result, as JSON, with a hash
data        values as plain data, and back
checks      checks before a search starts
checkpoint  the file from which a search goes on after it was killed
keeping     when it is written, and what is in it
carrying    carrying out a search: run by run, each from where its checkpoint is, polished and kept
searching   one run of a search on the engine, by its method
collisions  which parts of a scene break its constraints
drag        a part dragged to a point, by the derivatives of its place, or by a number of the source
worth       what is said of a result that is worth less than its search promised
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
