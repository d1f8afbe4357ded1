"""The number of heads among three coins, if the first or the second shows heads (dissertation 2.2.1).

Exact enumeration answers: 2 with probability 1/2, 1 with 1/3, 3 with 1/6.
"""

from niwaki import model
from niwaki.methods import enumerate_all
from niwaki.words import condition, flip

TITLE = "three coins, one of the first two heads"
METHOD = enumerate_all()


@model
def coin():
    """Count the heads of three coins, on the condition that the first or the second shows heads."""
    a = flip(0.5)
    b = flip(0.5)
    c = flip(0.5)
    condition(a or b)
    return a + b + c


MODEL = coin
