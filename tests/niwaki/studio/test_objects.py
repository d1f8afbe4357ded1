"""Goals beside the target, and the difference from the target, sent by a script."""

from __future__ import annotations

import pytest

pytest.importorskip("starlette")

import niwaki as nw
import numpy as np
import trimesh
from niwaki import _engine, studio
from niwaki.shell import run_files
from niwaki.studio.worker.primitives import PRIMITIVES, primitive
from trimesh.creation import box, cylinder, icosphere


@pytest.fixture
def connected(served):
    with studio.connect(served.url, served.key) as script:
        script.ask("model", reference="spaceship")
        script.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
        yield script


def sample(served, key):
    data = run_files.load(served.folder / "runs" / f"{key['run']}.json")
    return run_files.replayed(data, key["number"])


def shape_of(connected, role):
    connected.shapes.clear()
    while not any(shape.role == role for shape, _ in connected.shapes):
        connected.read(10)
    return next(shape for shape, _ in connected.shapes if shape.role == role)


def test_nothing_goes_below_the_floor_or_near_an_obstacle(served, connected):
    obstacle = {"source": "box", "move": [5.0, -0.5, -3.0], "scale": [1.0, 2.0, 1.0], "turn": 30.0}
    connected.ask("ask", ask={"floor": -1.5, "obstacles": [obstacle]})
    header = shape_of(connected, "obstacle")
    assert header.number == 0 and header.pivot == (5.0, -0.5, -3.0)
    connected.ask("run")
    best = sample(served, connected.view["picked"])
    assert best.scene.bounds[0][1] >= -1.5
    # The engine's own sketch forbids none of the parts.
    solid = next(ask.arguments["obstacle"] for ask in best.search.score.asks if ask.function == "avoid")
    sketch = _engine.Sketch(nw.avoid(solid).specs)
    assert not any(sketch.add(list(part.shapes)) for part in best.scene)
    turned = np.radians(30.0)
    reach = 0.5 * (np.cos(turned) + np.sin(turned))
    assert np.allclose(solid.bounds, [[5 - reach, -0.5, -3 - reach], [5 + reach, 1.5, -3 + reach]])


def test_a_change_of_a_goal_keeps_the_others_and_a_target_replaces_a_sketch(connected):
    stroke = {"points": [[0.5, 0.5]], "width": 0.2}
    connected.ask("ask", ask={"floor": 0.0, "target": {"source": "box"}})
    connected.ask("ask", ask={"sketch": {"strokes": [stroke], "aspect": 1.0}})
    ask = connected.view["ask"]
    assert ask["floor"] == 0.0 and ask["target"] is None and ask["sketch"] is not None
    connected.ask("ask", ask={"target": {"source": "ball"}, "floor": None})
    ask = connected.view["ask"]
    assert ask["floor"] is None and ask["target"]["source"] == "ball" and ask["sketch"] is None
    connected.ask("set", settings={"count": 3})
    assert connected.view["settings"]["seed"] == 1


@pytest.mark.parametrize(
    "ask",
    [
        {"obstacles": [{"source": "/etc/passwd"}]},
        {"obstacles": [{"source": "box"}] * 17},
        {"light": [0.0, 1.0, 0.0]},
        {"flor": 0.0},
    ],
)
def test_invalid_goals_are_refused(connected, ask):
    before = connected.view["ask"]
    with pytest.raises(studio.StudioError):
        connected.ask("ask", ask=ask)
    assert connected.view["ask"] == before


def test_a_shadow_falls_along_the_light(served, connected):
    connected.ask("model", reference="building")
    camera = {"position": [0.0, 14.0, 30.0], "look_at": [0.0, 0.0, 0.0], "up": [0, 1, 0], "fov": 30.0}
    stroke = {"points": [[0.6, 0.5], [0.75, 0.5]], "width": 0.1}
    sketch = {"strokes": [stroke], "aspect": 1.2, "camera": camera, "kind": "shadow"}
    connected.ask("ask", ask={"sketch": sketch, "light": [1.0, -1.0, 0.0]})
    connected.ask("run")
    best = sample(served, connected.view["picked"])
    (view,) = best.search.score.views
    assert view.kind == "shadow" and view.light == (1.0, -1.0, 0.0)
    assert connected.view["results"][0]["covered"] > 0.5


def test_the_difference_has_a_byte_for_each_cell_and_the_sums_of_the_fit(served, connected):
    connected.ask("run")
    key = connected.view["picked"]
    connected.ask("difference", key=key)
    header, payload = connected.differences[-1]
    counts = np.bincount(np.frombuffer(payload, np.uint8), minlength=4)
    assert len(payload) == np.prod(header.size) and not header.is_picture
    fit = sample(served, key).fit
    assert fit.covered == counts[1] / (counts[1] + counts[2])
    # A part of the scene may lie outside the grid.
    assert fit.outside >= counts[3] / (counts[1] + counts[3]) - 1e-12
    assert connected.view["results"][0]["covered"] == fit.covered


@pytest.mark.parametrize("name", PRIMITIVES)
def test_primitives_are_those_of_trimesh(name):
    ideal = {
        "box": box((1.0, 1.0, 1.0)),
        "ball": icosphere(3, 0.5),
        "column": cylinder(0.5, 1.0, sections=48),
    }[name]
    if name == "column":
        ideal.vertices = ideal.vertices[:, [0, 2, 1]] * (1.0, 1.0, -1.0)
    target = primitive(name)
    mesh = trimesh.Trimesh(target.vertices, target.faces)
    assert mesh.is_volume and mesh.volume == pytest.approx(ideal.volume, rel=1e-8)
    assert np.array_equal(mesh.bounds, ((-0.5, 0.0, -0.5), (0.5, 1.0, 0.5)))
    corners = ideal.vertices + (0.0, 0.5, 0.0)
    assert max(np.linalg.norm(corners - corner, axis=1).min() for corner in target.vertices) < 1e-8
