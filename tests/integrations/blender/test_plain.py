"""Claim: what the extension for Blender asks is what stands in Blender; a stored search gives the same bits, or keeps
what is held; a file of models is run only where a person has named it. (`inside_blender.py` has the rest.)"""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki.search import Search
from niwaki.search.entry import grow_search
from niwaki_blender import asking, axes, grid, growing, naming

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
BLOCK = asking.Mesh("block", CORNERS, FACES)

#: Leaves a mark when it is run; its host function keeps the model in its file.
MODEL = Path(__file__).with_name("marked_tower.txt").read_text()


@pytest.fixture(autouse=True)
def nothing_is_named() -> None:
    naming.forget()


def grown(job: object, words: tuple[str, ...] = ()) -> growing.Growing:
    one = growing.Growing(job, words)
    one.wait(60)
    return one


def ship(**settings: object) -> growing.Growing:
    order = asking.Order("spaceship", {"target": BLOCK.target()}, effort=0.2, **settings)
    one = grown(order.job())
    assert one.grown is not None, one.problem
    return one


def test_axes_turn_up_and_back() -> None:
    points = np.random.default_rng(1).normal(size=(50, 3))
    assert (axes.to_blender(axes.to_scene(points)) == points).all()
    assert axes.to_scene((0.0, 0.0, 1.0)).tolist() == [0, 1, 0]
    # A rotation: handedness stays, so that faces are not turned over.
    assert np.linalg.det(axes.to_scene(np.eye(3))) == pytest.approx(1.0)
    assert BLOCK.target().volume == pytest.approx(32.0)
    assert BLOCK.target().bounds.tolist() == [[-1, 0, -4], [1, 2, 4]]


def test_a_grid_has_room_for_each_result() -> None:
    sizes = [(2.0, 5.0), (4.0, 1.0), (3.0, 3.0), (1.0, 1.0), (2.0, 2.0)]
    found = grid.places(sizes)
    assert found[0] == (0.0, 0.0) and len(set(found)) == 5
    for a, (x, y) in enumerate(found):
        for b, (u, v) in enumerate(found[:a]):
            apart = (
                abs(x - u) >= (sizes[a][0] + sizes[b][0]) / 2,
                abs(y - v) >= (sizes[a][1] + sizes[b][1]) / 2,
            )
            assert any(apart)
    assert grid.places([]) == []


def test_an_order_is_the_search_that_python_makes() -> None:
    wall = asking.Mesh("wall", CORNERS + (0.0, 0.0, 5.0), FACES)
    one = grown(
        asking.Order(
            "spaceship",
            {"target": BLOCK.target(), "avoid": [wall.target()], "floor": -3.0},
            effort=0.2,
            seed=4,
        ).job()
    )
    assert one.grown is not None, one.problem
    found = Search.of_data(json.loads(one.grown.run)["search"])
    score = nw.floor(-3.0) * nw.avoid(wall.target())
    model = nw.gallery.entry("spaceship").model
    expected = grow_search(model, BLOCK.target(), score=score, rounds=3, seed=4)
    assert found == expected
    result = expected.run().best
    assert result.log_score == one.grown.outcomes[0].log_score
    assert (
        one.grown.files[0].read_bytes() == result.export(one.grown.files[0].with_name("own.glb")).read_bytes()
    )
    one.clear()
    assert not one.grown.files[0].exists()


def test_a_floor_alone_is_asked_beside_what_is_usual_for_the_model(tmp_path: Path) -> None:
    one = grown(asking.Order("spaceship", {"floor": -3.0}, effort=0.1).job())
    assert one.grown is not None, one.problem
    found = Search.of_data(json.loads(one.grown.run)["search"])
    assert [ask.function for ask in found.score.asks] == ["no_self_intersection", "floor", "match_volume"]
    # A file says nothing of what is usual.
    file = tmp_path / "towers.py"
    file.write_text(MODEL.format(mark=str(tmp_path / "mark")))
    naming.name(file)
    assert grown(asking.Order(str(file), {"floor": -3.0}).job(), naming.words()).code == "no-target"


def test_a_shadow_is_cast_along_blender_s_light() -> None:
    asked = {
        "match_shadow": np.eye(8, dtype=bool),
        "light": asking.direction((0.25, 0.5, -1.0)),
        "receiver": BLOCK.receiver((0.0, 0.0, 9.0)),
    }
    one = grown(asking.Order("spaceship", asked, effort=0.1).job())
    assert one.grown is not None, one.problem
    (view,) = Search.of_data(json.loads(one.grown.run)["search"]).score.views
    assert view.kind == "shadow" and view.light == (0.25, -1.0, -0.5)
    assert view.receiver.bounds.tolist() == [[-1, -9, -4], [1, -7, 4]]


def test_a_stored_search_gives_the_same_bits() -> None:
    one = ship(seed=5, count=2)
    again = grown(growing.Again(one.grown.run))
    assert again.grown is not None, again.problem
    first, second = ([file.read_bytes() for file in x.grown.files] for x in (one, again))
    assert len(first) == 2 and first[0] != first[1] and first == second
    assert growing.results(again.grown.run)[1]["choices"] == growing.results(one.grown.run)[1]["choices"]


