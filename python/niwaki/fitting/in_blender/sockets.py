"""The sockets of a Geometry Nodes modifier: limits, values, which of them are used, and when.

A socket behind a Switch or a Menu Switch is used only while the switch lets it through. The tree is followed from its
output back to its sockets; what no link shows counts as used always.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

#: Kinds of sockets that are parameters, by Blender's types. A vector is one for each of its components.
KINDS = {
    "NodeSocketFloat": "real",
    "NodeSocketInt": "whole",
    "NodeSocketBool": "switch",
    "NodeSocketMenu": "menu",
    "NodeSocketVector": "vector",
}

#: The names of a vector's components.
COMPONENTS = "xyzw"

#: A limit of this size counts as none: earlier versions of Blender gave it to every socket.
NO_LIMIT = 10_000.0

#: Conditions of a socket beyond this number, and visits of nodes, after which all sockets count as used always.
MOST_RULES, MOST_VISITS = 8, 20_000

#: Values of sockets under which something is used, by the sockets' identifiers.
Rule = dict[str, list[Any]]

_Literals = frozenset[tuple[str, Any]]


class NodeTreeError(ValueError):
    """A modifier that cannot be fitted.

    Attributes
    ----------
    reason, cure : str
        What is wrong, and what to do.
    """

    def __init__(self, reason: str, cure: str) -> None:
        super().__init__(f"{reason}: {cure}")
        self.reason, self.cure = reason, cure


@dataclass(frozen=True)
class Socket:
    """A number, switch or menu of a modifier; of a vector, one component.

    Attributes
    ----------
    name : str
        Its name in the modifier, with the panel's if two have the same.
    identifier : str
        Blender's name of the socket.
    component : int or None
        The place in a vector.
    kind : str
        "real", "whole", "switch" or "menu".
    value : float, int, bool or str
        Its value; the name of a menu's entry.
    low, high : float or None
        Its limits.
    subtype : str
        Blender's subtype of a number, such as "ANGLE".
    entries : list of str
        The entries of a menu.
    is_used : bool
        Whether the output of the tree depends on it for any values of the switches.
    rules : list of Rule
        Conditions, of which one must hold; empty if it is used always.
    """

    name: str
    identifier: str
    component: int | None
    kind: str
    value: Any
    low: float | None
    high: float | None
    subtype: str
    entries: list[str]
    is_used: bool
    rules: list[Rule]

    @property
    def key(self) -> str:
        """The identifier, with the component's number."""
        return self.identifier if self.component is None else f"{self.identifier}.{self.component}"


def find(objects: Iterable[Any], object_name: str | None, modifier_name: str | None) -> tuple[Any, Any]:
    """Return an object and its modifier; without names the only one that there is.

    Raises
    ------
    NodeTreeError
        There is none of this name, several could be meant, or the modifier is not of Geometry Nodes.
    """
    rows = list(objects)
    having = [obj for obj in rows if any(map(is_node_tree, obj.modifiers))]
    listed = ", ".join(obj.name for obj in having) or "none"
    if object_name is not None:
        chosen = next((obj for obj in rows if obj.name == object_name), None)
        if chosen is None:
            cure = f"name one of the objects with a Geometry Nodes modifier: {listed}"
            raise NodeTreeError(f"there is no object `{object_name}`", cure)
    elif len(having) == 1:
        chosen = having[0]
    elif having:
        raise NodeTreeError("several objects have a Geometry Nodes modifier", f"name one of {listed}")
    else:
        cure = "add one to an object in Blender, with a node group of its own, and save the file"
        raise NodeTreeError("no object has a Geometry Nodes modifier", cure)
    return chosen, find_modifier(chosen, modifier_name)


def find_modifier(obj: Any, name: str | None) -> Any:
    """Return a Geometry Nodes modifier of an object; without a name the only one.

    Raises
    ------
    NodeTreeError
        There is none of this name, several could be meant, or it is not of Geometry Nodes.
    """
    fitting = [modifier for modifier in obj.modifiers if is_node_tree(modifier)]
    listed = ", ".join(modifier.name for modifier in fitting) or "none"
    if name is None:
        if len(fitting) == 1:
            return fitting[0]
        if fitting:
            raise NodeTreeError(f"`{obj.name}` has several Geometry Nodes modifiers", f"name one of {listed}")
        cure = "add one in Blender, or name another object"
        raise NodeTreeError(f"`{obj.name}` has no Geometry Nodes modifier", cure)
    modifier = next((entry for entry in obj.modifiers if entry.name == name), None)
    if modifier is None:
        raise NodeTreeError(
            f"`{obj.name}` has no modifier `{name}`",
            f"name one of its Geometry Nodes modifiers: {listed}",
        )
    if modifier.type != "NODES":
        kind = str(modifier.type).replace("_", " ").lower()
        raise NodeTreeError(
            f"the modifier `{name}` is a {kind} modifier and not one of Geometry Nodes",
            f"name one of Geometry Nodes: {listed}",
        )
    if modifier.node_group is None:
        raise NodeTreeError(
            f"the modifier `{name}` has no node group", "choose one in Blender, and save the file"
        )
    return modifier


