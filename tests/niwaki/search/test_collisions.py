"""Claim: every part that breaks a constraint is found, and no other."""

from __future__ import annotations

from niwaki import Search, box, emit, floor, model, no_self_intersection, uniform
from niwaki.draw.scene import Scene
from niwaki.search.collisions import breaking, example


def test_pairs_that_collide_and_parts_that_break_a_rule_alone_are_named() -> None:
    places = {"a": (0, 0, 0), "b": (0.5, 0, 0), "c": (5, 0, 0), "d": (9, -5, 0), "e": (9.5, -5, 0)}
    scene = Scene([(name, [box(at, (1, 1, 1))]) for name, at in places.items()])
    apart = no_self_intersection()
    assert breaking(scene, apart.specs) == ["a", "b", "d", "e"]
    assert breaking(scene, floor(-2).specs) == ["d", "e"]
    assert breaking(scene, (apart * floor(-2)).specs) == ["a", "b", "d", "e"]
    assert breaking(scene, floor(-9).specs) == []


@model
def sometimes():
    emit(box((0, 0, 0), (1, 1, 1)), name="one")
    emit(box((uniform(0.0, 10.0), 0, 0), (1, 1, 1)), name="two")


def test_a_run_that_breaks_a_constraint_is_found_among_those_that_do_not() -> None:
    collision = example(Search(sometimes, score=no_self_intersection(), seed=3))
    assert collision is not None
    scene, parts = collision
    assert parts == ["one", "two"] and len(scene) == 2
    # By hand: the middles of two unit boxes that overlap are less than 1 apart.
    assert scene.parts[1].shapes[0].vertices()[:, 0].min() < 0.5
    assert example(Search(sometimes, score=floor(-9.0), seed=3)) is None
