"""Chains of discrete and continuous kernels from Python: a seed decides everything, what is held stays, what breaks off
is counted, errors say what to use. That the draws are the model's own is `tests/answers/test_mixed.py`."""

from __future__ import annotations

import linecache
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import kernels as k
from niwaki.result.hmc import GradientWarning

GOLDEN = Path(__file__).parents[2] / "golden"

TEXT = """
import math
from niwaki import model; from niwaki.words import *

@model
def beads(n=3):
    count = 1 + poisson(1.5)
    shares = dirichlet([2.0, 1.0, 3.0])
    total = 0.0
    for i in range(count):
        size = gamma(2.0, 1.0)
        total = total + size * shares[i % 3]
    observe(Gaussian(total, 0.3), 1.7)
    return (count, total)

@model
def coins():
    a = flip(0.3)
    b = flip(0.6)
    return a and b

@model
def steps():
    a = flip(0.3)
    x = gaussian(0, 1)
    factor(round(x, 1))
    return a

@model
def tower():
    a = flip(0.5)
    h = uniform(0.5, 2.0)
    emit(box((0, h / 2, 0), (1, h, 1)))
    return a

@model
def edge():
    a = flip(0.5)
    x = gamma(2.0, 1.0)
    factor(-math.sqrt(abs(x - 0.3)) if a else -1.0)
    factor(inf - inf if x > 2.5 else 0.0)
    return x

@model
def unordered():
    x = gaussian(0.0, 1.0)
    y = x * inf - abs(x) * inf if x > 1.0 else x
    factor(-0.1 if y > 0.0 else -0.2)
    return x

@model
def needle():
    side = gaussian(0.0, 1.0)
    factor(softeq(side * side, 1.0, 0.01))
    return side > 0

@model
def halves():
    x = gaussian(0, 1)
    if x > 0:
        z = gaussian(1, 1)
        factor(0.7 * z)
    return x > 0
"""


def loaded() -> dict[str, Any]:
    name = "trajectories.py"
    linecache.cache[name] = (len(TEXT), None, TEXT.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "trajectories", "inf": float("inf")}
    exec(compile(TEXT, name, "exec"), space)
    return space


MODELS = loaded()
BEADS = MODELS["beads"]
BOTH = k.cycle(k.prior(), k.hmc_step(steps=5, jitter=0.3))


def states(result: Any) -> list[Any]:
    return [(sample.log_prior, sample.log_score, sample.choices) for sample in result]


@pytest.mark.parametrize(
    "kernel", [BOTH, k.tempering(k.cycle(k.prior(), k.nuts_step()), (1, 0.25), every=10)], ids=repr
)
def test_a_seed_decides_whatever_the_threads_and_the_strategy(kernel: k.Kernel) -> None:
    method = {"steps": 600, "chains": 3, "keep": 5, "warmup": 200, "kernel": kernel}
    first = nw.run(BEADS, nw.mh(**method), seed=6, threads=1)
    for strategy in ("c3", "resume", "cache", "rerun"):
        again = nw.run(BEADS, nw.mh(**method, strategy=strategy), seed=6, threads=3)
        assert states(again) == states(first)
        assert again.trajectories == first.trajectories
    assert states(nw.run(BEADS, nw.mh(**method), seed=5)) != states(first)


def test_more_goes_on_where_it_stopped() -> None:
    settings = {"thin": 50, "kernel": BOTH, "warmup": 300}
    whole = nw.run(BEADS, nw.mh(steps=1000, **settings), seed=3)
    parts = nw.run(BEADS, nw.mh(steps=310, **settings), seed=3).more(90).more(600)
    assert states(parts) == states(whole)
    assert parts.trajectories == whole.trajectories


def test_every_state_scores_what_it_scores_when_it_is_run_again() -> None:
    result = nw.run(BEADS, nw.mh(steps=2000, keep=50, kernel=BOTH), seed=1)
    for sample in [*result, result.best]:
        assert sample._trace.run.log_score == sample.log_score
        assert abs(sum(sample.choices["shares"]) - 1.0) < 1e-12


