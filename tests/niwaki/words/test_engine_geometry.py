"""The binding's shapes, targets and sketches agree with the engine; bad input gives an error with a code."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from niwaki import _engine as engine


def match_volume(target: engine.Target, sigma: float) -> engine.SketchSpec:
    return engine.SketchSpec(json.dumps({"match_volume": {"sigma": sigma}}), target)


def no_self_intersection(rule: str = "solid") -> engine.SketchSpec:
    return engine.SketchSpec(json.dumps({"no_self_intersection": {"rule": rule}}))


CUBE = engine.shape("box", (0, 0, 0), (1, 1, 1))


def test_shapes_are_at_their_given_places() -> None:
    rod = engine.shape("cylinder", (0, 0, 2), 0.5, 4, axis="z")
    assert rod.aabb() == ([-0.5, -0.5, 0.0], [0.5, 0.5, 4.0])
    assert rod == engine.shape("cylinder", (0, 0, 2), 0.5, 4, axis=(0, 0, 3))
    assert rod != CUBE
    assert (rod.kind, rod.color) == ("cylinder", None)
    vertices, faces = rod.vertices(), rod.faces()
    assert vertices.shape == (18, 3) and faces.shape == (32, 3)
    assert vertices.dtype == np.float64 and faces.dtype == np.int64
    cone = engine.shape("cylinder", (0, 0, 0), 1, 2, top_radius=0, color=(1, 0, 0))
    assert cone.kind == "tapered-cylinder" and cone.color == [1, 0, 0]
    quarter = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    beam = engine.shape("box", (0, 0, 0), (1, 2, 4), rotation=quarter)
    assert beam.aabb() == ([-2, -1, -0.5], [2, 1, 0.5])
    limb = engine.shape("limb", (0, 0, 0), (0, 2, 0), 0.5, 0.4, end_normal=(0.2, 1, 0))
    assert limb.kind == "limb"


def test_a_mesh_is_a_shape_and_a_target() -> None:
    mesh = engine.shape("mesh", CUBE.vertices(), CUBE.faces(), center=(1, 0, 0), scale=2.0)
    assert mesh.aabb() == ([0, -1, -1], [2, 1, 1])
    target = engine.Target(CUBE.vertices(), CUBE.faces(), 0.1)
    assert target.dims == (12, 12, 12)
    assert target.domain == ([-0.6] * 3, [0.6] * 3)
    assert (target.triangles, target.open_edges) == (12, 0)
    cells = target.cells()
    assert cells.shape == target.dims and int(cells.sum()) == target.filled
    assert engine.Target(CUBE.vertices(), CUBE.faces()[1:], 0.1).open_edges == 3


@pytest.mark.parametrize(
    ("code", "make"),
    [
        ("bad-shape", lambda: engine.shape("box", (0, 0, 0), (1, 0, 1))),
        ("bad-shape", lambda: engine.shape("box", (0, 0, math.nan), (1, 1, 1))),
        ("bad-shape", lambda: engine.shape("cylinder", (0, 0, 0), 1, 1, axis="w")),
        ("bad-shape", lambda: engine.shape("limb", (0, 0, 0), (0, 0, 0), 1, 1)),
        ("bad-shape", lambda: engine.Target(np.zeros((0, 3)), np.zeros((0, 3), np.int64), 0.1)),
        ("bad-shape", lambda: engine.Target(CUBE.vertices(), CUBE.faces() + 1, 0.1)),
        ("bad-shape", lambda: engine.Target(CUBE.vertices(), CUBE.faces() - 1, 0.1)),
        ("bad-shape", lambda: engine.Target(CUBE.vertices()[:, :2].copy(), CUBE.faces(), 0.1)),
        ("bad-shape", lambda: engine.Target(CUBE.vertices() * math.inf, CUBE.faces(), 0.1)),
        ("bad-setting", lambda: engine.Target(CUBE.vertices(), CUBE.faces(), 0.0)),
        ("too-many-cells", lambda: engine.Target(CUBE.vertices(), CUBE.faces(), 1e-5)),
        ("bad-setting", lambda: match_volume(engine.Target(CUBE.vertices(), CUBE.faces(), 0.1), -1)),
        ("bad-setting", lambda: no_self_intersection("edges")),
        ("bad-setting", lambda: engine.SketchSpec('{"match_volume": {"sigma": 0.1}}')),
        ("bad-setting", lambda: engine.SketchSpec('{"match_image": {"sigma": 0.1}}')),
        ("bad-setting", lambda: engine.SketchSpec('{"nothing": {}}')),
        ("bad-setting", lambda: engine.Sketch([no_self_intersection()]).remove([CUBE])),
    ],
)
def test_bad_input_gives_an_error_with_a_code(code: str, make) -> None:
    with pytest.raises(ValueError) as raised:
        make()
    assert raised.value.code == code
    assert str(raised.value)[0].islower()


def test_a_scene_is_scored_as_it_grows_and_comes_back() -> None:
    target = engine.Target(CUBE.vertices(), CUBE.faces(), 0.1)
    sketch = engine.Sketch([no_self_intersection(), match_volume(target, 0.02)])
    empty = sketch.log_score()
    expected = 2 * (-0.5 * math.log(2 * math.pi) - math.log(0.02)) - 0.5 * (target.filled / 1728 / 0.02) ** 2
    assert empty == pytest.approx(expected, abs=1e-8)
    assert sketch.add([CUBE]) is None
    assert sketch.similarity() == 1.0
    copy = sketch.fork()
    assert copy.add([engine.shape("box", (0.5, 0, 0), (1, 1, 1))]) == "no_self_intersection"
    assert copy.log_score() == -math.inf
    assert sketch.measures() == {
        "intersecting_pairs": 0.0,
        "similarity": 1.0,
        "overshoot": 0.0,
        "filled": float(target.filled),
    }
    sketch.remove([CUBE])
    assert sketch.log_score() == empty
