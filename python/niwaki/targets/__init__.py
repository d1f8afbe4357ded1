"""What a scene should be like.

target     meshes: the volume to fill, and surfaces that shadows fall on
camera     from where an image is seen
images     which pixels of an image should be on
sketches   scores of a scene, as values that multiply
outline    the outline of a room, from a file
examples   targets and images of our own, made by code
"""
