"""Claim: the built extension installs into an empty Blender. Its operators grow into a mesh, avoid obstacles, place
results as collections with named parts, keep held parts in a re-roll, and repeat a loaded search with the same bits.

`make test-blender` runs this file on the Python that has `bpy`. There Niwaki is only in the extension's zip
(NIWAKI_ZIP), and Blender's own folder is empty (BLENDER_USER_RESOURCES). Mouse actions are not tested: `bpy` has no
window.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import layouts
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector
from rendering import render

ZIP = Path(os.environ["NIWAKI_ZIP"]).resolve()
PICTURES = os.environ.get("NIWAKI_PICTURES")

#: A model file that leaves a mark when it is run; its host function keeps the model in its file.
MODEL = Path(__file__).with_name("marked_tower.txt").read_text()


@pytest.fixture(autouse=True)
def scene(installed: None) -> bpy.types.Scene:
    """An empty scene with a short search."""
    bpy.ops.wm.read_homefile(use_empty=True)
    inside().permissions.forget()
    bpy.context.scene.niwaki_settings.effort = 0.2
    return bpy.context.scene


def inside() -> Any:
    """The extension's modules."""
    from bl_ext.user_default import niwaki as extension
    from bl_ext.user_default.niwaki import conversion, growth, operators, permissions, placement, storage

    del conversion, growth, operators, permissions, placement, storage
    return extension


def block(name: str, at: tuple[float, ...], size: tuple[float, ...]) -> bpy.types.Object:
    """Add a scaled box without modifiers to the scene."""
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=at)
    cube = bpy.context.object
    cube.name, cube.scale = name, size
    bpy.context.view_layer.update()
    return cube


def results() -> list[bpy.types.Collection]:
    return [collection for collection in bpy.data.collections if "niwaki_number" in collection]


def parts(result: bpy.types.Collection) -> dict[str, bpy.types.Object]:
    return {obj["address"]: obj for obj in result.objects if "address" in obj}


def points(obj: bpy.types.Object) -> np.ndarray:
    """Read the vertices of an object in world space."""
    vertices = np.empty(3 * len(obj.data.vertices), dtype=np.float32)
    obj.data.vertices.foreach_get("co", vertices)
    matrix = np.array(obj.matrix_world)
    return vertices.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def cloud(result: bpy.types.Collection) -> np.ndarray:
    return np.concatenate([points(part) for part in parts(result).values()])


def bits(result: bpy.types.Collection) -> dict[str, bytes]:
    """Collect the vertices of each part, and the stored properties of the result."""
    properties = "".join(f"{key}={result[key]!r};" for key in sorted(result.keys()))
    return {address: points(part).tobytes() for address, part in parts(result).items()} | {
        "": properties.encode()
    }


def activate(obj: bpy.types.Object) -> None:
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj


