"""Small files of meshes, each with a trap that readers fall into and its right answer.

Most hold a box of 1 by 2 by 3 with a corner at the origin, so that a wrong scale, a lost face or a turned axis changes
its volume or its bounds. Where the program assimp gives another answer, `assimp` says what it does.
"""

from __future__ import annotations

import base64
import json
import re
import struct
from dataclasses import dataclass
from typing import Any

import numpy as np

BOX = [(x, y, z) for z in (0, 3) for x, y in ((0, 0), (1, 0), (1, 2), (0, 2))]
QUADS = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
TRIANGLES = [half for a, b, c, d in QUADS for half in ((a, b, c), (a, c, d))]
MIXED = TRIANGLES[:2] + QUADS[1:]
#: A U of 3 by 3 with a notch of 1 by 2, and the corner of the notch first, from which a fan is wrong.
U = [(1, 3), (0, 3), (0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1)]
#: The same with corners in the middle of its straight sides.
HALVED = [
    (1, 3),
    (0.5, 3),
    (0, 3),
    (0, 1.5),
    (0, 0),
    (1.5, 0),
    (3, 0),
    (3, 3),
    (2, 3),
    (2, 1),
    (1.5, 1),
    (1, 1),
]
#: A triangle with a hole, to which a cut leads from its first corner, in line with a side of the hole.
CUT = [(1, 0), (5, 1), (3, 3), (1, 0), (3, 2), (4, 1), (2, 1), (3, 2)]
#: A quad with an inner corner; its fan from the first corner lies over itself.
DART = [(0, 0), (1, 1), (2, 0), (1, 3)]


@dataclass(frozen=True)
class Case:
    """A file and its answer: volume, bounds and perhaps area, or what a message says."""

    name: str
    suffix: str
    data: bytes
    volume: float = 6.0
    bounds: tuple[tuple[float, ...], tuple[float, ...]] = ((0, 0, 0), (1, 2, 3))
    area: float | None = None
    refused: str = ""
    assimp: str = ""
    #: Files beside it.
    beside: tuple[tuple[str, bytes], ...] = ()

    @property
    def slug(self) -> str:
        """The name as one word, for the name of a test."""
        return re.sub(r"\W+", "-", self.name)

    def agrees(self, corners: np.ndarray) -> bool:
        """Whether triangles (n, 3, 3) are the answer; whole numbers of 16 bits are a little off."""
        if not len(corners):
            return False
        a, b, c = corners.transpose(1, 0, 2)
        areas = np.cross(b - a, c - a)
        box = [corners.min(axis=(0, 1)), corners.max(axis=(0, 1))]
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0
        area = np.linalg.norm(areas, axis=1).sum() / 2.0
        return bool(
            np.allclose(box, self.bounds, atol=2e-3)
            and np.isclose(volume, self.volume, rtol=2e-3)
            and (self.area is None or np.isclose(area, self.area, rtol=1e-5))
        )


def prism(outline: list[tuple[float, float]], height: float) -> tuple[list[Any], list[Any]]:
    """Vertices and faces of a prism: two polygons and a quad for each edge."""
    count = len(outline)
    area = sum(x * b - a * y for (x, y), (a, b) in zip(outline, outline[1:] + outline[:1], strict=True))
    outline = outline if area > 0 else outline[::-1]
    vertices = [(x, y, z) for z in (0, height) for x, y in outline]
    sides = [(k, (k + 1) % count, count + (k + 1) % count, count + k) for k in range(count)]
    return vertices, [tuple(range(count))[::-1], tuple(range(count, 2 * count)), *sides]


def rows(values: Any) -> str:
    return "".join(" ".join(map(str, row)) + "\n" for row in values)


def v(vertices: Any = BOX, before: str = "v ", dx: float = 0.0) -> str:
    return "".join(before + f"{x + dx} {y} {z}\n" for x, y, z in vertices)


def f(faces: Any = QUADS, first: int = 1, before: str = "f ", form: str = "{}") -> str:
    return "".join(before + " ".join(form.format(k + first) for k in face) + "\n" for face in faces)


