"""Claim: orders of the Blender extension equal the scene in Blender; a stored search gives the same bits or keeps held
parts; a file of models runs only after a person has named it. (`inside_blender.py` has the other tests.)"""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki.fitting.in_blender import sockets
from niwaki.search import Search
from niwaki.search.entry import grow_search
from niwaki_blender import axes, fitting, grid, growth, order, permissions

CORNERS = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-4.0, 4.0) for z in (0.0, 2.0)])
FACES = np.array(
    [
        [0, 1, 3],
        [0, 3, 2],
        [4, 6, 7],
        [4, 7, 5],
        [0, 4, 5],
        [0, 5, 1],
        [2, 3, 7],
        [2, 7, 6],
        [0, 2, 6],
        [0, 6, 4],
        [1, 5, 7],
        [1, 7, 3],
    ]
)
BLOCK = order.Mesh("block", CORNERS, FACES)

#: A model file that leaves a mark when it is run; its host function keeps the model in its file.
MODEL = Path(__file__).with_name("marked_tower.txt").read_text()


@pytest.fixture(autouse=True)
def no_permissions() -> None:
    permissions.forget()


def grow(job: object, words: tuple[str, ...] = ()) -> growth.Growth:
    search = growth.Growth(job, words)
    search.wait(60)
    return search


def ship(**settings: object) -> growth.Growth:
    ship_order = order.Order("spaceship", {"target": BLOCK.target()}, effort=0.2, **settings)
    search = grow(ship_order.job())
    assert search.outcome is not None, search.problem
    return search


def test_axes_turn_up_and_back() -> None:
    points = np.random.default_rng(1).normal(size=(50, 3))
    assert (axes.to_blender(axes.to_scene(points)) == points).all()
    assert axes.to_scene((0.0, 0.0, 1.0)).tolist() == [0, 1, 0]
    # A rotation keeps the handedness, so that faces are not reversed.
    assert np.linalg.det(axes.to_scene(np.eye(3))) == pytest.approx(1.0)
    assert BLOCK.target().volume == pytest.approx(32.0)
    assert BLOCK.target().bounds.tolist() == [[-1, 0, -4], [1, 2, 4]]


def test_a_grid_has_room_for_each_result() -> None:
    sizes = [(2.0, 5.0), (4.0, 1.0), (3.0, 3.0), (1.0, 1.0), (2.0, 2.0)]
    places = grid.places(sizes)
    assert places[0] == (0.0, 0.0) and len(set(places)) == 5
    for a, (x, y) in enumerate(places):
        for b, (u, v) in enumerate(places[:a]):
            apart = (
                abs(x - u) >= (sizes[a][0] + sizes[b][0]) / 2,
                abs(y - v) >= (sizes[a][1] + sizes[b][1]) / 2,
            )
            assert any(apart)
    assert grid.places([]) == []


def test_an_order_equals_the_search_from_python() -> None:
    wall = order.Mesh("wall", CORNERS + (0.0, 0.0, 5.0), FACES)
    search = grow(
        order.Order(
            "spaceship",
            {"target": BLOCK.target(), "avoid": [wall.target()], "floor": -3.0},
            effort=0.2,
            seed=4,
        ).job()
    )
    assert search.outcome is not None, search.problem
    stored = Search.of_data(json.loads(search.outcome.run)["search"])
    score = nw.floor(-3.0) * nw.avoid(wall.target())
    model = nw.gallery.entry("spaceship").model
    expected = grow_search(model, BLOCK.target(), score=score, rounds=3, seed=4)
    assert stored == expected
    result = expected.run().best
    assert result.log_score == search.outcome.outcomes[0].log_score
    assert (
        search.outcome.files[0].read_bytes()
        == result.export(search.outcome.files[0].with_name("own.glb")).read_bytes()
    )
    search.clear()
    assert not search.outcome.files[0].exists()


def test_a_floor_alone_adds_to_the_usual_goals_of_the_model(tmp_path: Path) -> None:
    search = grow(order.Order("spaceship", {"floor": -3.0}, effort=0.1).job())
    assert search.outcome is not None, search.problem
    stored = Search.of_data(json.loads(search.outcome.run)["search"])
    assert [ask.function for ask in stored.score.asks] == ["no_self_intersection", "floor", "match_volume"]
    # A model of a file has no usual goals.
    file = tmp_path / "towers.py"
    file.write_text(MODEL.format(mark=str(tmp_path / "mark")))
    permissions.name(file)
    assert grow(order.Order(str(file), {"floor": -3.0}).job(), permissions.words()).code == "no-target"


