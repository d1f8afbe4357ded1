"""Claim: the sockets of Geometry Nodes modifiers are fitted, by `nw.blend` in worker processes and by the extension in
the Blender that runs. Hidden values are found again, and nothing but the modifier changes.

`make test-blender` runs this file on the Python that has `bpy`, which is also the Blender of the worker processes.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import layouts
import node_trees
import numpy as np
import pytest
import rendering

PICTURES = os.environ.get("NIWAKI_PICTURES")

#: Values of the chair that no search sees, and how near they are result.
HIDDEN = {
    "Seat Width": 0.62,
    "Seat Height": 0.38,
    "Stand": "Pedestal",
    "Column": 0.17,
    "Back": True,
    "Back Height": 0.55,
    "Slats": 4,
}
NEAR = 0.02

#: Blender as a module in the place of the program.
PROGRAM = """#!/bin/sh
echo "Blender 4.2.0 LTS"
test "$1 $2 $3" = "--background --factory-startup --python" || exit 9
exec {python} -c "import bpy, runpy, sys; runpy.run_path(sys.argv[1], run_name='__main__')" "$4"
"""


@pytest.fixture(autouse=True)
def scene(installed: None) -> bpy.types.Scene:
    """An empty scene."""
    bpy.ops.wm.read_homefile(use_empty=True)
    return bpy.context.scene


def extension() -> Any:
    """The extension's modules."""
    from bl_ext.user_default import niwaki as modules
    from bl_ext.user_default.niwaki import fit_operators, fitting, modifiers, operators, panel, placement

    del fit_operators, fitting, modifiers, operators, panel, placement
    return modules


def sockets() -> Any:
    from niwaki.fitting.in_blender import sockets as module

    return module


def values(modifier: Any) -> dict[str, Any]:
    """Read the sockets of a modifier by name."""
    return {row.name: row.value for row in sockets().sockets(modifier)}


def set_values(modifier: Any, new: dict[str, Any]) -> None:
    rows = sockets().sockets(modifier)
    sockets().write_all(modifier, rows, {row.key: new[row.name] for row in rows if row.name in new})


def assert_hidden(result: dict[str, Any]) -> None:
    for name, value in HIDDEN.items():
        assert result[name] == (pytest.approx(value, abs=NEAR) if isinstance(value, float) else value), name


