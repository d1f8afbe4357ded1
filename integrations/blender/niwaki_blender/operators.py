"""Operators: grow, re-roll, again, hold, cancel; open and trust a file of models.

An operator of a button searches in the background; an operator that a script calls waits for the end of the search.
"""

import random
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy
from bpy.props import IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper
from niwaki.errors import NiwakiError

from . import fitting, growth, permissions, placement, storage

#: Seconds between updates during a search.
INTERVAL = 0.1
#: Error codes for a file that the worker may not run.
UNTRUSTED = ("untrusted-file", "unnamed-file")

#: The search in the background.
_running: list[growth.Growth | fitting.Fitting] = []


def running() -> growth.Growth | fitting.Fitting | None:
    """Return the search in the background; None without a search."""
    return _running[0] if _running else None


def begin(search: growth.Growth | fitting.Fitting) -> None:
    """Note the search in the background."""
    _running.append(search)


def end() -> None:
    """Note that there is no search."""
    _running.clear()


def redraw(context: bpy.types.Context) -> None:
    """Draw the panels again."""
    for area in context.window.screen.areas if context.window else ():
        if area.type == "VIEW_3D":
            area.tag_redraw()


def _name(outcome: growth.GrowthOutcome) -> str:
    """Make the name of a run's collection."""
    return f"{growth.title(growth.reference(outcome.run))} {outcome.outcomes[0].seed}"


