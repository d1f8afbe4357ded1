"""Claim: the built extension installs into an empty Blender; its operators grow into a mesh, keep away from others,
place results as collections with named parts, keep what is held in a re-roll, and do a loaded search again with the
same bits.

`make test-blender` runs this on the Python that has `bpy`, where Niwaki is only in the extension's zip (NIWAKI_ZIP),
and Blender's own folder is an empty one (BLENDER_USER_RESOURCES).
Panels, timers and what a mouse does are not tested here: `bpy` has no window.
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
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

HOME = os.environ["BLENDER_USER_RESOURCES"]
ZIP = Path(os.environ["NIWAKI_ZIP"]).resolve()
PICTURES = os.environ.get("NIWAKI_PICTURES")

#: Leaves a mark when it is run; its host function keeps the model in its file.
MODEL = Path(__file__).with_name("marked_tower.txt").read_text()


@pytest.fixture(scope="session", autouse=True)
def installed() -> None:
    """The extension, as a user installs it."""
    # A module that `bpy` brings.
    import addon_utils

    addon_utils.enable("bl_pkg")
    with pytest.raises(ImportError):
        import niwaki
    done = bpy.ops.extensions.package_install_files(
        filepath=str(ZIP), repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"}
    import niwaki

    assert Path(niwaki.__file__).is_relative_to(HOME)


@pytest.fixture(autouse=True)
def scene() -> bpy.types.Scene:
    """An empty scene with a quick search."""
    bpy.ops.wm.read_homefile(use_empty=True)
    inside().naming.forget()
    bpy.context.scene.niwaki_settings.effort = 0.2
    return bpy.context.scene


def inside() -> Any:
    """The extension's modules."""
    from bl_ext.user_default import niwaki as extension
    from bl_ext.user_default.niwaki import growing, keeping, naming, operators, placing, reading

    del growing, keeping, naming, operators, placing, reading
    return extension


def block(name: str, at: tuple[float, ...], size: tuple[float, ...]) -> bpy.types.Object:
    """A box of the scene, with a scale and a modifier-free mesh."""
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=at)
    thing = bpy.context.object
    thing.name, thing.scale = name, size
    bpy.context.view_layer.update()
    return thing


def results() -> list[bpy.types.Collection]:
    return [one for one in bpy.data.collections if "niwaki_number" in one]


def parts(result: bpy.types.Collection) -> dict[str, bpy.types.Object]:
    return {thing["address"]: thing for thing in result.objects if "address" in thing}


def points(thing: bpy.types.Object) -> np.ndarray:
    """The vertices of an object in the world."""
    found = np.empty(3 * len(thing.data.vertices), dtype=np.float32)
    thing.data.vertices.foreach_get("co", found)
    matrix = np.array(thing.matrix_world)
    return found.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def cloud(result: bpy.types.Collection) -> np.ndarray:
    return np.concatenate([points(thing) for thing in parts(result).values()])


def bits(result: bpy.types.Collection) -> dict[str, bytes]:
    """The vertices of each part, and what is kept of the result."""
    kept = "".join(f"{key}={result[key]!r};" for key in sorted(result.keys()))
    return {address: points(thing).tobytes() for address, thing in parts(result).items()} | {
        "": kept.encode()
    }


def activate(thing: bpy.types.Object) -> None:
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def test_blender_finds_no_fault_in_the_manifest() -> None:
    tool = Path(bpy.utils.system_resource("SCRIPTS")) / "addons_core/bl_pkg/cli/blender_ext.py"
    found = subprocess.run([sys.executable, tool, "validate", ZIP], capture_output=True, text=True)
    assert found.returncode == 0, found.stdout + found.stderr


def test_a_ship_fills_a_mesh_and_keeps_away_from_another(scene: bpy.types.Scene) -> None:
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
    # It fills a mesh that stands away from the origin, along Blender's axes.
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
    found = parts(result)
    assert len(found) > 3
    for address, thing in found.items():
        assert thing.type == "MESH" and all(slot.material.node_tree for slot in thing.material_slots)
        assert address.split("/")[0] in {parent.name.split(".")[0] for parent in ancestors(thing)}
    # Each choice of a call is a property of its object.
    noted = [dict(one) for thing in result.objects for one in thing.get("choices", [])]
    assert noted and all(choices[one["address"]] == pytest.approx(one["value"]) for one in noted)
    assert "niwaki" not in scene


