from .checks import fresh as fresh
from .entry import OF_IMPROVE as OF_IMPROVE
from .entry import explain as explain
from .entry import grow as grow
from .entry import run as run
from .entry import usual as usual
from .request import Search as Search
from .searching import SearchWarning as SearchWarning
