"""Drawings that are coloured and structures that stand, by messages."""

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
from niwaki.color.drawing import OWN
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


def test_regions_and_rules_are_those_of_the_drawing(connected):
    connected.ask("model", reference="drawing:bug")
    while not connected.view["model"]["regions"] or not any(
        isinstance(one, Regions) for one, _ in connected.pictures
    ):
        connected.read(10)
    read = Drawing.load("bug")
    assert [one["name"] for one in connected.view["model"]["regions"]] == list(read.names)
    shares = [one["share"] for one in connected.view["model"]["regions"]]
    assert np.allclose(shares, read.areas, atol=0.005)
    header, payload = next((one, data) for one, data in connected.pictures[::-1] if isinstance(one, Regions))
    labels = np.frombuffer(payload, "<u2", header.width * header.height)
    found = np.bincount(labels[labels < len(read.names)]) / len(labels)
    assert np.allclose(found, shares)
    picture = Image.open(io.BytesIO(payload[2 * len(labels) :]))
    assert picture.width / picture.height == pytest.approx(header.width / header.height, rel=0.01)


def test_a_pinned_region_keeps_its_colour_in_twenty_colourings(served, connected):
    results = colored(connected)
    connected.ask("hold", parts=["roof", "sky"])
    held = {one["part"]: one["choices"][one["part"]] for one in connected.view["held"]}
    before = described(connected)["colors"]
    assert held == {name: before[name] for name in ("roof", "sky")}
    connected.ask("set", settings={"count": 20, "seed": 5})
    connected.ask("run")
    results = connected.view["results"]
    assert len(results) == 20
    seen = []
    for one in results:
        colors = connected.ask("describe", key=one["key"])["colors"]
        assert {name: colors[name] for name in held} == held
        seen.append(tuple(colors.values()))
    assert len(set(seen)) == 20
    connected.ask("hold", parts=["door"], color="#102030")
    connected.ask("run")
    assert described(connected)["colors"]["door"] == "#102030"
    rules = connected.ask("export", key=connected.view["picked"], format="toml")
    written = tomllib.loads(fetch(served, f"/file/{rules['hash']}").decode())
    assert written["held"] == {**held, "door": "#102030"}
    assert Rules.of(written) == Rules.of({**tomllib.loads((OWN / "house.toml").read_text()), **written})
    connected.ask("free")


def test_a_colour_that_is_given_is_measured_and_not_searched_for(connected):
    colored(connected, count=1)
    before = described(connected)
    connected.pictures.clear()
    connected.send("choose", address="wall", value="#ff0000", phase="move")
    connected.ask("choose", address="wall", value="#00ff00")
    after = described(connected)
    assert after["colors"] == {**before["colors"], "wall": "#00ff00"}
    assert [one.what for one, _ in connected.pictures if isinstance(one, Picture)][-1] == "result"
    missed = [one for one in after["kept"] if not one["holds"]]
    assert missed and all("wall" in (one["first"], one["second"]) for one in missed)
    assert {"wall", "wall-shade"} in [{one["first"], one["second"]} for one in missed]
    assert all(one["text"].endswith("holds") == one["holds"] for one in after["kept"])
    connected.ask("undo")
    assert described(connected)["colors"] == before["colors"]


def test_rules_are_asked_and_those_that_contradict_are_refused(connected):
    connected.ask("model", reference="drawing:robot")
    rules = {"rules": [{"kind": "lighter", "regions": ["face", "body"]}]}
    connected.ask("ask", ask={"rules": rules})
    connected.ask("set", settings={"count": 1, "seed": 1})
    connected.ask("run")
    (kept,) = described(connected)["kept"]
    assert (kept["first"], kept["second"], kept["holds"]) == ("face", "body", True)
    # A rule that is asked afterwards is measured on what is there.
    rules["rules"].append({"kind": "muted", "regions": ["body"], "most": 0.0})
    connected.ask("ask", ask={"rules": rules})
    assert [one["kind"] for one in described(connected)["kept"]] == ["lighter", "muted"]
    rules["rules"].append({"kind": "lighter", "regions": ["body", "face"]})
    connected.ask("ask", ask={"rules": rules})
    with pytest.raises(studio.StudioError, match="cannot hold together"):
        connected.ask("run")


