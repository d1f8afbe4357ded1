"""Results that differ are the best of different kinds, by structure, by look, by choices or by a query.

An archive has the best run of each kind. The search for the best is untouched by it, and bits do not depend on threads.
"""

import statistics

import niwaki as nw
import pytest
from niwaki import choose, discrete_uniform, emit, factor, flip, query, uniform
from niwaki.search import SearchWarning
from niwaki.targets.examples.lofts import block, solid

BACKS, LEGS = ("slats", "board", "none"), ("four", "block", "wall")


def box(low, high):
    """A box between two corners."""
    center = tuple((a + b) / 2 for a, b in zip(low, high, strict=True))
    return nw.box(center, tuple(b - a for a, b in zip(low, high, strict=True)))


@nw.model
def legs():
    """Three kinds of legs, below 1."""
    kind = choose(["four", "block", "wall"])
    thick = uniform(0.2, 0.5)
    if kind == "four":
        for x in range(2):
            for y in range(2):
                emit(nw.box((1.6 * x - 0.8, 0.5, 1.6 * y - 0.8), (thick, 1.0, thick)))
    elif kind == "block":
        emit(nw.box((0.0, 0.5, 0.0), (3.0 * thick, 1.0, 3.0 * thick)))
    else:
        emit(nw.box((-0.8, 0.5, 0.0), (thick, 1.0, 2.0)))
        emit(nw.box((0.8, 0.5, 0.0), (thick, 1.0, 2.0)))


@nw.model
def back():
    """Three kinds of backs, above 1.3."""
    kind = choose(["slats", "board", "none"])
    high = uniform(0.8, 2.0)
    if kind == "slats":
        for x in range(3):
            emit(nw.box((0.7 * x - 0.7, 1.31 + high / 2.0, -0.9), (0.3, high, 0.2)))
    elif kind == "board":
        emit(nw.box((0.0, 1.31 + high / 2.0, -0.9), (2.0, high, 0.2)))


@nw.model
def chair():
    """A chair with nine kinds, and a choice that hardly shows."""
    emit(nw.box((0.0, 1.15, 0.0), (2.0, 0.29, 2.0)))
    legs()
    back()
    if flip(0.5):
        emit(nw.box((0.0, 1.15, 1.05), (0.1, 0.1, 0.05)))
    query("parts high", 1)


@nw.model
def pillar():
    """A model of reals alone."""
    x = uniform(-2.0, 2.0)
    width = uniform(0.5, 3.0)
    query("width", width)
    emit(nw.box((x, 0.5, 0.0), (width, 1.0, 1.0)))


@nw.model
def numbers():
    """A model without a scene."""
    a = discrete_uniform(0, 3)
    factor(-0.1 * a)
    return a


@nw.model
def ranked():
    """Words of which each is far below the one before it, and eight numbers that every word needs right."""
    word = choose(["best", "good", "bad"])
    off = 0.0
    for _ in range(8):
        off += abs(uniform(0.0, 1.0) - 0.7)
    factor(-20.0 * off - (200.0 if word == "bad" else 100.0 if word == "good" else 0.0))


def seat():
    """A target that is a bit of every chair."""
    return solid(
        "seat", [block((-1.0, 0.0, -1.0), (1.0, 1.3, 1.0)), block((-1.0, 1.3, -1.0), (1.0, 3.0, -0.8))]
    )


def chairs(seed: int = 1, **settings):
    """Chairs, by few particles."""
    small = nw.improve(20, 5, **{"rounds": 10, **{k: v for k, v in settings.items() if k != "threads"}})
    rest = {k: v for k, v in settings.items() if k == "threads"}
    return nw.grow(chair, seat(), voxel=0.25, method=small, seed=seed, **rest)


def pairs(result):
    """The kinds of legs and backs of results."""
    return [(sample.choices["legs/kind"], sample.choices["back/kind"]) for sample in result]


def test_a_chair_with_three_backs_and_three_legs_has_nine_kinds() -> None:
    result = chairs(diverse=9, margin=None)
    assert len(set(pairs(result))) == 9
    scores = [sample.log_score for sample in result]
    assert scores == sorted(scores, reverse=True)
    assert result.info.niches == 9
    # The small part carries less than a tenth of the scene, and reals are of no kind.
    places = {place for kind in result.info.kinds for place in kind}
    assert {place for place in places if not place.endswith("/")} == {"legs/kind", "back/kind"}


def test_the_best_is_that_of_the_search_for_the_best_alone_or_better() -> None:
    alone, several = chairs(), chairs(diverse=4)
    assert several.best.log_score >= alone.best.log_score
    assert several.info.rounds == alone.info.rounds and several.info.searches > 4
    assert len(several) == 4 and len(set(pairs(several))) > 1


def test_several_results_take_four_times_the_work_of_one() -> None:
    ratios = []
    for seed in range(10):
        info = chairs(diverse=4, seed=seed).info
        single = sum(entry.work for entry in info.rounds)
        ratios.append((single + info.other_work) / single)
        assert info.generations > 0
    # The last generation may take more work than the one before it, which was measured.
    assert 2.5 < statistics.median(ratios) <= 4.0


def test_several_results_have_the_seconds_of_one_search() -> None:
    result = chairs(diverse=4)
    assert (result.seconds, result.cpu_seconds) == (result.best.seconds, result.best.cpu_seconds)


