"""A dragged part arrives or a reason says why not; the derivatives of positions are those of central differences.

The descent, its answers and its reasons are tested on models whose answers follow by hand.
"""

from __future__ import annotations

from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import (
    box,
    cylinder,
    emit,
    extrude,
    flip,
    gaussian,
    hull,
    limb,
    poisson,
    revolve,
    rotation,
    sweep,
    uniform,
    vec,
)
from niwaki.errors import InputError
from niwaki.gallery import entries
from niwaki.search.drag.source import NEAR

SPACE = [entry.name for entry in entries() if entry.target_name is not None or entry.draws is not None]


def place(positions: Any, part: int, shape: int, shares: tuple[float, float, float]) -> Any:
    """Where a point of a shape is."""
    frame = positions.frame(part, shape)
    return None if frame is None else frame[0] + np.array(shares) @ frame[1:]


@nw.model
def drawn():
    """Solids of points that are choices."""
    wide, deep, high = uniform(1.0, 2.0), gaussian(2.0, 0.1), uniform(1.0, 3.0)
    turn = rotation((0, 0, 1), high)
    polygon = [(0.0, 0.0), (wide, 0.0), (wide, deep), (0.5, 0.5 * deep), (0.0, 3.0)]
    emit(extrude(polygon, high, (wide, 0.0, 0.0), twist=0.3, rotation=turn), extrude(polygon, deep, axis="z"))
    emit(revolve([(wide, 0.0), (0.5 * wide, deep), (0.2, high + 5.0)], axis=(wide, 1.0, deep)))
    path = [(0.0, 0.0, 0.0), (0.0, high, 0.0), (wide + 3.0, 2.0 * high, deep)]
    emit(sweep([(0.1, 0.0), (0.0, 0.1), (-0.1, -0.1)], path))
    corners = [(0.0, 0.0, 0.0), (wide, 0.0, 0.0), (0.0, deep, 0.0), (0.0, 0.0, high), (1.0, 1.0, 1.0)]
    emit(hull([turn * vec(x, y, z) for x, y, z in corners]))


@pytest.mark.parametrize("name", [*SPACE, "drawn"])
def test_derivatives_of_positions_are_central_differences(name: str) -> None:
    """On every model of the gallery that emits: a point of some parts, by some of the choices that move them."""
    models = {entry.name: entry.model for entry in entries()} | {"drawn": drawn}
    sample = next(
        candidate
        for candidate in (nw.run(models[name], seed=s).best for s in range(20))
        if candidate.primitives
    )
    task = sample.search.task
    choices = sample._trace.choices
    placer, free = task.placer(sample._run), {candidate.address for candidate in choices}
    positions = placer.positions({}, free)
    ranges, shares = positions.ranges(), (0.3, -0.2, 0.1)
    size = max(np.ptp([corner for shape in part.shapes for corner in shape.aabb()]) for part in sample.parts)
    rng, looked = np.random.default_rng(1), 0
    for part in rng.permutation(len(positions.parts))[:6].tolist():
        slopes = positions.slopes(part, 0, shares)
        if slopes is None:
            continue
        moving = np.flatnonzero(np.abs(slopes).max(axis=0) > 0)
        for k in rng.permutation(moving)[:4].tolist():
            h = 1e-5 * ranges[k, 3]
            address, x = positions.movables[k][0], ranges[k, 0]
            steps = [2 * h, h, -h, -2 * h]
            at = [place(placer.positions({address: x + by}, free), part, 0, shares) for by in steps]
            difference = (-at[0] + 8 * at[1] - 8 * at[2] + at[3]) / (12 * h)
            np.testing.assert_allclose(slopes[:, k], difference, rtol=1e-5, atol=1e-7 * size / ranges[k, 3])
            looked += 1
    assert looked or all(positions.slopes(n, 0, shares) is None for n in range(len(positions.parts)))


@nw.model
def heap():
    """A prism with a corner that only one choice moves, and a hull that moves and turns as a whole."""
    wide = uniform(1.0, 2.0)
    deep = uniform(1.0, 3.0)
    emit(extrude([(0.0, 0.0), (wide, 0.0), (wide, deep), (0.5, 0.5), (0.0, 5.0)], 2.0), name="prism")
    angle = uniform(0.0, 1.0)
    shift = uniform(0.0, 1.0)
    turn, by = rotation((0, 0, 1), angle), vec(shift, 0.0, 0.0)
    points = [(1, 2, 3), (4, 0, 0), (0, 5, 0), (0, 0, 6), (1, 1, 1)]
    emit(hull([turn * vec(x, y, z) + by for x, y, z in points]), name="hull")