def objs() -> list[Case]:
    two = {"volume": 12.0, "bounds": ((0, 0, 0), (6, 2, 3))}
    u, dart, halved, cut = prism(U, 2), prism(DART, 1), prism(HALVED, 2), prism(CUT, 2)
    square = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\n"
    square += square.replace(" 0\n", " 1\n")
    # A frame: each of its two flat sides is one polygon, which a cut leads through to the hole and back.
    frame = "f 1 5 6 7 8 5 1 4 3 2\nf 9 10 11 12 9 13 16 15 14 13\n"
    frame += "f 1 2 10 9\nf 2 3 11 10\nf 3 4 12 11\nf 4 1 9 12\nf 6 5 13 14\nf 7 6 14 15\nf 8 7 15 16\nf 5 8 16 13\n"
    texts: list[tuple[str, str | bytes, dict[str, Any]]] = [
        ("plain", v() + f(), {}),
        ("relative", v() + f(first=-8), {}),
        ("relative in two objects", f"o a\n{v()}{f(first=-8)}o b\n{v(dx=5)}{f(first=-8)}", two),
        ("relative and absolute", v() + f(QUADS[:3]) + f(QUADS[3:], -8), {}),
        ("relative, more vertices after", v() + f(first=-8) + "v 9 9 9\n", {}),
        ("tabs", (v() + f()).replace(" ", "\t"), {}),
        ("indented", v(before="  v ") + f(before="\t f "), {"assimp": "reads no indented line"}),
        (
            "some lines indented",
            v() + f(QUADS[:2], before="   f ") + f(QUADS[2:]),
            {"assimp": "reads no indented line"},
        ),
        ("two blanks", (v() + f()).replace(" ", "  "), {}),
        ("from zero", v() + f(first=0), {"refused": "line 9: a face names vertex 0"}),
        (
            "from zero in two objects",
            v() + f(first=0) + v(dx=5) + f(first=8),
            {"refused": "line 9: a face names vertex 0"},
        ),
        ("name in Latin-1", b"o B\xe4r\nusemtl gr\xfcn\n" + (v() + f()).encode(), {}),
        ("name in UTF-8", "o クマ\n" + v() + f(), {}),
        ("mark of UTF-8", "\ufeff" + v() + f(), {"assimp": "reads no first line"}),
        ("UTF-16", (v() + f()).encode("utf-16"), {"assimp": "reads no line"}),
        ("lines of Windows", (v() + f()).replace("\n", "\r\n"), {}),
        ("lines of old Macs", (v() + f()).replace("\n", "\r"), {}),
        ("no last line end", (v() + f()).rstrip("\n"), {}),
        (
            "comments",
            "# f 1 2 3\n" + (v() + f()).replace("\n", " # 1 2 3\n"),
            {"assimp": "reads comments as numbers"},
        ),
        ("continued", v() + f().replace(" 5 6", " \\\n 5 6"), {}),
        ("continued on Windows", (v() + f().replace(" 5 6", " \\\n 5 6")).replace("\n", "\r\n"), {}),
        ("a path with a backslash", "mtllib C:\\a\\\n" + v() + f(), {"assimp": "joins the lines"}),
        ("textures", v() + "vt 0 0\n" + f(form="{}/1"), {}),
        ("normals", v() + "vn 0 0 1\n" + f(form="{}//1"), {}),
        ("textures and normals", v() + "vt 0 0\nvn 0 0 1\n" + f(form="{}/1/1"), {}),
        ("some with textures", v() + "vt 0 0\n" + f(QUADS[:2], form="{}/1") + f(QUADS[2:]), {}),
        ("colours", v().replace("\n", " 0.5 0.5 0.5\n") + f(), {}),
        ("some colours", v().replace("0 0 0\n", "0 0 0 1 1 1\n") + f(), {}),
        ("a weight", v().replace("\n", " 1.0\n") + f(), {}),
        ("triangles", v() + f(TRIANGLES), {}),
        ("faces before vertices", f() + v(), {}),
        ("vertices between faces", f"{v(BOX[:4])}f 4 3 2 1\n{v(BOX[4:])}{f(QUADS[1:])}", {}),
        ("groups", f"g a\ns 1\n{v()}{f(QUADS[:3])}g b\ns off\nusemtl c\n{f(QUADS[3:])}", {}),
        ("lines and points", v() + "l 1 2 3\np 1\n" + f(), {"assimp": "writes lines as broken facets"}),
        ("a face of two corners", v() + "f 1 2\n" + f(), {"assimp": "writes lines as broken facets"}),
        ("numbers with signs and exponents", v().replace(" 3", " +0.3e1") + f(), {}),
        ("vertices twice", v() + v() + f(QUADS[:3]) + f(QUADS[3:], 9), {}),
        ("unused vertices", "v 99 99 99\n" + v() + f(first=2), {}),
        ("a parameter and a curve", "vp 1 2\ncstype bezier\n" + v() + f(), {"assimp": "reads nothing"}),
        (
            "a decimal comma",
            v().replace(" 3", " 3,0") + f(),
            {"refused": "line 5: a vertex is", "assimp": "reads 3"},
        ),
        (
            "two coordinates",
            "v 1 2\n" + v() + f(),
            {"refused": "line 1: a vertex is `1 2`", "assimp": "reads homogeneous pairs"},
        ),
        ("a corner with a fraction", v() + f(form="{}.5"), {"refused": "line 9: a face names"}),
        ("beyond the last vertex", v() + "f 1 2 9\n", {"refused": "vertex 9, and there are 8"}),
        ("before the first vertex", v() + "f 1 2 -9\n" + v(), {"refused": "vertex -9, and there are 8"}),
        ("no faces", v(), {"refused": "points or curves only"}),
        ("a U", v(u[0]) + f(u[1]), {"volume": 14.0, "area": 46.0, "bounds": ((0, 0, 0), (3, 3, 2))}),
        (
            "a cut in line with a side of its hole",
            v(cut[0]) + f(cut[1]),
            {"volume": 8.0, "bounds": ((1, 0, 0), (5, 3, 2))},
        ),
        (
            "corners on straight lines",
            v(halved[0]) + f(halved[1]),
            {"volume": 14.0, "area": 46.0, "bounds": ((0, 0, 0), (3, 3, 2))},
        ),
        (
            "darts",
            v(dart[0]) + f(dart[1]),
            {"volume": 2.0, "area": 4.0 + 2.0 * (2.0**0.5 + 10.0**0.5), "bounds": ((0, 0, 0), (2, 3, 1))},
        ),
        ("a frame", square + frame, {"volume": 12.0, "area": 48.0, "bounds": ((0, 0, 0), (4, 4, 1))}),
    ]
    return [
        Case(f"obj: {name}", ".obj", t if isinstance(t, bytes) else t.encode(), **more)
        for name, t, more in texts
    ]


