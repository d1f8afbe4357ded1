"""The paint of a shape of an SVG: presentation attributes, style sheets, inline styles, inheritance.

Only the properties that decide whether a shape is painted are resolved: `fill`, `stroke`, `display`, `visibility`.
Selectors may contain a tag, classes and ids (`path.roof`, `#moon`). Of several that match, the more specific wins, then
the later (CSS 2.1, 6.4.3).
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
# Children do not inherit `display`; a hidden group is left out as a whole.
INHERITED = ("fill", "stroke", "visibility")

_SELECTOR = re.compile(r"(\*|[\w-]+)?((?:[.#][\w-]+)*)")


class SelectorError(Exception):
    """A selector that decides about paint and has more than a tag, classes and ids."""


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
        """An id, a class or a tag that every matching shape has; empty if any shape may match."""
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
        """Sort the rules by their keys, so that a shape is compared with few."""
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
        rules = []
        for sheet in sheets:
            for selectors, body in _blocks(sheet):
                declared = {key: value for key, value in declarations(body).items() if key in PAINTS}
                if declared and not selectors.strip().startswith("@"):
                    rules += [_rule(selector.strip(), declared) for selector in selectors.split(",")]
        # The sort is stable: of equal weights the later rule stays later, and wins.
        return cls(sorted(rules, key=lambda rule: rule.weight), place)

    def resolve(self, element: Element, above: dict[str, str]) -> dict[str, str]:
        """Resolve the four properties of an element; `above` has those of its parent."""
        declared = {key: element.attrib[key].strip() for key in PAINTS if key in element.attrib}
        name, classes = element.get("id", ""), frozenset(element.get("class", "").split())
        tag = tag_of(element)
        keys = ["", tag, f"#{name}", *(f".{class_}" for class_ in classes)]
        numbers = sorted(number for key in keys for number in self._by_key.get(key, ()))
        self.compared += len(numbers)
        check("styles", self.compared, self.place)
        for number in numbers:
            if self.rules[number].matches(tag, name, classes):
                declared.update(self.rules[number].declared)
        declared.update(
            {key: value for key, value in declarations(element.get("style", "")).items() if key in PAINTS}
        )
        resolved = dict(INITIAL)
        for key in PAINTS:
            value = declared.get(key, "inherit" if key in INHERITED else INITIAL[key])
            resolved[key] = above[key] if value == "inherit" else value
        return resolved


def _blocks(sheet: str) -> Iterator[tuple[str, str]]:
    """Go through the innermost blocks of a style sheet: selectors and body, without comments and imports."""
    first, *pieces = sheet.split("/*")
    text = " ".join([first, *(piece.partition("*/")[2] for piece in pieces)])
    text = text.replace("<!--", " ").replace("-->", " ")
    first, *pieces = re.split(r"@(?:import|charset)", text)
    text = " ".join([first, *(piece.partition(";")[2] for piece in pieces)])
    pieces = re.split(r"([{}])", text)
    for before, opened, body, closed in zip(
        pieces[::2], pieces[1::2], pieces[2::2], pieces[3::2], strict=False
    ):
        if opened == "{" and closed == "}" and before:
            yield before, body


def declarations(text: str) -> dict[str, str]:
    """Read the properties of `fill: red; stroke: none`, without `!important`."""
    properties = {}
    for declaration in text.split(";"):
        key, colon, value = declaration.partition(":")
        if colon:
            properties[key.strip().lower()] = value.replace("!important", "").strip()
    return properties


def tag_of(element: Element) -> str:
    """Return the tag without its namespace; empty for comments."""
    return element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""


def _rule(selector: str, declared: dict[str, str]) -> _Rule:
    match = _SELECTOR.fullmatch(selector)
    if match is None or not selector:
        raise SelectorError(selector)
    tag, names = match[1] or "", re.findall(r"[.#][\w-]+", match[2])
    return _Rule(
        "" if tag == "*" else tag,
        frozenset(name[1:] for name in names if name[0] == "#"),
        frozenset(name[1:] for name in names if name[0] == "."),
        declared,
    )
