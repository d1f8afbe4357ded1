"""The panel in the sidebar of the 3D view."""

from pathlib import Path
from typing import Any

import bpy
from niwaki.fitting.in_blender import sockets
from niwaki.fitting.in_blender.sockets import NodeTreeError
from niwaki.shares import coverage

from . import fitting, growth, modifiers, operators, permissions, storage


class NIWAKI_PT_panel(bpy.types.Panel):
    """The panel: settings, the running search, and the active result."""

    bl_idname = "NIWAKI_PT_panel"
    bl_label = "Niwaki"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Niwaki"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        layout, settings = self.layout, context.scene.niwaki_settings
        layout.use_property_split = True
        self._model(layout, settings)
        column = layout.column()
        column.prop(settings, "target")
        column.prop(settings, "obstacles")
        row = column.row(heading="Floor")
        row.prop(settings, "use_floor", text="")
        row.prop(settings, "floor", text="")
        column = layout.column(heading="Pictures")
        for name in ("camera", "silhouette", "light", "shadow", "receiver"):
            column.prop(settings, name)
        column = layout.column()
        for name in ("count", "effort", "seed"):
            column.prop(settings, name)
        search = operators.running()
        if search is None:
            layout.operator("niwaki.grow", icon="OUTLINER_OB_FORCE_FIELD").count = 0
            layout.operator("niwaki.grow", text="Ten Different Results", icon="GRID").count = 10
        else:
            self._progress(layout, search)
        result = storage.result_of(context.object)
        if result is not None:
            self._result(layout, result)

    def _model(self, layout: Any, settings: Any) -> None:
        file = settings.file()
        row = layout.row()
        row.prop(settings, "model_file")
        row.operator("niwaki.open", text="", icon="FILE_FOLDER")
        if file is None:
            layout.prop(settings, "model")
        else:
            layout.prop(settings, "function")
            if not permissions.is_allowed(file):
                _trust(layout, file)
        layout.prop(settings, "arguments")

    def _progress(self, layout: Any, search: growth.Growth | fitting.Fitting) -> None:
        if isinstance(search, fitting.Fitting):
            # The panel of fits shows it.
            return
        now = search.progress
        text = "Starting" if now is None else f"{now.seconds:.0f} s, round {now.done}"
        if now is not None and now.fit:
            text += f", {now.fit}"
        layout.label(text=text, icon="SORTTIME")
        layout.operator("niwaki.cancel", icon="CANCEL")

    def _result(self, layout: Any, result: bpy.types.Collection) -> None:
        box = layout.box()
        box.label(text=result.name, icon="OUTLINER_COLLECTION")
        numbers = [f"seed {result['niwaki_seed']}"]
        if "niwaki_covered" in result:
            numbers.append(coverage(result["niwaki_covered"], result["niwaki_outside"]))
        box.label(text=", ".join(numbers))
        box.label(text=f"Held parts: {len(storage.held(result))}")
        row = box.row(align=True)
        for name in ("hold", "reroll", "again"):
            row.operator(f"niwaki.{name}")
        run = storage.run_of(result)
        if run is not None and storage.FILE in run and not permissions.is_allowed(Path(run[storage.FILE])):
            _trust(box, Path(run[storage.FILE]), run[storage.FILE_HASH])


class NIWAKI_PT_fit(bpy.types.Panel):
    """The panel of fits: the modifier, its sockets, and the active answer."""

    bl_idname = "NIWAKI_PT_fit"
    bl_label = "Fit Modifier to Mesh"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Niwaki"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the panel."""
        layout, settings = self.layout, context.scene.niwaki_settings
        layout.use_property_split = True
        for name in (
            "fit_object",
            "fit_modifier",
            "target",
            "camera",
            "silhouette",
            "obstacles",
            "evaluations",
        ):
            layout.prop(settings, name)
        obj = settings.fit_object or context.object
        if obj is not None:
            self._sockets(layout, obj, settings.fit_modifier)
        search = operators.running()
        if search is None:
            layout.operator("niwaki.fit", icon="MODIFIER").count = 1
            layout.operator("niwaki.fit", text="Ten Different Answers", icon="GRID").count = 10
        elif isinstance(search, fitting.Fitting):
            layout.label(text=search.progress(), icon="SORTTIME")
            layout.operator("niwaki.cancel", icon="CANCEL")
        if context.object is not None and modifiers.OBJECT in context.object:
            self._answer(layout, context.object)

    def _sockets(self, layout: Any, obj: bpy.types.Object, name: str) -> None:
        """Draw a button for each socket, which holds it."""
        try:
            modifier = modifiers.modifier_of(obj, name)
        except NodeTreeError as error:
            layout.label(text=error.reason, icon="INFO")
            return
        held = modifiers.held(obj, modifier)
        box = layout.box()
        for row in sockets.sockets(modifier, follow=False):
            icon = "LOCKED" if row.key in held else "UNLOCKED"
            box.operator("niwaki.hold_socket", text=row.name, icon=icon).socket = row.name

    def _answer(self, layout: Any, answer: bpy.types.Object) -> None:
        box = layout.box()
        box.label(text=answer.name, icon="MODIFIER")
        if "niwaki_covered" in answer:
            box.label(text=coverage(answer["niwaki_covered"], answer["niwaki_outside"]))
        box.operator("niwaki.take")


def _trust(layout: Any, file: Path, sha256: str = "") -> None:
    """Draw the button that trusts a file with this hash; without a hash, the file's present bytes."""
    button = layout.operator("niwaki.trust", text=f"Trust {file.name}", icon="QUESTION")
    button.filepath, button.sha256 = str(file), sha256


def register() -> None:
    """Add the panels."""
    bpy.utils.register_class(NIWAKI_PT_panel)
    bpy.utils.register_class(NIWAKI_PT_fit)


def unregister() -> None:
    """Remove the panels."""
    bpy.utils.unregister_class(NIWAKI_PT_fit)
    bpy.utils.unregister_class(NIWAKI_PT_panel)