def test_blender_finds_no_fault_in_the_manifest() -> None:
    tool = Path(bpy.utils.system_resource("SCRIPTS")) / "addons_core/bl_pkg/cli/blender_ext.py"
    done = subprocess.run([sys.executable, tool, "validate", ZIP], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_ship_fills_a_mesh_and_avoids_another(scene: bpy.types.Scene) -> None:
    settings = scene.niwaki_settings
    settings.target = block("hull", (3, 0, 5), (4, 14, 3))
    wall = block("wall", (4.5, 0, 5), (0.5, 3, 3))
    settings.obstacles = bpy.data.collections.new("walls")
    settings.obstacles.objects.link(wall)
    settings.effort, settings.seed = 0.5, 3
    assert bpy.ops.niwaki.grow() == {"FINISHED"}
    (result,) = results()
    assert result["niwaki_covered"] > 0.4 and result["niwaki_outside"] < 0.4
    low, high = cloud(result).min(axis=0), cloud(result).max(axis=0)
    # The mesh is away from the origin, and the ship lies along Blender's axes.
    assert 2 < (low + high)[0] / 2 < 4 and 4 < (low + high)[2] / 2 < 6
    assert (high - low).argmax() == 1
    near = np.abs(cloud(result) - np.array(wall.location)) <= np.array(wall.scale) / 2 + 1e-4
    assert not near.all(axis=1).any()


def test_results_are_collections_with_named_parts(scene: bpy.types.Scene) -> None:
    scene.niwaki_settings.seed = 7
    assert bpy.ops.niwaki.grow() == {"FINISHED"}
    (result,) = results()
    (run,) = scene.collection.children
    assert run.name == "spaceship 7" and result.name == "spaceship 7 #0" and run.children[0] == result
    assert result["niwaki_seed"] == "7" and isinstance(result["niwaki_score"], float)
    choices = json.loads(result["niwaki_choices"])
    stored = json.loads(run["niwaki_run"])
    assert choices and stored["search"]["seed"] == 7
    members = parts(result)
    assert len(members) > 3
    for address, part in members.items():
        assert part.type == "MESH" and all(slot.material.node_tree for slot in part.material_slots)
        assert address.split("/")[0] in {parent.name.split(".")[0] for parent in ancestors(part)}
    # Each choice of a call is a property of its object.
    rows = [dict(row) for obj in result.objects for row in obj.get("choices", [])]
    assert rows and all(choices[row["address"]] == pytest.approx(row["value"]) for row in rows)
    assert "niwaki" not in scene


def ancestors(obj: bpy.types.Object) -> list[bpy.types.Object]:
    return [obj, *(ancestors(obj.parent) if obj.parent else [])]


def test_different_results_stand_in_a_grid(scene: bpy.types.Scene) -> None:
    assert bpy.ops.niwaki.grow(count=3) == {"FINISHED"}
    boxes = [(cloud(result).min(axis=0), cloud(result).max(axis=0)) for result in results()]
    assert len(boxes) == 3
    for number, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:number]:
            assert (high < other_low).any() or (other_high < low).any()
    assert len({result["niwaki_choices"] for result in results()}) == 3
    # Materials are shared.
    names = [material.name for material in bpy.data.materials]
    assert not any(name.endswith(".001") for name in names), names


def test_a_reroll_keeps_a_held_part(scene: bpy.types.Scene) -> None:
    scene.niwaki_settings.seed = 7
    bpy.ops.niwaki.grow()
    (old,) = results()
    before = parts(old)
    activate(before["while[0]/emit"])
    # The part's mesh is in edit mode.
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.niwaki.hold() == {"FINISHED"}
    assert bpy.ops.niwaki.reroll(seed=11) == {"FINISHED"}
    new = next(result for result in results() if result != old)
    after = parts(new)
    assert (points(after["while[0]/emit"]) == points(before["while[0]/emit"])).all()
    assert bits(new) != bits(old) and new["niwaki_seed"] == "11"
    assert old.hide_viewport and not new.hide_viewport and after["while[0]/emit"]["niwaki_held"]
    # A freed part may change again.
    activate(after["while[0]/emit"])
    bpy.ops.niwaki.hold()
    assert "niwaki_held" not in after["while[0]/emit"]


def test_a_loaded_search_repeats_with_the_same_bits(scene: bpy.types.Scene, tmp_path: Path) -> None:
    settings = scene.niwaki_settings
    settings.target = block("hull", (0, 0, 2), (3, 9, 3))
    settings.use_floor, settings.floor = True, 0.0
    bpy.ops.niwaki.grow(count=2)
    first = [bits(result) for result in results()]
    place = str(tmp_path / "ships.blend")
    bpy.ops.wm.save_as_mainfile(filepath=place)
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not results()
    bpy.ops.wm.open_mainfile(filepath=place)
    loaded = results()
    assert [bits(result) for result in loaded] == first
    # The stored search does not need the target object.
    bpy.data.objects.remove(bpy.data.objects["hull"])
    activate(next(iter(parts(loaded[0]).values())))
    assert bpy.ops.niwaki.again() == {"FINISHED"}
    again = [result for result in results() if result not in loaded]
    assert [bits(result) for result in again] == first


