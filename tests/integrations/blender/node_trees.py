"""Node trees made by code: a table whose sockets are always used, and a chair with parts behind switches.

Both are boxes of a width, a depth and a height in the middle of a place, with z up.
"""

from __future__ import annotations

from typing import Any

import bpy


class Tree:
    """A Geometry Nodes group under construction."""

    def __init__(self, name: str) -> None:
        self.group = bpy.data.node_groups.new(name, "GeometryNodeTree")
        self.group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        self.group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
        self.inputs = self.node("NodeGroupInput")

    def node(self, kind: str, **settings: Any) -> Any:
        node = self.group.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def socket(self, name: str, kind: str, value: Any = None, low: Any = None, high: Any = None) -> Any:
        """Add an input; return its output of the group's input node."""
        item = self.group.interface.new_socket(name, in_out="INPUT", socket_type=f"NodeSocket{kind}")
        for attribute, number in (("min_value", low), ("max_value", high), ("default_value", value)):
            if number is not None:
                setattr(item, attribute, number)
        return next(output for output in self.inputs.outputs if output.identifier == item.identifier)

    def link(self, value: Any, socket: Any) -> None:
        """Link an output, or set a number."""
        if isinstance(value, bpy.types.NodeSocket):
            self.group.links.new(value, socket)
        else:
            socket.default_value = value

    def math(self, operation: str, a: Any, b: Any) -> Any:
        node = self.node("ShaderNodeMath", operation=operation)
        self.link(a, node.inputs[0])
        self.link(b, node.inputs[1])
        return node.outputs[0]

    def vector(self, x: Any, y: Any, z: Any) -> Any:
        node = self.node("ShaderNodeCombineXYZ")
        for value, socket in zip((x, y, z), node.inputs, strict=True):
            self.link(value, socket)
        return node.outputs[0]

    def box(self, size: Any, middle: tuple[Any, Any, Any]) -> Any:
        cube = self.node("GeometryNodeMeshCube")
        self.link(size if isinstance(size, bpy.types.NodeSocket) else self.vector(*size), cube.inputs["Size"])
        place = self.node("GeometryNodeTransform")
        self.link(cube.outputs[0], place.inputs["Geometry"])
        self.link(self.vector(*middle), place.inputs["Translation"])
        return place.outputs[0]

    def joined(self, *parts: Any) -> Any:
        node = self.node("GeometryNodeJoinGeometry")
        for part in parts:
            self.link(part, node.inputs[0])
        return node.outputs[0]

    def switch(self, control: Any, without: Any, having: Any) -> Any:
        node = self.node("GeometryNodeSwitch", input_type="GEOMETRY")
        self.link(control, node.inputs["Switch"])
        for part, name in ((without, "False"), (having, "True")):
            if part is not None:
                self.link(part, node.inputs[name])
        return node.outputs[0]

    def menu(self, control: Any, parts: dict[str, Any]) -> Any:
        node = self.node("GeometryNodeMenuSwitch", data_type="GEOMETRY")
        node.enum_items.clear()
        for name in parts:
            node.enum_items.new(name)
        self.link(control, node.inputs["Menu"])
        for name, part in parts.items():
            self.link(part, node.inputs[name])
        return node.outputs[0]

    def end(self, geometry: Any) -> bpy.types.NodeTree:
        self.link(geometry, self.node("NodeGroupOutput").inputs[0])
        return self.group


