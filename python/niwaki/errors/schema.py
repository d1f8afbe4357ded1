"""JSON that came from elsewhere: read, and held against a schema, once and before anything is done with it.

A schema is a class of msgspec, or any type that it knows. What does not fit is an `Unfit`: the place in the JSON
(`$.method.particles`), what was expected there and what stood there. Who reads a file turns it into its own error.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import msgspec

from niwaki.errors import settings

#: The types of JSON in words, for people.
_WORDS = {
    "int": "a whole number",
    "float": "a number",
    "str": "a text",
    "bool": "true or false",
    "null": "null",
    "array": "a list",
    "object": "a table of names and values",
}


#: What a text should be.
JSON = "JSON"


class Unfit(ValueError):
    """A value of some JSON that does not fit.

    Attributes
    ----------
    at : str
        Its place, from `$`, which is the whole.
    expected : str
        What should stand there.
    found : str
        What stands there.
    """

    def __init__(self, at: str, expected: str, found: str) -> None:
        super().__init__(at, expected, found)
        self.at, self.expected, self.found = at, expected, found

    def inside(self, step: str) -> Unfit:
        """The same, seen from what holds the value: `step` leads from there to what `$` was."""
        return Unfit(f"${step}{self.at[1:]}", self.expected, self.found)

    def __str__(self) -> str:
        if self.expected == JSON:
            return f"it is not JSON: {self.found}"
        return f"at `{self.at}` there is {self.found}, expected {self.expected}"


def decoded(text: str | bytes) -> Any:
    """What a JSON text holds: numbers are finite, and tables are not nested without bound.

    Raises
    ------
    Unfit
        It is not JSON.
    """
    try:
        return msgspec.json.decode(text)
    except (
        ValueError,
        RecursionError,
    ) as error:  # msgspec's errors are ValueErrors, and so are those of UTF-8
        raise Unfit("$", JSON, str(error)) from error


def fitted(data: Any, kind: Any) -> Any:
    """The data as the schema has it.

    Raises
    ------
    Unfit
        They do not fit.
    """
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as error:
        raise _unfit(str(error), data) from None


@contextmanager
def inside(step: str) -> Iterator[None]:
    """Inside, a value is read to which `step` leads; an `Unfit` is about the whole."""
    try:
        yield
    except Unfit as error:
        raise error.inside(step) from error


def shown(value: Any) -> str:
    """A value in a few characters."""
    if isinstance(value, dict):
        names = ", ".join(repr(name) for name in list(value)[:3])
        return f"a table with {names}{', ...' if len(value) > 3 else ''}" if value else "an empty table"
    if isinstance(value, (list, tuple)):
        return f"a list of {len(value)}"
    return settings.shown(value)


def _unfit(message: str, data: Any) -> Unfit:
    """What msgspec says, in our words."""
    what, _, place = message.partition(" - at `")
    at = place.removesuffix("`") or "$"
    missing = re.fullmatch(r"Object missing required field `(.*)`", what)
    if missing:
        return Unfit(f"{at}.{missing[1]}", "a value", "nothing")
    unknown = re.fullmatch(r"Object contains unknown field `(.*)`", what)
    if unknown:
        return Unfit(f"{at}.{unknown[1]}", "no such name", "a value")
    expected, _, got = what.removeprefix("Expected ").partition(", got ")
    found = _found(data, at)
    return Unfit(at, _in_words(expected), shown(found[0]) if found else _in_words(got) or "something else")


def _in_words(text: str) -> str:
    """Replace `int | null` by words."""

    def words(found: re.Match[str]) -> str:
        return " or ".join(_WORDS.get(one, one) for one in found[1].split(" | "))

    return re.sub(r"`([^`]*)`", words, text)


def _found(data: Any, at: str) -> tuple[Any] | None:
    """The value at a place, in a tuple; None where the place is not exact."""
    for name, number in re.findall(r"\.(\w+)|\[(\d+|\.\.\.)\]", at):
        try:
            data = data[name] if name else data[int(number)]
        except (KeyError, IndexError, TypeError, ValueError):
            return None
    return (data,)
