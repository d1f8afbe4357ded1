"""Levels in `improve`: counts, iterations and recursions have one more or less, and what stands is held.

The programs differ in what may go wrong: a held count, conditions, invalid runs, iterations that differ in their
choices, loops in loops, two loops of one count, memoised calls, and nothing that could have a level.
"""

import niwaki as nw
import pytest
from niwaki import condition, discrete_uniform, emit, factor, flip, future, gaussian, mem, uniform
from niwaki.result.info import ImproveInfo
from niwaki.words import box


@nw.model
def steps(most=9):
    """A stair of a number of steps that is drawn first; the score wants five, each at a height of its own."""
    count = discrete_uniform(1, most)
    heights = [uniform(0.0, 1.0) for _ in range(count)]
    factor(-3.0 * abs(count - 5))
    for k, height in enumerate(heights):
        factor(-20.0 * abs(height - 0.15 * k))


@nw.model
def mixed():
    """Rows of one count: iterations that differ in their choices, and a sum that must not be too large."""
    count, total = discrete_uniform(1, 4), 0.0
    for _ in range(count):
        for _ in range(count):
            total = total + (uniform(0.0, 1.0) if flip(0.5) else abs(gaussian(0.0, 1.0)))
    condition(total < 8.0)
    factor(-abs(total - 7.5))


@nw.model
def invalid():
    """Boxes whose widths may be negative: such runs are invalid."""
    for k in range(discrete_uniform(1, 5)):
        emit(box((2.0 * k, 0.0, 0.0), (gaussian(0.8, 0.6), 1.0, 1.0)))
        factor(1.0)


@nw.model
def chain():
    """A recursion that wants many levels."""
    link(0.0)


@nw.model
def link(x):
    """Add a level, perhaps a future beside it, and perhaps the next."""
    y = x + uniform(0.0, 1.0)
    factor(-abs(y - 6.0) + abs(x - 6.0))
    future(beside)
    if flip(0.5):
        link(y)


@nw.model
def beside():
    """Perhaps a number."""
    if flip(0.5):
        factor(-uniform(0.0, 0.1))


@nw.model
def hedge(height):
    """A row of boxes from the origin on, which is decided box by box."""
    bush(0.0, height, 0)


@nw.model
def bush(x, height, number):
    """Add a box, perhaps a box behind it, and perhaps the next."""
    length = uniform(1.0, 3.0)
    emit(box((x + 0.5 * length, 0.0, 0.0), (0.9 * length, 1.0, 0.5)))
    if flip(0.5):
        emit(box((x + 0.5 * length, 0.0, 2.0), (0.5 * length, height * uniform(0.5, 1.0), 0.5)))
    if number < 6 and flip(0.8):
        bush(x + length, height, number + 1)


@nw.model
def shared():
    """A memoised choice in a loop: no part can be grown again."""
    size = mem(draw_size)
    total = 0.0
    for k in range(discrete_uniform(1, 6)):
        total = total + size(k % 2) + uniform(0.0, 0.1)
    factor(-10.0 * abs(total - 3.0))


@nw.model
def draw_size(kind):
    """The size of a kind."""
    return uniform(0.0, 1.0) + kind


@nw.model
def plain():
    """Two real numbers: there are no levels."""
    factor(-abs(uniform(0.0, 1.0) + uniform(0.0, 1.0) - 1.0))


MODELS = [steps, mixed, invalid, chain, shared]


def searched(model: nw.Model, threads: int = 1, **settings) -> nw.Result:
    """A short search."""
    method = nw.improve(particles=20, regrow=4, rounds=30)
    return nw.run(model, method=method, seed=3, threads=threads, **settings)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.name)
def test_a_search_with_levels_repeats_itself_and_its_result_is_a_run(model: nw.Model) -> None:
    first, second = searched(model), searched(model, threads=2)
    assert first.best.choices == second.best.choices and first.info == second.info
    levels = [each for each in first.info.rounds if each.step == "levels"]
    assert levels and all(each.work > 0 for each in levels)
    bests = [each.best for each in first.info.rounds]
    assert bests == sorted(bests) and bests[-1] == first.best.log_score
    assert first.best._trace.run.log_score == first.best.log_score


def test_levels_find_the_number_that_the_score_wants() -> None:
    assert len(searched(steps).best.choices) == 6
    assert len([name for name in searched(chain).best.choices if name.endswith("y")]) >= 6


def test_a_round_counts_its_own_work_alone() -> None:
    """A round has the work of its own chains, and none of that before them, though chains hand their state on."""
    tall = nw.Target(*nw.run(hedge, 6.0, choices={}, seed=12).best.scene.merged(), "hedge")
    score = nw.no_self_intersection() * nw.match_volume(tall)
    result = nw.run(hedge, 3.0, method=nw.improve(20, 6, rounds=400), score=score, seed=3)
    assert isinstance(result.info, ImproveInfo)
    works: dict[str, list[int]] = {}
    for entry in result.info.rounds:
        works.setdefault(entry.step, []).append(entry.work)
    assert max(works["move"]) < 3 * min(works["move"])
    assert max(works["levels"]) < 12 * sum(works["move"]) / len(works["move"])


def test_a_held_count_stays() -> None:
    result = searched(steps, hold={"count": 3})
    assert len(result.best.choices) == 4
    assert result.best.choices["count"] == 3


def test_a_model_of_real_numbers_has_no_rounds_of_levels() -> None:
    assert "levels" not in {each.step for each in searched(plain).info.rounds}