def test_a_drawing_that_is_sent_is_chosen_as_ours_are(served, connected):
    sent = json.loads(fetch(served, "/upload?name=mine.svg", (OWN / "rocket.svg").read_bytes()))
    assert sent["regions"] == len(Drawing.load("rocket").names)
    results = colored(connected, sent["reference"], count=1)
    assert results[0]["model"] == sent["reference"] and results[0]["note"] == "no rules"
    svg = connected.ask("export", key=results[0]["key"], format="svg")
    text = fetch(served, f"/file/{svg['hash']}").decode()
    colors = described(connected)["colors"]
    assert all(one in text for one in colors.values())
    flat = np.zeros((40, 60, 3), np.uint8)
    flat[:, 30:] = 200
    out = io.BytesIO()
    Image.fromarray(flat).save(out, "PNG")
    sent = json.loads(fetch(served, "/upload?name=flat.png", out.getvalue()))
    assert colored(connected, sent["reference"], count=1) and set(described(connected)["colors"]) == {
        "#000000",
        "#c8c8c8",
    }
    with pytest.raises(studio.StudioError, match="no model"):
        connected.ask("model", reference="drawing:upload:" + 64 * "0" + ".svg")
    with pytest.raises(studio.StudioError, match="no model"):
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
def test_what_is_no_drawing_is_refused_with_a_reason(served, name, body):
    with pytest.raises(urllib.error.HTTPError) as refused:
        fetch(served, f"/upload?name={name}", body)
    assert refused.value.code in (415, 422) and len(json.loads(refused.value.read())["text"]) > 10


def test_colourings_are_back_after_a_restart(tmp_path):
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as one:
        sent = json.loads(fetch(served, "/upload?name=a.svg", (OWN / "bug.svg").read_bytes()))
        colored(one, sent["reference"], count=2)
        one.ask("star", key=one.view["results"][1]["key"])
        before, colors = one.view["results"], described(one)["colors"]
        served.kill()
    with serving(tmp_path) as served, studio.connect(served.url, served.key) as one:
        while one.view["model"] is None:
            one.read(10)
        assert one.view["results"] == before and len(one.view["stars"]) == 1
        assert described(one)["colors"] == colors
        one.ask("show", key=one.view["picked"], detail="fine")
        while not any(isinstance(shape, Picture) for shape, _ in one.pictures):
            one.read(10)


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
    assert max(one["force"][1] for one in judged["arrows"]) == pytest.approx(6.0, abs=1e-6)
    file = connected.ask("export", key=results[0]["key"], format="dxf", board=[500.0, 300.0])
    board = ezdxf.read(io.StringIO(fetch(served, f"/file/{file['hash']}").decode()))
    layers = [one.dxf.layer for one in board.modelspace().query("LWPOLYLINE")]
    assert layers.count("CUT") == 6 and layers.count("BOARD") == 1
    edge = next(one for one in board.modelspace().query("LWPOLYLINE") if one.dxf.layer == "BOARD")
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
    found = {one["address"]: one["value"] for one in data["runs"][key["number"]]["choices"]}
    assert {name: found[name] for name in held} == held
    # Every piece slid as far to one side as its neighbour lets it.
    slid = [one for one in found if one.endswith("/block")]
    assert len(slid) == 5
    for address in slid:
        connected.ask("choose", address=address, value=1.0)
    assert connected.view["results"][0]["note"] == "falls"
    judged = connected.ask("judge", key=connected.view["picked"], simulate=True)
    parts = [one["address"] for one in described(connected)["parts"]]
    assert not judged["holds"] and judged["stands"] is False
    assert judged["loose"] and judged["fallen"] and {*judged["loose"], *judged["fallen"]} <= set(parts)
    with pytest.raises(studio.StudioError, match="no choices of its own that are free"):
        connected.ask("reroll", part="pile/piece")


def test_a_call_of_a_structure_is_grown_again_and_the_rest_stays(served, connected):
    connected.ask("free")
    connected.ask("model", reference="stack:cut_stack")
    connected.ask("set", settings={"count": 1, "seed": 1})
    connected.ask("run")
    before = {one["address"]: one["value"] for one in described(connected)["choices"]}
    part = "pile/piece"
    connected.ask("reroll", part=part, count=4, strength=1.0)
    found = [one for one in connected.view["results"] if one["origin"] == "regrow"]
    assert 1 <= len(found) <= 4
    for one in found:
        after = {own["address"]: own["value"] for own in connected.ask("describe", key=one["key"])["choices"]}
        outside = {
            name: value
            for name, value in before.items()
            if not name.startswith(f"{part}/") and "/balance/" not in name
        }
        assert len(outside) > 20
        assert {name: after[name] for name in outside} == outside and after != before
        judged = connected.ask("judge", key=one["key"])
        assert judged["holds"] and one["note"] == f"stands to {judged['tilt']:.1f}°"


def test_a_model_of_a_file_that_uses_stacks_is_a_structure(tmp_path):
    place = tmp_path / "mine.py"
    place.write_text(
        "from niwaki import model\nfrom niwaki.stacks import cut_stack\n\n\n"
        "@model\ndef mine(width: float = 0.01):\n    return cut_stack(width)\n"
    )
    with serving(tmp_path / "session", place) as served, studio.connect(served.url, served.key) as one:
        while one.view["model"] is None or one.view["model"]["kind"] != "structure":
            one.read(10)
        one.ask("set", settings={"count": 1, "seed": 3})
        one.ask("run")
        assert one.ask("judge", key=one.view["picked"])["holds"]
        one.ask("model", reference="spaceship")
        one.ask("run")
        with pytest.raises(studio.StudioError):
            one.ask("judge", key=one.view["picked"])
