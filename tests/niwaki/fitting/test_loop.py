"""A loop that asks and tells finds the parameters of a model, whoever evaluates it, and its answers fit its archive."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import _engine, fitting
from niwaki.draw.scene import Scene
from niwaki.errors import InputError
from niwaki.fitting import Answer, Failure, FitLoop, Goal, Outcome, number
from niwaki.search import Parameter, Space
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Gaussian, LogNormal, Uniform

SPACE = {
    "width": Uniform(0.5, 2.0),
    "height": Uniform(0.5, 2.0),
    "depth": Uniform(0.5, 2.0),
    "knob": Bernoulli(),
    "knob_height": Parameter(Uniform(0.1, 1.0), when={"knob": True}),
    "teeth": DiscreteUniform(0, 5),
    "side": ["left", "right"],
}

HIDDEN = {
    "width": 1.3,
    "height": 1.1,
    "depth": 0.8,
    "knob": True,
    "knob_height": 0.5,
    "teeth": 3,
    "side": "right",
}


def built(p: dict[str, Any]) -> list[_engine.Shape]:
    """A block with teeth at a side, and perhaps a knob."""
    w, h, sign = p["width"], p["height"], 1 if p["side"] == "right" else -1
    out = [nw.box((0, h / 2, 0), (w, h, p["depth"]))]
    if p["knob"]:
        out.append(nw.box((0, h + p["knob_height"] / 2, 0), (0.3, p["knob_height"], 0.3)))
    for tooth in range(p["teeth"]):
        out.append(nw.box((sign * (w / 2 + 0.1), h * (tooth + 0.5) / p["teeth"], 0), (0.2, 0.12, 0.4)))
    return out


def target(p: dict[str, Any]) -> nw.Target:
    shapes = built(p)
    starts = np.cumsum([0, *(len(shape.vertices()) for shape in shapes)])
    faces = [shape.faces() + start for shape, start in zip(shapes, starts, strict=False)]
    return nw.Target(np.concatenate([shape.vertices() for shape in shapes]), np.concatenate(faces))


@pytest.fixture(scope="module")
def goal() -> Goal:
    return Goal.of(nw.match_volume(target(HIDDEN), voxel=0.06))


def run(loop: FitLoop, count: int) -> FitLoop:
    while loop.evaluated < count:
        for point in loop.ask(4):
            loop.tell(point, built(point.parameters))
    return loop


@pytest.fixture(scope="module")
def searched(goal: Goal) -> FitLoop:
    return run(FitLoop(SPACE, goal, seed=1), 120)


def test_hidden_parameters_are_found(searched: FitLoop):
    best = searched.best
    assert best.parameters.keys() == HIDDEN.keys()
    assert {name: best.parameters[name] for name in ("knob", "teeth", "side")} == {
        "knob": True,
        "teeth": 3,
        "side": "right",
    }
    assert all(abs(best.parameters[name] - HIDDEN[name]) < 0.06 for name in ("width", "height", "depth"))
    assert best.iou is not None and best.iou > 0.95


def test_told_in_any_order_by_anybody_the_search_is_the_same(goal: Goal, searched: FitLoop):
    loop = FitLoop(SPACE, goal, seed=1)
    rng = np.random.default_rng(0)
    while loop.evaluated < 60:
        loop.ask(5)
        point = loop.pending[int(rng.integers(len(loop.pending)))]
        # An outcome that was measured in another process.
        outcome = goal.measure(Scene([("part", built(point.parameters))]))
        loop.tell(point.number, outcome)
    for ours, theirs in zip(loop.points, searched.points, strict=False):
        assert ours == theirs


def test_a_point_is_told_once(goal: Goal):
    loop = FitLoop(SPACE, goal)
    (point,) = loop.ask()
    loop.tell(point, Failure("no such part"))
    with pytest.raises(InputError, match="pending"):
        loop.tell(point, built(HIDDEN))
    with pytest.raises(InputError, match="pending"):
        loop.tell(99, built(HIDDEN))


def test_the_table_has_a_row_for_each_evaluation(goal: Goal, tmp_path: Path):
    loop = FitLoop(SPACE, goal)
    first, second = loop.ask(2)
    loop.tell(second, Failure("the knob is too thin"))
    assert loop.evaluated == 0
    loop.tell(first, built(first.parameters))
    rows = loop.answers.table(tmp_path / "table.csv")
    assert [row["number"] for row in rows] == [0, 1]
    assert rows[1]["failure"] == "the knob is too thin" and rows[1]["log_score"] is None
    assert rows[0]["width"] == first.parameters["width"] and rows[0]["iou"] is not None
    with (tmp_path / "table.csv").open() as file:
        assert [row["failure"] for row in csv.DictReader(file)] == ["", "the knob is too thin"]
    with pytest.raises(InputError, match="csv"):
        loop.answers.table(tmp_path / "table.doc")


def test_variants_are_of_each_kind_and_far_apart(searched: FitLoop):
    answers = searched.answers
    variants = answers.variants(20, loss=2.0)
    assert variants[0] == answers.best
    assert all(answer.log_score >= answers.best.log_score - 2.0 for answer in variants)

    def kind(answer: Answer) -> tuple[Any, ...]:
        return tuple(answer.parameters.get(name) for name in ("knob", "teeth", "side"))

    good = [answer for answer in answers if answer.log_score >= answers.best.log_score - 2.0]
    kinds = {kind(answer) for answer in good}
    assert 1 < len(kinds) < 20 < len(good)
    assert [kind(answer) for answer in variants[: len(kinds)]] == list(dict.fromkeys(map(kind, good)))

    def nearest(chosen: list[Answer]) -> float:
        rows = np.array([searched.points[answer.number].row for answer in chosen])
        apart = np.linalg.norm(rows[:, None] - rows[None], axis=2) + 9 * np.eye(len(rows))
        return float(apart.min())

    assert len(variants) == 20
    assert nearest(variants) > 3 * nearest(good[:20])


def test_intervals_hold_the_hidden_parameters(searched: FitLoop):
    for name in ("width", "height", "depth", "knob_height"):
        interval = searched.answers.interval(name, 0.98)
        assert interval.identified
        assert interval.low is not None and interval.high is not None
        assert interval.low <= HIDDEN[name] <= interval.high
        assert interval.high - interval.low < 0.7
    teeth = searched.answers.interval("teeth", 0.98)
    assert teeth.levels is not None and max(teeth.levels, key=teeth.levels.__getitem__) == 3
    with pytest.raises(InputError, match="width"):
        searched.answers.interval("weight")


def test_a_parameter_without_effect_is_not_identified(goal: Goal):
    loop = FitLoop({"idle": Uniform(0, 1), **SPACE}, goal, seed=2)
    run(loop, 70)
    idle = loop.answers.interval("idle")
    assert not idle.identified
    assert "does not tell" in str(idle)
    assert loop.answers.sensitivity()[-1].name == "idle"


def test_sensitivity_names_the_parts_that_move(searched: FitLoop):
    effects = {effect.name: effect for effect in searched.answers.sensitivity()}
    assert effects.keys() == HIDDEN.keys()
    knob, width = effects["knob_height"].blocks, effects["width"].blocks
    assert knob is not None and width is not None
    # The knob is on top; a wider block changes at its sides.
    assert np.abs(knob).sum((0, 2)).argmax() >= knob.shape[1] - 4
    assert np.abs(width).sum((1, 2)).argmax() not in range(width.shape[0] // 3, 2 * width.shape[0] // 3)
    knobs = effects["knob"].blocks
    # When a parameter grows, and when a switch goes on, the blocks gain.
    assert width.sum() > 0 and knobs is not None and knobs.sum() > 0
    assert effects["knob"].values == (False, True) and str(effects["knob"]) == "knob: False to True"
    assert effects["width"].values[0] < searched.best.parameters["width"] < effects["width"].values[1]
    picture = np.asarray(searched.answers.picture())
    assert picture.shape[1] > 100 and (picture == fitting.effects.MORE).all(2).any()


def test_what_sticks_out_of_the_target_counts_as_much_as_what_is_missing():
    def length(width: float) -> float:
        scene = Scene([("block", [nw.box((0, 0.5, 0), (width, 1, 1))])])
        return float(np.linalg.norm(goal.measure(scene).features))

    goal = Goal.of(nw.match_volume(nw.Target.of_shapes(nw.box((0, 0.5, 0), (2, 1, 1)))))
    # Ten cells more are outside of the grid; ten cells less are not.
    assert 0.7 < length(2.5) / length(1.5) < 1.4
    assert 1.3 < length(2.5) / length(2.25) < 2.3
    assert length(2.0) == 0.0 and length(40.0) < 10 * length(1.0)


def test_goals_of_every_kind_have_differences():
    block = target({**HIDDEN, "knob": False})
    image = np.zeros((40, 60), np.uint8)
    image[10:30, 20:40] = 255
    camera = nw.Camera.orthographic((0, 1, 8), (0, 1, 0), height=4.0)
    scores = [
        nw.match_volume(block, voxel=0.1),
        nw.avoid(block, voxel=0.1),
        nw.floor(0.2),
        nw.overshoot(((-1, 0, -1), (1, 1, 1))),
        nw.match_drawing(image, ((-1, -1), (1, 2))),
        nw.match_image(image, camera),
        nw.match_shadow(image, (0, -1, 0), nw.targets.target.Receiver(block.vertices, block.faces)),
        nw.limits((5.0, 6.0), ((-1, 0, -1), (1, 1, 1))),
        nw.fill_drawing(((-1, -1), (1, 2))),
    ]
    scene = Scene([("part", built(HIDDEN))])
    for score in scores:
        outcome = Goal.of(score).measure(scene)
        assert len(outcome.features) and np.abs(outcome.features).max() > 0, score
        assert len(Goal.of(score).measure(Scene([])).features) == len(outcome.features)
    assert [Goal.of(score).without for score in scores] == [()] * 8 + [("fill_drawing",)]
    product = Goal.of(scores[0] * scores[2]) * number("height", 2.0, 0.1)
    assert len(product.measure(scene).features) == sum(product.sizes) + 1
    assert Goal.of(nw.no_self_intersection()).without == ("no_self_intersection",)


def test_a_scene_that_matches_has_no_differences(goal: Goal):
    exact = goal.measure(Scene([("part", built(HIDDEN))]))
    empty = goal.measure(Scene([]))
    assert np.abs(exact.features).max() < 0.02 * np.abs(empty.features).max()
    assert exact.score > 5.5 and empty.score < -50
    assert exact.covered == 1.0


def test_differences_are_in_nats_of_the_score_of_balanced_cells():
    empty = Scene([])
    plain, balanced = (
        Goal.of(nw.match_volume(target(HIDDEN), voxel=0.06, weight=weight))
        for weight in ("cells", "balanced")
    )
    # By the deviation of each the whole target is missing: its share of all cells, and all of it.
    share = 1.0 - _engine.Sketch(plain.score.specs).similarity()
    ratio = (1.0 / (5 * 0.02)) / (share / 0.02)
    assert balanced.measure(empty).features == pytest.approx(ratio * plain.measure(empty).features, rel=1e-6)


def test_numbers_are_scored_by_their_tolerance():
    goal = (
        number("volume", 2.0, 0.1)
        * number("cost", 5.0, 0.5)
        * number(lambda scene: len(scene), 1, 0.5, "parts")
    )
    scene = Scene([("part", [nw.box((0, 0, 0), (1, 1, 2.2))])])
    outcome = goal.measure(scene, {"cost": 6.0})
    assert np.allclose(outcome.features, [2.0, 2.0, 0.0], atol=1e-5)
    assert outcome.numbers["cost"] == 6.0
    assert outcome.score == pytest.approx(-4.0 - np.log(0.1 * 0.5 * 0.5) - 1.5 * np.log(2 * np.pi))
    with pytest.raises(InputError, match="cost"):
        goal.measure(scene)


def test_a_loop_finds_a_number_alone():
    loop = FitLoop({"r": Uniform(0.1, 3), "h": Uniform(0.1, 3)}, number("volume", 4.0, 0.01))
    while loop.evaluated < 40:
        for point in loop.ask():
            loop.tell(point, nw.box((0, 0, 0), (point.parameters["r"], point.parameters["h"], 1)))
    assert abs(loop.best.numbers["volume"] - 4.0) < 0.02


def test_values_of_all_ranges_return_to_their_places():
    space = Space(
        {
            "a": Uniform(-2, 6),
            "b": Gaussian(1, 2),
            "c": LogNormal(0, 1),
            "d": DiscreteUniform(-2, 3),
            "e": Bernoulli(0.2),
            "f": ["x", "y", 3],
            "g": Parameter(Uniform(0, 1), when=[{"d": [2, 3]}, {"e": True, "f": ["x", 3]}]),
        }
    )
    for row in np.random.default_rng(0).random((30, 7)):
        proposer = _engine.Proposer(json.dumps(space.data()), 0)
        canonical, used = proposer.snap(row.tolist())
        values = space.values(canonical, used)
        assert ("g" in values) == (values["d"] >= 2 or (values["e"] and values["f"] in ("x", 3)))
        again, used_again = space.row(values)
        assert used_again == used
        assert np.allclose(again, canonical, atol=1e-9)


@pytest.mark.parametrize(
    ("parameters", "words"),
    [
        ({}, "at least one parameter"),
        ({"a": Uniform(2, 2)}, "lower one first"),
        ({"a": Uniform(0, float("nan"))}, "finite"),
        ({"a": DiscreteUniform(3, 1)}, "whole numbers"),
        ({"a": Gaussian(0, 0)}, "above 0"),
        ({"a": 3.0}, "a distribution"),
        ({"a": []}, "a distribution"),
        ({"a": Parameter(Uniform(0, 1), when={"b": True})}, "before it"),
        ({"b": Uniform(0, 1), "a": Parameter(Uniform(0, 1), when={"b": 0.5})}, "real"),
        ({"b": Bernoulli(), "a": Parameter(Uniform(0, 1), when={"b": 7})}, "values of `b`"),
        ({"a": Bernoulli(1.5)}, "probability"),
    ],
)
def test_bad_parameters_are_refused(parameters: dict[str, Any], words: str):
    with pytest.raises(InputError, match=words):
        Space(parameters)


def test_what_is_no_scene_is_refused(goal: Goal):
    loop = FitLoop(SPACE, goal)
    (point,) = loop.ask()
    with pytest.raises(InputError, match="vertices"):
        loop.tell(point, "a chair")
    assert isinstance(loop.tell(point, None), Outcome)


def test_a_model_without_conditions_tells_what_it_used(goal: Goal):
    flat = {name: value.range if isinstance(value, Parameter) else value for name, value in SPACE.items()}
    loop = FitLoop(flat, goal, seed=1)
    wasted = []
    while loop.evaluated < 100:
        for point in loop.ask():
            used = [name for name in SPACE if name != "knob_height" or point.parameters["knob"]]
            wasted.append(set(used) != set(point.parameters))
            loop.tell(point, built({"knob_height": 0.5, **point.parameters}), used=used)
    assert sum(wasted[:10]) >= 3 and sum(wasted[50:]) <= 5
    assert loop.best.log_score > 5.5