def ancestors(thing: bpy.types.Object) -> list[bpy.types.Object]:
    return [thing, *(ancestors(thing.parent) if thing.parent else [])]


def test_different_ones_stand_in_a_grid(scene: bpy.types.Scene) -> None:
    assert bpy.ops.niwaki.grow(count=3) == {"FINISHED"}
    boxes = [(cloud(one).min(axis=0), cloud(one).max(axis=0)) for one in results()]
    assert len(boxes) == 3
    for number, (low, high) in enumerate(boxes):
        for other_low, other_high in boxes[:number]:
            assert (high < other_low).any() or (other_high < low).any()
    assert len({one["niwaki_choices"] for one in results()}) == 3
    # Materials are shared.
    names = [one.name for one in bpy.data.materials]
    assert not any(name.endswith(".001") for name in names), names


def test_a_reroll_keeps_the_part_that_is_held(scene: bpy.types.Scene) -> None:
    scene.niwaki_settings.seed = 7
    bpy.ops.niwaki.grow()
    (old,) = results()
    before = parts(old)
    activate(before["while[0]/emit"])
    # Its mesh is being edited.
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.niwaki.hold() == {"FINISHED"}
    assert bpy.ops.niwaki.reroll(seed=11) == {"FINISHED"}
    new = next(one for one in results() if one != old)
    after = parts(new)
    assert (points(after["while[0]/emit"]) == points(before["while[0]/emit"])).all()
    assert bits(new) != bits(old) and new["niwaki_seed"] == "11"
    assert old.hide_viewport and not new.hide_viewport and after["while[0]/emit"]["niwaki_held"]
    # What is freed may change again.
    activate(after["while[0]/emit"])
    bpy.ops.niwaki.hold()
    assert "niwaki_held" not in after["while[0]/emit"]


def test_a_loaded_search_is_done_again_with_the_same_bits(scene: bpy.types.Scene, tmp_path: Path) -> None:
    settings = scene.niwaki_settings
    settings.target = block("hull", (0, 0, 2), (3, 9, 3))
    settings.use_floor, settings.floor = True, 0.0
    bpy.ops.niwaki.grow(count=2)
    first = [bits(one) for one in results()]
    place = str(tmp_path / "ships.blend")
    bpy.ops.wm.save_as_mainfile(filepath=place)
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not results()
    bpy.ops.wm.open_mainfile(filepath=place)
    loaded = results()
    assert [bits(one) for one in loaded] == first
    # What it needs is in its search.
    bpy.data.objects.remove(bpy.data.objects["hull"])
    activate(next(iter(parts(loaded[0]).values())))
    assert bpy.ops.niwaki.again() == {"FINISHED"}
    again = [one for one in results() if one not in loaded]
    assert [bits(one) for one in again] == first


def test_opening_runs_nothing_and_a_file_is_run_where_it_is_agreed_to(
    scene: bpy.types.Scene, tmp_path: Path
) -> None:
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
    inside().naming.forget()
    bpy.ops.wm.open_mainfile(filepath=place)
    (result,) = results()
    first = bits(result)
    activate(parts(result)["tower"])
    for refused in (bpy.ops.niwaki.grow, bpy.ops.niwaki.again, bpy.ops.niwaki.reroll):
        with pytest.raises(RuntimeError, match="Trust"):
            refused()
    with pytest.raises(RuntimeError, match="SHA-256"):
        bpy.ops.niwaki.trust(filepath=str(file), sha256="0" * 64)
    assert not mark.exists() and len(results()) == 1
    run = bpy.data.collections["tower 1"]
    named, sha256 = run["niwaki_file"], run["niwaki_file_sha256"]
    assert bpy.ops.niwaki.trust(filepath=named, sha256=sha256) == {"FINISHED"}
    assert bpy.ops.niwaki.again() == {"FINISHED"}
    (again,) = [one for one in results() if one != result]
    assert bits(again) == first


