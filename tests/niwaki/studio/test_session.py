"""The journeys of a designer, sent by a script: fill, stop, shape by hand, write, finish."""

from __future__ import annotations

import itertools
import json
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("starlette")

import numpy as np
import trimesh
from niwaki import studio
from niwaki.gallery.spaceship import spaceship
from niwaki.shell import run_files
from niwaki.studio.frames import unpack
from niwaki.studio.messages import Shape
from niwaki.studio.types import typescript
from studio_process import fetch

REPOSITORY = Path(__file__).parents[3]


def grown(connected, model="spaceship", count=3, seed=1):
    """Grow a gallery of results."""
    connected.ask("model", reference=model)
    connected.ask("set", settings={"count": count, "seed": seed, "effort": 0.25})
    connected.shapes.clear()
    connected.ask("run")
    return connected.view["results"]


def until(connected, is_so, seconds=60.0):
    """Read messages until a condition holds."""
    end = time.monotonic() + seconds
    while not is_so():
        connected.read(end - time.monotonic())


def test_a_search_shows_the_best_so_far_and_ends_with_results_that_differ(served, connected):
    results = grown(connected, count=8)
    kinds = [shape.role for shape, _ in connected.shapes]
    assert 2 <= len(results) <= 8 and kinds.count("result") == len(results)
    assert "best" in kinds[: kinds.index("result")]
    scores = [result["log_score"] for result in results]
    assert scores == sorted(scores, reverse=True) and connected.view["picked"] == results[0]["key"]
    data = run_files.load(served.folder / "runs" / f"{results[0]['key']['run']}.json")
    runs = [run_files.replayed(data, number) for number in range(len(results))]
    assert not any(a.choices == b.choices for a, b in itertools.combinations(runs, 2))


def test_a_shape_has_its_parts_and_lies_in_its_bounds(connected):
    key = grown(connected)[0]["key"]
    connected.shapes.clear()
    connected.ask("show", key=key, detail="fine")
    until(connected, lambda: connected.shapes)
    header, payload = connected.shapes[-1]
    n, m = header.vertices, header.triangles
    assert len(payload) == n * (12 + 12 + 4 + 2) + m * 16
    points = np.frombuffer(payload, "<f4", 3 * n).reshape(n, 3)
    corners = np.frombuffer(payload, "<u4", 3 * m, n * 28)
    owners = np.frombuffer(payload, "<u4", m, n * 28 + 12 * m)
    assert corners.max() < n and set(owners.tolist()) == set(range(len(header.parts)))
    assert np.allclose(points.min(axis=0), header.low) and np.allclose(points.max(axis=0), header.high)


def test_stop_ends_a_search_and_keeps_its_results(connected):
    """At this effort the search takes minutes."""
    connected.ask("model", reference="gnarly-tree")
    connected.ask("set", settings={"count": 1, "seed": 1, "effort": 64.0})
    number = connected.send("run")
    until(connected, lambda: any(shape.role == "best" for shape, _ in connected.shapes), 30)
    connected.send("stop")
    connected.wait(number, 30)
    assert connected.view["searching"] is None and len(connected.view["results"]) == 1


def test_impossible_runs_are_reported_with_their_parts(connected):
    grown(connected, count=1)
    losses = connected.view["losses"]
    assert losses.startswith("lost on the way: ") and "no_self_intersection" in losses and "(line " in losses
    connected.ask("model", reference="building")
    assert connected.view["losses"] == ""


def test_settings_can_change_during_a_search_and_the_newest_values_win(connected):
    connected.ask("model", reference="gnarly-tree")
    connected.ask("set", settings={"count": 1, "seed": 1, "effort": 64.0})
    number = connected.send("run")
    for count in (2, 3, 4, 5):
        connected.ask("set", settings={"count": count, "seed": 1, "effort": 0.25})
    assert connected.view["searching"] is not None and connected.view["settings"]["count"] == 5
    connected.send("stop")
    connected.wait(number, 10)


def test_pinned_choices_stay_equal_when_the_rest_is_grown_again(served, connected):
    results = grown(connected, count=1, seed=3)
    described = connected.ask("describe", key=results[0]["key"])
    part = next(row["address"] for row in described["parts"] if "wings" in row["address"]).rpartition("/")[0]
    connected.ask("hold", parts=[part])
    held = connected.view["held"][0]["choices"]
    assert any(address.startswith(part + "/") for address in held)
    for seed in range(100, 120):
        connected.ask("set", settings={"count": 1, "seed": seed, "effort": 0.25})
        connected.ask("run")
        key = connected.view["results"][0]["key"]
        data = run_files.load(served.folder / "runs" / f"{key['run']}.json")
        choices = {row["address"]: row["value"] for row in data["runs"][key["number"]]["choices"]}
        assert {address: choices[address] for address in held} == held
    connected.ask("free")
    assert connected.view["held"] == []