def test_statistics_of_trajectories_are_reported() -> None:
    kernel = k.cycle(k.prior(), k.on("size", k.hmc_step(steps=4)), k.on("shares", k.nuts_step(max_depth=3)))
    result = nw.run(BEADS, nw.mh(steps=6000, warmup=3000, kernel=kernel), seed=4)
    sizes, shares = result.trajectories
    assert repr(sizes.kernel) == "on(['size'], hmc_step(4, step=0.1, target=0.8))"
    assert repr(shares.kernel) == "on(['shares'], nuts_step(3, step=0.1, target=0.8))"
    assert sizes.made == shares.made == 2000
    assert abs(sizes.acceptance - 0.8) < 0.15 and abs(shares.acceptance - 0.8) < 0.15
    assert 3 < sizes.structures == sizes.recordings and sizes.unwritten == shares.unwritten == 0
    assert sizes.gradients == 4 * sizes.made
    assert sizes.step[0] != 0.1 and sizes.fault is None


def test_what_is_left_out_is_held() -> None:
    result = nw.run(BEADS, nw.mh(steps=300, kernel=k.on("size", k.hmc_step()), keep=300), seed=1)
    first = result[0].choices
    for sample in result:
        moved = {address for address, value in sample.choices.items() if first[address] != value}
        assert all(address.endswith("size") for address in moved)
    assert len({sample.log_prior for sample in result}) > 100


def test_without_a_warmup_nothing_is_adapted() -> None:
    with pytest.warns(
        GradientWarning, match="1 discrete choice of `beads` kept the value of each chain's start"
    ):
        result = nw.run(BEADS, nw.mh(steps=500, kernel=k.hmc_step(step=0.037)), seed=1)
    assert result.trajectories[0].step == (pytest.approx(0.037, abs=1e-15),)


def test_trajectories_that_reach_what_is_no_number_are_counted() -> None:
    """Below zero the root is a fault for one value of the coin: it is reported, and the chain continues."""
    kernel = k.cycle(k.on("a", k.prior()), k.on("x", k.hmc_step(steps=5, step=0.8)))
    with pytest.warns(GradientWarning, match="without a finite gradient"):
        result = nw.run(MODELS["edge"], nw.mh(steps=2000, kernel=kernel), seed=1)
    (statistics,) = result.trajectories
    assert statistics.divergences.not_finite > 20 and statistics.fault is not None
    assert "factor(inf - inf" in statistics.fault.render()


def test_a_comparison_with_nan_is_a_fault_with_its_place_and_no_path() -> None:
    with pytest.warns(GradientWarning, match="comparison"):
        result = nw.run(MODELS["unordered"], nw.mh(steps=2000, kernel=k.hmc_step(steps=5, step=0.5)), seed=1)
    (statistics,) = result.trajectories
    assert statistics.divergences.not_finite > 20
    assert max(sample.value for sample in result) <= 1.0


def chain(
    kernel: k.Kernel, model: str = "halves", warmup: int = 500, **settings: Any
) -> tuple[Any, list[str]]:
    """A chain and its warnings. Each warning names the line that runs the chain."""
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        method = nw.mh(**{"steps": 3000, "kernel": kernel, "warmup": warmup} | settings)
        result = nw.run(MODELS[model], method, seed=2)
    assert all(warning.category is GradientWarning and warning.filename == __file__ for warning in warned)
    return result, [str(warning.message) for warning in warned]


@pytest.mark.parametrize(
    ("kernel", "unmoved"),
    [
        (k.nuts_step(), "`x`"),
        (k.tempering(k.hmc_step(), (1, 0.25), every=10), "`x`"),
        (k.cycle(k.on("z", k.prior()), k.hmc_step()), "`x`"),
        (k.cycle(k.prior(), k.nuts_step()), None),
        (k.mixture(k.regenerate(), k.hmc_step()), None),
        (k.cycle(k.on("x", k.prior()), k.on("z", k.prior()), k.nuts_step()), None),
    ],
    ids=repr,
)
def test_refusals_for_structure_are_reported_where_no_other_kernel_moves_there(
    kernel: k.Kernel, unmoved: str | None
) -> None:
    """Each chain has trajectories that are refused; where something else changes the structure that is no matter."""
    result, warned = chain(kernel)
    (statistics,) = result.trajectories
    assert statistics.divergences.structure > 50
    values = {sample.value for sample in result}
    if unmoved is None:
        assert warned == [] and values == {True, False}
        return
    (text,) = warned
    assert text.startswith(
        f"{statistics.divergences.structure} of {statistics.settled} trajectories of `halves` "
        "after the warm-up were refused"
    )
    assert f"no other kernel of the chain moves {unmoved}" in text
    # Under tempering chains that keep their structures exchange them.
    assert len(values) == 1 or kernel.name == "tempering"