def baked(obj: bpy.types.Object, name: str) -> bpy.types.Object:
    """Add the mesh of an object, as an object without modifiers at the same place."""
    bpy.context.view_layer.update()
    data = bpy.data.meshes.new_from_object(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    copy = bpy.data.objects.new(name, data)
    copy.matrix_world = obj.matrix_world
    bpy.context.scene.collection.objects.link(copy)
    bpy.context.view_layer.update()
    return copy


def chair_and_target() -> tuple[bpy.types.Object, Any, bpy.types.Object]:
    """Add a chair away from the origin, and the target that its hidden values make."""
    obj, modifier = node_trees.add(node_trees.chair(), "Chair")
    obj.location, obj.rotation_euler = (2.0, 1.0, 0.0), (0.0, 0.0, 0.5)
    first = values(modifier)
    set_values(modifier, HIDDEN)
    target = baked(obj, "target")
    set_values(modifier, first | {"Stand": "Legs"})
    bpy.context.scene.niwaki_settings.target = target
    bpy.context.scene.niwaki_settings.fit_object = obj
    bpy.context.scene.niwaki_settings.evaluations = 80
    return obj, modifier, target


def test_sockets_have_limits_and_are_used_behind_their_switches() -> None:
    _, modifier = node_trees.add(node_trees.chair(), "Chair")
    rows = {row.name: row for row in sockets().sockets(modifier)}
    keys = {name: row.identifier for name, row in rows.items()}
    assert (rows["Seat Width"].low, rows["Seat Width"].high, rows["Seat Width"].rules) == (0.35, 0.8, [])
    assert rows["Stand"].entries == ["Legs", "Pedestal"] and rows["Slats"].kind == "whole"
    assert rows["Leg"].rules == [{keys["Stand"]: ["Legs"]}]
    assert rows["Column"].rules == [{keys["Stand"]: ["Pedestal"]}]
    assert rows["Back Height"].rules == rows["Slats"].rules == [{keys["Back"]: [True]}]
    _, modifier = node_trees.add(node_trees.table(), "Table")
    rows = {row.name: row for row in sockets().sockets(modifier)}
    assert not rows["Without Use"].is_used and rows["Top Size.y"].value == 0.8
    assert (rows["Height"].low, rows["Height"].high) == (None, None)


def test_conditions_go_through_groups_and_both_branches() -> None:
    tree = node_trees.Tree("Outer")
    on, size, both = tree.socket("On", "Bool"), tree.socket("Size", "Float"), tree.socket("Both", "Float")
    inner = node_trees.Tree("Inner")
    flag, length = inner.socket("Flag", "Bool"), inner.socket("Length", "Float")
    inner.end(inner.switch(flag, None, inner.box((length, 1, 1), (0, 0, 0))))
    group = tree.node("GeometryNodeGroup", node_tree=inner.group)
    reroute = tree.node("NodeReroute")
    tree.link(on, reroute.inputs[0])
    tree.link(reroute.outputs[0], group.inputs["Flag"])
    tree.link(size, group.inputs["Length"])
    first, second = (tree.box((both, both, height), (0, 0, 0)) for height in (1, 2))
    tree.end(tree.joined(group.outputs[0], tree.switch(on, first, second)))
    _, modifier = node_trees.add(tree.group, "Box")
    rows = {row.name: row for row in sockets().sockets(modifier)}
    assert rows["Size"].rules == [{rows["On"].identifier: [True]}] and rows["Size"].is_used
    assert rows["Both"].rules == [] and rows["Both"].is_used


def test_a_file_is_fitted_in_worker_processes(tmp_path: Path) -> None:
    import niwaki as nw

    node_trees.add(node_trees.chair(), "Chair")
    node_trees.add(node_trees.table(), "Table")
    place = tmp_path / "furniture.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(place))
    with pytest.raises(nw.errors.InputError, match="name one of Chair, Table"):
        nw.blend(place, blender=sys.executable)
    # A program with Blender's words and greeting.
    program = tmp_path / "blender"
    program.write_text(PROGRAM.format(python=sys.executable))
    program.chmod(0o755)
    model = nw.blend(place, "Chair", blender=program, hold={"Stand": "Pedestal"})
    assert "Leg" not in model.space.names and model.space.axis("Column").when == ()
    target = nw.Target(
        *model.call(
            {
                "Seat Width": 0.62,
                "Seat Height": 0.38,
                "Column": 0.17,
                "Back": 1,
                "Back Height": 0.55,
                "Slats": 4,
            }
        ).mesh
    )
    result = nw.fit(model, nw.match_volume(target), 60, workers=1, seed=1, folder=tmp_path / "fit")
    assert result.best.iou > 0.97 and not result.failures and result.spread == 0.0
    assert_hidden({**result.best.parameters, "Stand": "Pedestal"})
    # y is up in the files that Blender exports as glTF.
    high = nw.blend(place, "Table", up="y", height=0.9, blender=sys.executable)
    vertices, _ = high.call({}).mesh
    assert np.ptp(vertices, axis=0) == pytest.approx([1.0, 0.9, 0.8])


def test_files_that_cannot_be_fitted_are_refused_with_a_cure(tmp_path: Path) -> None:
    import niwaki as nw

    obj, _ = node_trees.add(node_trees.table(), "Table")
    obj.modifiers.new("Bevel", "BEVEL")
    points = node_trees.Tree("Points")
    line = points.node("GeometryNodeMeshToPoints")
    cube = points.node("GeometryNodeMeshCube")
    points.link(cube.outputs[0], line.inputs[0])
    points.link(points.socket("Radius", "Float", 1.0), line.inputs["Radius"])
    node_trees.add(points.end(line.outputs[0]), "Cloud")
    unused = node_trees.Tree("Unused")
    unused.socket("Length", "Float", 1.0)
    node_trees.add(unused.end(unused.box((1, 1, 1), (0, 0, 0))), "Unused")
    with pytest.raises(sockets().NodeTreeError, match="no object `Chair`: .*: Cloud, Table, Unused"):
        sockets().find(bpy.data.objects, "Chair", None)
    with pytest.raises(sockets().NodeTreeError, match="bevel modifier and not one of Geometry Nodes"):
        sockets().find(bpy.data.objects, "Table", "Bevel")
    with pytest.raises(sockets().NodeTreeError, match="no modifier `Nodes`"):
        sockets().find(bpy.data.objects, "Table", "Nodes")
    place = tmp_path / "a.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(place))
    with pytest.raises(nw.errors.InputError, match="depends on none of its sockets"):
        nw.blend(place, "Unused", blender=sys.executable)
    model = nw.blend(place, "Cloud", blender=sys.executable)
    with pytest.raises(
        RuntimeError, match="points and no mesh: end it with a node such as Instance on Points"
    ):
        model.call({})


def test_the_extension_finds_hidden_values_and_keeps_the_rest(scene: bpy.types.Scene) -> None:
    obj, modifier, target = chair_and_target()
    before = [set(row) for row in (bpy.data.objects, bpy.data.scenes, bpy.data.collections)]
    assert bpy.ops.niwaki.fit() == {"FINISHED"}
    assert_hidden(values(modifier))
    assert [set(row) for row in (bpy.data.objects, bpy.data.scenes, bpy.data.collections)] == before
    # The mesh stands where the target does.
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    boxes = [
        np.array([o.matrix_world @ v.co for v in o.evaluated_get(graph).data.vertices]) for o in (obj, target)
    ]
    assert boxes[0].max(axis=0) == pytest.approx(boxes[1].max(axis=0), abs=2 * NEAR)


def test_ten_answers_stand_in_a_grid_and_one_is_taken(scene: bpy.types.Scene) -> None:
    obj, modifier, _ = chair_and_target()
    assert bpy.ops.niwaki.fit(count=10) == {"FINISHED"}
    copies = list(bpy.data.collections["Chair fits"].objects)
    assert 2 <= len(copies) <= 10 and values(copies[0].modifiers[0]) == values(modifier)
    assert len({copy["niwaki_values"] for copy in copies}) == len(copies)
    scores = [copy["niwaki_score"] for copy in copies]
    assert scores[0] == max(scores) and copies[0]["niwaki_covered"] > 0.9
    graph = bpy.context.evaluated_depsgraph_get()
    rows = [
        np.array([o.matrix_world @ v.co for v in o.evaluated_get(graph).data.vertices])
        for o in [obj, *copies]
    ]
    boxes = [(row.min(axis=0), row.max(axis=0)) for row in rows]
    for number, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:number]:
            assert (high < other_low).any() or (other_high < low).any()
    # A person changes the last answer, and takes it.
    set_values(copies[-1].modifiers[0], {"Seat Width": 0.7})
    bpy.context.view_layer.objects.active = copies[-1]
    assert bpy.ops.niwaki.take() == {"FINISHED"}
    assert values(modifier) == values(copies[-1].modifiers[0]) and values(modifier)[
        "Seat Width"
    ] == pytest.approx(0.7)


