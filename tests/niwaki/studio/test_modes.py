"""Colourings and structures, by messages."""

from __future__ import annotations

import io
import json
import tomllib
import urllib.error

import pytest

pytest.importorskip("starlette")

import ezdxf
import numpy as np
from niwaki import studio
from niwaki.color import Drawing, Rules
from niwaki.color.drawing import EXAMPLES
from niwaki.shell import run_files
from niwaki.studio.messages import Picture, Regions
from PIL import Image
from studio_process import fetch, serving


def colored(connected, drawing="drawing:house", count=2, seed=1, **more):
    connected.ask("model", reference=drawing)
    connected.ask("set", settings={"count": count, "seed": seed, **more})
    connected.ask("run")
    return connected.view["results"]


def described(connected):
    return connected.ask("describe", key=connected.view["picked"])


def test_regions_match_the_drawing(connected):
    connected.ask("model", reference="drawing:bug")
    while not connected.view["model"]["regions"] or not any(
        isinstance(header, Regions) for header, _ in connected.pictures
    ):
        connected.read(10)
    drawing = Drawing.load("bug")
    assert [region["name"] for region in connected.view["model"]["regions"]] == list(drawing.names)
    shares = [region["share"] for region in connected.view["model"]["regions"]]
    assert np.allclose(shares, drawing.areas, atol=0.005)
    header, payload = next(
        (header, data) for header, data in connected.pictures[::-1] if isinstance(header, Regions)
    )
    labels = np.frombuffer(payload, "<u2", header.width * header.height)
    areas = np.bincount(labels[labels < len(drawing.names)]) / len(labels)
    assert np.allclose(areas, shares)
    picture = Image.open(io.BytesIO(payload[2 * len(labels) :]))
    assert picture.width / picture.height == pytest.approx(header.width / header.height, rel=0.01)


def test_a_pinned_region_keeps_its_colour_in_twenty_colourings(served, connected):
    results = colored(connected)
    connected.ask("hold", parts=["roof", "sky"])
    held = {row["part"]: row["choices"][row["part"]] for row in connected.view["held"]}
    before = described(connected)["colors"]
    assert held == {name: before[name] for name in ("roof", "sky")}
    connected.ask("set", settings={"count": 20, "seed": 5})
    connected.ask("run")
    results = connected.view["results"]
    assert len(results) == 20
    colourings = []
    for result in results:
        colors = connected.ask("describe", key=result["key"])["colors"]
        assert {name: colors[name] for name in held} == held
        colourings.append(tuple(colors.values()))
    assert len(set(colourings)) == 20
    connected.ask("hold", parts=["door"], color="#102030")
    connected.ask("run")
    assert described(connected)["colors"]["door"] == "#102030"
    rules = connected.ask("export", key=connected.view["picked"], format="toml")
    written = tomllib.loads(fetch(served, f"/file/{rules['hash']}").decode())
    assert written["held"] == {**held, "door": "#102030"}
    assert Rules.of(written) == Rules.of({**tomllib.loads((EXAMPLES / "house.toml").read_text()), **written})
    connected.ask("free")


def test_a_chosen_colour_is_measured_without_a_search(connected):
    colored(connected, count=1)
    before = described(connected)
    connected.pictures.clear()
    connected.send("choose", address="wall", value="#ff0000", phase="move")
    connected.ask("choose", address="wall", value="#00ff00")
    after = described(connected)
    assert after["colors"] == {**before["colors"], "wall": "#00ff00"}
    assert [header.role for header, _ in connected.pictures if isinstance(header, Picture)][-1] == "result"
    missed = [rule for rule in after["rules"] if not rule["holds"]]
    assert missed and all("wall" in (rule["first"], rule["second"]) for rule in missed)
    assert {"wall", "wall-shade"} in [{rule["first"], rule["second"]} for rule in missed]
    assert all(rule["text"].endswith("holds") == rule["holds"] for rule in after["rules"])
    connected.ask("undo")
    assert described(connected)["colors"] == before["colors"]