class _GrowthOperator:
    """An operator that runs a search."""

    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Allow one search at a time."""
        return running() is None

    def begin(self, context: bpy.types.Context) -> growth.Growth:
        """Start the search."""
        raise NotImplementedError

    def end(self, context: bpy.types.Context, outcome: growth.GrowthOutcome) -> None:
        """Place the outcome."""
        raise NotImplementedError

    def place(self) -> Sequence[float]:
        """Return the place of the model's origin."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Run from a script: wait for the end of the search."""
        if not self._start(context):
            return {"CANCELLED"}
        self._growth.wait()
        return self._finish(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Run from a button: update by a timer."""
        if not self._start(context):
            return {"CANCELLED"}
        begin(self._growth)
        self._shown = None
        manager = context.window_manager
        self._timer = manager.event_timer_add(INTERVAL, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Update during a search; Esc ends it with its results so far."""
        if event.type == "ESC":
            self._growth.stop()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        redraw(context)
        if not self._growth.has_ended:
            best = self._growth.best
            if best is not self._shown:
                self._shown = best
                placement.show_best(context, best, self.place())
            return {"PASS_THROUGH"}
        placement.hide_best()
        context.window_manager.event_timer_remove(self._timer)
        end()
        return self._finish(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Abandon the search; Blender calls this when it loads another file or closes the window."""
        end()
        self._growth.abandon()

    def _start(self, context: bpy.types.Context) -> bool:
        try:
            self._growth = self.begin(context)
        except (ValueError, NiwakiError, permissions.UntrustedFileError) as error:
            self.report({"ERROR"}, str(error))
            return False
        return True

    def _finish(self, context: bpy.types.Context) -> set[str]:
        try:
            outcome = self._growth.outcome
            if outcome is None:
                text = self._growth.problem
                if self._growth.code in UNTRUSTED:
                    text = "The model calls Python functions of its file. Read this file, then press Trust"
                self.report({"ERROR"}, text)
                return {"CANCELLED"}
            try:
                self.end(context, outcome)
            except ValueError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
            if outcome.interrupted:
                self.report({"INFO"}, "Cancelled: these are the best results so far")
            return {"FINISHED"}
        finally:
            self._growth.clear()


class NIWAKI_OT_grow(_GrowthOperator, bpy.types.Operator):
    """Grow the model into the target"""  # noqa: D400 - Blender shows it and adds the full stop

    bl_idname = "niwaki.grow"
    bl_label = "Grow"

    count: IntProperty(
        name="Results", description="Number of results; 0 for the number in the panel", min=0, max=48
    )

    def begin(self, context: bpy.types.Context) -> growth.Growth:
        """Start the search with the settings of the panel."""
        settings = context.scene.niwaki_settings
        order = settings.order(context, self.count)
        self._origin = order.origin
        return growth.Growth(order.job(), permissions.words())

    def place(self) -> Sequence[float]:
        """Return the place of the target's origin."""
        return self._origin

    def end(self, context: bpy.types.Context, outcome: growth.GrowthOutcome) -> None:
        """Place the results; the first result stands at the target."""
        placement.place(context, outcome, _name(outcome), at=self._origin)


class _RepetitionOperator(_GrowthOperator):
    """An operator that repeats a stored search."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Require an active part of a result."""
        return super().poll(context) and storage.result_of(context.object) is not None

    def stored(self, context: bpy.types.Context) -> growth.Repetition:
        """Return the search to repeat."""
        raise NotImplementedError

    def begin(self, context: bpy.types.Context) -> growth.Growth:
        """Start the search of the active result."""
        self._name = storage.result_of(context.object).name
        return growth.Growth(self.stored(context), permissions.words())

    def result(self) -> bpy.types.Collection:
        """Find the result that was active, by its name; an undo replaces all Python objects."""
        result = bpy.data.collections.get(self._name)
        if result is None:
            raise ValueError(f"{self._name} was removed during the search")
        return result

    def run(self) -> bpy.types.Collection:
        """Find the collection of the result's run."""
        run = storage.run_of(self.result())
        if run is None:
            raise ValueError(f"{self._name} is outside the collection with its search")
        return run

    def place(self) -> Sequence[float]:
        """Return the place of the active result."""
        handle = placement.handle_of(self.result())
        return self.run()[storage.ORIGIN] if handle is None else handle.location


class NIWAKI_OT_reroll(_RepetitionOperator, bpy.types.Operator):
    """Grow the active result again from another seed. Held parts stay, and the old result is hidden"""  # noqa: D400

    bl_idname = "niwaki.reroll"
    bl_label = "Re-roll"

    seed: IntProperty(
        name="Seed", description="Seed of the search; a negative value draws a random seed", default=-1
    )

    def stored(self, context: bpy.types.Context) -> growth.Repetition:
        """Return the search of the result with another seed and the held parts."""
        seed = self.seed if self.seed >= 0 else random.randrange(2**31)
        self._held = storage.held(self.result())
        number = self.result()[storage.NUMBER]
        return growth.Repetition(self.run()[storage.RUN], number, seed, 1, self._held)

    def end(self, context: bpy.types.Context, outcome: growth.GrowthOutcome) -> None:
        """Place the new result at the place of the old result."""
        run = placement.place(context, outcome, _name(outcome), self._held, self.place())
        old = self.result()
        old.hide_viewport = old.hide_render = True
        context.view_layer.objects.active = placement.handle_of(run.children[0])


class NIWAKI_OT_again(_RepetitionOperator, bpy.types.Operator):
    """Repeat the stored search of the active result, with the same results"""  # noqa: D400

    bl_idname = "niwaki.again"
    bl_label = "Again"

    def stored(self, context: bpy.types.Context) -> growth.Repetition:
        """Return the stored search."""
        return growth.Repetition(self.run()[storage.RUN])

    def place(self) -> Sequence[float]:
        """Return the place of the first result."""
        return self.run()[storage.ORIGIN]

    def end(self, context: bpy.types.Context, outcome: growth.GrowthOutcome) -> None:
        """Place the results at the places of the old results."""
        placement.place(context, outcome, _name(outcome), at=self.place())


class NIWAKI_OT_hold(bpy.types.Operator):
    """Hold the selected parts in re-rolls, or free them"""  # noqa: D400

    bl_idname = "niwaki.hold"
    bl_label = "Hold"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Require a selected part."""
        return any(storage.result_of(obj) is not None for obj in context.selected_objects)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Hold all selected parts; free them if all are held."""
        chosen = [
            part
            for obj in context.selected_objects
            if storage.result_of(obj) is not None
            for part in storage.below(obj)
        ]
        free = all(part.get(storage.HELD) for part in chosen)
        for part in chosen:
            if not free:
                part[storage.HELD] = True
            elif storage.HELD in part:
                del part[storage.HELD]
        return {"FINISHED"}


class NIWAKI_OT_cancel(bpy.types.Operator):
    """End the search and keep the best result so far"""  # noqa: D400

    bl_idname = "niwaki.cancel"
    bl_label = "Cancel"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """End the search."""
        search = running()
        if search is None:
            return {"CANCELLED"}
        search.stop()
        return {"FINISHED"}


class NIWAKI_OT_open(bpy.types.Operator, ImportHelper):
    """Choose a file of models. Growing one of its models runs the file"""  # noqa: D400

    bl_idname = "niwaki.open"
    bl_label = "Open Models"

    filename_ext = ".py"
    filter_glob: StringProperty(default="*.py", options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Set the file and allow it, because a person has chosen it."""
        context.scene.niwaki_settings.model_file = self.filepath
        permissions.name(Path(self.filepath))
        return {"FINISHED"}


class NIWAKI_OT_trust(bpy.types.Operator):
    """Allow a file that this .blend names to run, with its present bytes"""  # noqa: D400

    bl_idname = "niwaki.trust"
    bl_label = "Trust"

    filepath: StringProperty(subtype="FILE_PATH")
    sha256: StringProperty()

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Show the dialog with the file and its hash."""
        self.sha256 = self.sha256 or permissions.digest(Path(self.filepath))
        return context.window_manager.invoke_props_dialog(self, width=520)

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the file and its hash."""
        self.layout.label(text="A model is code. Read this file before you agree:")
        self.layout.label(text=self.filepath)
        self.layout.label(text=f"SHA-256 {self.sha256}")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Allow the file, if it has these bytes."""
        try:
            permissions.trust(Path(self.filepath), self.sha256)
        except permissions.UntrustedFileError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


_CLASSES: tuple[Any, ...] = (
    NIWAKI_OT_grow,
    NIWAKI_OT_reroll,
    NIWAKI_OT_again,
    NIWAKI_OT_hold,
    NIWAKI_OT_cancel,
    NIWAKI_OT_open,
    NIWAKI_OT_trust,
)


def register() -> None:
    """Add the operators."""
    for operator in _CLASSES:
        bpy.utils.register_class(operator)


def unregister() -> None:
    """Remove the operators, and end a running search."""
    search = running()
    if search is not None:
        search.stop()
    for operator in reversed(_CLASSES):
        bpy.utils.unregister_class(operator)