def plys() -> list[Case]:
    def head(form: str, faces: int = 7, **more: str) -> str:
        xyz = more.get("vertex", "".join(f"property {more.get('kind', 'float')} {axis}\n" for axis in "xyz"))
        listed = more.get("face", "property list uchar int vertex_indices\n")
        return (
            f"ply\nformat {form} 1.0\ncomment of ours\n{more.get('first', '')}element vertex 8\n{xyz}"
            f"element face {faces}\n{listed}end_header\n"
        )

    def lists(faces: Any = MIXED) -> str:
        return rows((len(face), *face) for face in faces)

    whole = head("ascii") + rows(BOX) + lists()
    edges = "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    after = head("ascii").replace("element face", "element thing 2\nproperty float a\nelement face")
    after = after.replace("end_header", edges + "end_header") + rows(BOX) + "1\n2\n" + lists() + "0 1\n"
    first = (
        "ply\nformat ascii 1.0\nelement face 7\nproperty list uchar int vertex_indices\nelement vertex 8\n"
    )
    first += "".join(f"property float {axis}\n" for axis in "xyz") + "end_header\n" + lists() + rows(BOX)
    # Around the box, then its two ends, each strip turned as its neighbours are.
    strips = [[4, 0, 5, 1, 6, 2, 7, 3, 4, 0], [0, 3, 1, 2], [4, 5, 7, 6]]
    strip = "ply\nformat ascii 1.0\nelement vertex 8\n" + "".join(
        f"property float {axis}\n" for axis in "xyz"
    )
    strip += "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + rows(BOX)
    one_list = [k for strip in strips for k in (*strip, -1)]
    textured = "property list uchar float texcoord\n"
    index = "property list uchar int vertex_indices\n"
    coords = rows((2 * len(entry), *[0.5] * 2 * len(entry), len(entry), *entry) for entry in MIXED)
    texts: list[tuple[str, str | bytes, dict[str, Any]]] = [
        ("text", whole, {}),
        ("quads", head("ascii", 6) + rows(BOX) + lists(QUADS), {}),
        ("lines of Windows", whole.replace("\n", "\r\n"), {}),
        ("lines of old Macs", whole.replace("\n", "\r"), {}),
        ("mark of UTF-8", "\ufeff" + whole, {"assimp": "reads no head"}),
        ("empty lines", whole.replace("end_header\n", "end_header\n\n") + "\n", {}),
        ("indented", head("ascii") + (rows(BOX) + lists()).replace("\n", "\n\t "), {}),
        (
            "all in one line",
            head("ascii") + (rows(BOX) + lists()).replace("\n", " "),
            {"assimp": "wants lines"},
        ),
        ("comment in Latin-1", whole.replace("of ours", "für uns").encode("latin-1"), {}),
        ("comments that look like a head", whole.replace("of ours", "end_header element face 3"), {}),
        ("obj_info", whole.replace("comment of ours", "obj_info element face 3"), {}),
        ("vertex_index", whole.replace("vertex_indices", "vertex_index"), {}),
        ("another name", whole.replace("vertex_indices", "corners"), {"assimp": "knows no such list"}),
        ("another list before", head("ascii", face=textured + index) + rows(BOX) + coords, {}),
        (
            "a number before",
            head("ascii", face="property uchar flag\n" + index)
            + rows(BOX)
            + rows((7, len(entry), *entry) for entry in MIXED),
            {},
        ),
        (
            "z before y and x",
            head("ascii", vertex="".join(f"property float {axis}\n" for axis in "zyx"))
            + rows(entry[::-1] for entry in BOX)
            + lists(),
            {},
        ),
        ("faces first", first, {"assimp": "wants vertices first"}),
        ("other tables", after, {"assimp": "writes lines as broken facets"}),
        ("strips", strip + lists([one_list]), {"assimp": "starts each strip on the other side"}),
        (
            "strips in two lists",
            strip.replace("tristrips 1", "tristrips 2") + lists([one_list[:15], one_list[16:]]),
            {"assimp": "starts each strip on the other side"},
        ),
        (
            "a list in vertices",
            head(
                "ascii",
                vertex="property float x\nproperty list uchar float w\nproperty float y\nproperty float z\n",
            )
            + rows((x, y + 1, *[5] * (y + 1), y, z) for x, y, z in BOX)
            + lists(),
            {},
        ),
        ("a corner below zero", whole.replace("4 0 1 5 4", "4 0 1 -5 4"), {"refused": "names vertex -5"}),
        (
            "no table of faces",
            whole[: whole.index("element face")] + "end_header\n" + rows(BOX),
            {"refused": "points or curves"},
        ),
        (
            "a lost row",
            head("ascii") + rows(BOX) + lists(MIXED[:-1]),
            {"refused": "cut short", "assimp": "leaves it out"},
        ),
        ("a word", whole.replace("1 2 3", "1 two 3"), {"refused": "no number"}),
        ("no format", whole.replace("ascii", "xml"), {"refused": "names no format"}),
    ]
    examples = [
        Case(f"ply: {name}", ".ply", t if isinstance(t, bytes) else t.encode(), **more)
        for name, t, more in texts
    ]
    for mark, order in (("<", "binary_little_endian"), (">", "binary_big_endian")):
        for name, faces in (("triangles", TRIANGLES), ("quads", QUADS), ("triangles and quads", MIXED)):
            body = b"".join(struct.pack(mark + "3f", *entry) for entry in BOX)
            body += b"".join(struct.pack(f"{mark}B{len(entry)}i", len(entry), *entry) for entry in faces)
            examples.append(Case(f"ply: {order}, {name}", ".ply", head(order, len(faces)).encode() + body))
        windows = head(order).replace("\n", "\r\n").encode()
        examples.append(Case(f"ply: {order}, lines of Windows", ".ply", windows + body))
        examples.append(
            Case(f"ply: {order}, bytes behind", ".ply", head(order).encode() + body + b"made by us")
        )
        examples.append(
            Case(f"ply: {order}, cut short", ".ply", head(order).encode() + body[:-3], refused="cut short")
        )
        wide = "property uchar flag\nproperty list int uint vertex_indices\nproperty short a\n"
        body = b"".join(struct.pack(mark + "3d", *entry) for entry in BOX)
        body += b"".join(struct.pack(f"{mark}Bi{len(entry)}Ih", 3, len(entry), *entry, 1) for entry in MIXED)
        examples.append(
            Case(
                f"ply: {order}, doubles and numbers around lists",
                ".ply",
                head(order, kind="double", face=wide).encode() + body,
            )
        )
    return examples


