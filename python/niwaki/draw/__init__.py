"""A scene as pictures and files.

scene.py    the parts that a model emitted, with pictures and files
assembly.py the parts alone
picture.py  a scene, and its target as a ghost, as one picture
sheet.py    several pictures on one page, with captions
plan.py     a scene from above, as SVG or pixels
swatches.py palettes of colours in rows
palette.py  colours for parts without colours

files.py        a scene as a file; the suffix decides the format
page.py         the numbers of an SVG
far.py          scenes far from the origin
parts.py        the meshes of its parts, by their paints
instances.py    which parts are one mesh in several places
glb.py          GLB: a node for each part
hierarchy.py    the nodes above the parts: the calls of the model
mesh_files.py   OBJ and PLY: plain meshes
solid.py        the union as one solid, for printing
print_files.py  the solid as STL and 3MF
animation.py    growth, or any sequence of scenes, as GIF or animated PNG
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
