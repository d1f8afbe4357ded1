"""Claim: the controls score as plain Python arithmetic does, they multiply, and bad input gives an error."""

from __future__ import annotations

import re
from collections.abc import Callable
from math import log, pi
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import _engine
from niwaki.targets.sketches import SKETCHES, Score
from niwaki.targets.target import TargetWarning

GOLDEN = Path(__file__).parents[2] / "golden"

CAMERA = nw.Camera.orthographic((0, 0, 20), (0, 0, 0), height=10)
ON = np.zeros((100, 100), dtype=bool)
ON[30:60, 20:80] = True


def shape(center: tuple[float, float, float], size: tuple[float, float, float]) -> Any:
    return _engine.shape("box", center, size)


def cube(at: tuple[float, float, float] = (0, 0, 0), size: float = 2.0) -> nw.Target:
    box = shape(at, (size, size, size))
    return nw.Target(box.vertices(), box.faces(), "cube")


def log_normal(x: float, mean: float, sd: float) -> float:
    return -0.5 * log(2 * pi) - log(sd) - (x - mean) ** 2 / (2 * sd**2)


def started(score: Score) -> Any:
    return _engine.Sketch(score.specs)


def test_an_image_is_scored_by_the_weight_of_equal_pixels() -> None:
    weight = np.zeros((100, 100), dtype=np.uint8)
    weight[25:35] = np.arange(100)
    score = nw.match_image(ON, CAMERA, weight_image=weight, weight=7.0, sigma=0.05)
    sketch = started(score)
    weights = 1 + 7.0 * weight / 255
    assert sketch.similarity() == pytest.approx(1 - (weights * ON).sum() / weights.sum())
    # A box from row 20 to 50 and column 40 to 90; a unit is ten pixels.
    sketch.add([shape((1.5, 1.5, 0), (5, 3, 1))])
    mask = np.zeros_like(ON)
    mask[20:50, 40:90] = True
    similarity = (weights * (mask == ON)).sum() / weights.sum()
    assert sketch.similarity() == pytest.approx(similarity)
    assert sketch.log_score() == pytest.approx(log_normal(similarity, 1, 0.05))
    assert (score.views[0].picture.mask([shape((1.5, 1.5, 0), (5, 3, 1))]) == mask).all()


def test_a_shadow_in_the_lights_own_view_is_a_plan() -> None:
    floor = nw.Receiver.floor(0, (-5, -5), (5, 5))
    score = nw.match_shadow(ON, (0, -2, 0), floor)
    assert score.views[0].camera.height == 10
    shapes = [shape((0, 3, -0.5), (6, 1, 3)), shape((0, -3, 0), (9, 1, 9))]
    assert (score.views[0].picture.mask(shapes) == ON).all()
    assert score.views[0].picture.seen().all()
    sketch = started(score)
    sketch.add(shapes)
    assert sketch.similarity() == 1
    assert sketch.log_score() == pytest.approx(log_normal(1, 1, 0.02))


def test_a_slanted_light_throws_the_shadow_aside() -> None:
    floor = nw.Receiver.floor(0, (-10, -10), (10, 10))
    above = nw.Camera.orthographic((0, 30, 0), (0, 0, 0), (0, 0, -1), height=20)
    view = nw.match_shadow(ON, (-1, -0.5, 0), floor, above).views[0]
    # A cube one unit wide whose middle is 2 above the floor: twice its height to the left.
    rows, columns = np.nonzero(view.picture.mask([shape((4, 2, 0.1), (1, 1, 0.98))]))
    low, high = (columns.min() / 5 - 10, (columns.max() + 1) / 5 - 10)
    assert (low, high) == (pytest.approx(-1.5, abs=0.21), pytest.approx(1.5, abs=0.21))
    assert rows.max() - rows.min() + 1 == 5


def test_two_views_are_distinct_in_the_measures() -> None:
    side = nw.Camera.orthographic((20, 0, 0), (0, 0, 0), height=10)
    score = nw.match_volume(cube()) * nw.match_image(ON, CAMERA) * nw.match_image(ON, side)
    assert [name for name in started(score).measures() if name.startswith("similarity")] == [
        "similarity",
        "similarity_2",
        "similarity_3",
    ]
    assert repr(score) == "match_volume * match_image * match_image"
    assert len(score.views) == 2 and score.target is not None


