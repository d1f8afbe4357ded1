"""Chains that follow a gradient, from Python: their results, the choices that they hold fixed, and their refusals."""

from __future__ import annotations

import linecache
import math
import os
import signal
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import NiwakiError
from niwaki.gallery.point import point
from niwaki.result.hmc import GradientWarning

GOLDEN = Path(__file__).parents[2] / "golden"

TEXT = """
import math

from niwaki import model; from niwaki.words import *

@model
def garden(n=3):
    size = gamma(2.0, 1.0)
    share = dirichlet([1.0, 2.0, 3.0])
    for i in range(n):
        x = gaussian(0, 1 + size)
        emit(box((3 * i, x, 0), (1, 1 + share[0], 1)))
    return size

@model
def fork():
    tall = flip(0.5)
    x = gaussian(0, 1)
    if x > 0.5:
        y = gaussian(x, 1)
        factor(-y * y)
    return x

@model
def always(shift=0.0):
    d = sample(Delta(2.0))
    x = gaussian(d, 1)
    return x

@model
def coins():
    return flip(0.5)

@model
def root():
    x = gaussian(0, 1)
    y = math.exp(-1000.0 - x * x)
    factor(-math.sqrt(y))
    return x

@model
def never():
    x = uniform(0, 1)
    condition(x > 2)
    return x

@model
def words():
    x = gaussian(0, 1)
    if str(x) == "0":
        factor(-1)
    return x

@model
def halves():
    x = gaussian(0, 1)
    if x > 0:
        z = gaussian(1, 1)
        factor(0.7 * z)
    return x > 0

@model
def funnel(centred):
    spread = math.exp(gaussian(0, 3))
    for i in range(5):
        x = gaussian(0, spread) if centred else spread * gaussian(0, 1)
    return spread

@model
def scaled(spread):
    return gaussian(0.0, spread * gamma(2.0, 1.0))

@model
def vectors(spread):
    c = spread * spread
    return multivariate_gaussian([0.0, 0.0], [[c, 0.0], [0.0, c]])

@model
def overflow():
    x = gaussian(0, 1)
    factor(inf - inf if x > 1.0 else 0.0)
    return x
"""


def loaded() -> dict[str, Any]:
    name = "hmc_models.py"
    linecache.cache[name] = (len(TEXT), None, TEXT.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "hmc_models", "inf": float("inf")}
    exec(compile(TEXT, name, "exec"), space)
    return space


MODELS = loaded()
GARDEN = MODELS["garden"]


def few(**settings: Any) -> Any:
    return nw.nuts(**{"draws": 30, "warmup": 60, "chains": 2} | settings)


def test_draws_come_by_address_and_each_is_a_run() -> None:
    result = nw.run(GARDEN, few(), seed=3)
    assert {path.rsplit("/", 1)[-1] for path in result.draws} == {"size", "share", "x"}
    assert len(result.draws) == 5 and len(result) == 60
    for path, values in result.draws.items():
        assert values.shape == ((2, 30, 3) if path.endswith("share") else (2, 30))
    sample = result[37]
    for path, value in sample.choices.items():
        assert np.array_equal(result.draws[path][1, 7], value)
    assert sample.log_score == result.log_score[1, 7]
    assert sample.log_prior == pytest.approx(result.log_prior[1, 7])
    assert sample.primitives == 3 and len(sample.scene.parts) == 3
    assert sample.value == sample.choices[next(path for path in result.draws if path.endswith("size"))]
    # The density over coordinates is that of `log_density` at the draw's coordinates.
    density = nw.log_density(result[0])
    assert density(result.positions[1][7]) == pytest.approx(result.log_density[1, 7])
    again = nw.run(GARDEN, seed=1, choices=sample.choices).best
    assert again.log_prior == sample.log_prior


def test_a_seed_decides_every_bit_on_any_number_of_threads() -> None:
    # More gradients than the tape serves, so that machine code has its part.
    method = nw.hmc(draws=40, steps=50, warmup=60, chains=3)
    single, many = (nw.run(point, method, 1.0, seed=5, threads=threads) for threads in (1, 3))
    assert all(np.array_equal(single.draws[path], many.draws[path]) for path in single.draws)
    assert np.array_equal(single.step_size, many.step_size)
    other = nw.run(point, method, 1.0, seed=6)
    assert not np.array_equal(single.log_density, other.log_density)