def test_the_bits_do_not_depend_on_threads() -> None:
    seen = [chairs(diverse=5, rounds=3, threads=threads) for threads in (1, 2)]
    assert [sample.choices for sample in seen[0]] == [sample.choices for sample in seen[1]]
    assert seen[0].info == seen[1].info


def test_a_timed_archive_is_repeated_by_its_counts() -> None:
    timed = chairs(diverse=4, rounds=None, seconds=0.6)
    rounds, generations = len(timed.info.rounds) - 1, timed.info.generations
    again = chairs(diverse=4, rounds=max(rounds, 1), generations=max(generations, 1))
    assert again.info.generations == max(generations, 1)
    # A busy machine may leave no time for a round.
    if rounds > 0 and generations > 0:
        assert [sample.choices for sample in again] == [sample.choices for sample in timed]
        assert again.info == timed.info


def test_generations_are_counted() -> None:
    short, longer = (chairs(diverse=4, rounds=2, generations=count) for count in (1, 3))
    assert (short.info.generations, longer.info.generations) == (1, 3)
    assert short.info.searches < longer.info.searches and short.info.rounds == longer.info.rounds


def test_one_result_for_each_combination_of_choices() -> None:
    result = chairs(diverse=3, by=["legs/kind"])
    assert sorted(legs for legs, _ in pairs(result)) == sorted(LEGS)
    by_label = chairs(diverse=3, by=["Legs › kind"])
    assert [sample.choices for sample in by_label] == [sample.choices for sample in result]
    assert nw.search.named(by_label) == [[("Legs › kind", legs)] for legs, _ in pairs(result)]
    with pytest.raises(nw.InputError, match="legs/kind"):
        chairs(diverse=3, by=["legs/kin"])


def test_a_kind_that_is_far_below_the_best_is_improved_too() -> None:
    for seed in range(2):
        method = nw.improve(30, 6, rounds=14, diverse=3, by=["word"], margin=None)
        result = nw.run(ranked, method=method, seed=seed)
        scores = {sample.choices["word"]: sample.log_score for sample in result}
        # A run of the prior has -48 nats for its numbers.
        most = {"best": 0.0, "good": -100.0, "bad": -200.0}
        assert all(most[word] - 15.0 < score <= most[word] for word, score in scores.items())
        assert scores.keys() == most.keys()


@pytest.mark.filterwarnings("ignore:only 2 of")
def test_by_look_results_fill_different_cells() -> None:
    result = nw.grow(pillar, seat(), voxel=0.25, seed=1, diverse=4, by="look", rounds=4, margin=None)
    places = [(sample.choices["x"], sample.choices["width"]) for sample in result]
    assert len(result) >= 2
    for (a, wide_a), (b, wide_b) in zip(places, places[1:], strict=False):
        # The ends of two boxes are not the same: less than four fifths of the cells are in common.
        assert abs(a - b) + abs(wide_a - wide_b) > 0.2


@pytest.mark.filterwarnings("ignore:only 2 of")
def test_a_model_of_reals_alone_has_one_kind_and_differs_by_look() -> None:
    result = nw.grow(pillar, seat(), voxel=0.25, seed=1, diverse=3, rounds=4, margin=None)
    assert len(result) >= 2 and result.info.niches == 1
    assert not any(result.info.kinds)


def test_the_bins_of_a_query() -> None:
    result = nw.grow(pillar, seat(), voxel=0.25, seed=1, diverse=4, by="width", bins=4, rounds=4)
    bins = [kind["width"] for kind in result.info.kinds]
    assert len(result) == 4 == len(set(bins))
    for sample, text in zip(result, bins, strict=True):
        low, high = map(float, text.split(" to "))
        assert low - 1e-3 <= sample.choices["width"] <= high + 1e-3


def test_without_a_scene_every_finite_choice_counts() -> None:
    with pytest.warns(SearchWarning, match=r"only 4 of 9"):
        result = nw.run(numbers, method=nw.improve(20, 5, rounds=3, diverse=9, margin=None), seed=1)
    assert sorted({sample.value for sample in result}) == [0, 1, 2, 3]


def test_the_archive_is_a_table_and_a_sheet(tmp_path) -> None:
    kept = nw.archive(chair, seat(), voxel=0.25, method=nw.improve(20, 5, rounds=10), seed=1)
    assert len(kept) == 9 and {tuple(kind.values.values()) for kind in kept} <= {
        (back, legs) for back in BACKS for legs in LEGS
    }
    assert [row["number"] for row in kept.table()] == list(range(1, 10))
    assert kept.quality(floor=kept[0].log_score) == 0.0 < kept.quality(floor=kept[1].log_score)
    assert "Back › kind" in str(kept)
    assert kept.save(tmp_path / "sheet.png", size=(60, 45), samples=1).stat().st_size > 0


def test_what_tells_results_apart_is_checked() -> None:
    for wrong in (3, "", [], ["a", 1]):
        with pytest.raises(nw.InputError, match="`by`"):
            nw.improve(diverse=2, by=wrong)
    with pytest.raises(nw.InputError, match="improve"):
        nw.archive(chair, seat(), method=nw.smc(), seed=1)
