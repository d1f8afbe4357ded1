"""Node trees as models: the part that runs inside of Blender. Blender's Python need not have Niwaki.

| module | contents |
| --- | --- |
| `sockets` | the sockets of a Geometry Nodes modifier: limits, values, which of them are used, and when |
| `stage` | the mesh of an object for other values of its sockets |
| `serve` | a worker process: the script that `blender --background --python` runs |

These files import neither the rest of the package nor each other by its name. Only `serve` imports `bpy`; the others
get Blender's objects as arguments.
"""
