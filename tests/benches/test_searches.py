"""Claim: the board of searches does what is missing and no more, and knows a complete scene from one that lacks an arm.

Two small problems, two seeds. The scenes are built here from the target's own parts.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import board
import niwaki as nw
import numpy as np
import pytest
from niwaki.draw.scene import Scene
from searches import table
from searches.complete import LEAST, has_enough, is_complete
from searches.methods import METHODS, Method, method
from searches.problems import PROBLEMS, Problem, problem
from searches.records import Records, version
from searches.searching import case_of, grown, scaled
from searches.seeds import MOST, PILOT, SETS
from searches.targets import forked_stem

SMALL = [problem("ship"), problem("wall and tower")]
SEEDS = SETS["tuning"][:2]
TWO = [method("default"), method("four populations")]


def measured(records: Records, methods: list[Method] = TWO, seeds: tuple[int, ...] = SEEDS) -> int:
    return board.measure(records, SMALL, methods, seeds, workers=1)


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Records]:
    board = Records(tmp_path_factory.mktemp("board") / "records.jsonl")
    assert measured(board) == 8
    yield board


def test_each_search_is_a_line_with_what_ran(records: Records) -> None:
    lines = [json.loads(line) for line in records.path.read_text().splitlines()]
    assert lines == records.rows
    searches = [row for row in lines if "seed" in row]
    assert {(row["problem"], row["method"], row["seed"]) for row in searches} == {
        (case.name, how.name, seed) for case in SMALL for how in TWO for seed in SEEDS
    }
    for row in searches:
        assert row["version"] == version()
        assert row["cpu"] > 0.0
        assert row["settings"] == method(row["method"]).text(row["size"])
        assert (row["score"] is None) == (row["shares"] == {})


def test_a_second_run_does_what_is_missing(records: Records, tmp_path: Path) -> None:
    text = records.path.read_text()
    again = Records(tmp_path / "records.jsonl")
    assert again.rows == []
    again.path.write_text(text)
    assert measured(Records(again.path)) == 0
    # A stop in the middle of the last line costs that search alone.
    again.path.write_text(text[:-20])
    assert measured(Records(again.path)) == 1
    assert measured(Records(again.path), seeds=SETS["tuning"][:3]) == 4
    # Nor are those of more CPU seconds; a default has no size, so it needs no pilot.
    assert board.measure(Records(again.path), SMALL, TWO[:1], SEEDS, times=4.0, workers=1) == 4
    # Records of other settings, or of another version, are not those of this method.
    other = Method("four populations", lambda n: {"particles": n, "populations": 4, "ess": 0.5}, 75)
    assert not Records(again.path).has(other, "ship", SEEDS[0])
    again.path.write_text(text.replace(version(), "0" * 12))
    assert not Records(again.path).has(TWO[0], "ship", SEEDS[0])
    assert len(Records(again.path).searches("000")) == 8
    with pytest.raises(SystemExit, match="no record of f00"):
        Records(again.path).searches("f00")


def test_a_record_is_the_search_of_its_user(records: Records) -> None:
    """`niwaki.grow(model, target)` with that seed has the recorded score."""
    row = next(row for row in records.searches() if row["problem"] == "ship" and row["method"] == "default")
    ship, case = problem("ship"), case_of("ship", row["seed"])
    assert nw.grow(ship.model, case.target, seed=row["seed"]).best.log_score == row["score"]


def shape_of(parts: dict, *without: str) -> Scene:
    kept = {name: mesh for name, mesh in parts.items() if not any(word in name for word in without)}
    return Scene([(name, [nw._engine.shape("mesh", *mesh)]) for name, mesh in kept.items()])


def test_a_forked_stem_is_complete_with_both_arms_only() -> None:
    parts = forked_stem(np.random.default_rng([1, SEEDS[0]]))
    case = case_of("forked stems", SEEDS[0])
    whole = case.measure(shape_of(parts))
    assert has_enough("forked stems", whole)
    # Cells at the skin of the scene's grid and of the target's are not the same: at most an eighth of these parts.
    assert min(whole.values()) > 0.87
    for missing in ("one arm", "other arm", "one ball", "other ball"):
        shares = case.measure(shape_of(parts, missing))
        # A branch that reaches its ball may run beside its arm.
        assert has_enough("forked stems", shares) == ("arm" in missing), missing
        assert shares[missing] < 0.5 * whole[missing]
    assert case.measure(Scene([])) == dict.fromkeys(parts, 0.0)
    assert not has_enough("forked stems", case.measure(Scene([])))
    row = {"problem": "forked stems", "shares": whole, "empty": -30.0}
    assert [is_complete(row | {"score": score}) for score in (-20.0, -40.0, None)] == [True, False, False]


def test_a_skyline_lacks_the_tower_that_is_not_built() -> None:
    case = case_of("skylines", SEEDS[0])
    view = case.score.views[0]
    height, (rows, columns) = view.camera.height, view.image.shape
    unit = height / rows
    towers = []
    for column in range(columns):
        high = unit * view.image[:, column].sum()
        if high:
            x = unit * (column + 0.5 - columns / 2)
            towers.append((x, nw._engine.shape("box", (x, high / 2, 0.0), (unit, high, unit))))
    whole = case.measure(Scene([("all", [shape for _, shape in towers])]))
    assert has_enough("skylines", whole)
    left = case.measure(Scene([("left", [shape for x, shape in towers if x < 0.0])]))
    assert not has_enough("skylines", left)


@pytest.mark.parametrize("task", PROBLEMS, ids=lambda task: task.name)
def test_every_problem_has_a_target_and_parts_that_count(task: Problem) -> None:
    case = task.case(PILOT[0])
    least, why = LEAST[task.name]
    shares = case.measure(Scene([]))
    assert why
    assert all(any(word in name.split() for name in shares) for word in least)
    assert not has_enough(task.name, shares)
    assert (case.target is None) == bool(case.score is not None and case.score.views)


def test_targets_of_seeds_are_the_same_again_and_differ() -> None:
    for case in PROBLEMS:
        if case.is_made and case.case(51).target is not None:
            first, again, other = (case.case(seed).target.vertices for seed in (51, 51, 52))
            assert np.array_equal(first, again)
            assert not np.array_equal(first, other)
    assert sum(case.is_made for case in PROBLEMS) >= len(PROBLEMS) / 2
    seeds = [*SETS["tuning"], *SETS["held_out"], *PILOT]
    assert len(set(seeds)) == 2 * MOST + len(PILOT)


def test_paired_differences_follow_the_seeds() -> None:
    def row(seed: int, method: str, score: float | None, pod: float) -> dict:
        shares = {"hull": 1.0, "wings": 1.0, "pods": pod}
        return {"problem": "ship", "method": method, "seed": seed, "score": score, "empty": -30.0} | {
            "shares": shares if score is not None else {},
            "cpu": 1.0,
        }

    rows = [row(k, "default", -10.0 + k, 1.0) for k in range(10)]
    rows += [row(k, "chain", -12.0 + k, 0.0) for k in range(9)] + [row(9, "chain", None, 0.0)]
    pairs = table.pairs(table.of(rows, "ship", "default"), table.of(rows, "ship", "chain"))
    scores, complete = table.gains(pairs)
    assert scores == [2.0] * 9 + [29.0]
    assert complete == [1.0] * 10
    mean, low, high = table.interval([scores])
    assert mean == pytest.approx(4.7)
    # The one large difference is drawn 0 to 3 times (0.3 to 98 % of the draws), each worth 2.7.
    assert (low, high) == pytest.approx((2.0, 10.1))
    assert table.interval([[1.0] * 5, [0.0] * 5]) == (0.5, 0.5, 0.5)
    s = table.summary([line for line in rows if line["method"] == "chain"])
    assert (s["median"], s["worst"], s["dead"], s["complete"]) == (-8.5, -30.0, 1, 0)


def test_sizes_scale_with_the_budget() -> None:
    assert [scaled(300, ratio) for ratio in (0.5, 1e-9, 1e9)] == [150, 10, 900]
    for how in (known for known in METHODS if known.size):
        assert how.text(how.size) != how.text(2 * how.size), how.name


def test_a_search_that_dies_has_no_result() -> None:
    """The manual's garden path: a population builds the tower first, too wide for the wall."""
    task, population = problem("wall and tower"), Method("", lambda n: {"method": nw.smc(n, power=16.0)})
    assert grown(task, case_of(task.name, 51), population, 20, 51) is None
