"""The studio's messages as tools of the Model Context Protocol (MCP), for programs that write models.

- `tools`    a tool for each command, made from `niwaki.studio.messages`
- `answers`  events as short texts and small pictures
- `caller`   a command sent, and what the session answers
- `server`   the server, on standard input and output, and on loopback HTTP beside the studio's page

The library `mcp` (the protocol's official SDK) is imported by `server` alone.
"""
