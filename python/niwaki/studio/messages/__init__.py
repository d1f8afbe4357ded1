"""The messages of the studio: commands and events of a page or a script, jobs and reports of a worker.

This is the protocol. The page's types are written from it (`niwaki.studio.types`). A message that arrives is decoded
into one of these structs or refused. On the socket each message is JSON with its `kind`; a struct that carries geometry
is the header of a frame (`niwaki.studio.frames`).

`id` is a number that the sender chooses; the answers to a command repeat it.

- `document`  goals, settings and results
- `commands`  messages from a client
- `events`    messages to a client
- `modes`     messages to a client about colourings and structures
- `jobs`      messages to and from a worker
"""

from niwaki.studio.messages.commands import *
from niwaki.studio.messages.document import *
from niwaki.studio.messages.events import *
from niwaki.studio.messages.jobs import *
from niwaki.studio.messages.modes import *

PROTOCOL = 1