def test_points_of_a_solid_move_with_its_list() -> None:
    sample = nw.run(heap, seed=1).best
    angle, shift, wide = (sample.choices[name] for name in ("angle", "shift", "wide"))
    positions = sample.search.task.placer(sample._run).positions(
        {}, {choice.address for choice in sample._trace.choices}
    )
    names = [path for _, path, *_ in positions.movables]
    prism, pile = (
        next(n for n, part in enumerate(positions.parts) if part[0] == name) for name in ("prism", "hull")
    )
    assert place(positions, prism, 0, (0.5, 0.5, 0.5)) == pytest.approx((wide, 2.0, 5.0))
    slopes = positions.slopes(prism, 0, (0.5, 0.5, 0.5))
    assert (
        slopes[:, names.index("wide")] == pytest.approx((1, 0, 0))
        and not slopes[:, names.index("deep")].any()
    )
    frame = np.array(positions.frame(pile, 0))
    for corner in ((1, 2, 3), (4, 0, 0), (0, 0, 6)):
        x, y, z = rotation((0, 0, 1), angle) * nw.vec(*corner)
        shares = tuple(np.linalg.solve(frame[1:].T, np.array((x + shift, y, z)) - frame[0]).tolist())
        slopes = positions.slopes(pile, 0, shares)
        assert slopes[:, names.index("shift")] == pytest.approx((1, 0, 0), abs=1e-9)
        assert slopes[:, names.index("angle")] == pytest.approx((-y, x, 0), abs=1e-9)


@nw.model
def arm(length=2.0):
    """A turned cylinder at the end of an arm."""
    angle = uniform(-1.0, 1.0)
    reach = gaussian(length, 0.5)
    turn = rotation((0, 0, 1), angle)
    tip = turn * nw.vec(reach, 0.0, 0.0)
    emit(limb((0, 0, 0), tip, 0.2, 0.1), name="bone")
    emit(cylinder(tip, 0.2, 1.0, axis=turn * nw.vec(0.0, 1.0, 0.0)), name="hand")


def test_derivatives_of_an_arm_follow_from_its_angle_and_length() -> None:
    sample = nw.run(arm, seed=3).best
    angle, reach = sample.choices["angle"], sample.choices["reach"]
    positions = sample.search.task.placer(sample._run).positions(
        {}, {choice.address for choice in sample._trace.choices}
    )
    c, s = np.cos(angle), np.sin(angle)
    (hand,) = [n for n, (address, _) in enumerate(positions.parts) if address == "hand"]
    slopes = positions.slopes(hand, 0, (0.0, 0.5, 0.0))
    # The end of the hand is at reach (c, s) + (-s, c) / 2.
    exact = [[-reach * s - c / 2, c], [reach * c - s / 2, s], [0.0, 0.0]]
    np.testing.assert_allclose(slopes, exact, rtol=1e-12, atol=1e-12)


@nw.model
def walled():
    """A wall on its own choice, with a window on another."""
    x = gaussian(0.0, 1.0)
    across = uniform(-1.0, 1.0)
    up = uniform(0.5, 1.5)
    emit(box((x, 1.0, 0.0), (4.0, 2.0, 0.2)) - box((x + across, up, 0.0), (0.5, 0.5, 1.0)), name="wall")


def test_a_hole_that_is_dragged_arrives_and_its_wall_stays() -> None:
    sample = nw.run(walled, seed=1).best
    x, across, up = (sample.choices[name] for name in ("x", "across", "up"))
    middle = np.array([x + across, up, 0.0])
    answer = sample.drag("wall", to=(x, 1.2, 0.0), grab=tuple(middle), hold="x").best
    assert answer is not None and answer.distance < 1e-3
    assert set(answer.changed) <= {"across", "up"}
    assert abs(answer.sample.choices["across"]) < 1e-3 and abs(answer.sample.choices["up"] - 1.2) < 1e-3
    low, high = answer.sample.scene.parts[0].shapes[0].leaves()[1].aabb()
    np.testing.assert_allclose(np.add(low, high) / 2, (x, 1.2, 0.0), atol=2e-3)
    # Without a point the wall itself is held, and only its own choice moves it.
    moved = sample.drag("wall", to=(x + 1.0, 1.0, 0.0)).best
    assert moved is not None and moved.distance < 1e-3 and "x" in moved.changed