def is_node_tree(modifier: Any) -> bool:
    """Tell whether a modifier is one of Geometry Nodes with a node group."""
    return modifier.type == "NODES" and modifier.node_group is not None


def sockets(modifier: Any, follow: bool = True) -> list[Socket]:
    """Return the numbers, switches and menus that a person can set in a modifier, in its order.

    A socket that reads an attribute, or that the modifier hides, is left out.

    Parameters
    ----------
    modifier
        The modifier.
    follow
        Whether to follow the tree; otherwise all sockets count as used always.
    """
    items = [item for item in _inputs(modifier.node_group) if item.socket_type in KINDS]
    items = [item for item in items if not item.hide_in_modifier and not _reads_attribute(modifier, item)]
    discrete: dict[str, list[Any]] = {
        item.identifier: [False, True]
        if item.socket_type == "NodeSocketBool"
        else entries(modifier, item.identifier)
        for item in items
        if item.socket_type in ("NodeSocketBool", "NodeSocketMenu")
    }
    always: dict[str, list[Rule]] = {item.identifier: [] for item in items}
    uses = conditions(modifier.node_group, discrete) if follow else always
    names = _names(items)
    rows = []
    for item in items:
        name, identifier = names[item.identifier], item.identifier
        rules = uses.get(identifier)
        rest: dict[str, Any] = {"is_used": rules is not None, "rules": rules or []}
        kind, value = KINDS[item.socket_type], read(modifier, identifier)
        options = discrete[identifier] if kind == "menu" else []
        if kind == "menu" and not options:
            continue
        limits: dict[str, Any] = {"low": None, "high": None, "subtype": ""}
        if kind in ("real", "whole", "vector"):
            limits = {"low": _limit(item.min_value), "high": _limit(item.max_value), "subtype": item.subtype}
        if kind != "vector":
            rows.append(Socket(name, identifier, None, kind, value, entries=options, **limits, **rest))
            continue
        for place, number in enumerate(value):
            called = f"{name}.{COMPONENTS[place]}"
            rows.append(Socket(called, identifier, place, "real", number, entries=[], **limits, **rest))
    return rows


def read(modifier: Any, identifier: str) -> Any:
    """Return the value of a socket: a number, a switch, a list of numbers, the name of a menu's entry."""
    inputs = _new_inputs(modifier)
    value = modifier[identifier] if inputs is None else getattr(inputs, identifier).value
    if isinstance(value, bool | str):
        return value
    if isinstance(value, float):
        return _short(value)
    if isinstance(value, int):
        options = dict(_old_entries(modifier, identifier)) if inputs is None else {}
        return next((name for name, number in options.items() if number == value), "") if options else value
    return [_short(number) for number in value]


def write(modifier: Any, identifier: str, value: Any) -> None:
    """Set the value of a socket."""
    inputs = _new_inputs(modifier)
    if inputs is not None:
        getattr(inputs, identifier).value = value
    elif isinstance(value, str):
        modifier[identifier] = dict(_old_entries(modifier, identifier))[value]
    else:
        modifier[identifier] = value


def entries(modifier: Any, identifier: str) -> list[str]:
    """Return the names of a menu's entries."""
    inputs = _new_inputs(modifier)
    if inputs is None:
        return [name for name, _ in _old_entries(modifier, identifier)]
    return [entry.identifier for entry in getattr(inputs, identifier).bl_rna.properties["value"].enum_items]


