"""What a scene should be like.

target     meshes: the volume to fill, and surfaces that shadows fall on
reading    meshes from files
obj        the triangles of OBJ files
stl        those of STL files
ply        those of PLY files
gltf       those of glTF files
polygons   polygons as triangles
pieces     what these readers share
memory     whether there is enough memory for a mesh
drawing    drawings to grow into, with the point where a model starts
drawings   drawings of our own, by name
camera     the camera that sees an image
images     which pixels of an image should be on
pixels     the pixels of image files
sketches   scores of a scene, as values that multiply
asks       what a person can ask by name, and the sketches that this stands for
fit        how a scene fits what it should be, in shares that cannot flatter
views      a scene as the sketch of an image or a shadow sees it, as a picture
outline    the outline of a room, from a file
examples   targets and images of our own, made by code
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
