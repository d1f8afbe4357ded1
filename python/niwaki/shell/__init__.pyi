from . import references as references
from . import run_files as run_files