def table() -> bpy.types.NodeTree:
    """Make a table of two sockets with limits and two without; its legs are instances."""
    tree = Tree("Table")
    width = tree.socket("Width", "Float", 1.0, 0.6, 2.0)
    size = tree.socket("Top Size", "Vector", (1.0, 0.8, 0.1), 0.05, 1.5)
    height = tree.socket("Height", "Float", 0.7)
    tree.socket("Without Use", "Float", 1.0, 0.0, 2.0)
    node = tree.node("ShaderNodeSeparateXYZ")
    tree.link(size, node.inputs[0])
    _, depth, thick = node.outputs
    top = tree.box(
        (width, depth, thick), (0.0, 0.0, tree.math("SUBTRACT", height, tree.math("MULTIPLY", thick, 0.5)))
    )
    line = tree.node("GeometryNodeMeshLine")
    line.inputs["Count"].default_value = 2
    half = tree.math("MULTIPLY", width, 0.4)
    tree.link(
        tree.vector(tree.math("MULTIPLY", half, -1.0), 0.0, tree.math("MULTIPLY", height, 0.5)),
        line.inputs["Start Location"],
    )
    tree.link(tree.vector(tree.math("MULTIPLY", half, 2.0), 0.0, 0.0), line.inputs["Offset"])
    legs = tree.node("GeometryNodeInstanceOnPoints")
    cube = tree.node("GeometryNodeMeshCube")
    tree.link(tree.vector(0.1, depth, height), cube.inputs["Size"])
    tree.link(line.outputs[0], legs.inputs["Points"])
    tree.link(cube.outputs[0], legs.inputs["Instance"])
    return tree.end(tree.joined(top, legs.outputs[0]))


def chair() -> bpy.types.NodeTree:
    """Make a chair: its back has a height if there is a back, and a column a radius if it stands on one."""
    tree = Tree("Chair")
    width = tree.socket("Seat Width", "Float", 0.5, 0.35, 0.8)
    height = tree.socket("Seat Height", "Float", 0.45, 0.3, 0.7)
    stand = tree.socket("Stand", "Menu")
    leg = tree.socket("Leg", "Float", 0.06, 0.04, 0.15)
    radius = tree.socket("Column", "Float", 0.1, 0.05, 0.25)
    has_back = tree.socket("Back", "Bool", False)
    back = tree.socket("Back Height", "Float", 0.4, 0.2, 0.8)
    slats = tree.socket("Slats", "Int", 3, 1, 5)
    half = tree.math("MULTIPLY", height, 0.5)
    seat = tree.box((width, width, 0.08), (0.0, 0.0, height))
    out = tree.math("MULTIPLY", tree.math("SUBTRACT", width, leg), 0.5)
    minus = tree.math("MULTIPLY", out, -1.0)
    legs = tree.joined(
        *(tree.box((leg, leg, height), (x, y, half)) for x in (out, minus) for y in (out, minus))
    )
    side = tree.math("MULTIPLY", radius, 2.0)
    column = tree.box((side, side, height), (0.0, 0.0, half))
    line = tree.node("GeometryNodeMeshLine")
    tree.link(slats, line.inputs["Count"])
    step = tree.math("DIVIDE", width, slats)
    start = tree.math("SUBTRACT", tree.math("MULTIPLY", step, 0.5), tree.math("MULTIPLY", width, 0.5))
    rise = tree.math("ADD", height, tree.math("MULTIPLY", back, 0.5))
    tree.link(tree.vector(start, tree.math("MULTIPLY", width, 0.46), rise), line.inputs["Start Location"])
    tree.link(tree.vector(step, 0.0, 0.0), line.inputs["Offset"])
    slat = tree.node("GeometryNodeMeshCube")
    tree.link(
        tree.vector(tree.math("MULTIPLY", step, 0.6), tree.math("MULTIPLY", width, 0.08), back),
        slat.inputs["Size"],
    )
    copies = tree.node("GeometryNodeInstanceOnPoints")
    tree.link(line.outputs[0], copies.inputs["Points"])
    tree.link(slat.outputs[0], copies.inputs["Instance"])
    whole = tree.node("GeometryNodeRealizeInstances")
    tree.link(copies.outputs[0], whole.inputs[0])
    stands = tree.menu(stand, {"Legs": legs, "Pedestal": column})
    return tree.end(tree.joined(seat, stands, tree.switch(has_back, None, whole.outputs[0])))


def add(group: bpy.types.NodeTree, name: str) -> tuple[bpy.types.Object, bpy.types.Modifier]:
    """Add an object with a modifier of a group to the scene."""
    obj = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    bpy.context.scene.collection.objects.link(obj)
    modifier = obj.modifiers.new("GeometryNodes", "NODES")
    modifier.node_group = group
    bpy.context.view_layer.update()
    return obj, modifier
