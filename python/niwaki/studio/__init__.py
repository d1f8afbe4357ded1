"""The studio: models, their targets and their results in a page, and everything that the page does for scripts, too.

- `messages/`  the protocol: what can be asked and what is told, one struct each; `types` writes the page's types
- `frames`     geometry on the wire
- `document`, `journal`  what a session is about, and its steps on disk; undo moves a head
- `refused`    what cannot be done, in words
- `session/`   commands in, steps and shapes out; a function for each kind of command
- `window`     what waits to be sent to one window
- `process`, `worker/`   the processes that import models, search, and read what users send
- `security`, `server`, `serving`  who may speak; the routes; the loop
- `client`     `connect`, for scripts

The page's sources are in `studio/page` of the repository; `make studio-page` bundles them into `page/` here.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
