"""The process that does the work of a session: it alone imports models, runs them and reads what users sent.

- `loop`     jobs in, reports out; the flag that stops a search
- `models`   models by reference, as the page lists them
- `asks`     what is asked, as a target and a score
- `jobs`     searches, parts grown again, choices changed
- `drag`     a part that is dragged
- `runs`     stored runs: replayed, described, shown, written
- `differences`  where a result differs from what is wanted
- `places`   where in the source a choice is made and a part is emitted, and how a choice's slider goes
- `shapes`   a scene as a mesh for the page
- `uploads`  a mesh that a user sent, read within limits
"""