def write_all(modifier: Any, rows: Iterable[Socket], values: Mapping[str, Any]) -> None:
    """Set sockets by their keys; those without a value get the one that they had when they were read."""
    vectors: dict[str, list[float]] = {}
    for row in rows:
        value = values.get(row.key, row.value)
        if row.component is not None:
            # Components come in order.
            vectors.setdefault(row.identifier, []).append(float(value))
        elif row.kind == "switch":
            write(modifier, row.identifier, bool(value))
        elif row.kind == "menu":
            # A menu that was never set has no value.
            if value:
                write(modifier, row.identifier, str(value))
        else:
            write(modifier, row.identifier, float(value) if row.kind == "real" else round(value))
    for identifier, vector in vectors.items():
        write(modifier, identifier, vector)
    # Blender does not see that a custom property has changed.
    modifier.id_data.update_tag()


def conditions(tree: Any, discrete: Mapping[str, list[Any]]) -> dict[str, list[Rule]]:
    """Return when each socket of a tree is used; a socket that the output does not depend on is missing.

    Parameters
    ----------
    tree
        The node group.
    discrete
        The values of switches and menus by identifier.

    Returns
    -------
    dict
        Conditions of which one must hold; no condition for a socket that is used always.
    """
    walk = _Walk(discrete)
    try:
        walk.output(None, tree, None, frozenset())
    except _TooManyError:
        return {item.identifier: [] for item in _inputs(tree)}
    return {identifier: _rules(literals, discrete) for identifier, literals in walk.uses.items()}


class _TooManyError(Exception):
    """The tree has too many paths."""


class _Walk:
    """A walk from the output of a tree back to its sockets.

    A place is a frame and a node: the frame is a group node with the frame around it; None for the tree itself.
    """

    def __init__(self, discrete: Mapping[str, list[Any]]) -> None:
        self.discrete = discrete
        self.uses: dict[str, list[_Literals]] = {}
        self._seen: dict[Any, list[_Literals]] = {}
        self._visits = 0

    def output(self, frame: Any, tree: Any, identifier: str | None, when: _Literals) -> None:
        """Follow an output of a tree; without a name all of them."""
        for node in tree.nodes:
            if node.bl_idname == "NodeGroupOutput" and getattr(node, "is_active_output", True):
                for socket in node.inputs:
                    if identifier is None or socket.identifier == identifier:
                        self.input(frame, socket, when)

    def input(self, frame: Any, socket: Any, when: _Literals) -> None:
        """Follow the links into a socket of a node."""
        for link in socket.links:
            if not link.is_muted:
                self.node(frame, link.from_node, link.from_socket, when)

    def node(self, frame: Any, node: Any, socket: Any, when: _Literals) -> None:
        """Follow what an output of a node depends on."""
        if self._is_known((_key(frame), node.name, socket.identifier), when):
            return
        if node.bl_idname == "NodeGroupInput":
            self._group_input(frame, socket, when)
        elif node.bl_idname == "GeometryNodeGroup" and node.node_tree is not None and not node.mute:
            self.output((frame, node), node.node_tree, socket.identifier, when)
        elif node.bl_idname in ("GeometryNodeSwitch", "GeometryNodeMenuSwitch") and not node.mute:
            self._switch(frame, node, when)
        else:
            self._all(frame, node, when)

    def _group_input(self, frame: Any, socket: Any, when: _Literals) -> None:
        if frame is None:
            self.uses.setdefault(socket.identifier, []).append(when)
            return
        outer, group = frame
        for entry in group.inputs:
            if entry.identifier == socket.identifier:
                self.input(outer, entry, when)

    def _switch(self, frame: Any, node: Any, when: _Literals) -> None:
        is_menu = node.bl_idname == "GeometryNodeMenuSwitch"
        rows = [socket for socket in node.inputs if socket.enabled]
        control = next((row for row in rows if row.name == ("Menu" if is_menu else "Switch")), None)
        if control is None:
            self._all(frame, node, when)
            return
        self.input(frame, control, when)
        source = self._source(frame, control)
        for row in rows:
            if row is control or row.name == control.name:
                continue
            value = row.name if is_menu else {"False": False, "True": True}.get(row.name)
            if source is None or value not in self.discrete[source]:
                self.input(frame, row, when)
            elif all(other == value for name, other in when if name == source):
                self.input(frame, row, when | {(source, value)})

    def _source(self, frame: Any, socket: Any) -> str | None:
        """Return the switch or menu of the tree that a socket is linked to directly."""
        links = [link for link in socket.links if not link.is_muted]
        if len(links) != 1:
            return None
        node, origin = links[0].from_node, links[0].from_socket
        if node.bl_idname == "NodeReroute":
            return self._source(frame, node.inputs[0])
        if node.bl_idname != "NodeGroupInput":
            return None
        if frame is None:
            return origin.identifier if origin.identifier in self.discrete else None
        outer, group = frame
        entry = next((entry for entry in group.inputs if entry.identifier == origin.identifier), None)
        return None if entry is None else self._source(outer, entry)

    def _all(self, frame: Any, node: Any, when: _Literals) -> None:
        for socket in node.inputs:
            self.input(frame, socket, when)
        # The two ends of a zone belong together.
        for other in node.id_data.nodes:
            if getattr(other, "paired_output_node", None) == node:
                for socket in other.inputs:
                    self.input(frame, socket, when)

    def _is_known(self, place: Any, when: _Literals) -> bool:
        """Tell whether a place was reached under a condition that includes this one; note it otherwise."""
        earlier = self._seen.setdefault(place, [])
        if any(other <= when for other in earlier):
            return True
        earlier.append(when)
        self._visits += 1
        if self._visits > MOST_VISITS:
            raise _TooManyError
        return False


