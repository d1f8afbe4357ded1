"""Claim: posterior means are those that others found.

Five models of the Inference Gym (Apache-2.0), whose data and ground truths lie in its wheel; these files are read as
data, so that TensorFlow is not needed. Every mean lies within 4 standard errors, ours and theirs combined. A true
sampler is outside once in 16,000 means; 240 means are judged, so one set of seeds in 65 would fail; the seeds are
fixed. A mutant, whose observations are twice as noisy as the data's, must be found out.

These run in `make soak`, where `inference_gym` is installed (extra `bench-hmc`).
"""

from __future__ import annotations

import importlib.util
import math
import runpy
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import diagnostics, model
from niwaki.words import Gaussian

FOUND = importlib.util.find_spec("inference_gym")
pytestmark = [
    pytest.mark.soak,
    pytest.mark.skipif(FOUND is None, reason="inference_gym is not installed (extra bench-hmc)"),
]


def read(*parts: str) -> dict[str, Any]:
    """The arrays of one file of the wheel, which imports NumPy alone."""
    assert FOUND is not None and FOUND.submodule_search_locations
    return runpy.run_path(str(Path(FOUND.submodule_search_locations[0]).joinpath(*parts)))


def dataset(name: str) -> dict[str, Any]:
    return read("internal", "datasets", f"{name}.py")


EFFECTS = [28.0, 8.0, -3.0, 7.0, -1.0, 1.0, 18.0, 12.0]
DEVIATIONS = [15.0, 10.0, 16.0, 11.0, 9.0, 11.0, 10.0, 18.0]


@model
def eight_schools(effects, deviations):
    average = nw.gaussian(0.0, 10.0)
    log_deviation = nw.gaussian(5.0, 1.0)
    for i in range(len(effects)):
        school = nw.gaussian(average, math.exp(log_deviation))
        nw.observe(Gaussian(school, deviations[i]), effects[i])
    return average


@model
def walk(seen, innovation, noise):
    place = 0.0
    for y in seen:
        place = nw.gaussian(place, innovation)
        if y is not None:
            nw.observe(Gaussian(place, noise), y)
    return place


@model
def walk_of_unknown_scales(seen):
    innovation = nw.log_normal(0.0, 2.0)
    noise = nw.log_normal(0.0, 2.0)
    place = 0.0
    for y in seen:
        place = nw.gaussian(place, innovation)
        if y is not None:
            nw.observe(Gaussian(place, noise), y)
    return place


@model
def convection(seen, innovation, noise, step):
    x = nw.gaussian(0.0, 1.0)
    y = nw.gaussian(0.0, 1.0)
    z = nw.gaussian(0.0, 1.0)
    deviation = math.sqrt(step) * innovation
    if seen[0] is not None:
        nw.observe(Gaussian(x, noise), seen[0])
    for value in seen[1:]:
        dx = 10.0 * (y - x)
        dy = x * (28.0 - z) - y
        dz = x * y - 8.0 / 3.0 * z
        x = nw.gaussian(x + step * dx, deviation)
        y = nw.gaussian(y + step * dy, deviation)
        z = nw.gaussian(z + step * dz, deviation)
        if value is not None:
            nw.observe(Gaussian(x, noise), value)
    return x


@model
def volatility(returns):
    persistence = 2.0 * nw.beta(20.0, 1.5) - 1.0
    mean = nw.cauchy(0.0, 5.0)
    # A half-Cauchy by its quantiles.
    shock = 2.0 * math.tan(0.5 * math.pi * nw.uniform(0.0, 1.0))
    above = shock / math.sqrt(1.0 - persistence * persistence) * nw.gaussian(0.0, 1.0)
    for i in range(len(returns)):
        if i > 0:
            above = persistence * above + shock * nw.gaussian(0.0, 1.0)
        nw.observe(Gaussian(0.0, math.exp(0.5 * (mean + above))), returns[i])
    return mean