@nw.model
def post():
    """Two choices move the box along x, of deviations 1 and 2; one moves it along z."""
    a = gaussian(0.0, 1.0)
    b = gaussian(0.0, 2.0)
    deep = uniform(0.0, 2.0)
    emit(box((a + b, 0.5, deep), (1, 1, 1)), name="top")


def test_the_least_change_is_shared_by_the_squares_of_deviations() -> None:
    sample = nw.run(post, seed=1).best
    a, b, deep = (sample.choices[name] for name in ("a", "b", "deep"))
    drag = sample.drag("top", (a + b + 1.0, 0.5, deep))
    after = drag.answers[0].sample.choices
    assert drag.answers[0].kind == "least"
    assert after["a"] - a == pytest.approx(0.2, abs=1e-3)
    assert after["b"] - b == pytest.approx(0.8, abs=1e-3)
    assert after["deep"] == pytest.approx(deep, abs=1e-3)
    assert set(drag.answers[0].changed) <= {"a", "b", "deep"}


def test_the_end_of_a_range_is_the_reason() -> None:
    sample = nw.run(post, seed=1).best
    drag = sample.drag("top", (0.0, 0.5, 3.0))
    assert not drag.answers
    assert '"Deep" is at the end of its range (0 to 2)' in drag.reason
    assert drag.nearest is not None
    assert drag.nearest.distance == pytest.approx(1.0, abs=1e-2)
    assert drag.nearest.sample.choices["deep"] <= 2.0


def test_where_the_choices_cannot_go_is_the_reason() -> None:
    sample = nw.run(post, seed=1).best
    drag = sample.drag("top", (0.0, 0.8, 1.0))
    assert "within a surface only" in drag.reason
    assert drag.nearest is not None
    assert drag.nearest.distance == pytest.approx(0.3, abs=1e-3)


def test_held_choices_stay_to_the_bit_and_are_the_reason_where_all_are_held() -> None:
    sample = nw.run(post, seed=1).best
    a, b, deep = (sample.choices[name] for name in ("a", "b", "deep"))
    for n in range(20):
        drag = sample.drag("top", (a + b + 0.1 * n, 0.5, deep), hold=["b"])
        assert drag.best is not None
        assert drag.best.sample.choices["b"] == b
    held = sample.drag("top", (a + b + 1.0, 0.5, deep), hold=["*"])
    assert held.best is None
    assert held.reason == 'no free choice moves "Top": all 3 choices that move it are held ("A", "B", "Deep")'
    # Values by address are those of the run, and hold the same.
    expected = sample.drag("top", (a + b + 0.1, 0.5, deep), hold=["b"]).answers
    for hold in ("b", {"b": b}, sample.held("b")):
        answers = sample.drag("top", (a + b + 0.1, 0.5, deep), hold=hold).answers
        assert [answer.changed for answer in answers] == [answer.changed for answer in expected]
    with pytest.raises(InputError, match="hold"):
        sample.drag("top", (a, 0.5, deep), hold={"b": b + 1.0})
    # A search's own hold holds as well.
    bound = nw.run(post, seed=1, hold={"a": 0.25}).best.drag("top", (3.0, 0.5, deep))
    assert bound.best is not None
    assert bound.best.sample.choices["a"] == 0.25


def test_a_grabbed_point_turns_with_its_part() -> None:
    sample = nw.run(arm, seed=3).best
    angle, reach = sample.choices["angle"], sample.choices["reach"]
    grab = (reach * np.cos(angle) / 2, reach * np.sin(angle) / 2, 0.0)
    to = (1.2 * np.cos(0.2), 1.2 * np.sin(0.2), 0.0)
    answer = sample.drag("bone", to, grab=grab).answers[0]
    assert answer.sample.choices["angle"] == pytest.approx(0.2, abs=0.01)
    assert answer.sample.choices["reach"] == pytest.approx(2.4, abs=0.02)


