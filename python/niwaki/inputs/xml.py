"""XML from users' files, as trees of limited size and depth."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from xml.etree.ElementTree import Element, ParseError, TreeBuilder, XMLParser

from niwaki.errors import FileError
from niwaki.inputs.limits import check


@dataclass(frozen=True)
class Tree:
    """A tree of elements, and its namespaces.

    Attributes
    ----------
    root : Element
    spaces : list of (str, str)
        Prefixes and names, in the order of the file; the default namespace has an empty prefix.
    """

    root: Element
    spaces: list[tuple[str, str]]


class _Builder:
    """Builder of a tree, which counts elements, levels and characters."""

    def __init__(self, place: str | PathLike[str] | None) -> None:
        self.place = place
        self.tree = TreeBuilder()
        self.spaces: list[tuple[str, str]] = []
        self.elements = self.depth = self.characters = 0

    def start(self, tag: str, attributes: dict[str, str]) -> Element:
        self.elements += 1
        self.depth += 1
        check("elements", self.elements, self.place)
        check("depth", self.depth, self.place)
        self._count(sum(map(len, attributes.values())))
        return self.tree.start(tag, attributes)

    def end(self, tag: str) -> Element:
        self.depth -= 1
        return self.tree.end(tag)

    def data(self, text: str) -> None:
        self._count(len(text))
        self.tree.data(text)

    def start_ns(self, prefix: str, name: str) -> None:
        self.spaces.append((prefix, name))
        check("spaces", len(self.spaces), self.place)

    def close(self) -> Element:
        return self.tree.close()

    def _count(self, more: int) -> None:
        # Entities can make more characters than the file has.
        self.characters += more
        check("characters", self.characters, self.place)


def xml_of(text: bytes, place: str | PathLike[str] | None, kind: str = ".svg") -> Tree:
    """Return the tree of an XML file.

    Raises
    ------
    FileError
        The text is not XML, or exceeds a limit of elements, levels or characters.
    """
    builder = _Builder(place)
    parser = XMLParser(target=builder)
    try:
        parser.feed(text)
        return Tree(parser.close(), builder.spaces)
    except (ParseError, ValueError, LookupError) as error:
        reason = f"it is not XML: {error!s:.200}"
        raise FileError("file-unreadable", place, suffix=kind, reason=reason) from error
