"""The nodes of a file in the hierarchy of the model's calls.

A component of an address (a call, an iteration of a loop) is a node that holds the nodes below it. The last component
names the part; an `emit` without a name is called after its call. A node that would hold one node only is that node,
its name written before with a dot, and so are the components below the depth `DEEPEST`, where readers that call
themselves could fail. So no name has a slash.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

#: Most levels of nodes: Blender shows them all, and readers that call themselves survive.
DEEPEST = 32


@dataclass
class _Call:
    """What is below a component: other components, and numbers of parts with their names."""

    below: dict[str, _Call] = field(default_factory=dict)
    parts: list[tuple[str, int]] = field(default_factory=list)


def hierarchy(nodes: list[dict[str, Any]]) -> list[int]:
    """Name the nodes of parts by their addresses and append the nodes that hold them; the numbers of the topmost."""
    root = _Call()
    for number, node in enumerate(nodes):
        *path, last = node["extras"]["address"].split("/")
        call = root
        for part in [*path[:DEEPEST], *([".".join(path[DEEPEST:])] if path[DEEPEST:] else [])]:
            call = call.below.setdefault(part, _Call())
        call.parts.append(("" if re.fullmatch(r"emit(#\d+)?", last) else last, number))
    return _placed(root, "", nodes)


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
            nodes.append({"name": component, "children": held})
            found.append(len(nodes) - 1)
    return found