@pytest.mark.skipif(PICTURES is None, reason="no folder of pictures")
def test_the_picture_shows_a_target_and_ten_answers(scene: bpy.types.Scene) -> None:
    obj, modifier, target = chair_and_target()
    obj.location, obj.rotation_euler = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    target.matrix_world = obj.matrix_basis
    scene.niwaki_settings.evaluations = 150
    bpy.context.view_layer.update()
    assert bpy.ops.niwaki.fit(count=10) == {"FINISHED"}
    copies = list(bpy.data.collections["Chair fits"].objects)
    obj.hide_render = True
    target.data.materials.clear()
    target.data.materials.append(rendering.material("target", (0.1, 0.3, 0.6)))
    wood = rendering.material("wood", (0.55, 0.3, 0.12))
    end = modifier.node_group
    paint, output = (
        end.nodes.new("GeometryNodeSetMaterial"),
        next(n for n in end.nodes if n.bl_idname == "NodeGroupOutput"),
    )
    paint.inputs["Material"].default_value = wood
    link = output.inputs[0].links[0]
    source = link.from_socket
    end.links.remove(link)
    end.links.new(source, paint.inputs["Geometry"])
    end.links.new(paint.outputs[0], output.inputs[0])
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    rows = [
        np.array([o.matrix_world @ v.co for v in o.evaluated_get(graph).data.vertices])
        for o in [target, *copies]
    ]
    place = Path(str(PICTURES)) / "blender-fit.png"
    rendering.render(place, np.concatenate(rows), (560, 334), tilt=1.0, colors=64)
    assert place.stat().st_size < 80_000


