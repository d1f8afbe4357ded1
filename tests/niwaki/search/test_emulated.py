"""Claims: a model whose choices come before its scene, or whose parts are made by host functions, is searched by an
emulator; its result is an ordinary one; what it cannot search is refused with the reason."""

from __future__ import annotations

import json

import niwaki as nw
import pytest
from niwaki.errors import InputError
from niwaki.methods import Emulate, Improve
from niwaki.search import Search, emulated, grow_search


@nw.model
def desk():
    wide = nw.uniform(0.8, 2.0)
    deep = nw.uniform(0.5, 1.2)
    tall = nw.uniform(0.5, 1.1)
    thick = nw.uniform(0.03, 0.15)
    stand = nw.choose(["column", "slabs"])
    parts = [nw.box((0, tall - thick / 2, 0), (wide, thick, deep))]
    if stand == "column":
        leg = nw.uniform(0.05, 0.4)
        parts = parts + [nw.box((0, (tall - thick) / 2, 0), (leg, tall - thick, leg))]
    else:
        for side in (-1, 1):
            parts = parts + [
                nw.box((side * (wide / 2 - 0.05), (tall - thick) / 2, 0), (0.1, tall - thick, deep))
            ]
    nw.emit(parts)


@nw.model
def step_by_step():
    for number in range(4):
        wide = nw.uniform(0.2, 1.0)
        nw.emit(nw.box((0, 0.3 * number, 0), (wide, 0.3, wide)))


@nw.model
def of_weighted_words():
    wide, deep, tall = nw.uniform(0.8, 2.0), nw.uniform(0.5, 1.2), nw.uniform(0.5, 1.1)
    form = nw.choose({"roof": 1, "block": 3})
    nw.emit(
        nw.box((0, tall / 2, 0), (wide, tall, deep))
        if form == "block"
        else nw.wedge((0, tall / 2, 0), (wide, tall, deep))
    )


@nw.host
def slab(wide: float, y: float):
    return nw.box((0, y, 0), (wide, 0.3, wide))


@nw.model
def by_host():
    for number in range(4):
        nw.emit(slab(nw.uniform(0.2, 1.0), 0.3 * number))


@nw.model
def of_a_drawn_range():
    tall = nw.uniform(0.5, 1.0)
    share = nw.uniform(0, tall)
    wide = nw.uniform(0.2, 1)
    deep = nw.uniform(0.2, 1)
    nw.emit(nw.box((0, tall / 2, share), (wide, tall, deep)))


@nw.model
def scored():
    wide, tall, deep, place = nw.uniform(0, 1), nw.uniform(0, 1), nw.uniform(0, 1), nw.uniform(0, 1)
    nw.factor(-wide)
    nw.emit(nw.box((place, 0, 0), (wide, tall, deep)))


def target(model, seed):
    scene = nw.run(model, seed=seed).best.scene
    return nw.Target.of_shapes(*[shape for part in scene.parts for shape in part.shapes])


def chosen(model, goal, **settings):
    return type(grow_search(model, goal, rule="none", seed=1, **settings).method)


def test_the_program_chooses_the_engine():
    block = target(desk, 3)
    assert chosen(desk, block) is Emulate
    assert chosen(by_host, block) is Emulate
    assert chosen(step_by_step, block) is Improve
    # A factor is one number: nothing to learn from.
    assert chosen(scored, block) is Improve
    assert chosen(desk, block, engine="sampler") is Improve
    assert chosen(desk, block, rounds=3) is Improve
    assert chosen(step_by_step, block, engine="emulator") is Emulate
    assert chosen(desk, None, score=nw.overshoot(block) * nw.floor(0.0)) is Emulate


