from .asking import explain as explain
from .asking import grow as grow
from .asking import run as run
from .asking import sharpened as sharpened
from .checks import fresh as fresh
from .request import Search as Search
from .searching import SearchWarning as SearchWarning
