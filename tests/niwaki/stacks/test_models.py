"""Claim: the structures are the dissertation's: their sizes, their geometry, their forces and their balance.

Numbers to check against come from running the original's rules by hand or with SciPy. The one statistical test fails a
true model in one of ten thousand seeds; its seed is fixed.
"""

from __future__ import annotations

from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki import stacks
from niwaki.lang import densities
from niwaki.lang.models import Model
from niwaki.stacks.blocks import box_corners, volume_and_centre
from niwaki.stacks.contacts import DOWN, GROUND, Contact, Tolerance, balance, contact, corners, force_at
from niwaki.stacks.structure import Structure
from niwaki.stacks.towers import BOTTOM, FLOOR, GROUND_TOP, TOP
from scipy import stats
from scipy.spatial import ConvexHull

AnyModel = Model[..., Any]

#: Continuous choices of each model.
COUNTS = {
    stacks.stack: 118,
    stacks.lean: 118,
    stacks.top_heavy: 118,
    stacks.platforms: 330,
    stacks.wheel: 555,
    stacks.tri_arch: 555,
    stacks.symmetric_tri_arch: 555,
    stacks.arch: 209,
    stacks.symmetric_arch: 209,
    stacks.cut_stack: 101,
    stacks.cut_lean: 106,
    stacks.cut_top_heavy: 106,
    stacks.tilt_stack: 178,
    stacks.cut_arch: 130,
    stacks.tilt_arch: 226,
    stacks.every_step: 198,
}
EVERY = pytest.mark.parametrize("model", COUNTS, ids=lambda model: model.name)


