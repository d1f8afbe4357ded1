"""Three coins, one of the first two heads: how many heads are there? The first program of dissertation 2.2.1.

Exact enumeration answers: 2 with probability 1/2, 1 with 1/3, 3 with 1/6.
"""

from niwaki import model
from niwaki.methods import enumerate_all
from niwaki.words import condition, flip

TITLE = "three coins, one of the first two heads"
METHOD = enumerate_all()


@model
def coin():
    """How many of three coins show heads, where the first or the second does."""
    a = flip(0.5)
    b = flip(0.5)
    c = flip(0.5)
    condition(a or b)
    return a + b + c


MODEL = coin