def stls() -> list[Case]:
    def text(faces: Any = TRIANGLES, name: str = "box", dx: float = 0.0) -> str:
        facets = "".join(
            "facet normal 0 0 0\n outer loop\n"
            + "".join(f"  vertex {BOX[k][0] + dx} {BOX[k][1]} {BOX[k][2]}\n" for k in face)
            + " endloop\nendfacet\n"
            for face in faces
        )
        return f"solid {name}\n{facets}endsolid {name}\n"

    def binary(head: bytes = b"") -> bytes:
        facets = (struct.pack("<12fH", 0, 0, 0, *np.ravel([BOX[k] for k in face]), 0) for face in TRIANGLES)
        return head.ljust(80, b"\0") + struct.pack("<I", len(TRIANGLES)) + b"".join(facets)

    texts: list[tuple[str, str | bytes, dict[str, Any]]] = [
        ("text", text(), {}),
        ("lines of Windows", text().replace("\n", "\r\n"), {}),
        ("lines of old Macs", text().replace("\n", "\r"), {}),
        ("capitals", text().upper(), {"assimp": "reads small letters only"}),
        ("tabs", text().replace(" ", "\t"), {}),
        ("mark of UTF-8", "\ufeff" + text(), {}),
        ("two solids", text() + text(dx=5.0), {"volume": 12.0, "bounds": ((0, 0, 0), (6, 2, 3))}),
        ("a name of keywords", text(name="facet vertex 1 2 3 endloop"), {}),
        ("normals of words", text().replace("normal 0 0 0", "normal up"), {"assimp": "wants numbers"}),
        ("no name", text(name="").replace("solid \n", "solid\n"), {}),
        ("name in Latin-1", text(name="Bär").encode("latin-1"), {}),
        ("a line before", "; made by us\n" + text(), {"assimp": "takes it for a binary file"}),
        ("facets of four corners", text(QUADS), {"assimp": "knows three corners only"}),
        (
            "cut short between facets",
            text()[:-13],
            {"refused": "no `endsolid`", "assimp": "reads what is there"},
        ),
        (
            "a lost corner",
            text().replace("  vertex 1.0 0 0\n", "", 1),
            {"refused": "fewer than three whole vertices"},
        ),
        (
            "a decimal comma",
            text().replace("1.0", "1,0"),
            {"refused": "expected three numbers", "assimp": "reads 1"},
        ),
        ("binary", binary(), {}),
        ("binary that begins with `solid`", binary(b"solid box"), {}),
        ("binary that begins with keywords", binary(b"solid facet vertex endsolid"), {}),
        ("binary with 6 bytes behind", binary() + b"\0" * 6, {"assimp": "wants the exact length"}),
        (
            "binary with words behind",
            binary(b"solid box") + b"made by us",
            {"assimp": "wants the exact length"},
        ),
        ("binary with a triangle behind", binary() + b"\0" * 50, {"refused": "announces 12"}),
        ("binary, cut short", binary()[:-9], {"refused": "announces 12"}),
    ]
    return [
        Case(f"stl: {name}", ".stl", t if isinstance(t, bytes) else t.encode(), **more)
        for name, t, more in texts
    ]


