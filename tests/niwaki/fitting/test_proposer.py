"""The engine's proposer: its emulator is the Gaussian process of the textbook, and its points depend on nothing but the
outcomes in the order of asking."""

from __future__ import annotations

import json

import numpy as np
import pytest
from niwaki import _engine

NUGGET = 0.002

#: A width, feet or not, their height if so, a web of three kinds, a whole number, and a size if it is not the first.
SPACE = [
    {"kind": "real"},
    {"kind": "choice", "levels": 2},
    {"kind": "real", "when": [[[1, [1]]]]},
    {"kind": "choice", "levels": 3},
    {"kind": "whole", "levels": 6},
    {"kind": "real", "when": [[[3, [1, 2]]]]},
]

#: A basis for features that bend with the parameters.
BASIS = np.random.default_rng(5).normal(size=(16, 90))


def features(row: np.ndarray, used: list[bool], hidden: np.ndarray) -> np.ndarray:
    """Differences of a made-up geometry, zero at the hidden point."""

    def bent(x: np.ndarray, on: np.ndarray) -> np.ndarray:
        levels = np.r_[x[1] > 0.5, x[3] < 0.3, x[3] > 0.6]
        parts = np.r_[x * on, np.sin(3 * x) * on, levels, x[0] * x[4]]
        return np.tanh(parts @ BASIS[: len(parts)] / 3) * 10

    on = np.array([1, hidden[1] > 0.5, hidden[1] > 0.5, 1, 1, hidden[3] > 1 / 3], float)
    return bent(np.asarray(row), np.asarray(used, float)) - bent(hidden, on)


HIDDEN = np.array([0.37, 0.75, 0.62, 5 / 6, 7 / 12, 0.21])


def evaluated(point: tuple[list[float], list[bool]]) -> tuple[float, np.ndarray]:
    vector = features(np.array(point[0]), point[1], HIDDEN).astype(np.float32)
    return -0.5 * float(vector @ vector), vector


def searched(
    count: int, seed: int = 0
) -> tuple[_engine.Proposer, list[tuple[list[float], list[bool]]], list[float]]:
    proposer = _engine.Proposer(json.dumps(SPACE), seed)
    points, scores = [], []
    for _ in range(count):
        point = proposer.ask()
        assert point is not None
        score, vector = evaluated(point)
        proposer.tell(score, vector)
        points.append(point)
        scores.append(score)
    return proposer, points, scores


def test_a_hidden_point_with_structure_is_found():
    for seed in range(3):
        _, points, scores = searched(120, seed)
        best = np.array(points[int(np.argmax(scores))][0])
        assert np.abs(best - HIDDEN).max() < 0.03, (seed, best)