def test_chains_in_lanes_draw_what_they_draw_alone() -> None:
    # 24 chains go in lanes on one thread, and each alone, with machine code, on eight. Near so thin a curve many
    # trajectories diverge after so short a warm-up: those are the same ones too.
    method = nw.hmc(draws=40, steps=30, jitter=0.5, warmup=40, chains=24)
    with pytest.warns(GradientWarning, match="diverged"):
        lanes, alone = (nw.run(point, method, seed=5, threads=threads) for threads in (1, 8))
    assert lanes.divergences == alone.divergences
    assert np.array_equal(lanes.stats["diverging"], alone.stats["diverging"])
    assert all(np.array_equal(lanes.draws[path], alone.draws[path]) for path in lanes.draws)
    assert np.array_equal(lanes.stats["energy"], alone.stats["energy"])
    assert np.array_equal(lanes.log_score, alone.log_score)


def test_a_point_stays_near_its_curve() -> None:
    result = nw.run(point, nw.nuts(draws=300, warmup=500, chains=2, target_accept=0.95), 0.02, seed=2)
    x, y = result.draws.values()
    assert np.abs(y**4 - y**2 + x**2 - 0.25).max() < 0.02 * 6
    # Both lobes of the curve are seen.
    assert (y > 0.5).any() and (y < -0.5).any()
    assert result.best.log_score == result.log_score.max()
    assert result.gradients > 1000 and (result.step_size > 0).all()


def test_what_is_discrete_is_held_fixed_with_a_warning_that_names_it() -> None:
    with pytest.warns(GradientWarning) as warned:
        result = nw.run(MODELS["fork"], few(chains=4), seed=1)
    held, refused = (str(warning.message) for warning in warned)
    assert "kept the value" in held and "tall`" in held and "refused for structure" in refused
    assert len(result.fixed) == 4
    assert {type(value) for fixed in result.fixed for value in fixed.values()} == {bool}
    # Whether there is a `y` hangs on the start of each chain, and no draw leaves its side.
    (path,) = [path for path in result.draws if path.endswith("x")]
    for chain, held in enumerate(result.draws[path]):
        assert len({bool(x > 0.5) for x in held}) == 1
        assert result[chain * 30].choices[path] == held[0]
    assert result.divergences.structure > 0


def test_a_choice_of_one_value_is_not_called_fixed() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = nw.run(MODELS["always"], few(), seed=1)
    assert result.fixed == [{}, {}]
    assert len(result.draws) == 1 and len(result[3].choices) == 2


def messages(*arguments: Any, **settings: Any) -> tuple[Any, list[str]]:
    """A result and the warnings of its run. Each warning names the line that runs the model."""
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        result = nw.run(*arguments, **settings)
    assert all(warning.category is GradientWarning and warning.filename == __file__ for warning in warned)
    return result, [str(warning.message) for warning in warned]


@pytest.mark.parametrize(
    "method",
    [nw.nuts(draws=300, warmup=200, thin=2), nw.hmc(draws=300, steps=10, warmup=200)],
    ids=["nuts", "hmc"],
)
def test_trajectories_refused_for_structure_are_reported_with_their_count(method: Any) -> None:
    """The count is the engine's; draws mark the same trajectories one by one."""
    result, warned = messages(MODELS["halves"], method, seed=9)
    refused, marked = result.divergences.structure, result.stats["refused_for_structure"]
    assert 300 < refused <= 1200 * method.thin and result.divergences.energy == 0
    assert marked.sum() == refused if method.thin == 1 else refused / 2 <= marked.sum() <= refused
    assert not result.stats["diverging"].any()
    (text,) = warned
    assert text.startswith(
        f"{refused} of {1200 * method.thin} trajectories of `halves` after the warm-up were refused"
    )
    assert f"kernels.cycle(kernels.prior(), kernels.{type(method).__name__.lower()}_step())" in text
    assert f"{refused} refused for structure" in repr(result)
    assert repr(result.summary()).endswith(f"\ntrajectories: {refused} refused for structure")


def test_divergences_are_reported_with_their_count() -> None:
    """A funnel that is drawn from its spread; of the same model, reparametrised, nothing is warned."""
    method = nw.nuts(draws=500, warmup=300)
    result, warned = messages(MODELS["funnel"], method, True, seed=1)
    count = result.divergences.energy
    assert count > 0 and result.divergences.structure == 0
    assert result.stats["diverging"].sum() == result.divergences.total
    assert not result.stats["refused_for_structure"].any()
    assert warned[0].startswith(f"{count} of 2000 trajectories of `funnel` after the warm-up diverged")
    assert (
        "raise `target_accept`, which is 0.8" in warned[0] and "mean + spread * gaussian(0, 1)" in warned[0]
    )
    assert f"{count} diverged" in repr(result) and f"{count} diverged" in repr(result.summary())
    better, quiet = messages(MODELS["funnel"], method, False, seed=1)
    assert quiet == [] and better.divergences.total == 0 and "trajectories" not in repr(better.summary())


