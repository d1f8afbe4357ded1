"""Modifiers of Geometry Nodes that are fitted: their sockets, trial values on a copy of the object, answers in a grid.

The object itself changes only at the end. The copy stands alone in a scene, so that one evaluation takes no longer than
its own nodes. An undo during the search replaces all Python objects, so they are looked up by their names.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix
from niwaki.fitting.in_blender import sockets, stage

from . import grid
from .fitting import Fitted, RemovedError, Values

#: The names of the scene and of the copy of the object during a search.
TRIAL = "niwaki: fitting"

#: Custom properties: the held sockets of an object; of an answer the object and the modifier that it belongs to.
HELD, OBJECT, MODIFIER = "niwaki_held_sockets", "niwaki_fit_of", "niwaki_fit_modifier"


def modifier_of(obj: bpy.types.Object, name: str) -> Any:
    """Return the modifier of a name; without a name the only one of Geometry Nodes.

    Raises
    ------
    niwaki.fitting.in_blender.sockets.NodeTreeError
    """
    return sockets.find_modifier(obj, name or None)


def held(obj: bpy.types.Object, modifier: Any) -> list[str]:
    """List the keys of the held sockets of a modifier."""
    table: dict[str, list[str]] = json.loads(obj.get(HELD, "{}"))
    return table.get(modifier.name, [])


def hold(obj: bpy.types.Object, modifier: Any, key: str) -> None:
    """Hold a socket of a modifier, or free it."""
    table = json.loads(obj.get(HELD, "{}"))
    keys = set(table.get(modifier.name, [])) ^ {key}
    obj[HELD] = json.dumps({**table, modifier.name: sorted(keys)})


class Trial:
    """A copy of an object on which values are tried.

    Parameters
    ----------
    obj
        The object.
    modifier
        Its modifier.
    """

    def __init__(self, obj: bpy.types.Object, modifier: Any) -> None:
        self.object, self.modifier = obj.name, modifier.name
        self.rows = sockets.sockets(modifier)

    def __call__(self, values: Values) -> Any:
        """Return the mesh of values, in the world."""
        scene, twin = bpy.data.scenes.get(TRIAL), bpy.data.objects.get(TRIAL)
        if scene is None or twin is None or self.modifier not in twin.modifiers:
            scene, twin = self._begin()
        sockets.write_all(twin.modifiers[self.modifier], self.rows, values)
        return stage.mesh(scene, twin)

    def end(self) -> None:
        """Remove the copy and its scene."""
        twin, scene = bpy.data.objects.get(TRIAL), bpy.data.scenes.get(TRIAL)
        if twin is not None:
            bpy.data.objects.remove(twin)
        if scene is not None:
            bpy.data.scenes.remove(scene)

    def original(self) -> tuple[bpy.types.Object, Any]:
        """Return the object and its modifier.

        Raises
        ------
        RemovedError
            One of them is gone.
        """
        obj = bpy.data.objects.get(self.object)
        modifier = None if obj is None else obj.modifiers.get(self.modifier)
        if modifier is None or not sockets.is_node_tree(modifier):
            raise RemovedError(f"{self.object} or its modifier {self.modifier} was removed during the search")
        return obj, modifier

    def _begin(self) -> tuple[bpy.types.Scene, bpy.types.Object]:
        self.end()
        obj, modifier = self.original()
        twin = obj.copy()
        twin.name = TRIAL
        twin.modifiers[modifier.name].show_viewport = True
        scene = stage.stage(bpy.data, twin, TRIAL)
        scene.frame_set(bpy.context.scene.frame_current)
        return scene, twin


def write(trial: Trial, answer: Fitted) -> None:
    """Set the sockets of the object's modifier to an answer."""
    _, modifier = trial.original()
    sockets.write_all(modifier, trial.rows, answer.values)


def place(context: bpy.types.Context, trial: Trial, answers: Sequence[Fitted]) -> bpy.types.Collection:
    """Place answers as copies of the object in a new collection, in a grid beside it; each can be edited further."""
    obj, modifier = trial.original()
    run = bpy.data.collections.new(f"{obj.name} fits")
    context.scene.collection.children.link(run)
    copies = []
    for number, answer in enumerate(answers):
        copy = obj.copy()
        copy.name = f"{obj.name} #{number}"
        copy.parent = None
        run.objects.link(copy)
        copy.matrix_world = obj.matrix_world
        sockets.write_all(copy.modifiers[modifier.name], trial.rows, answer.values)
        copy[OBJECT], copy[MODIFIER], copy["niwaki_score"] = obj.name, modifier.name, answer.log_score
        copy["niwaki_values"] = json.dumps(answer.named)
        for name, value in (("covered", answer.covered), ("outside", answer.outside)):
            if value is not None:
                copy[f"niwaki_{name}"] = value
        copies.append(copy)
    context.view_layer.update()
    sizes = [_size(context, copy) for copy in copies]
    beside = grid.APART * max((x for x, _ in sizes), default=0.0)
    for copy, (x, y) in zip(copies, grid.places(sizes), strict=True):
        copy.matrix_world = Matrix.Translation((beside + x, y, 0.0)) @ obj.matrix_world
    context.view_layer.update()
    return run


def take(answer: bpy.types.Object) -> bpy.types.Object:
    """Write the values of an answer, with later changes, into the modifier of its object; return the object.

    Raises
    ------
    ValueError
        The object or its modifier is gone.
    """
    obj = bpy.data.objects.get(answer[OBJECT])
    modifier = None if obj is None else obj.modifiers.get(answer[MODIFIER])
    source = answer.modifiers.get(answer[MODIFIER])
    if modifier is None or source is None or modifier.node_group != source.node_group:
        raise ValueError(f"{answer[OBJECT]} no longer has the modifier {answer[MODIFIER]} of this answer")
    rows = sockets.sockets(source, follow=False)
    sockets.write_all(modifier, rows, {})
    return obj


def _size(context: bpy.types.Context, obj: bpy.types.Object) -> tuple[float, float]:
    """Measure an object along x and y."""
    evaluated = obj.evaluated_get(context.evaluated_depsgraph_get())
    corners = np.array(evaluated.bound_box) @ np.array(obj.matrix_world)[:2, :3].T
    x, y = np.ptp(corners, axis=0).tolist()
    return (x, y)
