"""`improve` keeps its best, counts rounds and not time, repeats itself, and is refused where it makes no sense.

Where its populations die it tries others, and says so.
"""

import niwaki as nw
import pytest
from niwaki import box, categorical, emit, factor, flip, future, infer, uniform
from niwaki.errors import NiwakiError
from niwaki.gallery import entry
from niwaki.search import SearchWarning
from niwaki.targets.examples.lofts import block, solid
from niwaki.words import Beta


@nw.model
def coins():
    """Two choices with one best run."""
    a = flip(0.3)
    b = categorical([0.2, 0.3, 0.5])
    factor(1.0 if a else 0.0)
    factor(0.5 * b)
    return a, b


@nw.model
def within():
    """An inference that gives no sample."""
    return infer(coins, nw.improve(), 1)


@nw.model
def needle():
    """A number that only a proposal draws, scored after a barrier."""
    x = uniform(0.0, 1.0)
    factor(0.0)
    factor(9.0 if x < 1e-6 else 0.0)
    return x


def grown(seed: int = 4, **settings):
    """A ship, with few particles."""
    ship = entry("spaceship")
    assert ship is not None
    counts = {"particles": 30, "regrow": 6, "rounds": 12}
    method = nw.improve(**counts | {k: v for k, v in settings.items() if k in ("rounds", "seconds", "power")})
    rest = {k: v for k, v in settings.items() if k in ("threads", "progress")}
    return nw.grow(ship.model, ship.target(), voxel=0.5, seed=seed, method=method, **rest)


def test_the_best_never_falls_and_is_the_result() -> None:
    result = grown()
    rounds = result.info.rounds
    assert [rounds[0].step, len(rounds), len(result)] == ["population", 13, 1]
    bests = [line.best for line in rounds]
    assert bests == sorted(bests)
    assert bests[-1] > bests[0] + 1.0
    assert result.best.log_score == bests[-1]
    assert all(line.work > 0 for line in rounds)
    steps = {"population", "regrow", "regrow more", "move", "linkage", "levels"}
    assert {line.step for line in rounds} == steps
    assert not any(line.parts for line in rounds if line.step in ("move", "linkage"))
    trace = result.best._trace.run
    assert (trace.log_score, trace.primitives) == (result.best.log_score, result.best.primitives)


def test_proposals_are_not_weighed() -> None:
    """Weights of prior over proposal would remove the small numbers at the first barrier."""
    near_zero = nw.kernels.proposal(lambda: Beta(0.1, 1.0))
    for seed in range(4):
        result = nw.run(needle, method=nw.improve(20, 4, rounds=1, proposal=near_zero), seed=seed)
        assert result.best.log_score == 9.0


def test_a_seed_and_a_number_of_rounds_give_the_same_bits_on_any_number_of_threads() -> None:
    seen = [grown(threads=threads) for threads in (1, 2)]
    assert len({str(sorted(result.best.choices.items(), key=str)) for result in seen}) == 1
    assert seen[0].info == seen[1].info
    assert grown(seed=5).best.choices != seen[0].best.choices


def test_a_search_with_a_time_is_repeated_by_its_rounds() -> None:
    timed = grown(rounds=1000, seconds=0.2)
    again = grown(rounds=max(1, len(timed.info.rounds) - 1))
    assert timed.best.choices == again.best.choices or len(timed.info.rounds) == 1
    assert timed.info.rounds == again.info.rounds[: len(timed.info.rounds)]


def test_it_ends_when_nothing_is_gained_for_long() -> None:
    result = nw.run(coins, method=nw.improve(particles=20, effort=0.002), seed=1)
    assert result.value == (True, 2)
    assert 5 <= len(result.info.rounds) < 500


def test_a_stopped_search_returns_its_best() -> None:
    def stop(now: nw.result.Progress) -> None:
        raise KeyboardInterrupt

    result = grown(rounds=100_000, progress=stop)
    assert result.interrupted
    assert result.best.log_score == result.info.rounds[-1].best


@pytest.mark.parametrize(
    "settings", [{"regrow": 1}, {"power": 0}, {"rounds": 0}, {"particles": 0}, {"seconds": -1}]
)
def test_settings_that_make_no_sense_are_refused(settings: dict[str, float]) -> None:
    with pytest.raises(nw.InputError, match=next(iter(settings))):
        nw.improve(**settings)


def test_it_is_refused_inside_a_model() -> None:
    with pytest.raises(NiwakiError, match="improve"):
        nw.run(within, seed=1)


