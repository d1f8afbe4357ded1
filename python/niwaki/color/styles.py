"""The paint of a shape of an SVG: presentation attributes, style sheets, inline styles, inheritance.

Only what decides whether a shape is painted is resolved: `fill`, `stroke`, `display`, `visibility`. Selectors may
contain a tag, classes and ids (`path.roof`, `#moon`); of those that match, the more special wins, then the later (CSS
2.1, 6.4.3).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree.ElementTree import Element

from niwaki.inputs.limits import check

PAINTS = ("fill", "stroke", "display", "visibility")
INITIAL = {"fill": "black", "stroke": "none", "display": "inline", "visibility": "visible"}
# `display` is the one that children do not inherit; a hidden group is left out whole.
INHERITED = ("fill", "stroke", "visibility")

_SELECTOR = re.compile(r"(\*|[\w-]+)?((?:[.#][\w-]+)*)")


class SelectorError(Exception):
    """A selector that decides about paint and is of another kind."""


@dataclass(frozen=True)
class _Rule:
    tag: str
    ids: frozenset[str]
    classes: frozenset[str]
    declared: dict[str, str]

    @property
    def weight(self) -> tuple[int, int, int]:
        return len(self.ids), len(self.classes), int(bool(self.tag))

    @property
    def key(self) -> str:
        """What every shape that matches has: an id, a class, a tag; empty where it may be any."""
        if self.ids:
            return f"#{min(self.ids)}"
        return f".{min(self.classes)}" if self.classes else self.tag

    def matches(self, tag: str, name: str, classes: frozenset[str]) -> bool:
        return self.tag in ("", tag) and self.ids <= {name} and self.classes <= classes


@dataclass
class Styles:
    """The style sheets of one file."""

    rules: list[_Rule] = field(default_factory=list)
    place: str | Path | None = None
    compared: int = 0

    def __post_init__(self) -> None:
        """Sort the rules by what a shape must have, so that a shape is compared with few."""
        self._by_key: dict[str, list[int]] = {}
        for number, rule in enumerate(self.rules):
            self._by_key.setdefault(rule.key, []).append(number)

    @classmethod
    def of(cls, sheets: Iterable[str], place: str | Path | None = None) -> Styles:
        """Read the texts of all `style` elements.

        Raises
        ------
        SelectorError
            A selector with more than tag, classes and ids decides about paint.
        """
        found = []
        for sheet in sheets:
            for selectors, body in _blocks(sheet):
                declared = {key: value for key, value in declarations(body).items() if key in PAINTS}
                if declared and not selectors.strip().startswith("@"):
                    found += [_rule(one.strip(), declared) for one in selectors.split(",")]
        # Stable: of equals the later stays later, and wins.
        return cls(sorted(found, key=lambda rule: rule.weight), place)

    def resolve(self, element: Element, above: dict[str, str]) -> dict[str, str]:
        """The four properties of an element whose parent has those of `above`."""
        own = {key: element.attrib[key].strip() for key in PAINTS if key in element.attrib}
        name, classes = element.get("id", ""), frozenset(element.get("class", "").split())
        tag = tag_of(element)
        keys = ["", tag, f"#{name}", *(f".{one}" for one in classes)]
        numbers = sorted(number for key in keys for number in self._by_key.get(key, ()))
        self.compared += len(numbers)
        check("styles", self.compared, self.place)
        for number in numbers:
            if self.rules[number].matches(tag, name, classes):
                own.update(self.rules[number].declared)
        own.update(
            {key: value for key, value in declarations(element.get("style", "")).items() if key in PAINTS}
        )
        found = dict(INITIAL)
        for key in PAINTS:
            value = own.get(key, "inherit" if key in INHERITED else INITIAL[key])
            found[key] = above[key] if value == "inherit" else value
        return found


def _blocks(sheet: str) -> Iterator[tuple[str, str]]:
    """Each innermost block of a style sheet with what stands before it; comments and imports left out."""
    first, *others = sheet.split("/*")
    text = " ".join([first, *(one.partition("*/")[2] for one in others)])
    text = text.replace("<!--", " ").replace("-->", " ")
    first, *others = re.split(r"@(?:import|charset)", text)
    text = " ".join([first, *(one.partition(";")[2] for one in others)])
    pieces = re.split(r"([{}])", text)
    for before, opened, body, closed in zip(
        pieces[::2], pieces[1::2], pieces[2::2], pieces[3::2], strict=False
    ):
        if opened == "{" and closed == "}" and before:
            yield before, body


def declarations(text: str) -> dict[str, str]:
    """The properties of `fill: red; stroke: none`, without `!important`."""
    found = {}
    for one in text.split(";"):
        key, colon, value = one.partition(":")
        if colon:
            found[key.strip().lower()] = value.replace("!important", "").strip()
    return found


def tag_of(element: Element) -> str:
    """The tag without its namespace; empty for comments."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def _rule(selector: str, declared: dict[str, str]) -> _Rule:
    found = _SELECTOR.fullmatch(selector)
    if found is None or not selector:
        raise SelectorError(selector)
    tag, rest = found[1] or "", re.findall(r"[.#][\w-]+", found[2])
    return _Rule(
        "" if tag == "*" else tag,
        frozenset(one[1:] for one in rest if one[0] == "#"),
        frozenset(one[1:] for one in rest if one[0] == "."),
        declared,
    )
