"""Plain mesh files: OBJ (text, an object for each part) and PLY (binary, a single mesh).

An OBJ file has the materials that the model names, and a library of them beside it (MTL).
Both have scene units with y up, smooth normals, and colours at the vertices (in OBJ by the common extension of the `v`
line that Blender, MeshLab and trimesh read). Parts are not joined, so overlapping parts stay as they are. Coordinates
have 32 bits, or nine digits; in a scene far from the origin (`niwaki.draw.far`) they have 64 bits, or all digits.
"""

from __future__ import annotations

import io

import numpy as np

from niwaki.draw.assembly import Assembly
from niwaki.draw.far import is_far
from niwaki.draw.palette import Paint, material_names
from niwaki.draw.parts import PartMesh, part_meshes


def obj(scene: Assembly, library: str = "materials.mtl") -> tuple[bytes, bytes]:
    """Write an OBJ file, and its library of materials, which is empty if the model names none.

    Equal scenes give equal bytes. `library` is the name of the library's file.
    """
    parts, out = part_meshes(scene), io.StringIO()
    out.write("# niwaki: scene units, y up\n")
    names = _materials(parts)
    if names:
        out.write(f"mtllib {library}\n")
    digits = 17 if is_far(scene.bounds) else 9
    start = 1
    for part in parts:
        # For some readers a name ends at the first space.
        out.write(f"o {'_'.join(part.address.split())}\n")
        for piece in part.pieces:
            red, green, blue = piece.paint.color
            color = f"{red:.6g} {green:.6g} {blue:.6g}"
            out.writelines(
                f"v {x:.{digits}g} {y:.{digits}g} {z:.{digits}g} {color}\n"
                for x, y, z in piece.vertices.tolist()
            )
            out.writelines(f"vn {x:.6g} {y:.6g} {z:.6g}\n" for x, y, z in piece.normals.tolist())
            if names:
                out.write(f"usemtl {names[piece.paint]}\n" if piece.paint in names else "usemtl none\n")
            faces = (piece.faces + start).tolist()
            out.writelines(f"f {a}//{a} {b}//{b} {c}//{c}\n" for a, b, c in faces)
            start += len(piece.vertices)
    return out.getvalue().encode(), _library(names)


def _materials(parts: list[PartMesh]) -> dict[Paint, str]:
    """Return the paints that the model names, with names that are unique in the file and have no spaces."""
    named = [piece.paint for part in parts for piece in part.pieces if piece.paint.is_named]
    paints = dict.fromkeys(named)
    names = ("_".join(name.split()) for name in material_names(paints))
    return dict(zip(paints, names, strict=True))


def _library(names: dict[Paint, str]) -> bytes:
    """Write the library: colours, and roughness and metalness by the common extension for physical materials."""
    lines = ["# niwaki"] if names else []
    for paint, name in names.items():
        color = " ".join(f"{part:.6g}" for part in paint.color)
        lines += [f"newmtl {name}", f"Kd {color}", f"Pr {paint.roughness:.6g}", f"Pm {paint.metalness:.6g}"]
    return "".join(f"{line}\n" for line in lines).encode()


def ply(scene: Assembly) -> bytes:
    """Write a binary PLY file; equal scenes give equal bytes."""
    pieces = [piece for part in part_meshes(scene) for piece in part.pieces]
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    real, name = ("<f8", "double") if is_far(scene.bounds) else ("<f4", "float")
    corner = np.dtype([("place", real, 3), ("normal", "<f4", 3), ("color", "u1", 3)])
    vertices = np.zeros(starts[-1], corner)
    vertices["place"] = np.concatenate([piece.vertices for piece in pieces])
    vertices["normal"] = np.concatenate([piece.normals for piece in pieces])
    for piece, start in zip(pieces, starts, strict=False):
        vertices["color"][start : start + len(piece.vertices)] = [round(255 * c) for c in piece.paint.color]
    triangle = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    faces = np.zeros(sum(len(piece.faces) for piece in pieces), triangle)
    faces["count"] = 3
    faces["corners"] = np.concatenate([p.faces + start for p, start in zip(pieces, starts, strict=False)])
    header = ["ply", "format binary_little_endian 1.0", "comment niwaki: scene units, y up"]
    header.append(f"element vertex {len(vertices)}")
    header += [f"property {name} {axis}" for axis in "xyz"]
    header += [f"property float n{axis}" for axis in "xyz"]
    header += [f"property uchar {color}" for color in ("red", "green", "blue")]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    return "\n".join(header).encode() + vertices.tobytes() + faces.tobytes()
