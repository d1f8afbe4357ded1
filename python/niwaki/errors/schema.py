"""JSON from files and messages, checked against a schema before anything uses it.

A schema is a class of msgspec, or any other type that msgspec knows. A value that does not fit raises `Unfit`, with
the place in the JSON (`$.method.particles`), the expected value and the actual one. The reader of each kind of file
turns `Unfit` into its own error.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import msgspec

from niwaki.errors import settings

#: The types of JSON, in words.
_WORDS = {
    "int": "a whole number",
    "float": "a number",
    "str": "a text",
    "bool": "true or false",
    "null": "null",
    "array": "a list",
    "object": "a table of names and values",
}


#: The expected value where a text is not JSON.
JSON = "JSON"


class Unfit(ValueError):
    """Error about a value in JSON that does not fit its schema.

    Attributes
    ----------
    at : str
        The value's place, from `$`, the whole JSON.
    expected : str
        The expected value, in words.
    actual : str
        The actual value, in words.
    """

    def __init__(self, at: str, expected: str, actual: str) -> None:
        super().__init__(at, expected, actual)
        self.at, self.expected, self.actual = at, expected, actual

    def inside(self, step: str) -> Unfit:
        """Return this error for the JSON around the value, in which `step` leads to the value."""
        return Unfit(f"${step}{self.at[1:]}", self.expected, self.actual)

    def __str__(self) -> str:
        if self.expected == JSON:
            return f"it is not JSON: {self.actual}"
        return f"at `{self.at}` there is {self.actual}, expected {self.expected}"


def decoded(text: str | bytes) -> Any:
    """Decode a JSON text. Numbers are finite, and the depth of nesting is limited.

    Raises
    ------
    Unfit
        The text is not JSON.
    """
    try:
        return msgspec.json.decode(text)
    except (
        ValueError,
        RecursionError,
    ) as error:  # msgspec's errors are ValueErrors, and so are those of UTF-8
        raise Unfit("$", JSON, str(error)) from error


def fitted(data: Any, kind: Any) -> Any:
    """Convert decoded data to the type of a schema.

    Raises
    ------
    Unfit
        The data do not fit the schema.
    """
    try:
        return msgspec.convert(data, kind)
    except msgspec.ValidationError as error:
        raise _unfit(str(error), data) from None


@contextmanager
def inside(step: str) -> Iterator[None]:
    """Turn an `Unfit` of the block, about the value at `step`, into an error about the whole JSON."""
    try:
        yield
    except Unfit as error:
        raise error.inside(step) from error


def shown(value: Any) -> str:
    """Describe a value in a few characters."""
    if isinstance(value, dict):
        names = ", ".join(repr(name) for name in list(value)[:3])
        return f"a table with {names}{', ...' if len(value) > 3 else ''}" if value else "an empty table"
    if isinstance(value, (list, tuple)):
        return f"a list of {len(value)}"
    return settings.shown(value)


def _unfit(message: str, data: Any) -> Unfit:
    """Translate an error of msgspec."""
    text, _, place = message.partition(" - at `")
    at = place.removesuffix("`") or "$"
    missing = re.fullmatch(r"Object missing required field `(.*)`", text)
    if missing:
        return Unfit(f"{at}.{missing[1]}", "a value", "nothing")
    unknown = re.fullmatch(r"Object contains unknown field `(.*)`", text)
    if unknown:
        return Unfit(f"{at}.{unknown[1]}", "no such name", "a value")
    expected, _, got = text.removeprefix("Expected ").partition(", got ")
    value = _value_at(data, at)
    return Unfit(at, _in_words(expected), shown(value[0]) if value else _in_words(got) or "something else")


def _in_words(text: str) -> str:
    """Replace `int | null` by words."""

    def words(match: re.Match[str]) -> str:
        return " or ".join(_WORDS.get(word, word) for word in match[1].split(" | "))

    return re.sub(r"`([^`]*)`", words, text)


def _value_at(data: Any, at: str) -> tuple[Any] | None:
    """Return the value at a place, in a tuple, or None where the place is not exact."""
    for name, number in re.findall(r"\.(\w+)|\[(\d+|\.\.\.)\]", at):
        try:
            data = data[name] if name else data[int(number)]
        except (KeyError, IndexError, TypeError, ValueError):
            return None
    return (data,)
