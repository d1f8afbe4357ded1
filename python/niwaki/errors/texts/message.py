"""The entry of a message in the table of messages."""

from __future__ import annotations

from dataclasses import dataclass
from string import Formatter


@dataclass(frozen=True)
class Message:
    """Texts of a message. A value from the code that raises the error replaces `{name}`.

    Attributes
    ----------
    code
        The error's name, kebab-case.
    title
        What happened, understandable without `why`; lower case, no full stop.
    label, second
        The text beside the carets, and beside the second place if the error has a second place.
    why
        The reason for the rule.
    help
        What to write or do instead.
    example
        A program or a command that is refused; for the language, a model that the tests compile.
    cure
        The corrected program or command; for the language, a model that the tests compile.
    about
        The text of the manual's page in place of `why`; Markdown.
    """

    code: str
    title: str
    label: str = ""
    second: str = ""
    why: str = ""
    help: str = ""
    example: str = ""
    cure: str = ""
    about: str = ""

    @property
    def names(self) -> set[str]:
        """The names of the values that the templates need."""
        texts = (self.title, self.why, self.help)
        return {name for text in texts for _, name, _, _ in Formatter().parse(text) if name}
