"""Calls in frames: where shapes go, messages with a caret, the same shapes after drags, and addresses."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from niwaki import (
    arrayed,
    box,
    disc,
    emit,
    forward,
    gaussian,
    limb,
    mirrored,
    model,
    place,
    rotation,
    run,
    run_python,
    uniform,
    vec,
)
from niwaki.errors import ModelError, ModelFault
from niwaki.targets.sketches import no_self_intersection
from niwaki.words import Frame, linspace, look, smoothstep


def leg(height: float) -> float:
    """A leg that leans."""
    lean = gaussian(0.0, 0.1)
    emit(box((lean, height / 2, 0), (0.1, height, 0.1)), name="leg")
    return lean


@model
def stool() -> Any:
    """Three legs around, and two reflected ones."""
    turned = [((1, 0, 0), rotation((0, 1, 0), k)) for k in range(3)]
    return arrayed(turned, leg, 1.0), mirrored("x", leg, 2.0), place((0, 5, 0), leg, 1.0)


def test_each_call_draws_its_own_choices_at_its_own_address() -> None:
    sample = run(stool, seed=1).best
    names = [
        *(f"arrayed[{k}]/leg/lean" for k in range(3)),
        "mirrored[0]/leg/lean",
        "mirrored[1]/leg/lean",
        "leg/lean",
    ]
    assert list(sample.choices) == names and len(set(sample.choices.values())) == 6
    assert list(sample.value[0]) == [sample.choices[name] for name in names[:3]]
    left, right = (part for part in sample.parts if part.address.startswith("mirrored"))
    (a, b), (c, d) = left.shapes[0].aabb(), right.shapes[0].aabb()
    assert a[0] + b[0] == pytest.approx(2 * sample.choices["mirrored[0]/leg/lean"])
    # Reflected: its own lean, to the other side.
    assert c[0] + d[0] == pytest.approx(-2 * sample.choices["mirrored[1]/leg/lean"])
    assert run_python(stool, choices=sample.choices).scene[-1][1] == list(sample.parts[-1].shapes)


def branch(depth: int, reach: float) -> None:
    """A chain of frames, each in the one before."""
    turn = uniform(-0.5, 0.5)
    emit(limb((0, 0, 0), (0, reach, 0), 0.1, 0.1, joint="round"), name="bone")
    if depth > 0:
        place((vec(0, reach, 0), rotation((0, 0, 1), turn)), branch, depth - 1, reach)


@model
def finger() -> None:
    """Bones of one length, which is a choice, in frames of angles."""
    reach = uniform(1.0, 2.0)
    place((1, 0, 0), branch, 3, reach)


def test_positions_in_frames_have_the_slopes_of_central_differences() -> None:
    sample = run(finger, seed=2).best
    placer, free = sample.search.task.placer(sample._run), {c.address for c in sample._trace.choices}
    positions, shares, h = placer.positions({}, free), np.array((0.0, 0.5, 0.0)), 1e-4
    moving = 0
    for part in range(4):
        slopes = positions.slopes(part, 0, tuple(shares))
        assert slopes is not None
        frame = positions.frame(part, 0)
        low, high = np.array(sample.parts[part].shapes[0].aabb())
        assert np.all(low - 1e-9 <= frame[0]) and np.all(frame[0] <= high + 1e-9)
        for k, movable in enumerate(positions.movables):
            at = [
                placer.positions({movable[0]: positions.ranges()[k, 0] + by}, free).frame(part, 0)
                for by in (h, -h)
            ]
            up, down = (frame[0] + shares @ frame[1:] for frame in at)
            np.testing.assert_allclose(slopes[:, k], (up - down) / (2 * h), atol=1e-6)
            moving += bool(np.any(slopes[:, k]))
    assert moving > 8


def test_a_dragged_part_in_a_frame_arrives() -> None:
    sample = run(finger, seed=2).best
    tip = sample.parts[-1]
    point = np.mean(tip.shapes[0].aabb(), axis=0) + (0.2, -0.1, 0.0)
    drag = sample.drag(tip.address, tuple(point))
    assert drag.answers, drag.reason
    moved = drag.answers[0].sample.parts[-1].shapes[0].aabb()
    np.testing.assert_allclose(np.mean(moved, axis=0)[:2], point[:2], atol=0.05)


def test_collisions_are_those_of_placed_shapes() -> None:
    @model
    def two(apart: float) -> None:
        arrayed([(0, 0, 0), (apart, 0, 0)], leg, 1.0)

    upright = {"arrayed[0]/leg/lean": 0.0, "arrayed[1]/leg/lean": 0.0}
    scores = {
        apart: run(two, apart=apart, choices=upright, score=no_self_intersection()).best.log_score
        for apart in (0.0, 0.05, 9.0)
    }
    assert scores == {0.0: -np.inf, 0.05: -np.inf, 9.0: 0.0}


@model
def number() -> Any:
    """No frame."""
    return place(1.0, leg, 1.0)


@model
def skewed() -> Any:
    """Directions that are not at right angles."""
    return place(Frame((0, 0, 0), (1, 0, 0), (1, 1, 0), 1.0), leg, 1.0)


@model
def sideways() -> Any:
    """No axis."""
    return mirrored("w", leg, 1.0)


def blot() -> None:
    """A flat shape."""
    emit(disc((0, 0, 0), 1.0))


@model
def tilted() -> None:
    """A flat shape out of its plane."""
    place(rotation((1, 0, 0), 1.0), blot)


@pytest.mark.parametrize(
    ("wrong", "code", "message"),
    [
        (number, "type-mismatch", "`place` takes a point, a rotation, a pair of both, or a `Frame`, found"),
        (skewed, "bad-argument", "`forward` and `up` of a frame have the length 1 and are at right angles"),
        (sideways, "type-mismatch", '`mirrored` takes "x", "y", "z" or a direction as its axis, found'),
        (tilted, "bad-shape", "a flat shape lies on a plane parallel to z = 0"),
    ],
    ids=lambda value: getattr(value, "name", None),
)
def test_wrong_frames_are_reported_at_the_call(wrong: Any, code: str, message: str) -> None:
    for go in (lambda: run_python(wrong, seed=1), lambda: run(wrong, forward(1), seed=1)):
        with pytest.raises(ModelFault) as fault:
            go()
        assert fault.value.code == code
        assert message in str(fault.value) and "^^^^" in str(fault.value)


def test_calls_without_a_function_or_with_keywords_are_refused() -> None:
    @model
    def nothing() -> None:
        place((0, 0, 0))  # type: ignore[call-arg]

    @model
    def keyword() -> None:
        arrayed([(0, 0, 0)], leg, height=1.0)  # type: ignore[call-arg]

    with pytest.raises(ModelError, match="`place` takes a frame and a function, found 1"):
        nothing.core()
    with pytest.raises(ModelError, match="pass the value by position"):
        keyword.core()


def test_a_look_turns_with_its_frame() -> None:
    """A guide sees a look of a placed function in the world: it is the place of a guide's picture."""

    @model
    def ahead() -> Any:
        frame = look((1, 0, 0), (0, 0, 1), up=(0, 1, 0))
        return place(frame, leg, 1.0)

    lean = run(ahead, seed=4).best
    (low, high) = lean.parts[0].shapes[0].aabb()
    assert (low[0] + high[0]) / 2 == pytest.approx(1.0 + lean.choices["leg/lean"])


def test_numbers_between() -> None:
    assert linspace(0, 1, 3) == [0.0, 0.5, 1.0] and linspace(2, 9, 1) == [2.0]
    assert [smoothstep(x, 1.0, 3.0) for x in (0, 1, 2, 3, 4)] == [0.0, 0.0, 0.5, 1.0, 1.0]
    with pytest.raises(ValueError, match="1 number or more"):
        linspace(0, 1, 0)