def test_limits() -> None:
    score = nw.floor(0) * nw.avoid(cube(), voxel=0.1) * nw.overshoot(((-3, -3, -3), (3, 3, 3)))
    sketch = started(score)
    assert sketch.log_score() == pytest.approx(log_normal(0, 0, 0.02))
    assert sketch.add([shape((0, 2.5, 0), (1, 1, 1))]) is None
    assert sketch.add([shape((0, 1, 0), (1, 1, 1))]) == "avoid"
    assert sketch.add([shape((2.5, 0, 0), (1, 1.1, 1))]) == "floor"
    assert nw.overshoot(cube(size=6.0)).specs[0].name == "overshoot"


def test_balanced_counts_the_cells_of_both_over_those_of_either() -> None:
    """The similarity and the log score are those of the masks, also of an empty scene; files keep the weight."""
    score = nw.match_volume(cube(), 0.25, 0.03, weight="balanced")
    sketch = started(score)
    grid, part = score.asks[0].grid, shape((0.9, 0, 0), (2, 1, 1))
    assert grid is not None
    peak = log_normal(1, 1, 0.15) + log_normal(0, 0, 0.03)
    assert sketch.similarity() == 0.0
    assert sketch.log_score() == pytest.approx(peak - 0.5 * (1 / 0.15) ** 2)
    sketch.add([part])
    want, filled = grid.cells(), grid.mask([part])
    index = (want & filled).sum() / (want | filled).sum()
    outside = sketch.measures()["overshoot"]
    assert 0.1 < index < 0.9 and outside > 0.0
    assert sketch.similarity() == index
    assert sketch.log_score() == pytest.approx(
        peak - 0.5 * ((1 - index) / 0.15) ** 2 - 0.5 * (outside / 0.03) ** 2
    )
    assert score.data(str)[0]["given"]["weight"] == "balanced"
    assert "weight" not in nw.match_volume(cube(), weight="cells").asks[0].arguments
    again = SKETCHES["match_volume"](**score.asks[0].arguments)
    assert started(again).log_score() == started(score).log_score()
    with pytest.raises(nw.InputError, match=r'"cells" or "balanced"'):
        nw.match_volume(cube(), weight="surface")


def test_the_engine_names_a_sketch_as_the_function_that_makes_it() -> None:
    greys, plane = np.where(ON, 0, 255).astype(np.uint8), ((0, 0), (1, 1))
    scores = [
        nw.no_self_intersection(),
        nw.match_drawing(greys, plane),
        nw.fill_drawing(plane),
        nw.floor(),
        nw.avoid(cube()),
        nw.match_image(ON, CAMERA),
        nw.match_shadow(ON, (0, -1, 0), nw.Receiver.floor()),
        nw.overshoot(cube()),
        nw.limits((0.0, 1.0)),
        nw.match_volume(cube()),
    ]
    sketches = [sketch for score in scores for sketch in score.asks]
    assert [(sketch.function, sketch.spec.name) for sketch in sketches] == [(name, name) for name in SKETCHES]


@nw.model
def tower() -> None:
    nw.emit(nw.box((0, 0.5, 0), (1, 1, 1)))
    nw.emit(nw.box((0, nw.uniform(1.5, 9.0), 0), (1, 1, 1)))


def test_an_obstacle_above_is_kept_clear() -> None:
    score = nw.floor() * nw.avoid(cube((0, 4, 0)), voxel=0.1)
    result = nw.run(tower, score=score, method=nw.smc(particles=50), seed=1)
    for sample in result:
        low, high = sample.scene.parts[1].shapes[0].aabb()
        assert high[1] < 3 or low[1] > 5


def test_each_of_two_obstacles_is_kept_in_the_record() -> None:
    near, far = cube((0, 1, 0)), cube((0, 7, 0))
    score = nw.avoid(near, voxel=0.1) * nw.avoid(far, voxel=0.2)
    records = [record["given"] for record in score.data(lambda value: value)]
    obstacles = [(record["obstacle"].vertices[:, 1].min(), record["voxel"]) for record in records]
    assert obstacles == [(near.vertices[:, 1].min(), 0.1), (far.vertices[:, 1].min(), 0.2)]


def warned(make: Callable[[], Any]) -> str:
    with pytest.warns(TargetWarning) as caught:
        make()
    return f"{caught[0].category.__name__}: {caught[0].message}"


def refused(make: Callable[[], Any]) -> str:
    with pytest.raises(nw.NiwakiError) as error:
        make()
    return str(error.value)


