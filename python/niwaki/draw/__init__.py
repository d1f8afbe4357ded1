"""A scene as pictures and files.

Modules:

    scene.py        the parts of a scene, with pictures and files
    assembly.py     the parts of a scene alone
    picture.py      a picture of a scene, with its target as a ghost
    sheet.py        several pictures on one page, with captions
    plan.py         a scene from above, as SVG or pixels
    swatches.py     palettes of colours in rows
    palette.py      colours for shapes without colours

    files.py        a scene as a file; the suffix determines the format
    page.py         the numbers of an SVG
    far.py          scenes far from the origin
    parts.py        meshes of parts, by their paints
    closed.py       closed meshes of solids with holes
    instances.py    meshes that several parts share
    glb.py          GLB: a node for each part
    hierarchy.py    the nodes above the parts: the calls of the model
    mesh_files.py   OBJ and PLY: plain meshes
    solid.py        the union as a single solid, for printing
    print_files.py  the solid as STL and 3MF
    animation.py    growth, or any sequence of scenes, as GIF or animated PNG
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