def test_its_emulator_is_the_dense_gaussian_process():
    proposer, points, _ = searched(60)
    rows = np.array([row for row, _ in points])
    vectors = np.array([evaluated(point)[1] for point in points], dtype=np.float64)
    along, apart = (np.array(part) for part in proposer.scales())

    def kernel(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        square = np.zeros((len(a), len(b)))
        for k, axis in enumerate(SPACE):
            step = a[:, k][:, None] - b[:, k][None]
            if axis["kind"] != "choice":
                square += (step / along[k]) ** 2
            if axis["kind"] != "real":
                square += (step != 0) / apart[k] ** 2
        root = np.sqrt(5 * square)
        return (1 + root + 5 * square / 3) * np.exp(-root)

    squares = (vectors**2).sum(1)
    weights = np.exp(-0.5 * (squares - squares.min()) / np.sort(squares)[len(squares) // 2])
    _, values, directions = np.linalg.svd(weights[:, None] * vectors, full_matrices=False)
    directions = directions[: int((values**2 > 1e-10 * values[0] ** 2).sum())][:40]
    targets = vectors @ directions.T
    mean = targets.mean(0)
    inverse = np.linalg.inv(kernel(rows, rows) + NUGGET * np.eye(len(rows)))

    probes = np.array(
        [proposer.snap(list(row))[0] for row in np.random.default_rng(1).random((40, len(SPACE)))]
    )
    near = kernel(probes, rows)
    expected = mean + near @ inverse @ (targets - mean)
    left = 1 - np.einsum("ij,jk,ik->i", near, inverse, near)
    predicted, predicted_left = proposer.predict(probes)
    # Directions have no sign, and those of little variance may turn among themselves: lengths have neither freedom.
    assert np.allclose(predicted_left, left, rtol=0, atol=1e-9)
    assert np.allclose(np.linalg.norm(predicted, axis=1), np.linalg.norm(expected, axis=1), rtol=1e-3)
    assert np.allclose(
        np.abs(predicted[:, :4]), np.abs(expected[:, :4]), rtol=0, atol=1e-4 * np.abs(expected).max()
    )


def test_the_same_seed_gives_the_same_bits():
    _, first, _ = searched(90)
    _, second, _ = searched(90)
    _, other, _ = searched(90, seed=1)
    assert first == second
    assert first != other


@pytest.mark.parametrize("workers", [2, 3, 7])
def test_points_do_not_depend_on_when_they_are_asked_for(workers: int):
    _, alone, _ = searched(70)
    proposer = _engine.Proposer(json.dumps(SPACE), 0)
    rng = np.random.default_rng(workers)
    points: list[tuple[list[float], list[bool]]] = []
    count = 0
    while count < 70:
        while len(points) - count < workers and (point := proposer.ask()) is not None:
            points.append(point)
        for _ in range(int(rng.integers(1, len(points) - count + 1))):
            proposer.tell(*evaluated(points[count]))
            count += 1
    assert points[:70] == alone


def test_failures_are_avoided_and_do_not_stop_a_search():
    proposer = _engine.Proposer(json.dumps(SPACE), 4)
    failed = []
    scores = []
    for _ in range(150):
        point = proposer.ask()
        assert point is not None
        failed.append(point[0][0] > 0.5)
        score, vector = evaluated(point)
        if failed[-1]:
            proposer.tell(float("-inf"), None)
        else:
            scores.append(score)
            proposer.tell(score, vector)
    assert sum(failed[:10]) >= 3
    assert sum(failed[50:]) < 25
    assert max(scores) > -1.0


def test_unused_parameters_are_learnt_where_no_condition_is_known():
    flat = [{key: value for key, value in axis.items() if key != "when"} for axis in SPACE]
    proposer = _engine.Proposer(json.dumps(flat), 0)
    wasted = []
    scores = []
    for _ in range(150):
        point = proposer.ask()
        assert point is not None
        row = np.array(point[0])
        used = [True, True, bool(row[1] > 0.5), True, True, bool(row[3] > 1 / 3)]
        wasted.append(used != point[1])
        row[~np.array(used)] = 0.5
        score, vector = evaluated((row.tolist(), used))
        scores.append(score)
        proposer.tell(score, vector, used)
    assert sum(wasted[:12]) >= 4
    assert sum(wasted[60:]) <= 9
    assert max(scores) > -1.0


def test_a_small_space_is_exhausted_and_each_point_asked_once():
    proposer = _engine.Proposer(
        json.dumps([{"kind": "choice", "levels": 2}, {"kind": "whole", "levels": 3}]), 0
    )
    seen = []
    while (point := proposer.ask()) is not None:
        seen.append(tuple(point[0]))
        proposer.tell(-sum(point[0]), np.array([point[0][0]], np.float32))
    assert proposer.exhausted
    assert len(seen) == len(set(seen)) == 6


def test_a_goal_without_features_is_sought_by_its_score():
    proposer = _engine.Proposer(json.dumps([{"kind": "real"}] * 3), 0)
    scores = []
    for _ in range(80):
        point = proposer.ask()
        assert point is not None
        scores.append(-20 * float(((np.array(point[0]) - 0.3) ** 2).sum()))
        proposer.tell(scores[-1], np.zeros(0, np.float32))
    assert max(scores) > -0.02


def test_suggested_points_come_first():
    proposer = _engine.Proposer(json.dumps(SPACE), 0)
    proposer.suggest([0.25, 0.25, 0.9, 0.1, 0.99, 0.4])
    point = proposer.ask()
    assert point is not None
    assert point[0] == [0.25, 0.25, 0.5, 0.5 / 3, 5.5 / 6, 0.5]


def test_what_cannot_be_told_is_refused():
    proposer = _engine.Proposer(json.dumps(SPACE), 0)
    with pytest.raises(ValueError, match="told"):
        proposer.tell(0.0, np.zeros(3, np.float32))
    proposer.ask()
    proposer.tell(0.0, np.zeros(3, np.float32))
    proposer.ask()
    with pytest.raises(ValueError, match="features"):
        proposer.tell(0.0, np.zeros(4, np.float32))
    with pytest.raises(ValueError, match="finite"):
        proposer.tell(0.0, np.array([0, np.nan, 0], np.float32))
    with pytest.raises(ValueError, match="level"):
        _engine.Proposer(json.dumps([{"kind": "real"}, {"kind": "real", "when": [[[0, [1]]]]}]), 0)


def test_a_posterior_holds_the_hidden_point_and_is_wider_by_a_lower_power():
    proposer, _, _ = searched(80)

    def ends(power: float) -> np.ndarray:
        rows, used = proposer.posterior(power, 1)
        return np.array([np.quantile(rows[used[:, k], k], [0.02, 0.98]) for k in (0, 2, 5)])

    sharp, vague = ends(1.0), ends(0.1)
    assert (vague[:, 0] <= HIDDEN[[0, 2, 5]]).all() and (HIDDEN[[0, 2, 5]] <= vague[:, 1]).all()
    assert (np.diff(sharp) < 0.8 * np.diff(vague)).all()
    assert np.diff(sharp).max() < 0.5
