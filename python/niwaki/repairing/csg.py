"""Parts of an OpenSCAD file: the objects at its top, as solids of their own.

The program `openscad` writes the file as a tree of solids with all values computed (its format `.csg`), in a few
hundredths of a second; the solids are made of it here, by the library manifold3d. A loop at the top of the file gives a
part for each turn.
"""

from __future__ import annotations

import math
import re
import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from niwaki.errors import InputError
from niwaki.errors.extras import optional
from niwaki.fitting.commands import SHOWN
from niwaki.fitting.openscad import PROGRAM, program_output

_TOKEN = re.compile(
    r'"(?:\\.|[^"\\])*"|\$?[A-Za-z_]\w*|-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-{}()\[\],=;#%*!:]'
)
#: Words before an object's own name.
PLACING = {"translate", "rotate", "scale", "mirror", "color", "multmatrix", "render", "resize"}


@dataclass
class Node:
    """A node of the tree: its name, its arguments, its children."""

    name: str
    arguments: dict[str, Any]
    children: list[Node] = field(default_factory=list)


def parts_of_scad(text: str, path: Path) -> dict[str, Any]:
    """Return the objects at the top of an OpenSCAD text by name, as solids of manifold3d.

    Raises
    ------
    InputError
        `no-openscad`: the program is not there.
    RuntimeError
        It refuses the text.
    """
    program = shutil.which(PROGRAM)
    if program is None:
        raise InputError("no-openscad", name=path.name)
    with program_output(program, text, path.parent, "tree.csg") as (place, done, errors):
        if done.returncode or errors or not place.is_file():
            raise RuntimeError(f"openscad: {errors[:SHOWN] or done.stderr[-SHOWN:].strip()}")
        tree = place.read_text()
    kernel = optional("manifold3d", "reading the parts of an OpenSCAD file", "print")
    nodes = parsed(tree)
    names = statements(text)
    if len(names) != len(nodes):
        names = [("part", False)] * len(nodes)
    pairs: list[tuple[str, Any]] = []
    for node, (name, is_loop) in zip(nodes, names, strict=True):
        entries = node.children if is_loop and node.name in ("group", "union") else [node]
        pairs += [(name, solid(entry, kernel)) for entry in entries]
    total = {name: sum(other == name for other, _ in pairs) for name, _ in pairs}
    count: dict[str, int] = {}
    out = {}
    for name, body in pairs:
        count[name] = count.get(name, 0) + 1
        out[name if total[name] == 1 else f"{name} {count[name]}"] = body
    return out