def test_opening_runs_no_code_and_a_file_runs_after_consent(scene: bpy.types.Scene, tmp_path: Path) -> None:
    file, mark, place = tmp_path / "towers.py", tmp_path / "mark", str(tmp_path / "tower.blend")
    file.write_text(MODEL.format(mark=str(mark)))
    settings = scene.niwaki_settings
    settings.target = block("yard", (0, 0, 1), (1, 1, 2))
    assert bpy.ops.niwaki.open(filepath=str(file)) == {"FINISHED"}
    assert not mark.exists()
    assert bpy.ops.niwaki.grow() == {"FINISHED"}
    (result,) = results()
    assert result.name == "tower 1 #0" and list(parts(result)) == ["tower"]
    bpy.ops.wm.save_as_mainfile(filepath=place)
    mark.unlink()
    inside().permissions.forget()
    bpy.ops.wm.open_mainfile(filepath=place)
    (result,) = results()
    first = bits(result)
    activate(parts(result)["tower"])
    for operator in (bpy.ops.niwaki.grow, bpy.ops.niwaki.again, bpy.ops.niwaki.reroll):
        with pytest.raises(RuntimeError, match="Trust"):
            operator()
    with pytest.raises(RuntimeError, match="SHA-256"):
        bpy.ops.niwaki.trust(filepath=str(file), sha256="0" * 64)
    assert not mark.exists() and len(results()) == 1
    run = bpy.data.collections["tower 1"]
    file_name, sha256 = run["niwaki_file"], run["niwaki_file_sha256"]
    assert bpy.ops.niwaki.trust(filepath=file_name, sha256=sha256) == {"FINISHED"}
    assert bpy.ops.niwaki.again() == {"FINISHED"}
    (again,) = [other for other in results() if other != result]
    assert bits(again) == first


def test_a_search_is_cancelled(scene: bpy.types.Scene) -> None:
    growth, settings = inside().growth, scene.niwaki_settings
    settings.model, settings.effort = "gnarly-tree", 64.0
    search = growth.Growth(settings.order(bpy.context).job())
    while not search.has_ended and (search.progress is None or search.progress.best is None):
        search.wait(0.05)
    search.stop()
    search.wait(20)
    assert search.outcome is not None and search.outcome.interrupted, search.problem
    placement, before = inside().placement, len(bpy.data.objects)
    for _ in range(2):
        placement.show_best(bpy.context, search.best, (1, 2, 3))
    preview = bpy.data.objects[placement.BEST]
    bpy.context.view_layer.update()
    assert points(preview)[:, 2].min() > 2 and len(bpy.data.objects) == before + 1
    placement.hide_best()
    assert len(bpy.data.objects) == before
    placement.place(bpy.context, search.outcome, "tree")
    search.clear()
    assert len(parts(results()[0])) > 3