def volatilities(draws: np.ndarray) -> np.ndarray:
    """What the Gym calls its parameters, from our choices, both (numbers, chains, draws)."""
    persistence, mean, shock = 2 * draws[0] - 1, draws[1], 2 * np.tan(0.5 * np.pi * draws[2])
    above = shock / np.sqrt(1 - persistence**2) * draws[3]
    series = [mean + above]
    for z in draws[4:]:
        above = persistence * above + shock * z
        series.append(mean + above)
    return np.array([persistence, mean, shock, *series])


def with_gaps(values: Any, seen: Any) -> list[float | None]:
    return [float(value) if there else None for value, there in zip(values, seen, strict=True)]


def errors(result: nw.HmcResult, truth: str, names: tuple[str, ...], turned: Any = None) -> np.ndarray:
    """How many combined standard errors each mean is off; chains must agree."""
    draws = np.array(list(result.draws.values()))
    found = draws if turned is None else turned(draws)
    known = read("targets", "ground_truth", f"{truth}.py")

    def all_of(what: str) -> np.ndarray:
        keys = ["_".join(word for word in ("IDENTITY", name, what) if word) for name in names]
        return np.concatenate([np.ravel(known[key]) for key in keys])

    means, theirs = all_of("MEAN"), all_of("MEAN_STANDARD_ERROR")
    assert len(found) == len(means)
    assert max(diagnostics.rhat(x) for x in found) < 1.03
    ours = np.array([diagnostics.mcse_mean(x) for x in found])
    return np.abs(found.mean(axis=(1, 2)) - means) / np.hypot(ours, theirs)


def nuts(**more: Any) -> Any:
    return nw.nuts(draws=2500, warmup=1500, chains=4, **{"target_accept": 0.9, **more})


def test_eight_schools() -> None:
    result = nw.run(eight_schools, nuts(), EFFECTS, DEVIATIONS, seed=1)
    names = ("AVG_EFFECT", "LOG_STDDEV", "SCHOOL_EFFECTS")
    assert errors(result, "eight_schools", names).max() < 4


BROWNIAN = "brownian_motion_missing_middle_observations"


def brownian() -> tuple[list[float | None], float, float]:
    data = dataset(BROWNIAN)
    seen = data["OBSERVED_LOC"]
    return with_gaps(seen, ~np.isnan(seen)), data["INNOVATION_NOISE"], data["OBSERVATION_NOISE"]


def test_a_walk_with_a_gap_and_not_one_of_twice_the_noise() -> None:
    seen, innovation, noise = brownian()
    result = nw.run(walk, nuts(), seen, innovation, noise, seed=2)
    assert errors(result, BROWNIAN, ("",)).max() < 4
    mutant = nw.run(walk, nuts(), seen, innovation, 2 * noise, seed=2)
    assert errors(mutant, BROWNIAN, ("",)).max() > 10


def test_a_walk_of_unknown_scales() -> None:
    result = nw.run(walk_of_unknown_scales, nuts(target_accept=0.95), brownian()[0], seed=3)
    names = ("INNOVATION_NOISE_SCALE", "OBSERVATION_NOISE_SCALE", "LOCS")
    assert errors(result, "brownian_motion_unknown_scales_missing_middle_observations", names).max() < 4


def test_convection() -> None:
    data = dataset("convection_lorenz_bridge")
    seen = with_gaps(data["OBSERVED_VALUES"], data["OBSERVATION_MASK"])
    assert data["OBSERVATION_INDEX"] == 0
    scales = (data["INNOVATION_SCALE"], data["OBSERVATION_SCALE"], data["STEP_SIZE"])
    result = nw.run(convection, nuts(), seen, *map(float, scales), seed=4)
    assert errors(result, "convection_lorenz_bridge", ("",)).max() < 4


def test_stochastic_volatility() -> None:
    returns = np.diff(np.log(dataset("sp500_closing_prices")["CLOSING_PRICES"]))[-100:]
    result = nw.run(volatility, nuts(target_accept=0.95), list(returns - returns.mean()), seed=5)
    names = ("PERSISTENCE_OF_VOLATILITY", "MEAN_LOG_VOLATILITY", "WHITE_NOISE_SHOCK_SCALE", "LOG_VOLATILITY")
    assert errors(result, "stochastic_volatility_log_sp500_small", names, volatilities).max() < 4
