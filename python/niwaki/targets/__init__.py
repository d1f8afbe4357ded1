"""Targets of scenes: meshes, images and drawings, and the sketches that score them.

target     meshes: volumes to fill, and receivers of shadows
reading    meshes from files
obj        triangles of OBJ files
stl        triangles of STL files
ply        triangles of PLY files
gltf       triangles of glTF files
polygons   triangulation of polygons
pieces     the error and the joined meshes of these readers
memory     a check of free memory before a mesh is read
drawing    drawings to grow into, with the point where a model starts
drawings   built-in drawings, by name
camera     cameras of images
images     masks and greys of images
pixels     pixels of image files
sketches   scores of a scene, as values that multiply
differences  what a scene gets wrong, as a vector that an emulator learns
asks       options of the command line, batches and the studio, and their sketches
fit        coverage and surplus of a scene
views      pictures of a scene beside its image, shadow or drawing
outline    outlines of rooms, from files
examples   built-in targets and images, made by code
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