@nw.model
def boxes(count: int, apart: float):
    """Boxes in a row, of one size."""
    for i in range(count):
        emit(box((apart * i, 0.5, 0.0), (1.0, uniform(0.9, 1.1), 1.0)))


@nw.model
def garden_path():
    """A wall of eight stones, and a tower that is better the wider it is, until the wall comes."""
    future(wall)
    future(tower)


@nw.model
def wall():
    for i in range(8):
        emit(box((7.5 - i, 0.5, 0.0), (0.96, uniform(0.9, 1.1), 1.0)))


@nw.model
def tower():
    width = uniform(1.0, 8.0)
    emit(box((0.5 * width - 2.0, 2.0, 0.0), (width, 4.0, 1.0)))


def path_target() -> nw.Target:
    return solid(
        "path", [block((0.0, 0.0, -0.5), (8.0, 1.0, 0.5)), block((-2.0, 0.0, -0.5), (0.0, 4.0, 0.5))]
    )


def test_what_dies_as_usual_is_tried_in_other_forms_and_told() -> None:
    with pytest.raises(nw.InputError, match="every run of the search is impossible"):
        nw.grow(garden_path, path_target(), particles=100, seed=9)
    result = nw.grow(garden_path, path_target(), seed=9)
    assert result.info.attempts[0].died_at is not None and result.info.attempts[-1].died_at is None
    assert "which died at barrier" in str(result.info)
    assert result.best.primitives == 9 and result.best.similarity > 0.8


def test_a_dead_search_names_the_parts_and_what_was_tried() -> None:
    with pytest.raises(nw.InputError) as error:
        nw.grow(boxes, path_target(), 3, 0.5, seed=1)
    text = str(error.value)
    assert '"boxes › box" runs into another part of this line in 100 of 100' in text
    assert "emit(box((apart * i" in text and "^^^^" in text
    assert len(error.value.values["attempts"].split(";")) == 6 and "depth-first" in text


def test_two_places_are_blamed_where_two_parts_collide() -> None:
    with pytest.raises(nw.InputError) as error:
        nw.grow(garden_path, path_target(), particles=100, seed=9)
    lines = str(error.value).splitlines()
    first, second = (
        next(k for k, line in enumerate(lines) if text in line) for text in ("7.5 - i", "0.5 * width")
    )
    marks = {lines[first + 1].strip("| ")[0], lines[second + 1].strip("| ")[0]}
    assert marks == {"^", "-"} and "runs into" in str(error.value)


@pytest.mark.filterwarnings("ignore:the target is far from where the model begins")
def test_a_result_that_is_worse_than_nothing_is_a_warning() -> None:
    far = solid("far", [block((50.0, 0.0, 0.0), (52.0, 2.0, 2.0))])
    with pytest.warns(SearchWarning, match="less than an empty scene"):
        nw.grow(boxes, far, 1, 2.0, seed=1)


def test_results_that_differ_are_of_several_searches() -> None:
    ship = entry("spaceship")
    assert ship is not None
    result = nw.grow(ship.model, ship.target(), voxel=0.5, seed=3, diverse=4, rounds=5)
    assert len(result) == 4 and result.info.searches >= 4
    scores = [sample.log_score for sample in result]
    assert scores == sorted(scores, reverse=True) and result.best.log_score == scores[0]
    again = nw.grow(ship.model, ship.target(), voxel=0.5, seed=3, diverse=4, rounds=5, threads=1)
    assert [sample.choices for sample in again] == [sample.choices for sample in result]


def test_a_setting_of_a_population_makes_it_one() -> None:
    def method(**settings) -> str:
        return nw.grow(boxes, path_target(), 1, 2.0, seed=1, **settings).search.method.NAME

    assert [method(), method(rounds=2), method(seconds=0.01)] == ["improve"] * 3
    assert [method(particles=5), method(order="depth-first"), method(seconds=0.01, ess=0.5)] == ["smc"] * 3
    with pytest.raises(nw.InputError, match="method=improve"):
        method(rounds=2, particles=5)


def test_progress_shows_the_best_so_far() -> None:
    seen: list[nw.result.Progress] = []
    result = grown(rounds=30, progress=seen.append)
    shown = [now.sample for now in seen if now.sample is not None]
    assert shown and all(sample.search is shown[0].search for sample in shown)
    scores = [sample.log_score for sample in shown]
    assert scores == sorted(scores) and scores[-1] <= result.best.log_score
    assert len(shown[-1].scene) == shown[-1].primitives > 0
