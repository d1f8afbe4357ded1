"""What a person can do: grow, re-roll, again, hold, cancel, name and trust a file of models.

An operator that is called by a button grows in the background; one that is called by a script waits for the end.
"""

import random
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy
from bpy.props import IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper
from niwaki.errors import NiwakiError

from . import growing, keeping, naming, placing

#: Seconds between two looks at a search.
LOOK = 0.1
#: What a worker says of a file that it may not run.
UNNAMED = ("untrusted-file", "unnamed-file")

#: The search that is going on in the background.
_running: list[growing.Growing] = []


def running() -> growing.Growing | None:
    """The search that is going on in the background."""
    return _running[0] if _running else None


def _name(grown: growing.Grown) -> str:
    """Of a run's collection."""
    return f"{growing.title(growing.reference(grown.run))} {grown.outcomes[0].seed}"


class _Grows:
    """An operator that grows something."""

    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """One search at a time."""
        return running() is None

    def begin(self, context: bpy.types.Context) -> growing.Growing:
        """Start the search."""
        raise NotImplementedError

    def end(self, context: bpy.types.Context, grown: growing.Grown) -> None:
        """Place what it found."""
        raise NotImplementedError

    def place(self) -> Sequence[float]:
        """Where the model's origin stands."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Called by a script: wait for the end."""
        if not self._begun(context):
            return {"CANCELLED"}
        self._growing.wait()
        return self._ended(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Called by a button: look now and then."""
        if not self._begun(context):
            return {"CANCELLED"}
        _running.append(self._growing)
        self._shown = None
        manager = context.window_manager
        self._timer = manager.event_timer_add(LOOK, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Look how far it is; Esc ends it with what it has."""
        if event.type == "ESC":
            self._growing.stop()
            return {"RUNNING_MODAL"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        for area in context.window.screen.areas if context.window else ():
            if area.type == "VIEW_3D":
                area.tag_redraw()
        if not self._growing.has_ended:
            best = self._growing.best
            if best is not self._shown:
                self._shown = best
                placing.show_best(context, best, self.place())
            return {"PASS_THROUGH"}
        placing.hide_best()
        context.window_manager.event_timer_remove(self._timer)
        _running.clear()
        return self._ended(context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Called by Blender, where it loads another file or closes the window."""
        _running.clear()
        self._growing.abandon()

    def _begun(self, context: bpy.types.Context) -> bool:
        try:
            self._growing = self.begin(context)
        except (ValueError, NiwakiError, naming.Unnamed) as error:
            self.report({"ERROR"}, str(error))
            return False
        return True

    def _ended(self, context: bpy.types.Context) -> set[str]:
        try:
            grown = self._growing.grown
            if grown is None:
                text = self._growing.problem
                if self._growing.code in UNNAMED:
                    text = "The model calls Python functions of its file. Read that file, then press Trust"
                self.report({"ERROR"}, text)
                return {"CANCELLED"}
            try:
                self.end(context, grown)
            except ValueError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
            if grown.interrupted:
                self.report({"INFO"}, "Cancelled: the best until then")
            return {"FINISHED"}
        finally:
            self._growing.clear()


class NIWAKI_OT_grow(_Grows, bpy.types.Operator):
    """Grow the model into the target"""  # noqa: D400 - Blender shows it, and puts the end mark

    bl_idname = "niwaki.grow"
    bl_label = "Grow"

    count: IntProperty(
        name="Results", description="How many; those of the panel where it is 0", min=0, max=48
    )

    def begin(self, context: bpy.types.Context) -> growing.Growing:
        """Start the search of the panel."""
        settings = context.scene.niwaki_settings
        order = settings.order(context, self.count)
        self._origin = order.origin
        return growing.Growing(order.job(), naming.words())

    def place(self) -> Sequence[float]:
        """Where the target's origin stands."""
        return self._origin

    def end(self, context: bpy.types.Context, grown: growing.Grown) -> None:
        """Place the results: the first where the target stands."""
        placing.place(context, grown, _name(grown), at=self._origin)


class _Repeats(_Grows):
    """An operator that carries out a stored search again."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """A part of a result is active."""
        return super().poll(context) and keeping.result_of(context.object) is not None

    def stored(self, context: bpy.types.Context) -> growing.Again:
        """What to do again."""
        raise NotImplementedError

    def begin(self, context: bpy.types.Context) -> growing.Growing:
        """Start the search of the active result."""
        self._name = keeping.result_of(context.object).name
        return growing.Growing(self.stored(context), naming.words())

    def result(self) -> bpy.types.Collection:
        """The result that was active, by its name: undo makes other objects of Python of everything."""
        found = bpy.data.collections.get(self._name)
        if found is None:
            raise ValueError(f"{self._name} was removed while its search was done again")
        return found

    def run(self) -> bpy.types.Collection:
        """The collection of its run."""
        run = keeping.run_of(self.result())
        if run is None:
            raise ValueError(f"{self._name} is outside of the collection that has its search")
        return run

    def place(self) -> Sequence[float]:
        """Where the active result stands."""
        handle = placing.handle_of(self.result())
        return self.run()[keeping.ORIGIN] if handle is None else handle.location


class NIWAKI_OT_reroll(_Repeats, bpy.types.Operator):
    """Grow the active result again from another seed; held parts stay, and the old result is hidden"""  # noqa: D400

    bl_idname = "niwaki.reroll"
    bl_label = "Re-roll"

    seed: IntProperty(name="Seed", description="Any where it is negative", default=-1)

    def stored(self, context: bpy.types.Context) -> growing.Again:
        """Its search with another seed, and what is held."""
        seed = self.seed if self.seed >= 0 else random.randrange(2**31)
        self._held = keeping.held(self.result())
        number = self.result()[keeping.NUMBER]
        return growing.Again(self.run()[keeping.RUN], number, seed, 1, self._held)

    def end(self, context: bpy.types.Context, grown: growing.Grown) -> None:
        """Place it where the old one stands."""
        run = placing.place(context, grown, _name(grown), self._held, self.place())
        old = self.result()
        old.hide_viewport = old.hide_render = True
        context.view_layer.objects.active = placing.handle_of(run.children[0])


class NIWAKI_OT_again(_Repeats, bpy.types.Operator):
    """Carry out the stored search of the active result once more: the same results"""  # noqa: D400

    bl_idname = "niwaki.again"
    bl_label = "Again"

    def stored(self, context: bpy.types.Context) -> growing.Again:
        """Its search as it was."""
        return growing.Again(self.run()[keeping.RUN])

    def place(self) -> Sequence[float]:
        """Where the first result was grown."""
        return self.run()[keeping.ORIGIN]

    def end(self, context: bpy.types.Context, grown: growing.Grown) -> None:
        """Place the results where the old ones were placed."""
        placing.place(context, grown, _name(grown), at=self.place())


class NIWAKI_OT_hold(bpy.types.Operator):
    """Hold the selected parts in what is re-rolled, or free them"""  # noqa: D400

    bl_idname = "niwaki.hold"
    bl_label = "Hold"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """A part is selected."""
        return any(keeping.result_of(one) is not None for one in context.selected_objects)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Hold all that are selected, or free them where all are held."""
        chosen = [
            part
            for one in context.selected_objects
            if keeping.result_of(one) is not None
            for part in keeping.below(one)
        ]
        free = all(part.get(keeping.HELD) for part in chosen)
        for part in chosen:
            if not free:
                part[keeping.HELD] = True
            elif keeping.HELD in part:
                del part[keeping.HELD]
        return {"FINISHED"}


class NIWAKI_OT_cancel(bpy.types.Operator):
    """End the search, and keep the best that it has found"""  # noqa: D400

    bl_idname = "niwaki.cancel"
    bl_label = "Cancel"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """End the search."""
        found = running()
        if found is None:
            return {"CANCELLED"}
        found.stop()
        return {"FINISHED"}


class NIWAKI_OT_open(bpy.types.Operator, ImportHelper):
    """Choose a file of models; it is run when you grow one of them"""  # noqa: D400

    bl_idname = "niwaki.open"
    bl_label = "Open Models"

    filename_ext = ".py"
    filter_glob: StringProperty(default="*.py", options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Name the file: a person has chosen it."""
        context.scene.niwaki_settings.model_file = self.filepath
        naming.name(Path(self.filepath))
        return {"FINISHED"}


class NIWAKI_OT_trust(bpy.types.Operator):
    """Agree that a file which this .blend names is run, with the bytes that it has"""  # noqa: D400

    bl_idname = "niwaki.trust"
    bl_label = "Trust"

    filepath: StringProperty(subtype="FILE_PATH")
    sha256: StringProperty()

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Show what is agreed to."""
        self.sha256 = self.sha256 or naming.digest(Path(self.filepath))
        return context.window_manager.invoke_props_dialog(self, width=520)

    def draw(self, context: bpy.types.Context) -> None:
        """The file and its hash."""
        self.layout.label(text="A model is code. Read this file before you agree:")
        self.layout.label(text=self.filepath)
        self.layout.label(text=f"SHA-256 {self.sha256}")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Name the file, where it has those bytes."""
        try:
            naming.trust(Path(self.filepath), self.sha256)
        except naming.Unnamed as error:
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
    for one in _CLASSES:
        bpy.utils.register_class(one)


def unregister() -> None:
    """Remove them, and end what they have begun."""
    found = running()
    if found is not None:
        found.stop()
    for one in reversed(_CLASSES):
        bpy.utils.unregister_class(one)