def test_a_search_is_cancelled(scene: bpy.types.Scene) -> None:
    growing, settings = inside().growing, scene.niwaki_settings
    settings.model, settings.effort = "gnarly-tree", 64.0
    one = growing.Growing(settings.order(bpy.context).job())
    while not one.has_ended and (one.progress is None or one.progress.best is None):
        one.wait(0.05)
    one.stop()
    one.wait(20)
    assert one.grown is not None and one.grown.interrupted, one.problem
    placing, before = inside().placing, len(bpy.data.objects)
    for _ in range(2):
        placing.show_best(bpy.context, one.best, (1, 2, 3))
    preview = bpy.data.objects[placing.BEST]
    bpy.context.view_layer.update()
    assert points(preview)[:, 2].min() > 2 and len(bpy.data.objects) == before + 1
    placing.hide_best()
    assert len(bpy.data.objects) == before
    placing.place(bpy.context, one.grown, "tree")
    one.clear()
    assert len(parts(results()[0])) > 3


@pytest.mark.parametrize("key", ["TIMER", "ESC"])
def test_a_button_looks_now_and_then_and_esc_ends_it(scene: bpy.types.Scene, key: str) -> None:
    # What Blender would call, without the window that it needs for it.
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

    class Button(extension.operators._Grows):
        reports: list[str] = []

        def begin(self, context: Any) -> Any:
            order = scene.niwaki_settings.order(bpy.context)
            return extension.growing.Growing(order.job())

        def place(self) -> tuple[float, ...]:
            return (0.0, 0.0, 0.0)

        def end(self, context: Any, grown: Any) -> None:
            extension.placing.place(context, grown, "tree")

        def report(self, kind: set[str], text: str) -> None:
            self.reports.append(text)

    scene.niwaki_settings.model = "gnarly-tree"
    scene.niwaki_settings.effort = 64.0 if key == "ESC" else 0.5
    button = Button()
    assert button.invoke(context, None) == {"RUNNING_MODAL"}
    assert not bpy.ops.niwaki.grow.poll() and extension.operators.running() is button._growing
    assert button.modal(context, SimpleNamespace(type="MOUSEMOVE")) == {"PASS_THROUGH"}
    shown = False
    while (found := button.modal(context, SimpleNamespace(type="TIMER"))) == {"PASS_THROUGH"}:
        shown = shown or extension.placing.BEST in bpy.data.objects
        if key == "ESC" and shown:
            assert button.modal(context, SimpleNamespace(type="ESC")) == {"RUNNING_MODAL"}
        button._growing.wait(0.05)
    assert found == {"FINISHED"} and shown and stopped == ["timer"]
    assert extension.placing.BEST not in bpy.data.objects and len(results()) == 1
    assert extension.operators.running() is None and bpy.ops.niwaki.grow.poll()
    assert button.reports == (["Cancelled: the best until then"] if key == "ESC" else [])
    # Blender loads another file.
    assert button.invoke(context, None) == {"RUNNING_MODAL"}
    folder = button._growing._folder
    button.cancel(context)
    button._growing.wait(20)
    assert extension.operators.running() is None and not folder.exists()