def statements(text: str) -> list[tuple[str, bool]]:
    """Return the objects at the top of a text: the name of each, and whether a loop makes several."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)
    out: list[tuple[str, bool]] = []
    depth, start = 0, 0
    for match in re.finditer(r'"(?:\\.|[^"\\])*"|[{}()\[\];]', text):
        word = match[0]
        depth += (word in "{([") - (word in "})]")
        if depth == 0 and word in "};":
            statement = text[start : match.start() + 1].strip()
            rest = text[match.end() :].lstrip()
            if word == "}" and rest.startswith("else"):
                continue
            start = match.end()
            if re.match(r"(?:module|function|use|include)\b|\$?\w+\s*=[^=]|;|$", statement):
                continue
            words = re.findall(r"([A-Za-z_]\w*)\s*\(", statement)
            is_loop = bool(words) and words[0] == "for"
            called = [entry for entry in words if entry not in PLACING and entry not in ("for", "if")]
            out.append((called[0] if called else "part", is_loop))
    return out


def parsed(tree: str) -> list[Node]:
    """Read the text of a tree."""
    tokens = _TOKEN.findall(tree)
    nodes, place = _nodes(tokens, 0)
    if place != len(tokens):
        raise RuntimeError("openscad wrote a tree that cannot be read")
    return nodes


def _nodes(tokens: list[str], at: int) -> tuple[list[Node], int]:
    out = []
    while at < len(tokens) and tokens[at] != "}":
        if tokens[at] in "#%*!;":
            # Marks of how a part is shown.
            at += 1
            continue
        name, at = tokens[at], at + 1
        arguments: dict[str, Any] = {}
        while tokens[at] != ")":
            at += 1
            if tokens[at] == ")":
                break
            key = str(len(arguments))
            if tokens[at + 1] == "=":
                key, at = tokens[at], at + 2
            arguments[key], at = _value(tokens, at)
        node, at = Node(name, arguments), at + 1
        if at < len(tokens) and tokens[at] == "{":
            node.children, at = _nodes(tokens, at + 1)
            at += 1
        out.append(node)
    return out, at


def _value(tokens: list[str], at: int) -> tuple[Any, int]:
    word = tokens[at]
    if word == "[":
        out, at = [], at + 1
        while tokens[at] != "]":
            if tokens[at] in ",:":
                at += 1
                continue
            value, at = _value(tokens, at)
            out.append(value)
        return out, at + 1
    if word == "-":
        value, at = _value(tokens, at + 1)
        return -value, at
    if word.startswith('"'):
        return word[1:-1], at + 1
    words = {"true": True, "false": False, "undef": None, "inf": math.inf, "nan": math.nan}
    return (words[word] if word in words else float(word)), at + 1


def solid(node: Node, kernel: Any) -> Any:
    """Return the solid of a node."""
    body, outline = kernel.Manifold, kernel.CrossSection
    args = node.arguments
    if node.name == "cube":
        return body.cube(args["size"], args["center"])
    if node.name == "sphere":
        count = fragments(args["r"], args)
        rings = (count + 1) // 2
        angles = (np.arange(rings) + 0.5) * math.pi / rings
        circle = np.arange(count) * 2.0 * math.pi / count
        points = [
            (
                args["r"] * math.sin(a) * math.cos(t),
                args["r"] * math.sin(a) * math.sin(t),
                args["r"] * math.cos(a),
            )
            for a in angles
            for t in circle
        ]
        return body.hull_points(points)
    if node.name == "cylinder":
        count = fragments(max(args["r1"], args["r2"]), args)
        if args["r1"] > 0:
            return body.cylinder(args["h"], args["r1"], args["r2"], count, args["center"])
        # A point below: the cone upside down.
        upside = body.cylinder(args["h"], args["r2"], 0.0, count, args["center"]).mirror((0, 0, 1))
        return upside if args["center"] else upside.translate((0, 0, args["h"]))
    if node.name == "polyhedron":
        faces = [[face[0], face[k + 1], face[k]] for face in args["faces"] for k in range(1, len(face) - 1)]
        mesh = kernel.Mesh(np.array(args["points"], np.float32), np.array(faces, np.uint32))
        return body(mesh)
    if node.name in ("linear_extrude", "rotate_extrude"):
        flat = outline.batch_boolean([_outline(child, kernel) for child in node.children], kernel.OpType.Add)
        if node.name == "rotate_extrude":
            radius = max((abs(point[0]) for line in flat.to_polygons() for point in line), default=1.0)
            return flat.revolve(fragments(radius, args), args.get("angle", 360.0))
        scale = args.get("scale", [1.0, 1.0])
        turned = args.get("twist", 0.0)
        steps = int(args.get("slices") or (max(1.0, abs(turned) / 10.0) if turned else 0))
        raised = flat.extrude(
            args["height"], steps, -turned, scale if isinstance(scale, list) else [scale] * 2
        )
        return raised.translate((0, 0, -args["height"] / 2)) if args.get("center") else raised
    children = [solid(child, kernel) for child in node.children]
    if node.name == "multmatrix":
        joined = body.batch_boolean(children, kernel.OpType.Add)
        return joined.transform(np.array(args["0"], dtype=np.float64)[:3])
    if node.name == "hull":
        return body.batch_hull(children)
    if node.name == "minkowski":
        total = children[0]
        for child in children[1:]:
            total = total.minkowski_sum(child)
        return total
    kinds = {"difference": kernel.OpType.Subtract, "intersection": kernel.OpType.Intersect}
    if node.name not in (*kinds, "group", "union", "color", "render", "root"):
        raise RuntimeError(f"`{node.name}` of OpenSCAD cannot be read as a part")
    if not children:
        return body()
    return body.batch_boolean(children, kinds.get(node.name, kernel.OpType.Add))


def _outline(node: Node, kernel: Any) -> Any:
    """Return a flat object."""
    kind, args = kernel.CrossSection, node.arguments
    if node.name == "square":
        return kind.square(args["size"], args["center"])
    if node.name == "circle":
        return kind.circle(args["r"], fragments(args["r"], args))
    if node.name == "polygon":
        points = np.array(args["points"], dtype=np.float64)
        paths = args.get("paths") or [range(len(points))]
        return kind([points[[int(entry) for entry in path]] for path in paths], kernel.FillRule.EvenOdd)
    children = [_outline(child, kernel) for child in node.children]
    if node.name == "multmatrix":
        matrix = np.array(args["0"], dtype=np.float64)
        return kind.batch_boolean(children, kernel.OpType.Add).transform(matrix[:2][:, [0, 1, 3]])
    if node.name == "offset":
        joined = kind.batch_boolean(children, kernel.OpType.Add)
        return joined.offset(args.get("r", args.get("delta", 0.0)), kernel.JoinType.Round)
    kinds = {"difference": kernel.OpType.Subtract, "intersection": kernel.OpType.Intersect}
    if node.name not in (*kinds, "group", "union", "color"):
        raise RuntimeError(f"`{node.name}` of OpenSCAD cannot be read as a flat object")
    return kind.batch_boolean(children, kinds.get(node.name, kernel.OpType.Add))


def fragments(radius: float, arguments: dict[str, Any]) -> int:
    """Return the number of sides of a circle, as OpenSCAD counts them."""
    if radius < 1e-6 or not math.isfinite(radius):
        return 3
    if arguments["$fn"] > 0.0:
        return int(max(arguments["$fn"], 3.0))
    least: float = max(min(360.0 / arguments["$fa"], radius * 2.0 * math.pi / arguments["$fs"]), 5.0)
    return math.ceil(least)
