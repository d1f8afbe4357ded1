"""Niwaki in Blender: grow models into meshes of the scene.

Modules without `bpy`, which tests import:

- `axes`         coordinates of Blender and of scenes
- `order`        the goals of a search as values for a worker process
- `growth`       a search in a worker process, watched by a thread
- `fitting`      a fit of a modifier under way, point by point
- `grid`         places for several results
- `permissions`  model files that may be run

Modules with `bpy`:

- `conversion`   objects, cameras, lights and images of the scene as arrays
- `placement`    results as collections of objects
- `storage`      the search of a collection, in the .blend
- `settings`     the settings of the panel, stored with the scene
- `operators`    grow, re-roll, again, hold, cancel, open, trust
- `modifiers`    sockets of modifiers, trial values on a copy of the object, answers in a grid
- `fit_operators`  fit a modifier, hold a socket, take the values of an answer
- `panel`        the panels in the sidebar
"""


def register() -> None:
    """Register the extension; Blender calls this to enable it."""
    # Only Blender has `bpy`.
    from . import fit_operators, operators, panel, settings

    settings.register()
    operators.register()
    fit_operators.register()
    panel.register()


def unregister() -> None:
    """Unregister the extension; Blender calls this to disable it."""
    from . import fit_operators, operators, panel, settings

    panel.unregister()
    fit_operators.unregister()
    operators.unregister()
    settings.unregister()