def test_contradictory_rules_are_refused(connected):
    connected.ask("model", reference="drawing:robot")
    rules = {"rules": [{"kind": "lighter", "regions": ["face", "body"]}]}
    connected.ask("ask", ask={"rules": rules})
    connected.ask("set", settings={"count": 1, "seed": 1})
    connected.ask("run")
    (report,) = described(connected)["rules"]
    assert (report["first"], report["second"], report["holds"]) == ("face", "body", True)
    # A later rule is measured on the present result.
    rules["rules"].append({"kind": "muted", "regions": ["body"], "most": 0.0})
    connected.ask("ask", ask={"rules": rules})
    assert [report["kind"] for report in described(connected)["rules"]] == ["lighter", "muted"]
    rules["rules"].append({"kind": "lighter", "regions": ["body", "face"]})
    connected.ask("ask", ask={"rules": rules})
    with pytest.raises(studio.StudioError, match="contradict each other"):
        connected.ask("run")


def test_an_uploaded_drawing_works_as_a_drawing_of_the_package(served, connected):
    sent = json.loads(fetch(served, "/upload?name=mine.svg", (EXAMPLES / "rocket.svg").read_bytes()))
    assert sent["regions"] == len(Drawing.load("rocket").names)
    results = colored(connected, sent["reference"], count=1)
    assert results[0]["model"] == sent["reference"] and results[0]["note"] == "no rules"
    svg = connected.ask("export", key=results[0]["key"], format="svg")
    text = fetch(served, f"/file/{svg['hash']}").decode()
    colors = described(connected)["colors"]
    assert all(color in text for color in colors.values())
    flat = np.zeros((40, 60, 3), np.uint8)
    flat[:, 30:] = 200
    out = io.BytesIO()
    Image.fromarray(flat).save(out, "PNG")
    sent = json.loads(fetch(served, "/upload?name=flat.png", out.getvalue()))
    assert colored(connected, sent["reference"], count=1) and set(described(connected)["colors"]) == {
        "#000000",
        "#c8c8c8",
    }
    with pytest.raises(studio.StudioError, match="not a model"):
        connected.ask("model", reference="drawing:upload:" + 64 * "0" + ".svg")
    with pytest.raises(studio.StudioError, match="not a model"):
        connected.ask("model", reference="drawing:/etc/hostname")


@pytest.mark.parametrize(
    ("name", "body"),
    [
        ("no.svg", b"<svg xmlns='http://www.w3.org/2000/svg'/>"),
        ("no.svg", b"\x00\x01"),
        ("bomb.svg", b"<svg>" * 3_000),
        ("no.png", b"\x89PNG\r\n\x1a\n"),
        ("no.txt", b"hello"),
    ],
)
def test_an_invalid_drawing_is_refused_with_a_reason(served, name, body):
    with pytest.raises(urllib.error.HTTPError) as caught:
        fetch(served, f"/upload?name={name}", body)
    assert caught.value.code in (415, 422) and len(json.loads(caught.value.read())["text"]) > 10


def test_colourings_survive_a_restart(tmp_path):
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as script:
        sent = json.loads(fetch(served, "/upload?name=a.svg", (EXAMPLES / "bug.svg").read_bytes()))
        colored(script, sent["reference"], count=2)
        script.ask("star", key=script.view["results"][1]["key"])
        before, colors = script.view["results"], described(script)["colors"]
        served.kill()
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as script:
        while script.view["model"] is None:
            script.read(10)
        assert script.view["results"] == before and len(script.view["stars"]) == 1
        assert described(script)["colors"] == colors
        script.ask("show", key=script.view["picked"], detail="fine")
        while not any(isinstance(shape, Picture) for shape, _ in script.pictures):
            script.read(10)


