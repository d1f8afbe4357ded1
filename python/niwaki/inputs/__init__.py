"""Files that a person gives: read within limits, and what a library makes of them.

- limits: how large a file may be, how much it may hold, how long reading may take
- files: the bytes of a file: regular files only, up to a limit
- guard: the errors of a library that reads, as ours
- child: a reader in a process of its own, with limits of memory and time
- modules: Python files, run as modules
"""

from niwaki.inputs.child import read_apart
from niwaki.inputs.files import bytes_of, regular, text_of
from niwaki.inputs.guard import library
from niwaki.inputs.limits import LIMITS, limit

__all__ = ["LIMITS", "bytes_of", "library", "limit", "read_apart", "regular", "text_of"]
