from .checks import fresh as fresh
from .entry import POWER as POWER
from .entry import explain as explain
from .entry import grow as grow
from .entry import run as run
from .entry import sharpened as sharpened
from .request import Search as Search
from .searching import SearchWarning as SearchWarning