def test_a_part_is_grown_again_in_place_and_nothing_else_changes(served, connected):
    results = grown(connected, count=2, seed=3)
    described = connected.ask("describe", key=results[0]["key"])
    address = next(row["address"] for row in described["parts"] if "wings" in row["address"])
    # All wings of a section: a wing alone decides whether others follow, and these may not change.
    part = address[: address.index("wings") + len("wings")]
    connected.ask("reroll", part=part, count=6)
    grown_again = [result for result in connected.view["results"] if result["origin"] == "regrow"]
    assert 1 < len(grown_again) <= 6 and connected.view["picked"] == grown_again[0]["key"]
    forms = []
    for result in grown_again:
        data = run_files.load(served.folder / "runs" / f"{result['key']['run']}.json")
        forms.append(run_files.replayed(data, result["key"]["number"]).choices)
    before = {row["address"]: row["value"] for row in described["choices"]}
    for form in forms:
        outside = {a: v for a, v in before.items() if not a.startswith(part + "/")}
        assert outside.items() <= form.items()
    assert all(a != b for k, a in enumerate(forms) for b in forms[:k])


def test_a_choice_has_its_line_and_its_slider(connected):
    described = connected.ask("describe", key=grown(connected)[0]["key"])
    length = next(row for row in described["choices"] if row["address"] == "while[0]/length")
    lines = Path(spaceship.function.__code__.co_filename).read_text().splitlines()
    assert "length = uniform(2.0, 5.0)" in lines[length["place"]["line"] - 1]
    assert (length["low"], length["high"], length["family"]) == (2.0, 5.0, "uniform")
    for part in described["parts"]:
        assert "emit(" in lines[part["place"]["line"] - 1]


def test_a_slider_shows_the_newest_value_and_ends_in_a_result(connected):
    grown(connected, count=1)
    before = connected.view["picked"]
    for value in (2.5, 3.0, 3.5):
        connected.send("choose", address="while[0]/length", value=value, phase="move")
    connected.ask("choose", address="while[0]/length", value=4.0)
    with pytest.raises(studio.StudioError, match="no choice"):
        connected.ask("choose", address="while[0]/lenght", value=4.0)
    key = connected.view["picked"]
    assert key != before and [result["origin"] for result in connected.view["results"]] == ["choose"]
    described = connected.ask("describe", key=key)
    assert next(row["value"] for row in described["choices"] if row["address"] == "while[0]/length") == 4.0
    connected.ask("undo")
    assert connected.view["picked"] == before


def test_stars_stay_where_they_are_when_new_results_come(connected):
    results = grown(connected, count=3, seed=1)
    for result in results[:2]:
        connected.ask("star", key=result["key"])
    connected.ask("set", settings={"count": 2, "seed": 9, "effort": 0.25})
    connected.ask("run")
    assert [result["key"] for result in connected.view["results"][:2]] == [
        result["key"] for result in results[:2]
    ]
    for result in results[:2]:
        connected.ask("star", key=result["key"], on=False)


def test_the_gallery_shows_results_of_the_present_model(connected):
    results = grown(connected, count=2)
    connected.ask("model", reference="building")
    assert connected.view["results"] == [] and connected.view["picked"] is None
    connected.ask("set", settings={"count": 1, "seed": 1, "effort": 0.1})
    connected.ask("run")
    buildings = connected.view["results"]
    assert buildings
    connected.ask("model", reference="spaceship")
    assert connected.view["results"] == results and connected.view["picked"] == results[0]["key"]
    connected.ask("run")
    connected.ask("model", reference="building")
    assert connected.view["results"] == buildings


def test_two_windows_see_the_same_session(served, connected):
    with studio.connect(served.url, served.key) as other:
        grown(connected)
        until(other, lambda: other.view["results"] == connected.view["results"])
        other.ask("undo")
        until(connected, lambda: connected.view["redo"] == other.view["redo"])
        assert connected.view == other.view


def test_an_export_equals_the_bytes_of_replay(served, connected, tmp_path):
    key = grown(connected, count=3)[1]["key"]
    recipe = connected.ask("export", key=key, format="json")
    (tmp_path / "run.json").write_bytes(fetch(served, f"/file/{recipe['hash']}"))
    for name in ("glb", "stl"):
        file = connected.ask("export", key=key, format=name)
        data = fetch(served, f"/file/{file['hash']}")
        command = [
            sys.executable,
            "-m",
            "niwaki.shell.main",
            "replay",
            "run.json",
            "--format",
            name,
            "--no-picture",
        ]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
        assert (tmp_path / "out" / f"best.{name}").read_bytes() == data
        assert len(trimesh.load(tmp_path / "out" / f"best.{name}", force="mesh").faces)


