"""Collection rules: tests with `bpy` run only in a separate environment (`make test-blender`)."""

from importlib.util import find_spec

collect_ignore = [] if find_spec("bpy") else ["inside_blender.py", "meshes_in_blender.py"]