def test_depth_does_not_count_along_a_direction() -> None:
    sample = nw.run(post, seed=1).best
    a, b = sample.choices["a"], sample.choices["b"]
    drag = sample.drag("top", (a + b + 0.5, 0.5, 7.0), along=(0, 0, 1))
    assert drag.answers
    assert drag.answers[0].sample.choices["deep"] == sample.choices["deep"]


@nw.model
def pile():
    """Boxes on each other: only their number brings the last one up."""
    count = poisson(3.0)
    side = gaussian(0.0, 0.2)
    for i in range(count):
        emit(box((side, i + 0.5, 0.0), (1, 1, 1)))


def test_structure_changes_where_that_is_the_only_way() -> None:
    sample = next(
        best for best in (nw.run(pile, seed=s).best for s in range(50)) if best.choices["count"] == 3
    )
    drag = sample.drag("i[2]/emit", (0.1, 3.5, 0.0))
    assert drag.answers[0].kind == "structure"
    assert drag.answers[0].sample.choices["count"] == 4
    assert drag.answers[0].part == "i[3]/emit"
    assert drag.answers[0].share <= NEAR
    held = sample.drag("i[2]/emit", (0.1, 3.5, 0.0), hold=["count"])
    assert not held.answers
    assert held.best.sample.choices["count"] == 3
    assert not sample.drag("i[2]/emit", (0.1, 3.5, 0.0), structure=False).answers


@nw.model
def column():
    """Boxes on each other, whose width moves none of their middles."""
    count = poisson(3.0)
    width = uniform(0.5, 1.5)
    for i in range(count):
        emit(box((0.0, i + 0.5, 0.0), (width, 1, 1)))


def test_a_part_of_another_structure_that_nothing_moves_has_its_distance() -> None:
    sample = next(
        best for best in (nw.run(column, seed=s).best for s in range(50)) if best.choices["count"] == 3
    )
    there = sample.drag("i[2]/emit", (0.0, 3.5, 0.0))
    assert there.answers[0].sample.choices["count"] == 4
    far = sample.drag("i[2]/emit", (9.0, 3.5, 0.0))
    assert not far.answers and far.best is not None
    assert far.best.distance == pytest.approx(9.0, abs=0.01) and "does not move it that way" in far.reason


@nw.model
def fork():
    """A choice that another one makes: the run has other choices on the other side of zero."""
    x = gaussian(1.0, 1.0)
    if x > 0:
        z = gaussian(0.0, 1.0)
    else:
        z = 0.0
    emit(box((x, 0.5, z), (1, 1, 1)))


def test_a_branch_that_changes_under_the_move_is_run_again() -> None:
    sample = next(best for best in (nw.run(fork, seed=s).best for s in range(20)) if "z" in best.choices)
    drag = sample.drag("emit", (-1.0, 0.5, 0.0))
    assert drag.best is not None
    assert ("z" in drag.best.sample.choices) == (drag.best.sample.choices["x"] > 0)


@nw.model
def fixed():
    """Nothing moves it."""
    wide = flip(0.5)
    emit(box((0, 0, 0), (2 if wide else 1, 1, 1)))


def test_what_no_choice_moves_says_so() -> None:
    drag = nw.run(fixed, seed=1).best.drag("emit", (1, 0, 0))
    assert drag.best is None
    assert "its place follows from the source" in drag.reason


def test_bad_drags_are_refused() -> None:
    sample = nw.run(post, seed=1).best
    with pytest.raises(InputError, match="no-address"):
        sample.drag("tpo", (0, 0, 0))
    with pytest.raises(InputError, match="bad-setting"):
        sample.drag("top", (0, 0, float("nan")))


def test_a_mean_that_moves_takes_its_choice_along() -> None:
    sample = nw.run(arm, 2.0, seed=3).best
    positions = sample.search.task.placer(sample._run).positions({}, set(), arguments={0: 2.0})
    assert [movable[0] for movable in positions.movables] == [0]
    angle, reach = sample.choices["angle"], sample.choices["reach"]
    np.testing.assert_allclose(
        positions.slopes(1, 0, (0, 0, 0))[:, 0], [np.cos(angle), np.sin(angle), 0.0], atol=1e-12
    )
    assert list(positions.followed([2.5]).values()) == pytest.approx([reach + 0.5])