def test_a_shadow_is_cast_along_blender_s_light() -> None:
    goals = {
        "match_shadow": np.eye(8, dtype=bool),
        "light": order.direction((0.25, 0.5, -1.0)),
        "receiver": BLOCK.receiver((0.0, 0.0, 9.0)),
    }
    search = grow(order.Order("spaceship", goals, effort=0.1).job())
    assert search.outcome is not None, search.problem
    (view,) = Search.of_data(json.loads(search.outcome.run)["search"]).score.views
    assert view.kind == "shadow" and view.light == (0.25, -1.0, -0.5)
    assert view.receiver.bounds.tolist() == [[-1, -9, -4], [1, -7, 4]]


def test_a_stored_search_gives_the_same_bits() -> None:
    first_search = ship(seed=5, count=2)
    again = grow(growth.Repetition(first_search.outcome.run))
    assert again.outcome is not None, again.problem
    first, second = ([file.read_bytes() for file in x.outcome.files] for x in (first_search, again))
    assert len(first) == 2 and first[0] != first[1] and first == second
    assert (
        growth.results(again.outcome.run)[1]["choices"]
        == growth.results(first_search.outcome.run)[1]["choices"]
    )


def test_a_reroll_keeps_held_parts() -> None:
    first_search = ship(seed=5)
    again = grow(growth.Repetition(first_search.outcome.run, 0, 6, 1, ["while[0]/emit"]))
    assert again.outcome is not None, again.problem
    before, after = (
        {choice["address"]: choice["value"] for choice in growth.results(x.outcome.run)[0]["choices"]}
        for x in (first_search, again)
    )
    lock = json.loads(again.outcome.run)["search"]["lock"]["dict"]
    assert lock and all(before[address] == after[address] for address, _ in lock)
    assert before != after
    free = grow(growth.Repetition(again.outcome.run, 0, 7, 1, []))
    assert json.loads(free.outcome.run)["search"]["lock"] is None


def test_a_cancelled_search_keeps_the_best_result_so_far() -> None:
    search = growth.Growth(order.Order("gnarly-tree", effort=64.0).job())
    while not search.has_ended and (search.progress is None or search.progress.best is None):
        search.wait(0.05)
    search.stop()
    search.wait(20)
    assert search.has_ended and search.outcome is not None, search.problem
    assert search.outcome.interrupted and len(search.outcome.files) == 1
    # The tree stands upright in Blender, and the preview is its mesh.
    low, high = search.best.vertices.min(axis=0), search.best.vertices.max(axis=0)
    assert (
        low[2] > -1
        and (high - low).argmax() == 2
        and search.best.faces.max() == len(search.best.vertices) - 1
    )
    search = growth.Growth(order.Order("gnarly-tree", effort=64.0).job())
    search.stop()
    search.wait(20)
    assert search.has_ended and (search.outcome is None or search.outcome.interrupted)


def test_a_file_is_run_only_where_a_person_named_it(tmp_path: Path) -> None:
    file, mark = tmp_path / "towers.py", tmp_path / "mark"
    file.write_text(MODEL.format(mark=str(mark)))
    tower_order = order.Order(str(file), {"target": BLOCK.target()}, effort=0.1)
    with pytest.raises(permissions.UntrustedFileError):
        permissions.check(file)
    blocked = grow(tower_order.job(), permissions.words())
    assert blocked.code == "unnamed-file" and not mark.exists()
    with pytest.raises(permissions.UntrustedFileError, match="SHA-256"):
        permissions.trust(file, "0" * 64)
    with pytest.raises(permissions.UntrustedFileError, match="cannot be read"):
        permissions.trust(tmp_path / "none.py", permissions.digest(tmp_path / "none.py"))
    permissions.name(file)
    search = grow(tower_order.job(), permissions.words())
    assert search.outcome is not None, search.problem
    path, sha256 = growth.model_file(search.outcome.run)
    assert path == file and sha256 == permissions.digest(file)
    mark.unlink()
    permissions.forget()
    blocked = grow(growth.Repetition(search.outcome.run), permissions.words())
    assert blocked.code == "untrusted-file" and not mark.exists()
    permissions.trust(path, sha256)
    again = grow(growth.Repetition(search.outcome.run), permissions.words())
    assert (
        again.outcome is not None
        and again.outcome.files[0].read_bytes() == search.outcome.files[0].read_bytes()
    )


def test_missing_settings_give_a_message() -> None:
    with pytest.raises(ValueError, match="no camera"):
        order.Order("spaceship", {"match_image": np.ones((4, 4), dtype=bool)}).job()
    with pytest.raises(ValueError, match="a light"):
        order.Order("spaceship", {"match_shadow": np.ones((4, 4), dtype=bool)}).job()
    flat = order.Mesh("flat", CORNERS * (1, 1, 0), FACES)
    with pytest.raises(nw.errors.NiwakiError, match="flat"):
        flat.target()
    assert grow(order.Order("spacesip").job()).problem.count("spaceship")


