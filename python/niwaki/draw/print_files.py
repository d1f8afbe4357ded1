"""Files for slicers: a solid as STL and 3MF, in millimetres with z up.

STL has only triangles (binary: 80 bytes of header, a count, 50 bytes for each triangle). 3MF also has the unit, a name,
and shared vertices, so a slicer need not guess (3MF core specification 1.3, chapters 2 to 4).
"""

from __future__ import annotations

import io
import zipfile
from html import escape

import numpy as np
from numpy.typing import NDArray

from niwaki.draw.solid import Solid

CONTENT_TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""

RELATIONSHIPS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0"
  Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""

MODEL = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">niwaki</metadata>
 <metadata name="Title">{name}</metadata>
 <resources>
  <object id="1" type="model" name="{name}">
   <mesh>
    <vertices>
{vertices}
    </vertices>
    <triangles>
{triangles}
    </triangles>
   </mesh>
  </object>
 </resources>
 <build><item objectid="1"/></build>
</model>
"""


def stl(solid: Solid) -> bytes:
    """Write a binary STL file; equal solids give equal bytes."""
    return triangles_stl(solid.vertices[solid.faces], "binary STL by niwaki, millimetres, z up")


def triangles_stl(corners: NDArray[np.floating], header: str) -> bytes:
    """Write triangles (n, 3, 3) as binary STL.

    The header must not begin with "solid", the first word of the text form.
    """
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    rows = np.zeros(len(corners), record)
    rows["normal"] = normals / np.where(lengths > 0.0, lengths, 1.0)
    rows["corners"] = corners
    return header.encode("ascii").ljust(80) + np.uint32(len(rows)).tobytes() + rows.tobytes()


def threemf(solid: Solid, name: str) -> bytes:
    """Write a 3MF file; equal solids give equal bytes."""
    title = escape(name, quote=False).replace('"', "&quot;")
    vertices = "\n".join(
        f'<vertex x="{x:.9g}" y="{y:.9g}" z="{z:.9g}"/>' for x, y, z in solid.vertices.tolist()
    )
    triangles = "\n".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in solid.faces.tolist())
    files = {
        "[Content_Types].xml": CONTENT_TYPES,
        "_rels/.rels": RELATIONSHIPS,
        "3D/3dmodel.model": MODEL.format(name=title, vertices=vertices, triangles=triangles),
    }
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as package:
        for place, text in files.items():
            # A fixed date: the bytes must not depend on the day.
            entry = zipfile.ZipInfo(place, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, text)
    return out.getvalue()
