"""Blender as a module is only in an environment of its own (`make test-blender`)."""

from importlib.util import find_spec

collect_ignore = [] if find_spec("bpy") else ["inside_blender.py", "meshes_in_blender.py"]
