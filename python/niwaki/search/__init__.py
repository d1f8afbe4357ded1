"""Searching: what is asked of a model as a value, and how it is carried out on the engine.

asking      `run` and `grow`, which make a search and run it
request     `Search`: all that decides what is found, as JSON, with a hash
data        values as plain data, and back
checks      what is refused before a search starts
searching   carrying a search out: run by run, each by its method
"""

from niwaki.result.progress import Progress, Watch
from niwaki.search.asking import explain, grow, run
from niwaki.search.request import Search
from niwaki.search.searching import SearchWarning

__all__ = ["Progress", "Search", "SearchWarning", "Watch", "explain", "grow", "run"]
