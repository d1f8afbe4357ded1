"""Niwaki in Blender: grow models into meshes of the scene.

Without Blender (tests import these):

- `axes`       Blender's coordinates and those of a scene
- `asking`     what is asked, as values that a worker process is sent
- `growing`    a search in a worker process, watched from a thread
- `grid`       places for several results
- `naming`     which model files may be run

With Blender:

- `reading`    objects, cameras, lights and images of the scene as arrays
- `placing`    results as collections of objects
- `keeping`    the search of a collection, in the .blend
- `settings`   what the panel asks, stored with the scene
- `operators`  grow, re-roll, again, hold, cancel, trust
- `panel`      the panel in the sidebar
"""


def register() -> None:
    """Called by Blender when the extension is enabled."""
    # Only Blender has `bpy`.
    from . import operators, panel, settings

    settings.register()
    operators.register()
    panel.register()


def unregister() -> None:
    """Called by Blender when the extension is disabled."""
    from . import operators, panel, settings

    panel.unregister()
    operators.unregister()
    settings.unregister()
