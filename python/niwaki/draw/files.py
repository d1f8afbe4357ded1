"""A scene as a file for other programs; the suffix determines the format.

    .glb         a node for each part, materials, shared meshes: Blender, games, the web  glb.py
    .obj, .ply   plain meshes with colours                                                mesh_files.py
    .stl, .3mf   a watertight solid in millimetres, z up, for printing                    solid.py, print_files.py
    .gif, .apng  an animation of the growth, part by part                                 animation.py
    .svg         a scene of flat shapes: a group with a readable id for each part         flat/svg.py

A file is written completely or not at all.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import Any

from niwaki.draw import far
from niwaki.draw.animation import growth
from niwaki.draw.assembly import Assembly
from niwaki.draw.flat.marks import is_flat
from niwaki.draw.flat.svg import svg
from niwaki.draw.glb import About, glb
from niwaki.draw.mesh_files import obj, ply
from niwaki.draw.print_files import stl, threemf
from niwaki.draw.solid import METRE, union
from niwaki.errors import FileError
from niwaki.errors.files import write_whole

MESHES = (".glb", ".obj", ".ply")
SOLIDS = (".stl", ".3mf")
ANIMATIONS = (".gif", ".apng")
DRAWINGS = (".svg",)
FORMATS = (*MESHES, *SOLIDS, *ANIMATIONS, *DRAWINGS)


def export(
    scene: Assembly,
    path: str | PathLike[str],
    *,
    scale: float | None = None,
    fuse: float | None = None,
    about: About | None = None,
    **settings: Any,
) -> Path:
    """Write a scene to a file whose name ends in .glb, .obj, .ply, .stl, .3mf, .gif, .apng or .svg.

    Parameters
    ----------
    scene
        The scene.
    path
        The file.
    scale
        For .stl and .3mf: millimetres for each scene unit; 1000 when left out, because scenes are in metres.
    fuse
        For .stl and .3mf: the distance by which each shape expands before the union, scene units. The default is enough
        to connect shapes that touch, and too small to see.
    about
        The origin of the scene, for the extras of a .glb file.
    settings
        For .svg: `style`, `window` and `margin`, as for a picture of flat shapes.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    FileError
        The suffix is unknown, the scene is empty, a part is not a solid (.stl, .3mf), or the file cannot be written.

    Warns
    -----
    FarSceneWarning
        The scene is far from the origin, and the file is .obj or .ply.
    """
    place = Path(path)
    suffix = check_format(place)
    for name, number in (("scale", scale), ("fuse", fuse)):
        if number is not None and suffix not in SOLIDS:
            expected = (
                f"left out: it is for {' and '.join(SOLIDS)}, and a {suffix} file has the scene unchanged"
            )
            raise FileError("setting", place, name=name, found=number, expected=expected)
    if settings and suffix not in DRAWINGS:
        name, value = next(iter(settings.items()))
        raise FileError("setting", place, name=name, found=value, expected="left out: it is for .svg")
    if len(scene) == 0:
        raise FileError("scene-empty", place, verb="write")
    if suffix in DRAWINGS:
        if not is_flat(scene):
            raise FileError("not-flat", place)
        return write_whole(place, svg(scene, **settings).encode())
    if suffix in ANIMATIONS:
        return growth(scene, place)
    if suffix in SOLIDS:
        solid = union(scene, METRE if scale is None else scale, fuse)
        return write_whole(place, stl(solid) if suffix == ".stl" else threemf(solid, place.stem))
    if suffix == ".glb":
        return write_whole(place, glb(scene, about))
    far.warn_of(scene)
    if suffix == ".ply":
        return write_whole(place, ply(scene))
    library = place.with_name("_".join(place.stem.split()) + ".mtl")
    data, materials = obj(scene, library.name)
    if materials:
        write_whole(library, materials)
    return write_whole(place, data)


def check_format(place: Path) -> str:
    """Return the suffix of a file in lower case, if it is a known format."""
    suffix = place.suffix.lower()
    if suffix not in FORMATS:
        ending = place.suffix or "no suffix"
        raise FileError("file-format", place, suffix=ending, done="written", formats=", ".join(FORMATS))
    return suffix
