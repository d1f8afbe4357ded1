"""Operators of fits: fit a modifier to a mesh, hold a socket, take the values of an answer.

The button searches between Blender's events, in this Blender; an operator that a script calls waits for the end.
"""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import IntProperty, StringProperty
from niwaki.errors import NiwakiError
from niwaki.fitting.in_blender.sockets import NodeTreeError

from . import fitting, modifiers, operators, placement

#: Seconds of work between Blender's events.
SHARE = 0.05


def chosen(context: bpy.types.Context) -> tuple[bpy.types.Object, Any]:
    """Return the object and the modifier of the panel; without an object there the active one.

    Raises
    ------
    ValueError
        There is none that can be fitted.
    """
    settings = context.scene.niwaki_settings
    obj = settings.fit_object or context.object
    if obj is None:
        raise ValueError("Choose an object with a Geometry Nodes modifier")
    return obj, modifiers.modifier_of(obj, settings.fit_modifier)


class NIWAKI_OT_fit(bpy.types.Operator):
    """Search the sockets of a Geometry Nodes modifier until its mesh fills the target or covers the silhouette"""  # noqa: D400

    bl_idname = "niwaki.fit"
    bl_label = "Fit Modifier to Mesh"
    bl_options = {"UNDO"}

    count: IntProperty(
        name="Results",
        description="Answers in a grid; 1 changes the modifier alone",
        default=1,
        min=1,
        max=48,
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Allow one search at a time."""
        return operators.running() is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Run from a script: wait for the end of the search."""
        if not self._start(context):
            return {"CANCELLED"}
        while not self._fitting.has_ended:
            self._fitting.work(SHARE)
        return self._finish(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Run from a button: work by a timer."""
        if not self._start(context):
            return {"CANCELLED"}
        operators.begin(self._fitting)
        self._shown = None
        manager = context.window_manager
        self._timer = manager.event_timer_add(operators.INTERVAL, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Work during a search; Esc ends it with its answers so far."""
        if event.type == "ESC":
            self._fitting.stop()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        operators.redraw(context)
        self._fitting.work(SHARE)
        if not self._fitting.has_ended:
            best = self._fitting.best
            if best is not self._shown:
                self._shown = best
                placement.show_best(context, best, (0.0, 0.0, 0.0))
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self._timer)
        operators.end()
        return self._finish(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Abandon the search; Blender calls this when it loads another file or closes the window."""
        operators.end()
        self._fitting.stop()
        placement.hide_best()
        self._trial.end()

    def _start(self, context: bpy.types.Context) -> bool:
        settings = context.scene.niwaki_settings
        try:
            obj, modifier = chosen(context)
            if obj == settings.target:
                raise ValueError(f"{obj.name} is the target, too: choose another mesh to fill")
            self._trial = modifiers.Trial(obj, modifier)
            goals = settings.goals(context, but=obj)
            if ("match_image" in goals or "match_shadow" in goals) and "camera" not in goals:
                raise ValueError("The silhouette has no camera: choose a camera")
            self._fitting = fitting.Fitting(
                self._trial.rows,
                modifiers.held(obj, modifier),
                goals,
                self._trial,
                settings.evaluations,
                settings.seed,
            )
        except (ValueError, NiwakiError) as error:
            self.report({"ERROR"}, _text(error))
            return False
        return True

    def _finish(self, context: bpy.types.Context) -> set[str]:
        placement.hide_best()
        self._trial.end()
        answers = self._fitting.answers(self.count)
        if self._fitting.problem or not answers:
            text = self._fitting.problem or "The search was cancelled before it found a mesh"
            self.report({"ERROR"}, text)
            return {"CANCELLED"}
        try:
            modifiers.write(self._trial, answers[0])
            if self.count > 1:
                modifiers.place(context, self._trial, answers)
        except fitting.RemovedError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.view_layer.update()
        if self._fitting.interrupted:
            self.report({"INFO"}, "Cancelled: these are the best values so far")
        return {"FINISHED"}


class NIWAKI_OT_hold_socket(bpy.types.Operator):
    """Keep the value of this socket in fits, or free it"""  # noqa: D400

    bl_idname = "niwaki.hold_socket"
    bl_label = "Hold Socket"
    bl_options = {"UNDO"}

    socket: StringProperty(name="Socket", description="Its name in the modifier")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Hold the socket, or free it."""
        try:
            obj, modifier = chosen(context)
            rows = {row.name: row.key for row in modifiers.sockets.sockets(modifier, follow=False)}
            if self.socket not in rows:
                listed = ", ".join(rows) or "none"
                raise ValueError(f"{modifier.name} has no socket {self.socket}. Its sockets: {listed}")
        except ValueError as error:
            self.report({"ERROR"}, _text(error))
            return {"CANCELLED"}
        modifiers.hold(obj, modifier, rows[self.socket])
        return {"FINISHED"}


class NIWAKI_OT_take(bpy.types.Operator):
    """Write the values of this answer into the modifier of the object that was fitted"""  # noqa: D400

    bl_idname = "niwaki.take"
    bl_label = "Use These Values"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Require an active answer."""
        return context.object is not None and modifiers.OBJECT in context.object

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Write the values."""
        try:
            obj = modifiers.take(context.object)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"{obj.name} has the values of {context.object.name}")
        return {"FINISHED"}


def _text(error: Exception) -> str:
    """Return the text of an error as a sentence."""
    text = f"{error.reason}: {error.cure}" if isinstance(error, NodeTreeError) else str(error)
    return text[:1].upper() + text[1:]


_CLASSES: tuple[Any, ...] = (NIWAKI_OT_fit, NIWAKI_OT_hold_socket, NIWAKI_OT_take)


def register() -> None:
    """Add the operators."""
    for operator in _CLASSES:
        bpy.utils.register_class(operator)


def unregister() -> None:
    """Remove the operators."""
    for operator in reversed(_CLASSES):
        bpy.utils.unregister_class(operator)
