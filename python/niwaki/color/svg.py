"""The regions of an SVG file, and the file with each region painted.

The class of a shape names its region; a shape without a class takes the class of the nearest group around it. Where
there is no class, the nearest id counts. `data-stroke` names another region for the shape's stroke. Shapes without any
name keep their colours and belong to no region. Each `use` is replaced by a copy of the shape that it uses, so that two
uses of one shape can have two colours.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from niwaki.color.raster import raster
from niwaki.color.styles import INITIAL, SelectorError, Styles, declarations, tag_of
from niwaki.errors import FileError
from niwaki.inputs.limits import beyond, check, limit
from niwaki.inputs.xml import xml_of

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
SHAPES = {"path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text"}
NO_PAINT = ("none", "transparent")
GROUPS = {"svg", "g", "a", "switch"}

# Styles for counting pixels: each shape is whole, opaque and in a flat colour.
PLAIN = {
    "opacity": "1",
    "fill-opacity": "1",
    "stroke-opacity": "1",
    "filter": "none",
    "mix-blend-mode": "normal",
    "shape-rendering": "crispEdges",
}


@dataclass(frozen=True)
class Shape:
    """A painted shape, with the regions of its fill and its stroke: None without that paint, empty without a name."""

    element: Element
    fill: str | None
    stroke: str | None


class Artwork:
    """An SVG file, divided into regions.

    Attributes
    ----------
    names : tuple of str
        The regions, in the order of their first shapes.
    """

    def __init__(self, text: bytes, place: str | Path | None = None) -> None:
        self.place = place
        self._tree = _parsed(text, place)
        self._shapes: list[Shape] = []
        sheets = ["".join(element.itertext()) for element in self._tree.iter() if tag_of(element) == "style"]
        try:
            self._styles = Styles.of(sheets, place)
        except SelectorError as error:
            raise FileError(
                "drawing-unclear",
                place,
                reason=f"the style sheet's selector `{error!s:.80}` has more than a tag, classes and ids",
            ) from error
        self._by_id = {element.get("id"): element for element in self._tree.iter() if element.get("id")}
        self._copies = self._characters = 0
        self._expand(self._tree, (), 0)
        self._walk(self._tree, dict(INITIAL), "", "")
        named = [name for shape in self._shapes for name in (shape.fill, shape.stroke) if name]
        self.names = tuple(dict.fromkeys(named))

    def painted(self, colors: Mapping[str, str], plain: bool = False) -> str:
        """Write the file with its regions in these colours.

        Parameters
        ----------
        colors
            Colours by region, as CSS writes them: `#a04020`. Other regions keep their colours.
        plain
            Without transparency, filters and soft edges; shapes without a region are black.
        """
        root = deepcopy(self._tree)
        copies = {id(old): new for old, new in zip(self._tree.iter(), root.iter(), strict=True)}
        if plain:
            for new in copies.values():
                _flatten(new)
        for shape in self._shapes:
            element = copies[id(shape.element)]
            style = declarations(element.get("style", ""))
            for key, region in (("fill", shape.fill), ("stroke", shape.stroke)):
                if region is not None and region in colors:
                    style[key] = colors[region]
                elif plain and region == "":
                    style[key] = "#000000"
            element.set("style", _written(style))
        for element in root.iter():
            # A sheet's `!important` would win over the new colours.
            if tag_of(element) == "style" and element.text:
                element.text = element.text.replace("!important", "")
        return ElementTree.tostring(root, encoding="unicode")

    def labels(self, size: int) -> NDArray[np.int64]:
        """Number the region of each pixel, (height, width); -1 for none. The longer side has `size` pixels."""
        codes = [(k + 1) * 2654435761 % (1 << 24) for k in range(len(self.names))]
        text = self.painted(
            {name: f"#{code:06x}" for name, code in zip(self.names, codes, strict=True)}, plain=True
        )
        pixels = np.asarray(raster(text, size, self.place).convert("RGBA"), dtype=np.int64)
        pixel_codes = (pixels[..., 0] << 16) | (pixels[..., 1] << 8) | pixels[..., 2]
        labels = np.full(pixel_codes.shape, -1, dtype=np.int64)
        for k, code in enumerate(codes):
            labels[(pixel_codes == code) & (pixels[..., 3] >= 128)] = k
        # Soft edges of clips and masks mix two codes: such a pixel goes to a neighbour's region.
        mixed = (labels < 0) & (pixels[..., 3] >= 128) & (pixel_codes != 0)
        return _settled(labels, mixed)

    def _expand(self, element: Element, within: tuple[str, ...], depth: int) -> None:
        """Replace each `use` below the element by a group with a copy of its source."""
        check("depth", depth, self.place)
        for place, child in enumerate(list(element)):
            tag = tag_of(child)
            if tag == "use":
                name = (child.get("href") or child.get(f"{{{XLINK}}}href") or "").removeprefix("#")
                if name in within:
                    raise FileError("drawing-unclear", self.place, reason=f"`#{name}` uses itself")
                group = self._used(child, name)
                element[place] = group
                self._expand(group, (*within, name), depth + 1)
            elif tag in GROUPS:
                self._expand(child, within, depth + 1)

    def _used(self, use: Element, name: str) -> Element:
        attributes = {k: v for k, v in use.attrib.items() if k.rpartition("}")[2] not in _USE_ONLY}
        shift = f"translate({use.get('x', '0')} {use.get('y', '0')})"
        if shift != "translate(0 0)":
            attributes["transform"] = f"{attributes.get('transform', '')} {shift}".strip()
        group = Element(f"{{{SVG}}}g", attributes)
        group.tail = use.tail
        source = self._by_id.get(name)
        if source is None:
            return group
        for element in source.iter():
            self._copies += 1
            if self._copies > limit("elements"):
                raise beyond(
                    "elements", f"its `use`s create more than {limit('elements'):,} elements", self.place
                )
            self._characters += sum(map(len, element.attrib.values())) + len(element.text or "")
            check("characters", self._characters, self.place)
        copy = deepcopy(source)
        # The definition's id is only a reference; the `use` or a class names the region.
        for element in copy.iter():
            if element is copy or tag_of(element) not in SHAPES | GROUPS | {"use"}:
                element.attrib.pop("id", None)
        if tag_of(copy) == "symbol":
            copy.tag = f"{{{SVG}}}svg"
            for key in ("width", "height"):
                copy.set(key, use.get(key, "100%"))
        group.append(copy)
        return group

    def _walk(self, element: Element, above: dict[str, str], by_class: str, by_id: str) -> None:
        tag = tag_of(element)
        if tag not in SHAPES | GROUPS:
            return
        style = self._styles.resolve(element, above)
        if style["display"] == "none":
            return
        classes = element.get("class", "").split()
        by_class = classes[0] if classes else by_class
        by_id = element.get("id", by_id)
        if tag in GROUPS:
            for child in element:
                self._walk(child, style, by_class, by_id)
            return
        name = by_class or by_id
        if style["visibility"] != "visible":
            return
        fill = name if style["fill"] not in NO_PAINT and tag != "line" else None
        stroke = element.get("data-stroke", name) if style["stroke"] not in NO_PAINT else None
        if fill is not None or stroke is not None:
            self._shapes.append(Shape(element, fill, stroke))


_USE_ONLY = {"href", "x", "y", "width", "height"}


def _parsed(text: bytes, place: str | Path | None) -> Element:
    tree = xml_of(text, place)
    root = tree.root
    # Attributes of other programs keep their prefixes.
    for prefix, space in tree.spaces:
        if prefix and not re.fullmatch(r"ns\d+", prefix):
            ElementTree.register_namespace(prefix, space)
    ElementTree.register_namespace("", SVG)
    if tag_of(root) != "svg":
        reason = f"its outermost element is `{tag_of(root):.80}`, not `svg`"
        raise FileError("file-unreadable", place, suffix=".svg", reason=reason)
    for element in root.iter():
        if tag_of(element) in ("image", "feImage"):
            _check_image(element, place)
    return root


def _check_image(element: Element, place: str | Path | None) -> None:
    """Refuse an image from another file: a drawing shows only its own contents."""
    for name in ("href", f"{{{XLINK}}}href"):
        shown = element.get(name, "").strip()
        if shown and not shown.startswith(("data:", "#")):
            raise FileError(
                "drawing-unclear", place, reason=f"it shows another file, {shown!a:.80}; embed that image"
            )


def _flatten(element: Element) -> None:
    tag = tag_of(element)
    if tag not in SHAPES | GROUPS | {"tspan", "image"}:
        return
    style = declarations(element.get("style", ""))
    style.update(PLAIN)
    if tag == "image":
        style["display"] = "none"
    if tag == "tspan":
        style.pop("fill", None)
        element.attrib.pop("fill", None)
    element.set("style", _written(style))


def _written(style: Mapping[str, str]) -> str:
    return ";".join(f"{key}:{value}" for key, value in style.items())


def _settled(labels: NDArray[np.int64], open_: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Give each open pixel the label of a neighbour, ring by ring; at most 4 rings."""
    labels = labels.copy()
    for _ in range(4):
        if not open_.any():
            break
        for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            beside = np.roll(labels, (dy, dx), (0, 1))
            take = open_ & (labels < 0) & (beside >= 0)
            labels[take] = beside[take]
        open_ = open_ & (labels < 0)
    return labels