class Gltf:
    """A file of glTF that grows accessor by accessor."""

    def __init__(self) -> None:
        self.body = b""
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes, **more: Any) -> int:
        self.body += b"\0" * (-len(self.body) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.body), "byteLength": len(data), **more})
        self.body += data
        return len(self.views) - 1

    def add(self, values: Any, code: int, kind: str, view: dict[str, Any] | None = None, **more: Any) -> int:
        dtype = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[code]
        array = np.array(values, dtype)
        at = self.view(array.tobytes(), **(view or {}))
        self.accessors.append(
            {"bufferView": at, "componentType": code, "count": len(array), "type": kind, **more}
        )
        return len(self.accessors) - 1

    def tree(self, nodes: Any, primitives: Any, **more: Any) -> dict[str, Any]:
        return {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": nodes,
            "meshes": [{"primitives": primitives}],
            "buffers": [{"byteLength": len(self.body)}],
            "bufferViews": self.views,
            "accessors": self.accessors,
            **more,
        }

    def glb(self, *nodes: Any, **more: Any) -> bytes:
        text = json.dumps(self.tree(*nodes, **more)).encode()
        text += b" " * (-len(text) % 4)
        body = self.body + b"\0" * (-len(self.body) % 4)
        total = 28 + len(text) + len(body)
        head = struct.pack("<4sIIII", b"glTF", 2, total, len(text), 0x4E4F534A)
        return head + text + struct.pack("<II", len(body), 0x004E4942) + body


