from . import references as references
from . import replay_changed as replay_changed
from . import requirements as requirements
from . import results as results
from . import run_files as run_files
from . import show as show
from . import trust as trust