def test_a_reroll_keeps_what_is_held() -> None:
    one = ship(seed=5)
    again = grown(growing.Again(one.grown.run, 0, 6, 1, ["while[0]/emit"]))
    assert again.grown is not None, again.problem
    before, after = (
        {choice["address"]: choice["value"] for choice in growing.results(x.grown.run)[0]["choices"]}
        for x in (one, again)
    )
    lock = json.loads(again.grown.run)["search"]["lock"]["dict"]
    assert lock and all(before[address] == after[address] for address, _ in lock)
    assert before != after
    free = grown(growing.Again(again.grown.run, 0, 7, 1, []))
    assert json.loads(free.grown.run)["search"]["lock"] is None


def test_a_cancelled_search_keeps_the_best_until_then() -> None:
    one = growing.Growing(asking.Order("gnarly-tree", effort=64.0).job())
    while not one.has_ended and (one.progress is None or one.progress.best is None):
        one.wait(0.05)
    one.stop()
    one.wait(20)
    assert one.has_ended and one.grown is not None, one.problem
    assert one.grown.interrupted and len(one.grown.files) == 1
    # The tree stands upright in Blender, and the preview is a mesh of it.
    low, high = one.best.vertices.min(axis=0), one.best.vertices.max(axis=0)
    assert low[2] > -1 and (high - low).argmax() == 2 and one.best.faces.max() == len(one.best.vertices) - 1
    one = growing.Growing(asking.Order("gnarly-tree", effort=64.0).job())
    one.stop()
    one.wait(20)
    assert one.has_ended and (one.grown is None or one.grown.interrupted)


def test_a_file_is_run_only_where_a_person_named_it(tmp_path: Path) -> None:
    file, mark = tmp_path / "towers.py", tmp_path / "mark"
    file.write_text(MODEL.format(mark=str(mark)))
    order = asking.Order(str(file), {"target": BLOCK.target()}, effort=0.1)
    with pytest.raises(naming.Unnamed):
        naming.check(file)
    refused = grown(order.job(), naming.words())
    assert refused.code == "unnamed-file" and not mark.exists()
    with pytest.raises(naming.Unnamed, match="SHA-256"):
        naming.trust(file, "0" * 64)
    with pytest.raises(naming.Unnamed, match="cannot be read"):
        naming.trust(tmp_path / "none.py", naming.digest(tmp_path / "none.py"))
    naming.name(file)
    one = grown(order.job(), naming.words())
    assert one.grown is not None, one.problem
    path, sha256 = growing.model_file(one.grown.run)
    assert path == file and sha256 == naming.digest(file)
    mark.unlink()
    naming.forget()
    refused = grown(growing.Again(one.grown.run), naming.words())
    assert refused.code == "untrusted-file" and not mark.exists()
    naming.trust(path, sha256)
    again = grown(growing.Again(one.grown.run), naming.words())
    assert again.grown is not None and again.grown.files[0].read_bytes() == one.grown.files[0].read_bytes()


def test_what_is_missing_is_said() -> None:
    with pytest.raises(ValueError, match="no camera"):
        asking.Order("spaceship", {"match_image": np.ones((4, 4), dtype=bool)}).job()
    with pytest.raises(ValueError, match="a light"):
        asking.Order("spaceship", {"match_shadow": np.ones((4, 4), dtype=bool)}).job()
    flat = asking.Mesh("flat", CORNERS * (1, 1, 0), FACES)
    with pytest.raises(nw.errors.NiwakiError, match="flat"):
        flat.target()
    assert grown(asking.Order("spacesip").job()).problem.count("spaceship")


def test_cameras_look_where_blender_s_look() -> None:
    seen = asking.Eye((0.0, -10.0, 2.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), fov=40.0).camera()
    assert seen.position == (0, 2, 10) and seen.look_at == (0, 2, 9) and seen.up == (0, 1, 0)
    above = asking.Eye((0.0, 0.0, 9.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0), height=6.0).camera()
    assert above.kind == "orthographic" and above.up == (0, 0, -1) and above.height == 6.0


def test_the_build_s_manifest_is_of_one_python_and_one_platform() -> None:
    build = pytest.importorskip("build_extension")
    text = build.manifest("1.2.3", "3.11", "linux-x64", ["a.whl"])
    found = tomllib.loads(text)
    assert found["version"] == "1.2.3" and found["platforms"] == ["linux-x64"]
    assert (found["blender_version_min"], found["blender_version_max"]) == ("4.2.0", "5.1.0")
    assert found["wheels"] == ["./wheels/a.whl"] and set(found["permissions"]) == {"files"}
    assert len(found["tagline"]) <= 64 and found["tagline"][-1].isalnum()
    later = tomllib.loads(build.manifest("1.2.3", "3.13", "windows-x64", []))
    assert later["blender_version_min"] == "5.1.0" and "blender_version_max" not in later
    needed = build.requirements(build.LOCK.read_text())
    assert needed.count("==") == len(build.NEEDED) and "--hash=sha256:" in needed