def test_a_held_socket_keeps_its_value(scene: bpy.types.Scene) -> None:
    obj, modifier, _ = chair_and_target()
    with pytest.raises(RuntimeError, match="no socket Width"):
        bpy.ops.niwaki.hold_socket(socket="Width")
    for name in ("Slats", "Leg", "Back"):
        assert bpy.ops.niwaki.hold_socket(socket=name) == {"FINISHED"}
    bpy.ops.niwaki.hold_socket(socket="Back")
    before = values(modifier)
    assert bpy.ops.niwaki.fit() == {"FINISHED"}
    after = values(modifier)
    assert after["Slats"] == before["Slats"] == 3 and after["Leg"] == before["Leg"]
    assert after["Stand"] == "Pedestal" and after["Seat Width"] == pytest.approx(0.62, abs=2 * NEAR)
    for row in sockets().sockets(modifier):
        if row.name not in ("Slats", "Leg"):
            bpy.ops.niwaki.hold_socket(socket=row.name)
    with pytest.raises(RuntimeError, match="all sockets are held"):
        bpy.ops.niwaki.fit()


def test_a_silhouette_and_an_obstacle_decide_the_width(scene: bpy.types.Scene) -> None:
    """The image shows a table 1.6 wide; an obstacle stands where its top would be deeper than 0.5."""
    obj, modifier = node_trees.add(node_trees.table(), "Table")
    settings = scene.niwaki_settings
    scene.render.resolution_x, scene.render.resolution_y = 64, 64
    lens = bpy.data.cameras.new("eye")
    lens.type, lens.ortho_scale = "ORTHO", 3.2
    eye = bpy.data.objects.new("eye", lens)
    eye.location, eye.rotation_euler = (0.0, -10.0, 0.0), (np.pi / 2, 0.0, 0.0)
    scene.collection.objects.link(eye)
    bpy.context.view_layer.update()
    image = bpy.data.images.new("silhouette", 64, 64)
    pixels = np.zeros((64, 64, 4), np.float32)
    x, z = np.meshgrid((np.arange(64) + 0.5) / 20 - 1.6, (np.arange(64) + 0.5) / 20 - 1.6)
    top = (np.abs(x) < 0.8) & (z > 0.9) & (z < 1.1)
    legs = (np.abs(np.abs(x) - 0.64) < 0.05) & (z > 0) & (z < 1.1)
    pixels[..., :3] = (top | legs)[..., None]
    pixels[..., 3] = 1.0
    image.pixels.foreach_set(pixels.ravel())
    settings.camera, settings.silhouette, settings.fit_object = eye, image, obj
    settings.evaluations = 60
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0.0, 0.75, 0.5))
    wall = bpy.context.object
    wall.scale = (3.0, 1.0, 2.0)
    settings.obstacles = bpy.data.collections.new("walls")
    settings.obstacles.objects.link(wall)
    bpy.context.view_layer.update()
    assert bpy.ops.niwaki.fit() == {"FINISHED"}
    after = values(modifier)
    assert after["Width"] == pytest.approx(1.6, abs=0.1) and after["Height"] == pytest.approx(1.1, abs=0.1)
    assert after["Top Size.y"] <= 0.52


def test_an_undo_returns_to_the_values_before(scene: bpy.types.Scene) -> None:
    _, modifier, _ = chair_and_target()
    before = values(modifier)
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.niwaki.fit() == {"FINISHED"}
    assert values(modifier) != before
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    assert values(bpy.data.objects["Chair"].modifiers[0]) == before
    assert extension().modifiers.TRIAL not in bpy.data.objects