def test_divergences_are_reported_with_their_count() -> None:
    result, warned = chain(k.cycle(k.prior(), k.hmc_step(steps=3, step=50.0)), model="needle", warmup=0)
    (statistics,) = result.trajectories
    assert statistics.divergences.energy > 0
    assert warned[0].startswith(
        f"{statistics.divergences.energy} of {statistics.settled} trajectories of `needle` after the warm-up diverged"
    )
    assert "give it a smaller `step`, or a `warmup`" in warned[0] and statistics.settled == statistics.made


def test_tempering_reaches_the_other_side_of_a_tight_constraint() -> None:
    alone = nw.run(MODELS["needle"], nw.mh(steps=4000, warmup=1000, kernel=k.nuts_step(target=0.95)), seed=1)
    assert len({sample.value for sample in alone}) == 1
    widths = (1, 1 / 16, 1 / 256, 1 / 4096)
    kernel = k.tempering(k.nuts_step(target=0.95), widths, every=2)
    result = nw.run(MODELS["needle"], nw.mh(steps=12_000, warmup=2000, thin=10, kernel=kernel), seed=1)
    share = np.array([sample.value for sample in result], dtype=float)
    assert abs(share.mean() - 0.5) < 0.15
    assert all(len(statistics.step) == 4 for statistics in result.trajectories)


def failing() -> dict[str, Callable[[], Any]]:
    """Every kind of error, by name."""
    run, hmc = nw.run, k.cycle(k.prior(), k.hmc_step())
    return {
        "nothing continuous": lambda: run(MODELS["coins"], nw.mh(steps=10, kernel=hmc), seed=1),
        "nothing continuous that is selected": lambda: run(
            MODELS["edge"], nw.mh(steps=10, kernel=k.on("a", k.hmc_step())), seed=1
        ),
        "no derivative": lambda: run(MODELS["steps"], nw.mh(steps=10, kernel=hmc), seed=1),
        "a sketch": lambda: run(
            MODELS["tower"],
            nw.mh(steps=10, kernel=hmc),
            score=nw.no_self_intersection() * nw.floor(0),
            seed=1,
        ),
        "particles that still run": lambda: run(
            BEADS, nw.smc(particles=20, rejuvenate=k.hmc_step(), moves=1, at="resampled"), seed=1
        ),
        "no steps": lambda: k.hmc_step(steps=0),
        "too deep": lambda: k.nuts_step(max_depth=31),
        "a step backwards": lambda: k.hmc_step(step=-0.1),
        "too much jitter": lambda: k.hmc_step(jitter=2.0),
    }


def test_errors_are_as_reviewed(reviewed) -> None:
    reviewed(GOLDEN / "trajectories.txt", failing())


def test_particles_are_moved_at_the_end() -> None:
    method = nw.smc(particles=50, rejuvenate=k.hmc_step(steps=3, step=0.2), moves=3, at="end")
    assert np.isfinite([sample.log_score for sample in nw.run(BEADS, method, seed=1)]).all()


def test_kernels_are_read_as_they_are_written() -> None:
    text = "cycle(prior(), on('size', hmc_step(steps=5, jitter=0.5)), nuts_step(max_depth=4))"
    expected = k.cycle(k.prior(), k.on("size", k.hmc_step(steps=5, jitter=0.5)), k.nuts_step(max_depth=4))
    assert k.parse(text) == expected
    assert [repr(leaf) for leaf in expected.leaves()][0] == "prior()"


def test_a_sketch_is_no_hindrance_to_other_kernels() -> None:
    result = nw.run(MODELS["tower"], nw.mh(steps=50, kernel=k.prior()), score=nw.floor(0), seed=1)
    assert result.trajectories == []
