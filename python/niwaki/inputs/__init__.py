"""Reading of users' files, within limits.

- limits: limits of the size of a file, of its contents and of the time to read it
- files: the bytes of a regular file, up to a limit
- guard: errors of libraries that read files, as errors of the package
- child: a reader in a separate process, with limits of memory and time
- modules: Python files, run as modules
- texts, xml: JSON, TOML, numbers and XML
"""

from niwaki.inputs.child import read_apart
from niwaki.inputs.files import bytes_of, regular, text_of
from niwaki.inputs.guard import library
from niwaki.inputs.limits import LIMITS, limit

__all__ = ["LIMITS", "bytes_of", "library", "limit", "read_apart", "regular", "text_of"]
