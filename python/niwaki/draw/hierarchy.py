"""The nodes of a file in the hierarchy of the model's calls.

A component of an address (a call, an iteration of a loop) is a node that holds the nodes below it. The last component
names the part; an `emit` without a name is called after its call. A node that would hold one node only is that node,
its name written before with a dot, and so are the components below the depth `DEEPEST`, where readers that call
themselves could fail. So no name has a slash.

A node that holds others stands where the first of them stands, and turning it turns them about that place. A choice is
an extra of the node of its call; of a call that emits nothing, of the nearest call around it that has a node.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

#: Most levels of nodes: Blender shows them all, and readers that call themselves survive.
DEEPEST = 32

#: An address and a value, as JSON has it.
Noted = tuple[str, Any]


@dataclass
class _Call:
    """What is below a component: other components, numbers of parts with their names, and its own choices."""

    below: dict[str, _Call] = field(default_factory=dict)
    parts: list[tuple[str, int]] = field(default_factory=list)
    choices: list[Noted] = field(default_factory=list)


def hierarchy(nodes: list[dict[str, Any]], choices: Iterable[Noted] = ()) -> tuple[list[int], list[Noted]]:
    """Name the nodes of parts by their addresses and append the nodes that hold them.

    Parameters
    ----------
    nodes
        With the address among their extras, and their translation in the scene, which becomes that in the node around.
    choices
        They become extras, too.

    Returns
    -------
    topmost : list of int
        The numbers of the nodes that no other one holds.
    choices : list
        Those of calls that have no node, and are in none that has one.
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
    topmost = _placed(root, "", nodes)
    places = [node["translation"] for node in nodes]
    for node, place in zip(nodes, places, strict=True):
        for child in node.get("children", ()):
            nodes[child]["translation"] = [a - b for a, b in zip(places[child], place, strict=True)]
    return topmost, root.choices


def _levels(path: list[str]) -> list[str]:
    return [*path[:DEEPEST], *([".".join(path[DEEPEST:])] if path[DEEPEST:] else [])]


def _placed(call: _Call, name: str, nodes: list[dict[str, Any]]) -> list[int]:
    """The nodes of what is in a call; `name` is its own."""
    found = []
    for own, number in call.parts:
        nodes[number]["name"] = own or name or "emit"
        found.append(number)
    for component, inner in call.below.items():
        held = _placed(inner, component, nodes)
        if len(held) == 1:
            only = nodes[held[0]]
            if only["name"] != component:
                only["name"] = f"{component}.{only['name']}"
            found.append(held[0])
        else:
            nodes.append({"name": component, "translation": nodes[held[0]]["translation"], "children": held})
            found.append(len(nodes) - 1)
        if inner.choices:
            extras = nodes[found[-1]].setdefault("extras", {})
            noted = [{"address": address, "value": value} for address, value in inner.choices]
            # The outer call has chosen before.
            extras["choices"] = noted + extras.get("choices", [])
    return found