def test_cameras_have_the_views_of_blender_s_cameras() -> None:
    level = order.Eye((0.0, -10.0, 2.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), fov=40.0).camera()
    assert level.position == (0, 2, 10) and level.look_at == (0, 2, 9) and level.up == (0, 1, 0)
    above = order.Eye((0.0, 0.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), height=6.0).camera()
    assert above.kind == "orthographic" and above.up == (0, 0, -1) and above.height == 6.0


def test_a_manifest_is_for_one_python_and_one_platform() -> None:
    build = pytest.importorskip("build_extension")
    text = build.manifest("1.2.3", "3.11", "linux-x64", ["a.whl"])
    manifest = tomllib.loads(text)
    assert manifest["version"] == "1.2.3" and manifest["platforms"] == ["linux-x64"]
    assert (manifest["blender_version_min"], manifest["blender_version_max"]) == ("4.2.0", "5.1.0")
    assert manifest["wheels"] == ["./wheels/a.whl"] and set(manifest["permissions"]) == {"files"}
    assert len(manifest["tagline"]) <= 64 and manifest["tagline"][-1].isalnum()
    later = tomllib.loads(build.manifest("1.2.3", "3.13", "windows-x64", []))
    assert later["blender_version_min"] == "5.1.0" and "blender_version_max" not in later
    needed = build.requirements(build.LOCK.read_text())
    assert needed.count("==") == len(build.NEEDED) and "--hash=sha256:" in needed


def box_row(name: str, kind: str = "real", value: object = 1.0, **settings: object) -> sockets.Socket:
    """A socket with limits 0.5 and 3."""
    usual = {"low": 0.5, "high": 3.0, "subtype": "", "entries": [], "is_used": True, "rules": []}
    return sockets.Socket(name, name.lower(), None, kind, value, **{**usual, **settings})


ROWS = [
    box_row("Width"),
    box_row("Height", rules=[{"tall": [True]}]),
    box_row("Tall", "switch", False),
    box_row("Unused", is_used=False),
]


def box(values: fitting.Values) -> tuple[np.ndarray, np.ndarray]:
    """A block as deep as it is, in Blender's world, by the keys of its sockets."""
    height = values["height"] if values["tall"] else 0.5
    return (CORNERS * (0.5, 0.125, 0.5) + (0.5, 0.5, 0.0)) * (values["width"], 1.0, height), FACES


def test_a_modifier_is_fitted_point_by_point() -> None:
    target = order.Mesh("target", *box({"width": 2.0, "height": 1.6, "tall": True}))
    fit = fitting.Fitting(ROWS, [], {"target": target.target()}, box, evaluations=60)
    assert fit.loop.space.names == ["Width", "Tall", "Height"]
    fit.work(0.0)
    assert fit.done == 1 and not fit.has_ended and fit.progress().startswith("1 of 60")
    while not fit.has_ended:
        fit.work(0.01)
    best, *rest = fit.answers(5)
    assert best.values["tall"] is True and best.values["height"] == pytest.approx(1.6, abs=0.05)
    assert best.covered > 0.98 and best.named["Width"] == pytest.approx(2.0, abs=0.05) and rest
    assert not fit.interrupted and not fit.problem
    # z is up in Blender, and the best mesh is shown there.
    assert fit.best.vertices.max(axis=0) == pytest.approx([2.0, 1.0, 1.6], abs=0.1)
    held = fitting.Fitting(ROWS, ["tall"], {"target": target.target()}, box, evaluations=1)
    assert held.loop.space.names == ["Width"]


def test_a_fit_ends_with_its_reason() -> None:
    goals = {"target": BLOCK.target()}

    def pointless(values: fitting.Values) -> None:
        raise ValueError("the modifier gives points")

    def removed(values: fitting.Values) -> None:
        raise fitting.RemovedError("Chair was removed")

    fit = fitting.Fitting(ROWS, [], goals, pointless)
    fit.work(60.0)
    assert fit.has_ended and fit.done == 20 and "failed: the modifier gives points" in fit.problem
    fit = fitting.Fitting(ROWS, [], goals, removed)
    fit.work(60.0)
    assert fit.problem == "Chair was removed" and fit.answers(3) == []
    fit = fitting.Fitting(ROWS, [], goals, box)
    fit.stop()
    fit.work(60.0)
    assert fit.interrupted and fit.done == 0
    with pytest.raises(ValueError, match="Choose a target mesh"):
        fitting.goal_of({"floor": 0.0})
    with pytest.raises(sockets.NodeTreeError, match="all sockets are held"):
        fitting.Fitting(ROWS, ["width", "height", "tall"], goals, box)
    with pytest.raises(sockets.NodeTreeError, match="depends on none"):
        fitting.Fitting(ROWS[3:], [], goals, box)