def box_of(file: Gltf) -> list[dict[str, Any]]:
    """The primitives of the box."""
    places = file.add(BOX, 5126, "VEC3", min=[0, 0, 0], max=[1, 2, 3])
    return [{"attributes": {"POSITION": places}, "indices": file.add(np.ravel(TRIANGLES), 5123, "SCALAR")}]


def gltfs() -> list[Case]:
    examples = []

    def case(name: str, data: bytes, suffix: str = ".glb", **more: Any) -> None:
        examples.append(Case(f"gltf: {name}", suffix, data, **more))

    file = Gltf()
    case("plain", file.glb([{"mesh": 0}], box_of(file)))
    file = Gltf()
    tree = file.tree([{"mesh": 0}], box_of(file))
    inside = {"uri": "data:application/octet-stream;base64," + base64.b64encode(file.body).decode()}
    case("inside", json.dumps({**tree, "buffers": [{**tree["buffers"][0], **inside}]}).encode(), ".gltf")
    outside = {**tree, "buffers": [{**tree["buffers"][0], "uri": "a%20b.bin"}]}
    case(
        "beside",
        json.dumps(outside).encode(),
        ".gltf",
        beside=(("a b.bin", file.body),),
        assimp="keeps the %20 of a name",
    )
    file = Gltf()
    nodes = [{"children": [1], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [1, 0, 0]}]
    case("places", file.glb(nodes, box_of(file)), volume=48.0, bounds=((2, 0, 0), (4, 4, 6)))
    file = Gltf()
    turned = {"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]}
    case("a quarter turn", file.glb([turned], box_of(file)), bounds=((-2, 0, 0), (0, 1, 3)))
    file = Gltf()
    matrix = [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]
    case("a matrix", file.glb([{"mesh": 0, "matrix": matrix}], box_of(file)), bounds=((3, 0, 0), (5, 1, 3)))
    file = Gltf()
    case(
        "a mirror image",
        file.glb([{"mesh": 0, "scale": [-1, 1, 1]}], box_of(file)),
        bounds=((-1, 0, 0), (0, 2, 3)),
        assimp="does not turn the triangles over",
    )

    spots = [[0, 0, 0], [5, 0, 0], [0, 0, 10]]
    for required in (False, True):
        file = Gltf()
        box = box_of(file)
        attributes = {
            "TRANSLATION": file.add(spots, 5126, "VEC3"),
            "SCALE": file.add([[1, 1, 1], [2, 1, 1], [1, 1, 1]], 5126, "VEC3"),
        }
        nodes = [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}}]
        more = {"extensionsRequired": ["EXT_mesh_gpu_instancing"]} if required else {}
        case(
            f"instances{', required' * required}",
            file.glb(nodes, box, extensionsUsed=["EXT_mesh_gpu_instancing"], **more),
            volume=24.0,
            bounds=((0, 0, 0), (7, 2, 13)),
            assimp="refuses instances",
        )
    file = Gltf()
    box = box_of(file)
    half = [0, 0, 16384, 16384]
    attributes = {"ROTATION": file.add([[0, 0, 0, 32767], half], 5122, "VEC4", normalized=True)}
    nodes = [
        {
            "mesh": 0,
            "translation": [9, 0, 0],
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}},
        }
    ]
    case(
        "turned instances",
        file.glb(nodes, box, extensionsUsed=["EXT_mesh_gpu_instancing"]),
        volume=12.0,
        bounds=((7, 0, 0), (10, 2, 3)),
        assimp="refuses instances",
    )
    file = Gltf()
    box = box_of(file)
    attributes = {"TRANSLATION": file.add(spots, 5126, "VEC3"), "SCALE": file.add([[1, 1, 1]], 5126, "VEC3")}
    nodes = [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": attributes}}}]
    case("instances without scales", file.glb(nodes, box), refused="instances have [1, 3]")

    for name, reason in (
        ("KHR_draco_mesh_compression", "compressed"),
        ("EXT_meshopt_compression", "compressed"),
        ("XYZ_curved_space", "'XYZ_curved_space', which is not known"),
    ):
        file = Gltf()
        case(
            f"requires {name}",
            file.glb([{"mesh": 0}], box_of(file), extensionsUsed=[name], extensionsRequired=[name]),
            refused=reason,
            assimp="reads without it",
        )
    file = Gltf()
    name = "KHR_materials_unlit"
    case(
        f"requires {name}",
        file.glb([{"mesh": 0}], box_of(file), extensionsUsed=[name], extensionsRequired=[name]),
    )

    file = Gltf()
    small = file.add(np.array(BOX) * 100, 5122, "VEC3", normalized=True)
    indices = file.add(np.ravel(TRIANGLES), 5121, "SCALAR")
    nodes = [{"mesh": 0, "scale": [327.67] * 3}]
    case(
        "whole numbers from -1 to 1",
        file.glb(
            nodes,
            [{"attributes": {"POSITION": small}, "indices": indices}],
            extensionsUsed=["KHR_mesh_quantization"],
            extensionsRequired=["KHR_mesh_quantization"],
        ),
        assimp="reads real numbers only",
    )
    file = Gltf()
    plain = file.add(BOX, 5121, "VEC3")
    indices = file.add(np.ravel(TRIANGLES), 5125, "SCALAR")
    case(
        "whole numbers",
        file.glb(
            [{"mesh": 0}],
            [{"attributes": {"POSITION": plain}, "indices": indices}],
            extensionsUsed=["KHR_mesh_quantization"],
            extensionsRequired=["KHR_mesh_quantization"],
        ),
        assimp="reads real numbers only",
    )
    file = Gltf()
    wide = file.add(np.hstack([BOX, np.full((8, 2), 99)]), 5126, "VEC3", {"byteStride": 20})
    indices = file.add(np.ravel(TRIANGLES), 5123, "SCALAR")
    case("a stride", file.glb([{"mesh": 0}], [{"attributes": {"POSITION": wide}, "indices": indices}]))
    file = Gltf()
    wide = file.add(BOX, 5126, "VEC3", {"byteStride": -12})
    case(
        "a stride below zero",
        file.glb([{"mesh": 0}], [{"attributes": {"POSITION": wide}}]),
        refused="`byteStride` is -12",
    )
    file = Gltf()
    loose = file.add([BOX[k] for k in np.ravel(TRIANGLES)], 5126, "VEC3")
    case("no indices", file.glb([{"mesh": 0}], [{"attributes": {"POSITION": loose}}]))

    file = Gltf()
    places = file.add(BOX, 5126, "VEC3")
    around = file.add([0, 4, 1, 5, 2, 6, 3, 7, 0, 4], 5123, "SCALAR")
    ends = [file.add(strip, 5123, "SCALAR") for strip in ([0, 3, 2, 1], [4, 5, 6, 7])]
    parts = [{"attributes": {"POSITION": places}, "indices": ends[k], "mode": 6} for k in range(2)]
    around_back = file.add([4, 0, 5, 1, 6, 2, 7, 3, 4, 0], 5123, "SCALAR")
    del around
    case(
        "strips and fans",
        file.glb(
            [{"mesh": 0}], [{"attributes": {"POSITION": places}, "indices": around_back, "mode": 5}, *parts]
        ),
    )

    file = Gltf()
    low = [(x, y, min(z, 1)) for x, y, z in BOX]
    box = [
        {
            "attributes": {"POSITION": file.add(low, 5126, "VEC3")},
            "indices": file.add(np.ravel(TRIANGLES), 5123, "SCALAR"),
        }
    ]
    rows_, values = (
        file.view(np.array([4, 5, 6, 7], "<u2").tobytes()),
        file.view(np.array(BOX[4:], "<f4").tobytes()),
    )
    file.accessors[0]["sparse"] = {
        "count": 4,
        "indices": {"bufferView": rows_, "componentType": 5123},
        "values": {"bufferView": values},
    }
    case("sparse", file.glb([{"mesh": 0}], box))
    file = Gltf()
    box = box_of(file)
    values = file.view(np.array(BOX, "<f4").tobytes())
    rows_ = file.view(np.arange(8, dtype="u1").tobytes())
    del file.accessors[0]["bufferView"]
    file.accessors[0]["sparse"] = {
        "count": 8,
        "indices": {"bufferView": rows_, "componentType": 5121},
        "values": {"bufferView": values},
    }
    case("sparse over zeros", file.glb([{"mesh": 0}], box))
    file.accessors[0]["sparse"]["indices"]["byteOffset"] = 1
    case(
        "sparse beyond its view",
        file.glb([{"mesh": 0}], box),
        refused="a sparse accessor names 8 rows",
        assimp="reads beyond it",
    )

    file = Gltf()
    box = box_of(file)
    moved = file.add([(0, 0, 1) if z else (0, 0, 0) for _, _, z in BOX], 5126, "VEC3")
    box[0]["targets"] = [{"POSITION": moved}]
    case("a target without weight", file.glb([{"mesh": 0}], box))
    case(
        "a target of weight 2",
        file.glb([{"mesh": 0, "weights": [2]}], box),
        volume=10.0,
        bounds=((0, 0, 0), (1, 2, 5)),
        assimp="keeps targets apart",
    )

    file = Gltf()
    box = box_of(file)
    box[0]["attributes"]["JOINTS_0"] = file.add([[0, 1, 0, 0]] * 8, 5121, "VEC4")
    box[0]["attributes"]["WEIGHTS_0"] = file.add([[0, 1, 0, 0]] * 8, 5126, "VEC4")
    rest = file.add([np.eye(4).ravel(), np.diag([0.5, 0.5, 0.5, 1]).ravel()], 5126, "MAT4")
    # A node's own place does not move what its bones hold.
    nodes = [{"children": [1, 2]}, {"mesh": 0, "skin": 0, "translation": [7, 7, 7]}, {"scale": [4, 4, 4]}]
    case(
        "bones",
        file.glb(nodes, box, skins=[{"joints": [0, 2], "inverseBindMatrices": rest}]),
        volume=48.0,
        bounds=((0, 0, 0), (2, 4, 6)),
        assimp="keeps bones apart",
    )
    return examples


CASES = [*objs(), *plys(), *stls(), *gltfs()]
