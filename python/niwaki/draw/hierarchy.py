"""The hierarchy of nodes in a file: the calls of the model.

A component of an address (a call, an iteration of a loop) is a node that contains the nodes below it. The last
component names the part; an `emit` without a name gets the name of its call. A node with a single child is merged with
the child, and their names are joined by a dot. Components below the depth `DEEPEST` are merged in the same way, because
recursive readers could fail there. No name has a slash.

A node with children is at the place of its first child, and a rotation turns all children about this place. A choice is
an extra of the node of its call. If the call emits nothing, the nearest outer call with a node has the extra.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

#: The most levels of nodes: Blender shows all of them, and recursive readers can read them.
DEEPEST = 32

#: A choice: its address and its value in JSON.
Choice = tuple[str, Any]


@dataclass
class _Call:
    """A call: inner calls, names and numbers of parts, and choices."""

    below: dict[str, _Call] = field(default_factory=dict)
    parts: list[tuple[str, int]] = field(default_factory=list)
    choices: list[Choice] = field(default_factory=list)


def hierarchy(nodes: list[dict[str, Any]], choices: Iterable[Choice] = ()) -> tuple[list[int], list[Choice]]:
    """Name the nodes of parts by their addresses, and append the nodes of calls.

    Parameters
    ----------
    nodes
        Nodes of parts, with the address among their extras. Their translation in the scene becomes relative to the
        parent node.
    choices
        Choices, which become extras.

    Returns
    -------
    topmost : list of int
        The numbers of the nodes without a parent.
    choices : list
        Choices of calls that have no node and no outer call with a node.
    """
    root = _Call()
    for number, node in enumerate(nodes):
        *path, last = node["extras"]["address"].split("/")
        call = root
        for part in _levels(path):
            call = call.below.setdefault(part, _Call())
        call.parts.append(("" if re.fullmatch(r"emit(#\d+)?", last) else last, number))
    for address, value in choices:
        call = root
        for part in _levels(address.split("/")[:-1]):
            if part not in call.below:
                break
            call = call.below[part]
        call.choices.append((address, value))
    topmost = _place(root, "", nodes)
    places = [node["translation"] for node in nodes]
    for node, place in zip(nodes, places, strict=True):
        for child in node.get("children", ()):
            nodes[child]["translation"] = [a - b for a, b in zip(places[child], place, strict=True)]
    return topmost, root.choices


def _levels(path: list[str]) -> list[str]:
    return [*path[:DEEPEST], *([".".join(path[DEEPEST:])] if path[DEEPEST:] else [])]


def _place(call: _Call, name: str, nodes: list[dict[str, Any]]) -> list[int]:
    """Append the nodes of a call with this name; return the numbers of its direct children."""
    children = []
    for part_name, number in call.parts:
        nodes[number]["name"] = part_name or name or "emit"
        children.append(number)
    for component, inner in call.below.items():
        inside = _place(inner, component, nodes)
        if len(inside) == 1:
            only = nodes[inside[0]]
            if only["name"] != component:
                only["name"] = f"{component}.{only['name']}"
            children.append(inside[0])
        else:
            nodes.append(
                {"name": component, "translation": nodes[inside[0]]["translation"], "children": inside}
            )
            children.append(len(nodes) - 1)
        if inner.choices:
            extras = nodes[children[-1]].setdefault("extras", {})
            choices = [{"address": address, "value": value} for address, value in inner.choices]
            # Choices of the outer call come first.
            extras["choices"] = choices + extras.get("choices", [])
    return children
