"""The parent of every error that Niwaki raises on purpose."""

from __future__ import annotations


class NiwakiError(Exception):
    """An error with a code; `str(error)` is the message as it is meant to be read.

    Attributes
    ----------
    code : str
        The error's name, kebab-case.
    """

    code: str = ""

    def render(self) -> str:
        """Return the whole message."""
        raise NotImplementedError

    def __str__(self) -> str:
        """Return the whole message."""
        return self.render()
