"""Dragging a part through the studio: shapes during the move, a result or a reason at the end."""

from __future__ import annotations

import pytest

pytest.importorskip("starlette")

import numpy as np
from niwaki import studio


@pytest.fixture
def ship(connected):
    """A connection with one spaceship as the result."""
    connected.ask("model", reference="spaceship")
    connected.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
    connected.ask("free")
    connected.ask("run")
    return connected


def described(connected):
    return connected.ask("describe", key=connected.view["picked"])


def middles(connected):
    """Compute the middle of each part of the last shape."""
    header, payload = connected.shapes[-1]
    n, m = header.vertices, header.triangles
    points = np.frombuffer(payload, "<f4", 3 * n).reshape(n, 3)
    corners = np.frombuffer(payload, "<u4", 3 * m, 12 * n + 4 * n).reshape(m, 3)
    owners = np.frombuffer(payload, "<u4", m, 12 * n + 4 * n + 12 * m)
    boxes = [points[corners[owners == k].ravel()] for k in range(len(header.parts))]
    return {
        part: (box.min(axis=0) + box.max(axis=0)) / 2 for part, box in zip(header.parts, boxes, strict=True)
    }


def shown(connected):
    """Show the active result; return the middles of its parts."""
    connected.shapes.clear()
    connected.ask("show", key=connected.view["picked"])
    while not connected.shapes:
        connected.read(10.0)
    return middles(connected)


#: A drag in the plane that faces a camera.
AIM, ALONG = np.array([0.2, 0.0, -0.1]), [0.0, 1.0, 0.0]


def test_a_part_moves_with_the_pointer_and_its_end_is_a_result(ship):
    before, arrived = shown(ship), 0
    for part, middle in before.items():
        picked = ship.view["picked"]
        ship.shapes.clear()
        for step in (0.3, 0.6, 1.0):
            to = (middle + step * AIM).tolist()
            ship.ask("drag", part=part, to=to, grab=middle.tolist(), along=ALONG, phase="move")
        # Runs of the models of the first screen may still arrive.
        moving = [shape for shape, _ in ship.shapes if shape.role not in ("ghost", "prior", "glimpse")]
        header = moving[-1]
        assert {shape.role for shape in moving} == {"moving"}
        left = np.linalg.norm((np.array(header.held) - middle - AIM)[[0, 2]])
        assert (left <= 0.01 * 20) == (header.note == "")
        outcome = ship.ask("drag", part=part, to=to, grab=middle.tolist(), along=ALONG, phase="end")
        assert outcome["kind"] == "dragged"
        assert (outcome["share"] <= 0.01) == (outcome["reason"] == "")
        assert (ship.view["picked"] != picked) == bool(outcome["changes"])
        arrived += outcome["reason"] == ""
        if outcome["changes"]:
            ship.ask("undo")
        assert ship.view["picked"] == picked
    assert arrived >= 2


def test_pinned_choices_are_equal_to_the_bit_after_twenty_drags(ship):
    first = described(ship)["choices"]
    held = [row["address"] for row in first][::3]
    ship.ask("hold", parts=held)
    values = {row["address"]: row["value"] for row in first if row["address"] in held}
    rng = np.random.default_rng(1)
    for _ in range(20):
        places = shown(ship)
        part = sorted(places)[rng.integers(len(places))]
        to = places[part] + rng.normal(size=3) * 0.3
        outcome = ship.ask("drag", part=part, to=to.tolist(), along=[0.6, 0.4, 0.7], phase="end")
        assert outcome["share"] <= 0.01 or outcome["reason"]
        after = {row["address"]: row["value"] for row in described(ship)["choices"]}
        assert {address: after.get(address) for address in values} == values


def test_the_rest_is_grown_again_around_the_part(ship):
    for part in shown(ship):
        middle, picked = shown(ship).get(part), ship.view["picked"]
        if middle is None:
            continue
        goal = middle + np.array([0.0, 0.0, -0.15])
        outcome = ship.ask("drag", part=part, to=goal.tolist(), phase="end", follow=True)
        if outcome["reason"] == "":
            # The result of the drag is followed by a result of the search that begins there.
            assert ship.view["picked"]["run"] == picked["run"] + 2
            after = shown(ship)[outcome["part"]]
            assert np.linalg.norm(after - goal) <= 0.01 * 20
            return
    pytest.fail("no part was followed")


def test_a_drag_that_is_cancelled_leaves_the_result(ship):
    picked = ship.view["picked"]
    part = described(ship)["parts"][0]["address"]
    ship.ask("drag", part=part, to=[0, 0, 0.3], phase="move")
    ship.ask("drag", part=part, to=[0, 0, 0.3], phase="cancel")
    assert ship.view["picked"] == picked


def test_a_default_that_explains_a_drag_is_written_when_accepted(connected, pile):
    text = pile.read_text()
    connected.ask("model", reference=str(pile))
    connected.ask("set", settings={"count": 1, "seed": 1, "effort": 0.25})
    connected.ask("ask", ask={"target": {"source": "box", "scale": [2.0, 3.0, 2.0]}})
    connected.ask("run")
    (part,) = [address for address in shown(connected) if "i[3]" in address]
    middle = shown(connected)[part]
    to = (middle + [0.0, 3.5 / 8, 0.0]).tolist()
    outcome = connected.ask("drag", part=part, to=to, phase="end")
    first = outcome["offers"][0]
    assert first["label"] == "line 7: 3.0 becomes 3.5"
    assert pile.read_text() == text
    with pytest.raises(studio.StudioError, match="did not offer"):
        connected.ask("rewrite", difference="---")
    connected.ask("rewrite", difference=first["difference"])
    assert pile.read_text() == text.replace("height: float = 3.0", "height: float = 3.5")
    pile.write_text(text)


def test_arguments_are_offered_as_defaults_and_written_when_accepted(connected, pile):
    text = pile.read_text()
    connected.ask("model", reference=str(pile))
    # An argument equal to its default is no change.
    connected.ask("set", arguments={"height": 3.0})
    assert connected.ask("propose")["offers"] == []
    connected.ask("set", arguments={"height": 4, "count": 6})
    (offer,) = connected.ask("propose")["offers"]
    assert offer["label"] == "line 7: 3.0 becomes 4.0; line 7: 4 becomes 6"
    assert pile.read_text() == text
    connected.ask("rewrite", difference=offer["difference"])
    assert pile.read_text() == text.replace(
        "height: float = 3.0, count: int = 4", "height: float = 4.0, count: int = 6"
    )
    pile.write_text(text)
    # Files of the gallery are never changed.
    connected.ask("model", reference="spaceship")
    assert connected.ask("propose")["offers"] == []
