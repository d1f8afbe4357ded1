"""Gradients of random programs are those of central differences, to 1e-6 of the largest component.

The differences are taken of the density itself where its value is also checked against the engine's own log joint:
after a recording the density at the run's coordinates is log prior + log score + the Jacobians, which are checked one
family at a time in the engine's tests. Seeds are fixed; nothing here is statistical.
"""

from __future__ import annotations

import secrets

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import NiwakiError
from niwaki.result.gradient import LogDensity
from programs import program
from test_engine import load

PROGRAMS = 100
#: Why a random program may have no density.
WITHOUT = {"no-continuous-choices", "no-derivative", "impossible-trace"}


def slope(f: LogDensity, x: np.ndarray, k: int) -> tuple[float, float]:
    """Central differences of two widths, and their extrapolation with its own error estimate."""
    step = np.zeros_like(x)
    slopes = []
    for h in (4e-4, 2e-4, 1e-4):
        step[k] = h
        slopes.append((f(x + step) - f(x - step)) / (2 * h))
    first, second = (4 * slopes[1] - slopes[0]) / 3, (4 * slopes[2] - slopes[1]) / 3
    return (16 * second - first) / 15, abs(second - first)


def checked(seed: int) -> str:
    """Return the outcome of a program: "checked", "corner" (no smooth difference), or why it has no density."""
    try:
        sample = nw.run(load(program(seed, 6).text), seed=seed).best
        density = nw.log_density(sample)
    except NiwakiError as error:
        return str(error.code)
    if not np.isfinite(sample.log_joint):
        return "impossible-trace"
    value, gradient = density.value_and_gradient(density.start)
    assert np.isfinite(value), seed
    lines = sum(c.transform == "line" for c in density.choices)
    if lines == len(density.choices):
        # No Jacobians; terms are rounded to 2^-32 in the one and not in the other.
        assert abs(value - sample.log_joint) < 1e-7 * max(1.0, abs(value)), seed
    size = max(1e-2, float(np.abs(gradient).max()))
    smooth = True
    for k in range(density.dim):
        numeric, error = slope(density, density.start, k)
        if not np.isfinite(numeric) or error > 1e-6 * size:
            smooth = False
        else:
            assert abs(numeric - gradient[k]) < 1e-6 * size, (seed, k, numeric, gradient[k])
    return "checked" if smooth else "corner"


def look(programs: int, first: int) -> None:
    """Checks so many programs, from a seed on."""
    outcomes: dict[str, int] = {}
    seed = first
    while outcomes.get("checked", 0) < programs and seed < first + 12 * programs:
        outcome = checked(seed)
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
        seed += 1
    assert outcomes["checked"] == programs, outcomes
    assert outcomes.get("corner", 0) < 0.2 * programs, outcomes


def test_random_programs() -> None:
    look(PROGRAMS, 0)


@pytest.mark.soak
def test_random_programs_for_long() -> None:
    first = secrets.randbelow(2**31)
    print(f"first seed {first}")
    look(5 * PROGRAMS, first)


@pytest.mark.parametrize("seed", range(20))
def test_machine_code_gives_what_the_tape_gives(seed: int) -> None:
    try:
        density = nw.log_density(nw.run(load(program(seed, 6).text), seed=seed).best)
    except NiwakiError as error:
        assert error.code
        return
    value, gradient = density.value_and_gradient(density.start)
    density.compile()
    again, by_code = density.value_and_gradient(density.start)
    assert np.isclose(value, again, rtol=1e-11, atol=1e-11)
    assert np.allclose(gradient, by_code, rtol=1e-10, atol=1e-10)