def test_messages_say_what_is_missing(scene: bpy.types.Scene) -> None:
    settings = scene.niwaki_settings
    for set_up, said in (
        (lambda: setattr(settings, "model", "spacesip"), "did you mean `spaceship`"),
        (lambda: setattr(settings, "arguments", "{"), "no JSON"),
    ):
        set_up()
        with pytest.raises(RuntimeError, match=said):
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
def test_a_camera_of_the_search_sees_what_blender_s_sees(
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
    seen_by = inside().reading.eye(camera, scene).camera()
    columns, rows = size[0] // 2, size[1] // 2
    view = match_image(np.eye(rows, columns, dtype=bool), seen_by).views[0]
    for x, y, z in ((0, 0, 0), (1, 0.5, 1), (-0.7, 1, 0.3)):
        mask = view.mask(Scene([("dot", [_engine.shape("box", (x, z, -y), (0.2, 0.2, 0.2), bevel=0.0)])]))
        expected = world_to_camera_view(scene, camera, Vector((x, y, z)))
        row, column = (float(one.mean()) + 0.5 for one in np.nonzero(mask))
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
    wanted = np.zeros((100, 100, 4), dtype=np.float32)
    wanted[:, :, 3] = 1.0
    # 1 wide, 2 high, on the ground: the lower row comes first.
    wanted[:40, 40:60, :3] = 1.0
    settings.silhouette = bpy.data.images.new("tall", 100, 100)
    settings.silhouette.pixels.foreach_set(wanted.ravel())
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
    # Seen along the light, 10 wide: 1.5 on both sides.
    wanted[:, :, :3] = 0.0
    wanted[42:58, 42:58, :3] = 1.0
    settings.shadow.pixels.foreach_set(wanted.ravel())
    bpy.context.view_layer.update()
    assert bpy.ops.niwaki.grow() == {"FINISHED"}
    (found,) = [one for one in results() if one != first]
    low, high = cloud(found).min(axis=0), cloud(found).max(axis=0)
    assert (high - low)[:2] == pytest.approx([1.6, 1.6], abs=0.2)


def test_the_panel_is_drawn(scene: bpy.types.Scene, tmp_path: Path) -> None:
    # By a layout that notes what is drawn; there is no window for a real one.
    extension = inside()
    from bl_ext.user_default.niwaki import panel

    class Layout(SimpleNamespace):
        drawn: list[str] = []

        def __getattr__(self, name: str) -> Any:
            def note(*words: Any, **settings: Any) -> Any:
                if name == "prop":
                    assert words[1] in words[0].bl_rna.properties
                self.drawn.append(" ".join([name, *map(str, words[-1:]), *map(str, settings.values())]))
                return Layout()

            return note

    def drawn() -> str:
        Layout.drawn.clear()
        fake = SimpleNamespace(layout=Layout())
        for name in ("_model", "_progress", "_result"):
            setattr(fake, name, getattr(panel.NIWAKI_PT_panel, name).__get__(fake))
        panel.NIWAKI_PT_panel.draw(fake, bpy.context)
        return "\n".join(Layout.drawn)

    assert "prop target" in drawn() and "operator niwaki.grow" in drawn() and "Trust" not in drawn()
    bpy.ops.niwaki.grow()
    activate(next(iter(parts(results()[0]).values())))
    bpy.ops.niwaki.hold()
    assert "label spaceship 1 #0" in drawn() and "1 parts are held" in drawn() and "niwaki.reroll" in drawn()
    scene.niwaki_settings.model_file = str(tmp_path / "none.py")
    assert "Trust none.py" in drawn() and "prop function" in drawn()
    extension.operators._running.append(SimpleNamespace(progress=None))
    assert "Starting" in drawn() and "operator niwaki.cancel" in drawn()
    extension.operators._running.clear()


def test_it_is_switched_off_and_on() -> None:
    import addon_utils

    name = "bl_ext.user_default.niwaki"
    addon_utils.disable(name)
    assert not hasattr(bpy.types.Scene, "niwaki_settings")
    addon_utils.enable(name)
    assert bpy.context.scene.niwaki_settings.model == "spaceship"


@pytest.mark.skipif(PICTURES is None, reason="pictures are made by `make blender-pictures`")
def test_the_manual_s_picture(scene: bpy.types.Scene) -> None:
    from PIL import Image

    settings = scene.niwaki_settings
    settings.effort, settings.seed = 1.0, 2
    bpy.ops.niwaki.grow(count=4)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    clouds = np.concatenate([cloud(one) for one in results()])
    low, high = clouds.min(axis=0), clouds.max(axis=0)
    bpy.ops.mesh.primitive_plane_add(size=400.0, location=((low + high)[0] / 2, (low + high)[1] / 2, low[2]))
    ground = bpy.data.materials.new("ground")
    ground.use_nodes = True
    ground.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.42, 0.42, 0.4, 1)
    bpy.context.object.data.materials.append(ground)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 4.0, 0.05, (0.9, 0.0, -0.5)
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.75, 0.8, 0.9, 1)
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.3
    camera.rotation_euler = (0.85, 0.0, 0.6)
    bpy.context.view_layer.update()
    flat = [value for point in clouds[::7] for value in point]
    camera.location, _ = camera.camera_fit_coords(bpy.context.evaluated_depsgraph_get(), flat)
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 16, True
    scene.render.resolution_x, scene.render.resolution_y = 880, 550
    scene.view_settings.view_transform = "AgX"
    place = Path(PICTURES) / "blender.png"
    scene.render.filepath = str(place)
    bpy.ops.render.render(write_still=True)
    with Image.open(place) as picture:
        small = picture.convert("RGB").resize((720, 450), Image.Resampling.LANCZOS)
    small = small.quantize(128, dither=Image.Dither.NONE)
    small.save(place, optimize=True)
    assert place.stat().st_size < 150_000
