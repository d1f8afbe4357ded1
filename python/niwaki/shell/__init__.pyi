from . import anyway as anyway
from . import references as references
from . import results as results
from . import run_files as run_files
from . import trust as trust
