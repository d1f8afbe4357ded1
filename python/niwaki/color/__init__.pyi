from . import agree as agree
from . import files as files
from .drawing import Drawing as Drawing
from .model import coloring as coloring
from .rules import Rules as Rules
from .search import Coloring as Coloring
from .search import color as color
from .search import rules_of as rules_of
