"""The shape of one entry of the table of messages."""

from __future__ import annotations

from dataclasses import dataclass
from string import Formatter


@dataclass(frozen=True)
class Message:
    """A message's texts. `{name}` is replaced by a value from the code that raises it.

    Attributes
    ----------
    code
        The error's name, kebab-case.
    title
        What happened, complete without `why`; lower case, no full stop.
    label, second
        The text beside the carets, and beside the second place if there is one.
    why
        Why there is such a rule.
    help
        What to write or do instead.
    example
        A program or a command that is refused; for the language, a model that the tests compile.
    cure
        The same, put right; for the language, a model that the tests compile.
    about
        What the manual's page says in place of `why`; Markdown.
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
        """The names of the values that it needs."""
        texts = (self.title, self.why, self.help)
        return {name for text in texts for _, name, _, _ in Formatter().parse(text) if name}