@pytest.mark.parametrize("key", ["TIMER", "ESC"])
def test_a_button_updates_by_a_timer_and_esc_ends_the_search(scene: bpy.types.Scene, key: str) -> None:
    # The test makes Blender's calls, because `bpy` has no window.
    extension = inside()
    stopped: list[str] = []
    manager = SimpleNamespace(
        event_timer_add=lambda seconds, window: "timer",
        event_timer_remove=stopped.append,
        modal_handler_add=lambda operator: None,
    )
    window = SimpleNamespace(screen=SimpleNamespace(areas=[]))
    context = SimpleNamespace(
        window_manager=manager, window=window, scene=scene, view_layer=bpy.context.view_layer, object=None
    )

    class Button(extension.operators._GrowthOperator):
        reports: list[str] = []

        def begin(self, context: Any) -> Any:
            order = scene.niwaki_settings.order(bpy.context)
            return extension.growth.Growth(order.job())

        def place(self) -> tuple[float, ...]:
            return (0.0, 0.0, 0.0)

        def end(self, context: Any, outcome: Any) -> None:
            extension.placement.place(context, outcome, "tree")

        def report(self, kind: set[str], text: str) -> None:
            self.reports.append(text)

    scene.niwaki_settings.model = "gnarly-tree"
    scene.niwaki_settings.effort = 64.0 if key == "ESC" else 0.5
    button = Button()
    assert button.invoke(context, None) == {"RUNNING_MODAL"}
    assert not bpy.ops.niwaki.grow.poll() and extension.operators.running() is button._growth
    assert button.modal(context, SimpleNamespace(type="MOUSEMOVE")) == {"PASS_THROUGH"}
    shown = False
    while (state := button.modal(context, SimpleNamespace(type="TIMER"))) == {"PASS_THROUGH"}:
        shown = shown or extension.placement.BEST in bpy.data.objects
        if key == "ESC" and shown:
            assert button.modal(context, SimpleNamespace(type="ESC")) == {"RUNNING_MODAL"}
        button._growth.wait(0.05)
    assert state == {"FINISHED"} and shown and stopped == ["timer"]
    assert extension.placement.BEST not in bpy.data.objects and len(results()) == 1
    assert extension.operators.running() is None and bpy.ops.niwaki.grow.poll()
    assert button.reports == (["Cancelled: these are the best results so far"] if key == "ESC" else [])
    # Blender loads another file.
    assert button.invoke(context, None) == {"RUNNING_MODAL"}
    folder = button._growth._folder
    button.cancel(context)
    button._growth.wait(20)
    assert extension.operators.running() is None and not folder.exists()


def test_missing_settings_give_a_message(scene: bpy.types.Scene) -> None:
    settings = scene.niwaki_settings
    for set_up, message in (
        (lambda: setattr(settings, "model", "spacesip"), "did you mean `spaceship`"),
        (lambda: setattr(settings, "arguments", "{"), "not JSON"),
    ):
        set_up()
        with pytest.raises(RuntimeError, match=message):
            bpy.ops.niwaki.grow()
        settings.property_unset("model")
        settings.property_unset("arguments")
    bpy.ops.mesh.primitive_plane_add()
    settings.target = bpy.context.object
    with pytest.raises(RuntimeError, match="flat"):
        bpy.ops.niwaki.grow()
    assert not results()


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("size", [(640, 480), (300, 500)])
def test_a_camera_of_the_search_has_the_view_of_blender_s_camera(
    scene: bpy.types.Scene, kind: str, size: tuple[int, int]
) -> None:
    from niwaki import _engine, match_image
    from niwaki.draw.scene import Scene

    scene.render.resolution_x, scene.render.resolution_y = size
    lens = bpy.data.cameras.new("camera")
    lens.type, lens.ortho_scale, lens.lens = kind, 9.0, 35.0
    camera = bpy.data.objects.new("camera", lens)
    scene.collection.objects.link(camera)
    camera.location, camera.rotation_euler = (6, -9, 5), (1.1, 0.1, 0.6)
    bpy.context.view_layer.update()
    search_camera = inside().conversion.eye(camera, scene).camera()
    columns, rows = size[0] // 2, size[1] // 2
    view = match_image(np.eye(rows, columns, dtype=bool), search_camera).views[0]
    for x, y, z in ((0, 0, 0), (1, 0.5, 1), (-0.7, 1, 0.3)):
        mask = view.mask(Scene([("dot", [_engine.shape("box", (x, z, -y), (0.2, 0.2, 0.2), bevel=0.0)])]))
        expected = world_to_camera_view(scene, camera, Vector((x, y, z)))
        row, column = (float(indices.mean()) + 0.5 for indices in np.nonzero(mask))
        assert column / columns == pytest.approx(expected.x, abs=0.01)
        assert 1.0 - row / rows == pytest.approx(expected.y, abs=0.01)


