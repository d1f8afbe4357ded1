"""Claim: soft constraints follow their documented formulas, are smooth, and their residuals are reported."""

from __future__ import annotations

import math

import niwaki as nw
import pytest
from niwaki.words import soft


def test_equality_is_the_normal_density() -> None:
    expected = math.log(math.exp(-0.5 * (0.3 / 0.2) ** 2) / (0.2 * math.sqrt(2 * math.pi)))
    assert nw.softeq(1.3, 1.0, 0.2) == pytest.approx(expected, rel=1e-13)


def test_one_sided_scores_are_flat_on_one_side() -> None:
    assert nw.soft_at_least(5.0, 1.0, 0.1) == pytest.approx(0.0, abs=3e-5)
    assert nw.soft_at_least(1.0, 1.0, 0.1) == -0.125
    assert nw.soft_at_least(0.0, 1.0, 0.01) == pytest.approx(-5000.0, rel=1e-3)
    assert nw.soft_at_most(0.0, 1.0, 0.3) == nw.soft_at_least(1.0, 0.0, 0.3)


FUNCTIONS = [
    (soft.softeq, 3),
    (soft.soft_at_least, 3),
    (soft.soft_at_most, 3),
    (soft.smooth_max, 3),
    (soft.smooth_min, 3),
    (soft.smooth_abs, 2),
]


@pytest.mark.parametrize(("function", "count"), FUNCTIONS, ids=lambda x: getattr(x, "__name__", ""))
def test_there_is_no_corner(function, count) -> None:  # type: ignore[no-untyped-def]
    """The slope jumps nowhere: where a corner would be, left and right differ by the curvature times the step."""
    for place in range(count):
        for at in (-0.3, 0.0, 0.3):
            args = [at, 0.0, 0.5] if count == 3 else [at, 0.5]

            def value(step: float, args: list[float] = args, place: int = place) -> float:
                moved = list(args)
                moved[place] += step
                return float(function(*moved))

            h = 1e-4
            left, right = (value(0.0) - value(-h)) / h, (value(h) - value(0.0)) / h
            assert abs(right - left) < 20 * h


@pytest.mark.parametrize("width", [0, -1, math.nan, math.inf])
def test_a_width_is_above_zero(width: float) -> None:
    def model():  # type: ignore[no-untyped-def]
        factor_of = nw.uniform(0, 1)
        nw.factor(nw.softeq(factor_of, 0.5, width))

    with pytest.raises(nw.ModelFault) as plain:
        nw.run_python(model, seed=1)
    with pytest.raises(nw.ModelFault) as engine:
        nw.run(model, seed=1)
    assert plain.value.code == engine.value.code == "bad-argument"


@nw.model
def contradictory(n):  # type: ignore[no-untyped-def]
    """Contradict a soft equality by soft bounds."""
    x = nw.uniform(0.0, 10.0)
    nw.factor(nw.softeq(x, 2.0, 0.1))
    for i in range(n):
        nw.factor(nw.soft_at_least(x, 4.0 + i, 0.5))
    nw.factor(nw.soft_at_most(x, 9.0, 0.5))
    return x


def test_residuals_show_constraints_that_do_not_hold() -> None:
    sample = nw.run(contradictory, 2, seed=3, method=nw.importance(200)).best
    constraints = nw.residuals(contradictory, 2, choices=sample.choices)
    assert len(constraints) == 4 and len(constraints.beyond(3.0)) >= 1
    assert [constraint.widths for constraint in constraints] == sorted(
        (constraint.widths for constraint in constraints), reverse=True
    )
    x = sample.choices["x"]
    by_kind = {(constraint.kind, constraint.goal): constraint for constraint in constraints}
    assert by_kind["softeq", 2.0].residual == pytest.approx(x - 2.0)
    assert by_kind["soft_at_least", 5.0].residual == pytest.approx(5.0 - x)
    assert by_kind["soft_at_most", 9.0].residual == 0.0
    assert by_kind["soft_at_least", 5.0].address == "i[1]/soft_at_least"
    assert by_kind["softeq", 2.0].line.partition(":")[0].endswith("test_soft.py")
    assert len(repr(constraints).splitlines()) == 5


def test_plain_runs_with_constraints_score_as_in_the_engine() -> None:
    run = nw.run_python(contradictory, 2, seed=3)
    here = nw.run(contradictory, 2, choices=run.choices).best
    assert here.log_score == pytest.approx(run.log_score, rel=1e-12)