def test_an_uploaded_mesh_is_a_target_that_moves_and_turns(served, connected):
    mesh = trimesh.creation.box((2.0, 1.0, 4.0))
    sent = json.loads(fetch(served, "/upload?name=block.obj", mesh.export(file_type="obj").encode()))
    assert sent["triangles"] == 12 and sent["size"] == [2.0, 1.0, 4.0]
    connected.shapes.clear()
    target = {"source": sent["source"], "move": [10.0, 0.5, 0.0], "scale": [1.0, 2.0, 1.0], "turn": 90.0}
    connected.ask("ask", ask={"target": target})
    until(connected, lambda: connected.shapes and connected.shapes[-1][0].triangles == 12)
    header, _ = connected.shapes[-1]
    assert header.role == "ghost"
    assert np.allclose([header.low, header.high], [[8.0, 0.0, -1.0], [12.0, 2.0, 1.0]], atol=1e-5)
    assert np.allclose(header.pivot, [10.0, 0.0, 0.0], atol=1e-5)


def test_a_large_mesh_is_shown_with_fewer_triangles(served, connected):
    ball = trimesh.creation.icosphere(7, 3.0)
    assert len(ball.faces) > 300_000
    sent = json.loads(fetch(served, "/upload?name=ball.stl", ball.export(file_type="stl")))
    connected.shapes.clear()
    connected.ask("ask", ask={"target": {"source": sent["source"]}})
    until(connected, lambda: connected.shapes and connected.shapes[-1][0].note, 30)
    header, _ = connected.shapes[-1]
    assert 2_000 < header.triangles <= 60_000 and "327,680" in header.note
    assert np.allclose(header.high, 3.0, atol=0.05)


def test_a_silhouette_drawn_by_hand_is_grown_into(connected):
    connected.ask("model", reference="building")
    connected.ask("set", settings={"count": 1, "seed": 1, "effort": 1.0})
    camera = {"position": [0, 5, 60], "look_at": [0, 5, 0], "up": [0, 1, 0], "fov": 20.0}
    stroke = {"points": [[0.6, 0.25], [0.6, 0.72]], "width": 0.3}
    connected.ask("ask", ask={"sketch": {"strokes": [stroke], "aspect": 1.2, "camera": camera}})
    connected.ask("run")
    assert connected.view["results"][0]["similarity"] >= 0.8


def test_drawing_models_follow_their_own_drawing_or_a_sketch(connected):
    assert grown(connected, "vines", count=1)[0]["similarity"] > 0.8
    stroke = {"points": [[0.5, 0.9], [0.5, 0.2]], "width": 0.12}
    connected.ask("ask", ask={"sketch": {"strokes": [stroke], "aspect": 1.0}})
    connected.ask("run")
    assert connected.view["results"][0]["similarity"] > 0.5


def test_a_broken_file_keeps_the_last_shape_until_it_is_corrected(served, pile, connected):
    good = pile.read_text()
    connected.ask("model", reference=str(pile))
    connected.ask("ask", ask={"target": {"source": "box", "scale": [1.5, 3.0, 1.5]}})
    connected.ask("set", settings={"count": 1, "seed": 4, "effort": 0.25})
    connected.ask("run")
    results = connected.view["results"]
    try:
        pile.write_text(good.replace("w = uniform(0.5, 2.0)", "w = [uniform(0.5, 2.0)]\n    w.append(1)"))
        until(connected, lambda: connected.view["problem"] is not None)
        problem = connected.view["problem"]
        assert problem["place"]["line"] == 15 and "w.append(1)" in problem["text"] and "^" in problem["text"]
        assert connected.view["results"] == results
        # An editor saves by renaming.
        pile.with_suffix(".tmp").write_text(good)
        pile.with_suffix(".tmp").rename(pile)
        until(connected, lambda: connected.view["problem"] is None)
        until(connected, lambda: connected.view["results"] != results)
        after = connected.view["results"][0]
        assert (after["log_score"], after["seed"]) == (results[0]["log_score"], results[0]["seed"])
    finally:
        pile.write_text(good)


def test_arguments_reach_the_shape_that_is_shown(pile, connected):
    connected.ask("model", reference=str(pile))
    assert [parameter["name"] for parameter in connected.view["model"]["parameters"]] == ["height", "count"]
    connected.ask("ask", ask={"target": {"source": "box", "scale": [1.5, 3.0, 1.5]}})
    connected.ask("set", settings={"seed": 1})
    connected.ask("run")
    before = connected.view["results"]
    connected.shapes.clear()
    connected.ask("set", arguments={"height": 6.0})
    until(connected, lambda: connected.view["results"] != before)
    # Shapes of the earlier search may still arrive.
    until(
        connected,
        lambda: any(
            shape.role == "result" and abs(shape.high[1] - 6.0) < 1e-6 for shape, _ in connected.shapes
        ),
    )
    with pytest.raises(studio.StudioError):
        connected.ask("run", fields="no")


def test_the_types_of_the_page_match_the_messages():
    assert (REPOSITORY / "studio/page/src/messages.ts").read_text() == typescript(), "run `make studio-page`"


def test_a_frame_that_is_cut_short_is_refused():
    for data in (b"", b"\x01\x00", b"\xff\x00\x00\x00{}"):
        with pytest.raises(ValueError, match="frame"):
            unpack(data)
    assert Shape().role == "result"
