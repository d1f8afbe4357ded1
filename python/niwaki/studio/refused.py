"""What cannot be done, with the text that a window shows."""

from __future__ import annotations

from niwaki.studio.messages import Problem


class Refused(Exception):  # noqa: N818 - it is what happens to a command
    """A command cannot be carried out; the window that asked is told why."""

    def __init__(self, code: str, text: str) -> None:
        super().__init__(text)
        self.problem = Problem(code, text)