@pytest.fixture
def nominal(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every uniform choice at its middle, every force at its median."""

    def draw(dist: Any, seed: Any, address: str) -> float:
        if isinstance(dist, nw.words.Uniform):
            return 0.5 * (dist.lo + dist.hi)
        return 1.0 if isinstance(dist, nw.words.Exponential) else 0.0

    monkeypatch.setattr(densities, "draw", draw)


def corners_of(structure: Any) -> Any:
    return np.array([[list(point) for point in block] for block in structure.blocks])


@EVERY
def test_models_make_as_many_continuous_choices_as_the_original(model: AnyModel) -> None:
    assert len(nw.run_python(model, seed=3).choices) == COUNTS[model]


@EVERY
def test_the_engine_agrees_with_plain_python(model: AnyModel) -> None:
    plain = nw.run_python(model, seed=3)
    engine = nw.run(model, choices=plain.choices).best
    assert engine.log_score == pytest.approx(plain.log_score, rel=1e-12)
    assert engine.log_prior == pytest.approx(plain.log_prior, rel=1e-12)
    ours, theirs = corners_of(plain.value), corners_of(engine.value)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-12)
    assert len(engine.scene) == len(ours)


@pytest.mark.parametrize(
    ("model", "top", "volume", "blocks", "touches"),
    [
        (stacks.tri_arch, 489.58, 2866.74, 29, 32),
        (stacks.symmetric_tri_arch, 489.48, 2827.45, 29, 32),
        (stacks.wheel, 473.28, 3071.21, 29, 32),
        (stacks.arch, 247.75, 918.43, 11, 12),
    ],
    ids=lambda value: getattr(value, "name", ""),
)
def test_arches_at_their_middles_have_the_known_size(
    nominal: None, model: AnyModel, top: float, volume: float, blocks: int, touches: int
) -> None:
    structure = Structure.of(nw.run_python(model, seed=1))
    assert (len(structure), len(structure.touches)) == (blocks, touches)
    assert 1e3 * structure.corners[:, :, 2].max() == pytest.approx(top, abs=0.006)
    assert 1e6 * structure.solids()[0].sum() == pytest.approx(volume, abs=0.006)


TOWERS = (stacks.stack, stacks.every_step, stacks.cut_lean, stacks.tilt_stack)


@pytest.mark.parametrize("model", TOWERS, ids=lambda model: model.name)
def test_volume_and_centre_are_those_of_the_convex_hull(model: AnyModel) -> None:
    structure = Structure.of(nw.run_python(model, seed=4))
    for number, points in enumerate(structure.corners):
        volume, centre = structure.solid(number)
        in_language = volume_and_centre(tuple(nw.vec(*p) for p in points.tolist()))
        hull = ConvexHull(points)
        assert in_language[0] == pytest.approx(volume, rel=1e-9)
        np.testing.assert_allclose(list(in_language[1]), centre, rtol=0, atol=1e-12)
        assert volume == pytest.approx(hull.volume, rel=1e-9)


def test_the_mean_of_the_corners_is_another_point() -> None:
    structure = Structure.of(nw.run_python(stacks.stack, seed=5))
    off = [
        np.linalg.norm(structure.solid(k)[1] - points.mean(axis=0))
        for k, points in enumerate(structure.corners)
    ]
    assert max(off) > 1e-3


def cubes(count: int, side: float = 0.05) -> list[Any]:
    return [
        box_corners(nw.vec(0.0, 0.0, GROUND_TOP + (k + 0.5) * side), side, side, side) for k in range(count)
    ]


@nw.model
def tower(width: float = 0.005) -> float:
    pieces = cubes(6)
    found = [contact(0, corners(pieces[0], BOTTOM), GROUND, FLOOR)]
    for i in range(1, 6):
        found = found + [contact(i, corners(pieces[i], BOTTOM), i - 1, corners(pieces[i - 1], TOP))]
    balance(pieces, found, 0.5, Tolerance(width, True, 0.0), DOWN)
    return 0.0


def score_of(pushes: list[float]) -> float:
    """The tower's score with the same push at the four corners of each contact, less the densities' constants."""
    choices = dict(nw.run_python(tower, seed=1).choices)
    names = [name for name in choices if name.endswith("push")]
    assert len(names) == 24
    for name in choices:
        choices[name] = 0.0
    for k, name in enumerate(names):
        choices[name] = pushes[k // 4]
    constant = 36 * (-np.log(0.005) - 0.5 * np.log(2.0 * np.pi))
    return nw.run_python(tower, choices=choices).log_score - constant


def test_a_tower_of_cubes_balances_under_the_known_forces() -> None:
    # Six equal weights: a contact's corner carries a quarter of what is above it, in mean weights.
    assert score_of([(6 - k) / 4 for k in range(6)]) == pytest.approx(0.0, abs=1e-6)


def test_without_forces_each_block_lacks_its_weight() -> None:
    assert score_of([1e-15] * 6) == pytest.approx(-6 / (2 * 0.005**2), rel=1e-9)


def test_a_force_on_the_wrong_contact_is_seen() -> None:
    assert score_of([(6 - k) / 4 for k in (1, 0, 2, 3, 4, 5)]) < -1000


@pytest.mark.parametrize(("cone", "uniform"), [(True, True), (False, False)], ids=["cone", "pyramid"])
def test_tangents_are_uniform_over_the_disc(cone: bool, uniform: bool) -> None:
    x, y, z = nw.vec(1.0, 0.0, 0.0), nw.vec(0.0, 1.0, 0.0), nw.vec(0.0, 0.0, 1.0)
    touch = Contact(0, 1, (z, z, z, z), z, x, y)

    @nw.model
    def forces() -> Any:
        return [force_at(touch, 0.5, cone) for _ in range(4000)]

    values = np.array([list(force) for force in nw.run_python(forces, seed=5).value])
    inside = values[:, :2] / (0.5 * values[:, 2:])
    squares = (inside**2).sum(axis=1)
    # Area grows with the square of the radius; a square reaches beyond the disc.
    assert (stats.kstest(squares, "uniform").pvalue > 1e-4) == uniform
    assert (squares.max() <= 1.0) == uniform
    assert np.abs(inside).max() <= 1.0


UNIT = tuple(nw.vec(*p) for p in ((0.25, 0.5, 0.0), (0.25, 2.0, 0.0), (3.0, 2.0, 0.0), (3.0, 0.5, 0.0)))


def test_a_contact_is_the_overlap_of_two_rectangles() -> None:
    square = tuple(nw.vec(*p) for p in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)))

    @nw.model
    def touching() -> Any:
        return contact(0, square, 1, UNIT)

    touch = nw.run_python(touching, seed=1).value
    corners_of_overlap = [tuple(point) for point in touch.points]
    assert corners_of_overlap == [(0.25, 0.5, 0.0), (1.0, 0.5, 0.0), (1.0, 1.0, 0.0), (0.25, 1.0, 0.0)]


def test_blocks_that_slide_apart_are_impossible_and_named() -> None:
    square = tuple(nw.vec(*p) for p in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)))
    away = tuple(point + nw.vec(2.0, 0.0, 0.0) for point in square)

    @nw.model
    def apart() -> Any:
        return contact(0, square, 1, away)

    run = nw.run_python(apart, seed=1)
    assert run.log_score == -np.inf
    blocks = np.array([[list(p) for p in block] for block in cubes(2)])
    touch = run.value
    frame = [list(touch.normal), list(touch.along), list(touch.across)]
    with pytest.raises(nw.NiwakiError, match="block 1 and block 2 no longer touch"):
        stacks.plain(blocks, [(0, 1, [list(p) for p in touch.points], frame)], 0.5)


def test_contradictory_requests_are_named_by_the_residuals() -> None:
    # Blocks have at most 64 times the least volume: five steps of 40 cannot be.
    choices = nw.run_python(stacks.top_heavy, seed=1, ratio=40.0).choices
    factors = nw.residuals(stacks.top_heavy, choices=choices, ratio=40.0)
    growths = [row for row in factors if "grow_by" in row.address]
    assert len(growths) == 5
    assert min(row.widths for row in growths) > 100


@pytest.mark.parametrize("model", [stacks.stack, stacks.arch, stacks.tilt_arch], ids=lambda model: model.name)
def test_gradients_are_those_of_differences(model: AnyModel) -> None:
    density = nw.log_density(nw.run(model, seed=1).best)
    rng = np.random.default_rng(1)
    x, step = 0.2 * rng.normal(size=density.dim), rng.normal(size=density.dim)
    value, gradient = density.value_and_gradient(x)
    assert np.isfinite(value)
    h = 1e-5
    slope = (density(x + h * step) - density(x - h * step)) / (2 * h)
    assert gradient @ step == pytest.approx(slope, rel=1e-6)
