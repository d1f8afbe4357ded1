from . import finding as finding
from . import run_files as run_files