def test_few_runs_find_hidden_choices_and_the_result_is_an_ordinary_one():
    goal = target(desk, 3)
    result = nw.grow(desk, goal, rule="none", evaluations=60, seed=1)
    best = result.best
    assert best.log_score > 5.5 and best.choices["stand"] == nw.run(desk, seed=3).best.choices["stand"]
    assert result.info.evaluations == 60 and result.info.best_at < 60
    assert nw.run(desk, choices=best.choices).best.choices == best.choices
    data = json.loads(result.search.json())
    assert data["method"] == {"method": "emulate", "evaluations": 60, "diverse": None}
    again = Search.of_json(result.search.json()).run()
    assert again.best.choices == best.choices and again.best.log_score == best.log_score


def test_words_with_weights_are_searched():
    goal = target(of_weighted_words, 3)
    result = nw.grow(of_weighted_words, goal, rule="none", engine="emulator", evaluations=40, seed=1)
    assert result.info.choices == 4
    assert result.best.choices["form"] == nw.run(of_weighted_words, seed=3).best.choices["form"]
    assert nw.run(of_weighted_words, choices=result.best.choices).best.choices == result.best.choices


def test_held_choices_stay_and_several_results_differ():
    goal = target(desk, 3)
    result = nw.grow(desk, goal, rule="none", evaluations=40, diverse=3, seed=2, hold={"wide": 1.25})
    assert len(result) == 3
    assert {sample.choices["wide"] for sample in result} == {1.25}


def test_a_host_function_that_fails_is_an_invalid_run():
    @nw.host
    def fragile(wide: float):
        if wide > 0.7:
            raise ValueError("too wide")
        return nw.box((0, 0, 0), (wide, 0.3, 0.3))

    @nw.model
    def fragile_block():
        nw.emit(fragile(nw.uniform(0.2, 1.0)))

    goal = nw.Target.of_shapes(nw.box((0, 0, 0), (0.6, 0.3, 0.3)))
    result = nw.grow(fragile_block, goal, rule="none", evaluations=24, seed=1)
    assert result.best.log_score > 5.0
    (invalid,) = result.invalid
    assert invalid.name == "fragile" and 0 < invalid.runs < 24


@pytest.mark.parametrize(
    ("model", "settings", "reason"),
    [
        (
            of_a_drawn_range,
            {"engine": "emulator"},
            r"the range of its choice `share` differs from run to run",
        ),
        (desk, {"evaluations": 10, "particles": 4}, r"nothing of the sampler"),
        (desk, {"evaluations": 10, "engine": "sampler"}, r"nothing of the sampler"),
        (desk, {"engine": "clock"}, r'"auto" or "sampler" or "emulator"'),
        (desk, {"evaluations": 0}, r"evaluations"),
    ],
)
def test_what_no_emulator_can_search_is_refused(model, settings, reason):
    with pytest.raises(InputError, match=reason):
        grow_search(model, target(desk, 3), rule="none", seed=1, **settings)


def test_a_score_without_differences_is_refused_and_so_is_a_search_inside():
    with pytest.raises(InputError, match="nothing to learn from but one number"):
        nw.run(desk, nw.emulate(10), seed=1)

    @nw.model
    def outer():
        return nw.infer(desk, nw.emulate(10))

    with pytest.raises(nw.NiwakiError, match="emulate"):
        nw.run(outer, seed=1)


def test_all_families_of_numbers_have_places():
    @nw.model
    def many():
        a, b, c = nw.beta(2, 3), nw.gamma(2, 1), nw.truncated_gaussian(0.5, 0.2, 0, 1)
        d, e = nw.poisson(3), nw.binomial(4, 0.5)
        nw.emit(nw.box((0, 0, 0), (a + 0.1, b + 0.1, c + 0.1 * d + 0.1 * e)))

    search = grow_search(many, target(desk, 3), rule="none", seed=1, engine="emulator")
    space = emulated.structure(search, search.task, 1).space
    for axis in space.axes:
        for place in (0.1, 0.5, 0.9):
            assert abs(axis.place(axis.value(place)) - place) < (0.2 if axis.range is None else 1e-9)