def test_a_structure_stands_and_its_boards_are_read_by_ezdxf(served, connected):
    connected.ask("model", reference="stack:cut_stack")
    connected.ask("set", settings={"count": 2, "seed": 1})
    connected.ask("run")
    results = connected.view["results"]
    assert len(results) == 2 and results[0]["note"].startswith("stands to")
    judged = connected.ask("judge", key=results[0]["key"], simulate=True)
    assert judged["holds"] and judged["stands"] and judged["loose"] == judged["fallen"] == []
    assert results[0]["note"] == f"stands to {judged['tilt']:.1f}°"
    # The lowest contact carries all six blocks.
    assert max(arrow["force"][1] for arrow in judged["arrows"]) == pytest.approx(6.0, abs=1e-6)
    file = connected.ask("export", key=results[0]["key"], format="dxf", board=[500.0, 300.0])
    board = ezdxf.read(io.StringIO(fetch(served, f"/file/{file['hash']}").decode()))
    layers = [line.dxf.layer for line in board.modelspace().query("LWPOLYLINE")]
    assert layers.count("CUT") == 6 and layers.count("BOARD") == 1
    edge = next(line for line in board.modelspace().query("LWPOLYLINE") if line.dxf.layer == "BOARD")
    assert np.allclose(np.ptp([point[:2] for point in edge], axis=0), [500.0, 300.0])
    plan = connected.ask("export", key=results[0]["key"], format="assembly")
    assert b"<svg" in fetch(served, f"/file/{plan['hash']}")


def test_blocks_that_fall_are_named_and_pinned_calls_stay(served, connected):
    connected.ask("model", reference="stack:cut_stack")
    connected.ask("set", settings={"count": 1, "seed": 1})
    connected.ask("run")
    connected.ask("hold", parts=["pile/piece"])
    held = connected.view["held"][0]["choices"]
    connected.ask("set", settings={"count": 1, "seed": 2})
    connected.ask("run")
    key = connected.view["picked"]
    data = run_files.load(served.folder / "runs" / f"{key['run']}.json")
    choices = {row["address"]: row["value"] for row in data["runs"][key["number"]]["choices"]}
    assert {name: choices[name] for name in held} == held
    # Every piece slides to one side as far as its neighbour allows.
    sliding = [address for address in choices if address.endswith("/block")]
    assert len(sliding) == 5
    for address in sliding:
        connected.ask("choose", address=address, value=1.0)
    assert connected.view["results"][0]["note"] == "falls"
    judged = connected.ask("judge", key=connected.view["picked"], simulate=True)
    parts = [part["address"] for part in described(connected)["parts"]]
    assert not judged["holds"] and judged["stands"] is False
    assert judged["loose"] and judged["fallen"] and {*judged["loose"], *judged["fallen"]} <= set(parts)
    with pytest.raises(studio.StudioError, match="no free choices of its own"):
        connected.ask("reroll", part="pile/piece")


def test_a_call_of_a_structure_is_grown_again_and_the_rest_stays(served, connected):
    connected.ask("free")
    connected.ask("model", reference="stack:cut_stack")
    connected.ask("set", settings={"count": 1, "seed": 1})
    connected.ask("run")
    before = {row["address"]: row["value"] for row in described(connected)["choices"]}
    part = "pile/piece"
    connected.ask("reroll", part=part, count=4, strength=1.0)
    grown_again = [result for result in connected.view["results"] if result["origin"] == "regrow"]
    assert 1 <= len(grown_again) <= 4
    for result in grown_again:
        choices = connected.ask("describe", key=result["key"])["choices"]
        after = {row["address"]: row["value"] for row in choices}
        outside = {
            name: value
            for name, value in before.items()
            if not name.startswith(f"{part}/") and "/balance/" not in name
        }
        assert len(outside) > 20
        assert {name: after[name] for name in outside} == outside and after != before
        judged = connected.ask("judge", key=result["key"])
        assert judged["holds"] and result["note"] == f"stands to {judged['tilt']:.1f}°"


def test_a_model_of_a_file_that_uses_stacks_is_a_structure(tmp_path):
    place = tmp_path / "mine.py"
    place.write_text(
        "from niwaki import model\nfrom niwaki.stacks import cut_stack\n\n\n"
        "@model\ndef mine(width: float = 0.01):\n    return cut_stack(width)\n"
    )
    with serving(tmp_path / "session", place) as served, studio.connect(served.url, served.key) as script:
        while script.view["model"] is None or script.view["model"]["kind"] != "structure":
            script.read(10)
        script.ask("set", settings={"count": 1, "seed": 3})
        script.ask("run")
        assert script.ask("judge", key=script.view["picked"])["holds"]
        script.ask("model", reference="spaceship")
        script.ask("run")
        with pytest.raises(studio.StudioError):
            script.ask("judge", key=script.view["picked"])
