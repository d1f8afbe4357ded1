"""Results to turn and look at, in a notebook or as a page that is one file.

- `viewer`  `view`: results as a picture that can be turned, drawn by the studio's stage

Pictures and numbers of results need nothing from here: each has its own.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