@pytest.mark.parametrize("key", ["TIMER", "ESC", "GONE"])
def test_a_button_works_between_events_and_esc_keeps_the_best(scene: bpy.types.Scene, key: str) -> None:
    # The test makes Blender's calls, because `bpy` has no window.
    modules = extension()
    obj, modifier, _ = chair_and_target()
    before = values(modifier)
    stopped: list[str] = []
    manager = SimpleNamespace(
        event_timer_add=lambda seconds, window: "timer",
        event_timer_remove=stopped.append,
        modal_handler_add=lambda operator: None,
    )
    window = SimpleNamespace(screen=SimpleNamespace(areas=[]))
    context = SimpleNamespace(
        window_manager=manager,
        window=window,
        scene=scene,
        view_layer=bpy.context.view_layer,
        object=None,
        evaluated_depsgraph_get=bpy.context.evaluated_depsgraph_get,
    )
    reports: list[str] = []
    members = {
        name: entry
        for name, entry in vars(modules.fit_operators.NIWAKI_OT_fit).items()
        if callable(entry) and not name.startswith("__")
    }
    button = type(
        "Button", (), {**members, "count": 1, "report": lambda self, kind, text: reports.append(text)}
    )()
    assert button.invoke(context, None) == {"RUNNING_MODAL"}
    assert not bpy.ops.niwaki.fit.poll() and not bpy.ops.niwaki.grow.poll()
    assert button.modal(context, SimpleNamespace(type="MOUSEMOVE")) == {"PASS_THROUGH"}
    shown = False
    while (state := button.modal(context, SimpleNamespace(type="TIMER"))) == {"PASS_THROUGH"}:
        assert values(modifier) == before and "of 80" in modules.operators.running().progress()
        panels = layouts.drawn(modules.panel.NIWAKI_PT_fit, ("_sockets", "_answer"))
        assert "operator niwaki.cancel" in panels and "operator niwaki.fit " not in panels
        shown = shown or modules.placement.BEST in bpy.data.objects
        if key == "ESC" and shown:
            bpy.ops.niwaki.cancel()
        if key == "GONE" and shown and modules.modifiers.TRIAL in bpy.data.objects:
            # An undo takes the copy away, and a person the object.
            bpy.data.objects.remove(bpy.data.objects[modules.modifiers.TRIAL])
            obj.name = "Another"
    assert shown and stopped == ["timer"] and modules.operators.running() is None
    assert modules.placement.BEST not in bpy.data.objects and modules.modifiers.TRIAL not in bpy.data.scenes
    if key == "GONE":
        assert state == {"CANCELLED"} and "was removed during the search" in reports[0]
        assert values(modifier) == before
        return
    assert state == {"FINISHED"} and values(modifier) != before
    assert reports == (["Cancelled: these are the best values so far"] if key == "ESC" else [])


def test_missing_settings_give_a_message(scene: bpy.types.Scene) -> None:
    settings = scene.niwaki_settings
    with pytest.raises(RuntimeError, match="Choose an object"):
        bpy.ops.niwaki.fit()
    obj, _, target = chair_and_target()
    for name, value, message in (
        ("target", None, "Choose a target mesh"),
        ("target", obj, "is the target, too"),
        ("fit_modifier", "Nodes", "has no modifier `Nodes`"),
        ("fit_object", target, "has no Geometry Nodes modifier"),
    ):
        old = getattr(settings, name)
        setattr(settings, name, value)
        with pytest.raises(RuntimeError, match=message):
            bpy.ops.niwaki.fit()
        setattr(settings, name, old)
    assert json.loads(obj.get("niwaki_held_sockets", "{}")) == {}


def test_the_panel_shows_sockets_progress_and_the_active_answer(scene: bpy.types.Scene) -> None:
    modules = extension()

    def drawn() -> str:
        return layouts.drawn(modules.panel.NIWAKI_PT_fit, ("_sockets", "_answer"))

    assert "prop fit_object" in drawn() and "operator niwaki.fit" in drawn()
    _, _, target = chair_and_target()
    bpy.ops.niwaki.hold_socket(socket="Leg")
    assert "operator niwaki.hold_socket Leg LOCKED" in drawn() and "Seat Width UNLOCKED" in drawn()
    scene.niwaki_settings.evaluations = 20
    bpy.ops.niwaki.fit(count=2)
    bpy.context.view_layer.objects.active = bpy.data.collections["Chair fits"].objects[0]
    assert "label Chair #0" in drawn() and "operator niwaki.take" in drawn() and "covered" in drawn()
    scene.niwaki_settings.fit_object = target
    assert "has no Geometry Nodes modifier" in drawn()
