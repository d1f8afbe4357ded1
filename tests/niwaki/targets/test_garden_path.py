"""Claim: the model of the manual's page on garden paths behaves as on the page.

Each search is repeated with fixed seeds. The page claims that random order never comes to an end and depth-first order
always does: were each to succeed in one run of two, ten runs of each would show it by chance once in a million.
"""

from __future__ import annotations

import linecache
import re
import statistics
import warnings
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
import trimesh
from niwaki.errors import InputError

PAGE = (Path(__file__).parents[3] / "docs/guide/garden-paths.md").read_text(encoding="utf-8")
SEEDS = range(10)
LATE = [0.0] * 8 + [16.0]


@pytest.fixture(scope="module")
def program() -> Any:
    block = re.search(r"```python\n(.*?)```", PAGE, re.DOTALL)
    assert block is not None
    linecache.cache["garden_path.py"] = (len(block[1]), None, block[1].splitlines(True), "garden_path.py")
    space: dict[str, Any] = {"__name__": "garden_path"}
    exec(compile(block[1], "garden_path.py", "exec"), space)
    return space["wall_and_tower"]


@pytest.fixture(scope="module")
def target() -> nw.Target:
    tower = trimesh.creation.box((2, 4, 1), np.array(trimesh.transformations.translation_matrix((-1, 2, 0))))
    wall = trimesh.creation.box((8, 2, 1), np.array(trimesh.transformations.translation_matrix((4, 1, 0))))
    both = trimesh.util.concatenate([tower, wall])
    return nw.Target(both.vertices, both.faces)


def grown(program: Any, target: nw.Target, seed: int, **settings: Any) -> nw.Result | None:
    try:
        return nw.grow(program, target, voxel=0.25, seed=seed, **{"particles": 100} | settings)
    except InputError as error:
        assert error.code == "everything-impossible"
        return None


def test_random_order_follows_the_path_and_depth_first_does_not(program: Any, target: nw.Target) -> None:
    lost = [grown(program, target, seed) for seed in SEEDS]
    results = [grown(program, target, seed, order="depth-first") for seed in SEEDS]
    assert not any(lost)
    assert all(result is not None and result.best.log_score > 5.5 for result in results)


def test_the_usual_search_tries_a_power_that_rises(program: Any, target: nw.Target) -> None:
    for seed in SEEDS:
        result = nw.grow(program, target, voxel=0.25, seed=seed)
        assert result.best.log_score > 5.0
        *dead, alive = result.info.attempts
        assert dead and all(attempt.died_at is not None for attempt in dead) and alive.died_at is None


def test_judging_late_and_revising_help(program: Any, target: nw.Target) -> None:
    score = nw.no_self_intersection() * nw.match_volume(target, 0.25)
    late, revised = [], []
    for seed in SEEDS:
        first = grown(program, target, seed, particles=50, anneal=LATE)
        assert first is not None
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            method = nw.particle_gibbs(particles=10, sweeps=10, power=16.0)
            chain = nw.run(program, method=method, score=score, seed=seed, choices=first.best.choices)
        late.append(first.best.log_score)
        revised.append(chain.best.log_score)
    assert statistics.fmean(revised) > statistics.fmean(late) + 2.0