def test_messages(golden: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    floor = nw.Receiver.floor(0, (-5, -5), (5, 5))
    away = nw.Camera.perspective((0, 5, 20), (0, 5, 40))
    flat = nw.Receiver.floor()
    covered = nw.avoid(cube((0, 0.5, 0)), voxel=0.2)
    lines = tmp_path / "far.obj"
    lines.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    messages = [
        refused(lambda: nw.match_image(np.zeros((50, 40)), CAMERA)),
        refused(lambda: nw.match_image(np.ones((50, 40)), CAMERA)),
        refused(lambda: nw.match_image(np.zeros(7), CAMERA)),
        refused(lambda: nw.match_image(ON, CAMERA, weight_image=np.zeros((200, 200)))),
        refused(lambda: nw.match_image(ON, CAMERA, weight=-1)),
        refused(lambda: nw.match_image(ON, CAMERA, sigma=0)),
        refused(lambda: nw.match_volume(cube()) * nw.match_image(ON, away)),
        refused(lambda: nw.match_image(ON, {"position": [0, 0, 1], "look_at": [0, 0, 1]})),
        refused(lambda: nw.match_shadow(ON, (0, -1, 0), floor, away)),
        refused(
            lambda: nw.match_shadow(
                ON, (0, -1, 0), floor, nw.Camera.perspective((90, 5, 0), (90, 0, 0), (0, 0, 1))
            )
        ),
        refused(
            lambda: nw.match_shadow(
                ON, (-1, 0, 0), floor, nw.Camera.perspective((0, 5, 0), (0, 0, 0), (0, 0, 1))
            )
        ),
        refused(lambda: nw.match_shadow(ON, (-1, 0, 0), floor)),
        refused(lambda: nw.match_shadow(ON, (0, 0, 0), flat)),
        refused(lambda: nw.match_shadow(ON, (0, float("nan"), 0), flat)),
        refused(lambda: nw.floor(float("inf"))),
        refused(lambda: nw.avoid(cube(), voxel=-1)),
        refused(lambda: nw.avoid(3)),  # type: ignore[arg-type]
        refused(lambda: nw.match_volume(None)),  # type: ignore[arg-type]
        refused(lambda: nw.overshoot(((0, 0, 0), (1, 0, 1)))),
        refused(lambda: nw.overshoot(3)),  # type: ignore[arg-type]
        refused(lambda: nw.run(tower, score=covered, method=nw.smc(particles=20), seed=1)),
    ]
    whole = cube()
    messages.append(warned(lambda: nw.Target(whole.vertices, whole.faces[1:], "a cube with a hole")))
    monkeypatch.setattr("niwaki.targets.memory.free_memory", lambda: 1000)
    messages += [
        refused(lambda: nw.Target(np.eye(3), np.tile([0, 1, 2], (10_000_000, 1)), "a scan")),
        refused(lambda: nw.Receiver.load(lines)).replace(str(tmp_path), "targets"),
    ]
    golden(GOLDEN / "controls.txt", "\n\n".join(messages) + "\n")


def test_an_open_obstacle_is_warned_of(tmp_path: Path) -> None:
    whole = cube()
    path = tmp_path / "open.obj"
    text = "".join(f"v {x} {y} {z}\n" for x, y, z in whole.vertices)
    path.write_text(text + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in whole.faces[1:]))
    with pytest.warns(TargetWarning, match="3 open edges"):
        nw.avoid(path)
    # A receiver may be open: no warning.
    nw.match_shadow(ON, (0, -1, 0), path)


def test_every_sketch_of_the_engine_has_a_public_function() -> None:
    with pytest.raises(ValueError, match="unknown variant") as raised:
        _engine.SketchSpec('{"nothing": {}}')
    named = set(re.findall(r"`(\w+)`", str(raised.value).split("expected one of")[1]))
    assert named == set(SKETCHES)
    assert named <= set(nw.__all__)


def test_a_file_is_a_target(tmp_path: Path) -> None:
    """Growth into a file equals growth into its mesh, to the bit; another mesh scores otherwise."""

    def tower() -> None:
        nw.emit(nw.box((0, 0, 0), (1, nw.uniform(0.5, 3), 1)))

    def best(target: Any) -> float:
        score = nw.match_volume(target, voxel=0.25)
        return nw.run(nw.model(tower), score=score, method=nw.smc(20), seed=1).best.log_score

    solid, path = cube(), tmp_path / "cube.obj"
    corners = "".join(f"v {x} {y} {z}\n" for x, y, z in solid.vertices)
    path.write_text(corners + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in solid.faces))
    assert best(path) == best(str(path)) == best(solid) != best(cube(size=3.0))
