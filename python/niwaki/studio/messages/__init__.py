"""Every message of the studio: what a page or a script can ask, what it is told, and what a worker is given.

This is the protocol. The page's types are written from it (`niwaki.studio.types`), and whatever arrives is decoded into
one of these structs or refused. On the socket each message is JSON with its `kind`; a struct that carries geometry is
the header of a frame (`niwaki.studio.frames`).

`id` is a number of the sender's own choice; the answers to a command repeat it.

- `document`  what is asked, how it is searched for, and what came of it
- `commands`  what a client asks
- `events`    what it is told
- `modes`     what it is told of drawings that are coloured, and of structures that stand
- `jobs`      what a worker is given, and its answer
"""

from niwaki.studio.messages.commands import *
from niwaki.studio.messages.document import *
from niwaki.studio.messages.events import *
from niwaki.studio.messages.jobs import *
from niwaki.studio.messages.modes import *

PROTOCOL = 1