def test_designs_are_counted_and_not_warned_of() -> None:
    result, warned = messages(point, nw.explore(), seed=1)
    assert result.divergences.energy > 0 and warned == []
    halves, warned = messages(MODELS["halves"], nw.explore(), seed=1)
    assert halves.divergences.structure > 0 and warned == []


def test_a_step_that_was_given_is_to_be_smaller() -> None:
    result, warned = messages(
        MODELS["funnel"], nw.hmc(draws=200, warmup=50, steps=5, step_size=3.0), True, seed=1
    )
    assert result.divergences.energy > 0 and "a smaller `step_size` than 3" in warned[0]


def test_gradients_that_are_not_finite_are_reported_with_their_count() -> None:
    result, warned = messages(MODELS["overflow"], few(), seed=1)
    assert warned[0].startswith(
        f"{result.divergences.not_finite} trajectories of `overflow` reached points without"
    )
    assert "factor(inf - inf" in warned[0] and len(warned) == 1


def test_an_extreme_scale_that_is_a_choice_is_an_error() -> None:
    """It has to be learnt, and its square is out of range."""
    for method in (few(), nw.mh(steps=50, kernel=nw.kernels.hmc_step())):
        for name, spread in (("scaled", 1e300), ("scaled", 1e-300), ("vectors", 1e150), ("vectors", 1e-150)):
            with pytest.raises(NiwakiError, match="extreme-scale"):
                nw.run(MODELS[name], method, spread, seed=1)


def test_chains_start_from_given_choices() -> None:
    choices = {path: 0.3 for path in nw.run(point, seed=1).best.choices}
    method = nw.hmc(draws=1, steps=1, warmup=0, chains=2, step_size=1e-9)
    result = nw.run(point, method, 1.0, seed=1, choices=choices)
    assert all(np.allclose(values, 0.3, atol=1e-6) for values in result.draws.values())


def test_ctrl_c_gives_what_there_is() -> None:
    timer = threading.Timer(0.7, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    result = nw.run(point, nw.hmc(draws=10**6, steps=1000, warmup=20, chains=2, step_size=0.01), 1.0, seed=1)
    assert result.interrupted and 0 < len(result) < 10**6
    assert math.isfinite(result.best.log_score)
    assert result.log_density.shape == next(iter(result.draws.values())).shape


def test_progress_is_reported() -> None:
    seen: list[int] = []
    method = nw.hmc(draws=4000, steps=60, chains=1)
    nw.run(point, method, 1.0, seed=1, progress=lambda p: seen.append(p.done))
    assert seen == sorted(seen) and seen[-1] > 0


def test_a_summary_and_arviz() -> None:
    result = nw.run(GARDEN, few(), seed=3)
    names = [row.name for row in result.summary()]
    assert names[-1] == "log density" and len(names) == 1 + 3 + 3 + 1
    pytest.importorskip("arviz", reason="ArviZ is not installed")
    tree = result.to_arviz()
    assert "energy" in tree["sample_stats"]


def failing() -> dict[str, Callable[[], Any]]:
    def run(name: str, **settings: Any) -> Callable[[], Any]:
        return lambda: nw.run(MODELS[name], few(tries=50), seed=1, **settings)

    return {
        "a scene that is scored by sketches": run("garden", score=nw.no_self_intersection() * nw.floor(0.0)),
        "no continuous choice": run("coins"),
        "no possible start": run("never"),
        "no derivative": run("words"),
        "no finite gradient at the start": run("root"),
        "too many draws": lambda: nw.hmc(draws=2**32),
    }


def test_errors_are_as_reviewed(golden) -> None:
    lines = []
    for title, fails in failing().items():
        with pytest.raises(NiwakiError) as error:
            fails()
        text = error.value.render() if hasattr(error.value, "render") else str(error.value)
        lines.append(f"# {title}\n{text}")
    golden(GOLDEN / "gradients.txt", "\n\n".join(lines) + "\n")


def test_chains_that_climb_start_higher_and_count_the_gradients_of_the_ascent() -> None:
    settings = {"draws": 1, "steps": 1, "step_size": 1e-9, "chains": 8, "warmup": 0, "metric": "unit"}
    flat, climbed, again = (
        nw.run(point, 0.001, method=nw.hmc(**settings, climb=climb), seed=3) for climb in (0, 1000, 1000)
    )
    # From thousands of nats below to within a few of the top, where the log density is about 3, or tens at most.
    assert np.median(flat.log_density) < -1000.0
    assert np.median(climbed.log_density) > 0.0 and climbed.log_density.min() > -100.0
    # The ascent ends by itself, where there is nothing to gain.
    assert flat.gradients + 8 * 40 < climbed.gradients < flat.gradients + 8 * 1000
    assert np.array_equal(climbed.log_density, again.log_density)
    assert len({round(float(x), 3) for x in climbed.draws[next(iter(climbed.draws))][:, 0]}) > 4
