"""The studio: a page with models, targets and results, and a client with which scripts do the same.

- `messages/`  the protocol: commands and events, one struct each; `types` writes the page's types
- `frames`     geometry on the wire
- `document`, `journal`  the contents of a session, and its steps on disk; undo moves a head
- `problems`   errors as messages for a window
- `session/`   commands in, steps and shapes out; a function for each kind of command
- `window`     the queue of messages to one window
- `process`, `worker/`   the processes that import models, search, and read uploads
- `security`, `server`, `serving`  access, routes, the loop
- `client`     `connect`, for scripts

The page's sources are in `studio/page` of the repository; `make studio-page` bundles them into `page/` here.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