def _key(frame: Any) -> Any:
    return None if frame is None else (_key(frame[0]), frame[1].name)


def _rules(uses: Iterable[_Literals], discrete: Mapping[str, list[Any]]) -> list[Rule]:
    """Simplify conditions of which one must hold; an empty list if one of them always does."""
    rules: list[dict[str, frozenset[Any]]] = []
    for literals in uses:
        rule = {name: frozenset([value]) for name, value in literals}
        if rule not in rules:
            rules.append(rule)
    joined = True
    while joined:
        joined = False
        for a in rules:
            for b in rules:
                both = None if a is b else _union(a, b, discrete)
                if both is not None:
                    rules = [rule for rule in rules if rule is not a and rule is not b]
                    if both not in rules:
                        rules.append(both)
                    joined = True
                    break
            if joined:
                break
    if len(rules) > MOST_RULES or not all(rules):
        return []
    return [
        {name: [value for value in discrete[name] if value in values] for name, values in rule.items()}
        for rule in rules
    ]


def _union(
    a: Mapping[str, frozenset[Any]], b: Mapping[str, frozenset[Any]], discrete: Mapping[str, list[Any]]
) -> dict[str, frozenset[Any]] | None:
    """Return one condition for two of which one must hold, if they differ in one socket or one includes the other."""
    if all(name in b and b[name] <= values for name, values in a.items()):
        return dict(a)
    differing = [name for name in a if a.get(name) != b.get(name)]
    if a.keys() != b.keys() or len(differing) != 1:
        return None
    (name,) = differing
    values = a[name] | b[name]
    rest = {other: entry for other, entry in a.items() if other != name}
    return rest if values == frozenset(discrete[name]) else {**rest, name: values}


def _inputs(tree: Any) -> list[Any]:
    return [
        item for item in tree.interface.items_tree if item.item_type == "SOCKET" and item.in_out == "INPUT"
    ]


def _names(items: Iterable[Any]) -> dict[str, str]:
    """Return a name of its own for each socket, by identifier."""
    rows = {item.identifier: item.name for item in items}
    panels = {item.identifier: getattr(getattr(item, "parent", None), "name", "") for item in items}
    out: dict[str, str] = {}
    for identifier, name in rows.items():
        twins = [other for other in rows if rows[other] == name]
        called = name
        if len(twins) > 1 and panels[identifier]:
            called = f"{panels[identifier]}: {name}"
        if called in out.values() or (len(twins) > 1 and not panels[identifier]):
            called = f"{name} ({identifier})"
        out[identifier] = called
    return out


def _limit(value: float) -> float | None:
    return None if abs(value) >= NO_LIMIT else _short(value)


def _short(value: float) -> float:
    """Return a number of single precision as a person wrote it."""
    return float(f"{value:.7g}")


def _new_inputs(modifier: Any) -> Any:
    """Return the inputs of a modifier as Blender 5.2 has them; None before."""
    return getattr(getattr(modifier, "properties", None), "inputs", None)


def _old_entries(modifier: Any, identifier: str) -> list[tuple[str, int]]:
    try:
        table = modifier.id_properties_ui(identifier).as_dict()
    except TypeError:
        return []
    return [(row[0], row[4]) for row in table.get("items", ())]


def _reads_attribute(modifier: Any, item: Any) -> bool:
    inputs = _new_inputs(modifier)
    if inputs is None:
        return item.identifier not in modifier or bool(modifier.get(f"{item.identifier}_use_attribute"))
    entry = getattr(inputs, item.identifier, None)
    return entry is None or getattr(entry, "type", "VALUE") == "ATTRIBUTE"
