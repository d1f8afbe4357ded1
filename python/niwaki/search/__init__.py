"""Searching: what is asked of a model as a value, and how it is carried out on the engine.

entry       `run` and `grow`, which make a search and run it
request     `Search`: all that decides what is found, as JSON, with a hash
data        values as plain data, and back
checks      what is refused before a search starts
searching   carrying a search out: run by run, each by its method
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
