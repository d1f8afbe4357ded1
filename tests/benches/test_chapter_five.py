"""Claim: the models of chapter 5 have the published sizes, and intersect themselves as often as the original's do.

The figures that we compare with are means of several hundred forward runs, as are ours; each test names the standard
error of the difference and allows four of them, so that a true model fails one in 16 000 seeds. The seeds are fixed.
Standard deviations of the sizes: building 55, tree 51, blocks 7.6, pipes 1000. Shares of self-intersection, by the rule
of surfaces: a share p of n runs has the standard error sqrt(p (1 - p) / n).

A mutant stands beside them: a tree whose branches are half as likely is rejected.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from experiments import EXPERIMENTS, Experiment
from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.gallery import entry
from niwaki.gallery.building import building
from niwaki.gallery.gnarly_tree import gnarly_tree
from niwaki.gallery.pipes import pipes
from niwaki.gallery.toy_blocks import toy_blocks
from niwaki.lang.models import Model
from niwaki.targets import examples as targets

AnyModel = Model[..., Any]


def sizes(model: AnyModel, runs: int, **arguments: float) -> list[int]:
    return [sample.primitives for sample in nw.run(model, method=nw.forward(runs), seed=1, **arguments)]


def as_published(counts: list[int], mean: float, sd: float, runs: int) -> bool:
    """Whether the mean size is within four standard errors of the published one, which came from so many `runs`."""
    error = sd * math.sqrt(1.0 / len(counts) + 1.0 / runs)
    return abs(sum(counts) / len(counts) - mean) < 4.0 * error


@pytest.mark.parametrize(
    ("model", "mean", "sd", "published", "runs"),
    [
        (building, 72.6, 55.0, 400, 1000),
        (gnarly_tree, 73.5, 51.0, 300, 1000),
        (toy_blocks, 15.6, 7.6, 300, 1000),
        (pipes, 1800.0, 1000.0, 100, 60),
    ],
    ids=["building", "tree", "blocks", "pipes"],
)
def test_models_are_as_large_as_published(
    model: AnyModel, mean: float, sd: float, published: int, runs: int
) -> None:
    assert as_published(sizes(model, runs), mean, sd, published)


def test_a_tree_with_fewer_branches_is_rejected() -> None:
    assert not as_published(sizes(gnarly_tree, 1000, fork=0.25), 73.5, 51.0, 300)


@pytest.mark.parametrize(
    ("model", "share", "published"),
    [(building, 0.74, 400), (gnarly_tree, 0.61, 300), (toy_blocks, 0.75, 300)],
    ids=["building", "tree", "blocks"],
)
def test_models_run_through_themselves_as_often_as_published(
    model: AnyModel, share: float, published: int
) -> None:
    runs = 600
    result = nw.run(model, method=nw.importance(runs), score=nw.no_self_intersection("surface"), seed=1)
    here = sum(sample.log_score == -math.inf for sample in result) / runs
    assert abs(here - share) < 4.0 * math.sqrt(share * (1.0 - share) * (1.0 / runs + 1.0 / published))


def test_segments_that_grow_from_one_another_only_touch() -> None:
    """By both rules, but for a few welds where a wide branch meets a bend at an extreme angle: fewer than 3 in 100."""
    pairs, overlapping = 0, {"solid": 0, "surface": 0}
    for sample in nw.run(gnarly_tree, method=nw.forward(20), seed=2):
        shapes = {part.address: part.shapes for part in sample.scene}
        for address, shape in shapes.items():
            parent = shapes.get(grown_from(address))
            if parent is None:
                continue
            pairs += 1
            for rule in overlapping:
                sketch = _engine.Sketch(nw.no_self_intersection(rule).specs)
                sketch.add(list(parent))
                overlapping[rule] += sketch.add(list(shape)) is not None
    assert pairs > 1000
    assert max(overlapping.values()) < 0.03 * pairs


def grown_from(address: str) -> str:
    """The address of the segment that the one at `address` continues or branches from."""
    calls = address.split("/")[:-2]
    while calls and calls[-1] != "branch":
        calls.pop()
    return "/".join([*calls, "emit"])


def test_trees_grow_from_fifty_segments_to_thousands() -> None:
    """Means of forward runs: what the curves of cost over size are drawn with."""
    means = [np.mean(sizes(gnarly_tree, 40, smallest=smallest)) for smallest in (0.1, 0.05, 0.025, 0.0125)]
    assert all(large > 2.0 * small for small, large in pairwise(means))


def test_the_tree_is_one_program_for_particles_and_chains() -> None:
    """Depth-first, a future is a call: a stochastic order makes the same tree from the same choices."""
    tree = nw.run(gnarly_tree, seed=3).best
    again = nw.run_python(gnarly_tree, choices=tree.choices)
    assert [part.address for part in Scene(again.scene)] == [part.address for part in tree.scene]


@pytest.mark.parametrize("experiment", EXPERIMENTS, ids=lambda experiment: experiment.name)
def test_experiments_name_what_there_is(experiment: Experiment) -> None:
    assert entry(experiment.model) is not None
    for solid in (experiment.fill, experiment.avoid):
        assert solid is None or solid in targets.TARGETS
    for image in (experiment.image, experiment.weights):
        assert image is None or image in targets.IMAGES
    # A solid to fill or an image to match; an image has a camera, a shadow a light.
    assert (experiment.fill is None) != (experiment.image is None)
    assert bool(experiment.camera) == (experiment.image is not None)