def test_a_silhouette_and_a_shadow_are_matched(scene: bpy.types.Scene, tmp_path: Path) -> None:
    file = tmp_path / "towers.py"
    file.write_text(MODEL.format(mark=str(tmp_path / "mark")))
    settings = scene.niwaki_settings
    bpy.ops.niwaki.open(filepath=str(file))
    scene.render.resolution_x, scene.render.resolution_y = 200, 200
    lens = bpy.data.cameras.new("camera")
    lens.type, lens.ortho_scale = "ORTHO", 5.0
    settings.camera = bpy.data.objects.new("camera", lens)
    scene.collection.objects.link(settings.camera)
    settings.camera.location, settings.camera.rotation_euler = (0, -9, 2.5), (np.pi / 2, 0, 0)
    image = np.zeros((100, 100, 4), dtype=np.float32)
    image[:, :, 3] = 1.0
    # A tower of width 1 and height 2 on the ground; the lower row comes first.
    image[:40, 40:60, :3] = 1.0
    settings.silhouette = bpy.data.images.new("tall", 100, 100)
    settings.silhouette.pixels.foreach_set(image.ravel())
    bpy.context.view_layer.update()
    settings.effort = 1.0
    assert bpy.ops.niwaki.grow() == {"FINISHED"}
    (first,) = results()
    low, high = cloud(first).min(axis=0), cloud(first).max(axis=0)
    assert high - low == pytest.approx([1, 1, 2], abs=0.15) and low[2] == pytest.approx(0, abs=1e-5)
    settings.silhouette = None
    settings.light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    scene.collection.objects.link(settings.light)
    bpy.ops.mesh.primitive_plane_add(size=10.0)
    settings.receiver, settings.shadow, settings.camera = bpy.context.object, bpy.data.images["tall"], None
    # The view along the light is 10 wide; the square has side 1.6.
    image[:, :, :3] = 0.0
    image[42:58, 42:58, :3] = 1.0
    settings.shadow.pixels.foreach_set(image.ravel())
    bpy.context.view_layer.update()
    assert bpy.ops.niwaki.grow() == {"FINISHED"}
    (second,) = [result for result in results() if result != first]
    low, high = cloud(second).min(axis=0), cloud(second).max(axis=0)
    assert (high - low)[:2] == pytest.approx([1.6, 1.6], abs=0.2)


def test_the_panel_is_drawn(scene: bpy.types.Scene, tmp_path: Path) -> None:
    extension = inside()
    from bl_ext.user_default.niwaki import panel

    def drawn() -> str:
        return layouts.drawn(panel.NIWAKI_PT_panel, ("_model", "_progress", "_result"))

    assert "prop target" in drawn() and "operator niwaki.grow" in drawn() and "Trust" not in drawn()
    bpy.ops.niwaki.grow()
    activate(next(iter(parts(results()[0]).values())))
    bpy.ops.niwaki.hold()
    assert "label spaceship 1 #0" in drawn() and "Held parts: 1" in drawn() and "niwaki.reroll" in drawn()
    scene.niwaki_settings.model_file = str(tmp_path / "none.py")
    assert "Trust none.py" in drawn() and "prop function" in drawn()
    extension.operators._running.append(SimpleNamespace(progress=None))
    assert "Starting" in drawn() and "operator niwaki.cancel" in drawn()
    extension.operators._running.clear()


def test_the_extension_is_disabled_and_enabled() -> None:
    import addon_utils

    name = "bl_ext.user_default.niwaki"
    addon_utils.disable(name)
    assert not hasattr(bpy.types.Scene, "niwaki_settings")
    addon_utils.enable(name)
    assert bpy.context.scene.niwaki_settings.model == "spaceship"


@pytest.mark.skipif(PICTURES is None, reason="pictures are made by `make blender-pictures`")
def test_the_manual_s_picture(scene: bpy.types.Scene) -> None:

    settings = scene.niwaki_settings
    settings.effort, settings.seed = 1.0, 2
    bpy.ops.niwaki.grow(count=4)
    clouds = np.concatenate([cloud(result) for result in results()])
    place = Path(PICTURES) / "blender.png"
    render(place, clouds[::7], (720, 450))
    assert place.stat().st_size < 150_000
