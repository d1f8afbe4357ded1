"""`improve` keeps its best, counts rounds and not time, repeats itself, and is refused where it makes no sense."""

import niwaki as nw
import pytest
from niwaki import categorical, factor, flip, infer
from niwaki.errors import NiwakiError
from niwaki.gallery import entry


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


def grown(seed: int = 4, **settings):
    """A ship, with few particles."""
    ship = entry("spaceship")
    assert ship is not None
    own = {"particles": 30, "regrow": 6, "rounds": 12}
    method = nw.improve(**own | {k: v for k, v in settings.items() if k in ("rounds", "seconds", "power")})
    rest = {k: v for k, v in settings.items() if k in ("threads", "progress")}
    return nw.grow(ship.model, ship.target(), voxel=0.5, seed=seed, method=method, **rest)


def test_the_best_never_falls_and_is_the_result() -> None:
    result = grown()
    rounds = result.info.rounds
    assert [rounds[0].kind, len(rounds), len(result)] == ["population", 13, 1]
    bests = [one.best for one in rounds]
    assert bests == sorted(bests)
    assert bests[-1] > bests[0] + 1.0
    assert result.best.log_score == bests[-1]
    assert all(one.work > 0 for one in rounds)
    assert {one.kind for one in rounds} == {"population", "regrow", "regrow more", "move"}
    trace = result.best._trace.run
    assert (trace.log_score, trace.primitives) == (result.best.log_score, result.best.primitives)


def test_a_seed_and_a_number_of_rounds_give_the_same_bits_on_any_number_of_threads() -> None:
    seen = [grown(threads=threads) for threads in (1, 2)]
    assert len({str(sorted(one.best.choices.items(), key=str)) for one in seen}) == 1
    assert seen[0].info == seen[1].info
    assert grown(seed=5).best.choices != seen[0].best.choices


def test_a_search_with_a_time_is_repeated_by_its_rounds() -> None:
    timed = grown(rounds=1000, seconds=0.2)
    again = grown(rounds=max(1, len(timed.info.rounds) - 1))
    assert timed.best.choices == again.best.choices or len(timed.info.rounds) == 1
    assert timed.info.rounds == again.info.rounds[: len(timed.info.rounds)]


def test_it_ends_when_nothing_is_gained_for_long() -> None:
    result = nw.run(coins, method=nw.improve(particles=20, rounds=5000), seed=1)
    assert result.value == (True, 2)
    assert 20 <= len(result.info.rounds) < 100


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
