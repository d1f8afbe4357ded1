"""Niwaki in Blender: grow models into meshes of the scene.

Modules without `bpy`, which tests import:

- `axes`         coordinates of Blender and of scenes
- `order`        the goals of a search as values for a worker process
- `growth`       a search in a worker process, watched by a thread
- `grid`         places for several results
- `permissions`  model files that may be run

Modules with `bpy`:

- `conversion`   objects, cameras, lights and images of the scene as arrays
- `placement`    results as collections of objects
- `storage`      the search of a collection, in the .blend
- `settings`     the settings of the panel, stored with the scene
- `operators`    grow, re-roll, again, hold, cancel, open, trust
- `panel`        the panel in the sidebar
"""


def register() -> None:
    """Register the extension; Blender calls this to enable it."""
    # Only Blender has `bpy`.
    from . import operators, panel, settings

    settings.register()
    operators.register()
    panel.register()


def unregister() -> None:
    """Unregister the extension; Blender calls this to disable it."""
    from . import operators, panel, settings

    panel.unregister()
    operators.unregister()
    settings.unregister()
