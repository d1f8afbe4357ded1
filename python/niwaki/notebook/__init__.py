"""Views of results that you can turn, in a notebook or as a page in one file.

- viewer: `view`, which shows results with the studio's stage

Pictures and tables of results in a notebook do not need this package.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
