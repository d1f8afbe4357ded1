"""The compatibility model agrees with reference scores: colours, single terms, whole colourings, gradients."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from niwaki import factor, log_density, mh, model, run, run_python, softeq, uniform
from niwaki.color import coloring, lab
from niwaki.color.model import to_lab

# The dissertation's drawings as chains of regions, light to dark: lightness, then chroma (its author's data).
ROBOT = (
    [
        [1, 4, 11],
        [1, 10, 6],
        [4, 5],
        [14, 13, 15],
        [9, 8, 18],
        [10, 17],
        [6, 12],
        [7, 3],
        [16, 17, 3],
        [0, 2],
    ],
    [[4, 5], [7, 3], [9, 8, 18], [14, 13, 15], [0, 2]],
)
HOUSE = (
    [
        *([1, 7], [1, 18], [1, 11], [11, 10, 0], [12, 13, 0], [7, 5, 6, 0], [18, 17, 19, 0], [15, 9, 0]),
        *([14, 16, 0], [4, 8, 0]),
    ],
    [[11, 10], [12, 13], [14, 16], [7, 5, 6], [18, 17, 19], [4, 8], [15, 9]],
)
BUG = ([[2, 1], [3, 4], [8, 5], [8, 6, 7], [4, 9]], [[2, 1], [3, 4], [6, 7]])
ROCKET = (
    [
        *([11, 13, 12], [10, 9, 8, 7], [9, 11], [7, 2], [12, 2], [19, 18], [1, 9], [3, 4], [4, 2], [18, 2]),
        *([13, 17], [16, 14], [2, 0]),
    ],
    [[11, 13, 12], [10, 9, 8, 7], [16, 14], [19, 18], [3, 4]],
)
# regions, chains, and the sums of the two terms for the colouring below
GOLDEN = {
    "robot": (19, ROBOT, -301.74472, -1264.5057),
    "house": (20, HOUSE, -271.94038, -1126.9208),
    "bug": (10, BUG, -167.8231, -923.28783),
    "rocket": (20, ROCKET, -258.29856, -1757.7594),
}


def pairs(chains: list[list[int]]) -> list[tuple[int, int]]:
    return [pair for chain in chains for pair in zip(chain, chain[1:], strict=False)]


def colors_of(count: int) -> list[tuple[float, float, float]]:
    return [
        ((37 * i + 11) % 101 / 100, (53 * i + 29) % 101 / 100, (71 * i + 47) % 101 / 100)
        for i in range(count)
    ]


def log_normal_density(x: float, mean: float, sd: float) -> float:
    return -0.5 * ((x - mean) / sd) ** 2 - math.log(sd * math.sqrt(2 * math.pi))


@pytest.mark.parametrize(
    ("rgb", "expected"),
    [
        ((1, 0, 0), (53.2408, 80.0925, 67.2032)),
        ((0, 1, 0), (87.7347, -86.1827, 83.1793)),
        ((0, 0, 1), (32.2970, 79.1875, -107.8602)),
        ((0.2, 0.4, 0.6), (41.98291, -0.32686, -33.73449)),
    ],
)
def test_a_colour_has_the_lab_values_of_the_dissertation_code(rgb, expected) -> None:
    assert tuple(to_lab(*map(float, rgb))) == pytest.approx(expected, abs=6e-5)
    assert tuple(lab.of_rgb(rgb)) == pytest.approx(expected, abs=6e-5)


def test_the_lightness_of_half_grey() -> None:
    assert to_lab(0.5, 0.5, 0.5).l == pytest.approx(53.77545, abs=6e-6)
    assert lab.of_rgb((0.5, 0.5, 0.5))[0] == pytest.approx(53.77545, abs=6e-6)


@pytest.mark.parametrize("name", GOLDEN)
def test_rules_score_as_in_the_dissertation_code(name: str) -> None:
    """The reference has eight digits of the rules' scores; it lacks the drawings' areas and neighbours."""
    count, (lightness, chroma), expected_lightness, expected_chroma = GOLDEN[name]
    pinned, no_areas = colors_of(count), [0.0] * count
    scores = [
        run_python(coloring, no_areas, [], rules[0], [], rules[1], [], [], 0, pinned, 1.0, seed=1).log_score
        for rules in ((pairs(lightness), []), ([], pairs(chroma)))
    ]
    assert scores[0] == pytest.approx(expected_lightness, rel=5e-8)
    assert scores[1] == pytest.approx(expected_chroma, rel=5e-8)


def ring_score(rgb, weight):
    """Score six regions in a ring with NumPy."""
    colors = lab.of_rgb(rgb)
    light, chroma = colors[:, 0], np.hypot(colors[:, 1], colors[:, 2])
    saturation = sum(
        log_normal_density(c / math.hypot(c, high), 0.3 if i == 0 else 0.7, 1.0) / 6
        for i, (c, high) in enumerate(zip(chroma, light, strict=True))
    )
    apart = 0.0
    for i in range(6):
        j = (i + 1) % 6
        apart += log_normal_density(np.linalg.norm(colors[i] - colors[j]) / 300, 0.3, 0.2)
        touches = 0.3 if 0 in (i, j) else 0.2
        apart += log_normal_density(abs(light[i] - light[j]) / 100, touches, 0.4)
    relation = log_normal_density((light[1] - light[2]) / 100, 0.15, 0.05)
    relation += log_normal_density((light[2] - light[4]) / 100, 0.15, 0.05)
    equal_chroma = log_normal_density(np.linalg.norm(colors[1, 1:] - colors[2, 1:]) / 282.9, 0.0, 5 / 282.9)
    return weight * (saturation + apart / 6 + relation + equal_chroma)


@pytest.mark.parametrize("weight", [1.0, 100.0])
def test_a_ring_of_six_scores_as_computed_by_hand(weight: float) -> None:
    ring = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (0, 5)]
    areas = [1 / 6] * 6
    for seed in range(5):
        rgb = np.random.default_rng(seed).random((6, 3))
        arguments = (areas, ring, [(1, 2), (2, 4)], [], [(1, 2)], [], [], 0)
        plain = run_python(coloring, *arguments, [tuple(c) for c in rgb.tolist()], weight, seed=1)
        assert plain.log_score == pytest.approx(ring_score(rgb, weight), abs=1e-9 * weight)


def test_engine_and_plain_run_agree() -> None:
    ring = [(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (0, 5)]
    arguments = ([1 / 6] * 6, ring, [(1, 2)], [(0, 3)], [(1, 2)], [(0, 3)], [(4, 20.0)], 0, [None] * 6, 100.0)
    sample = run(coloring, *arguments, seed=3)[0]
    assert len(sample.choices) == 18
    plain = run_python(coloring, *arguments, choices=sample.choices)
    assert plain.log_score == pytest.approx(sample.log_score, abs=1e-9 * abs(sample.log_score))


def test_equal_and_black_colours_have_finite_scores_and_slopes() -> None:
    """Two equal greys, and black, put square roots at 0."""
    arguments = ([0.5, 0.5], [(0, 1)], [], [], [(0, 1)], [(0, 1)], [(0, 10.0)], 0, [None, None], 100.0)
    sample = run(coloring, mh(steps=2, keep=1), *arguments, seed=1)[-1]
    density = log_density(sample)
    for x in (np.zeros(6), np.full(6, -60.0)):
        value, gradient = density.value_and_gradient(x)
        assert np.isfinite(value) and np.isfinite(gradient).all()


# ---- the colouring of the benches: another scale, sRGB's straight foot, sums instead of means

BENCH = Path(__file__).parents[3] / "benches" / "hmc"


@model
def bench_coloring(areas, edges, chroma, light):
    """The density of benches/hmc, without the constants of the normal densities."""
    labs = [bench_color() for _ in areas]
    for i in range(len(areas)):
        l, a, b = labs[i]  # noqa: E741
        c = a * a + b * b
        factor(-0.5 * areas[i] * (math.sqrt(c / (c + l * l)) - (0.3 if i == 0 else 0.7)) ** 2)
    for i, j in edges:
        dl, da, db = labs[i][0] - labs[j][0], labs[i][1] - labs[j][1], labs[i][2] - labs[j][2]
        factor(unscaled(abs(dl) / 100.0, 0.3 if i == 0 or j == 0 else 0.2, 0.4))
        factor(unscaled(math.sqrt(dl * dl + da * da + db * db) / 300.0, 0.3, 0.2))
    for i, j in chroma:
        factor(unscaled(labs[i][1] - labs[j][1], 0.0, 5.0) + unscaled(labs[i][2] - labs[j][2], 0.0, 5.0))
    for i, j in light:
        factor(unscaled(labs[i][0] - labs[j][0], 15.0, 5.0))


def bench_color():
    r = linear(uniform(0.0, 1.0))
    g = linear(uniform(0.0, 1.0))
    b = linear(uniform(0.0, 1.0))
    x = bench_root((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047)
    y = bench_root(0.2126729 * r + 0.7151522 * g + 0.0721750 * b)
    z = bench_root((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883)
    return 116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)


def linear(s):
    return s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4


def bench_root(t):
    return t ** (1.0 / 3.0) if t > (6.0 / 29.0) ** 3 else t * 841.0 / 108.0 + 4.0 / 29.0


def unscaled(x, mean, sd):
    return softeq(x, mean, sd) + math.log(sd) + 0.5 * math.log(2.0 * math.pi)


def test_the_colouring_of_the_benches_has_the_reference_values_and_gradients() -> None:
    words = (BENCH / "coloring.txt").read_text().split()
    n, *counts = map(int, words[:4])
    areas, rest = [float(word) for word in words[4 : 4 + n]], [int(word) for word in words[4 + n :]]
    table = [tuple(rest[k : k + 2]) for k in range(0, len(rest), 2)]
    edges, chroma = table[: counts[0]], table[counts[0] : counts[0] + counts[1]]
    light = table[counts[0] + counts[1] :]
    density = log_density(run(bench_coloring, areas, edges, chroma, light, seed=1)[0])
    lines = (BENCH / "reference.txt").read_text().splitlines()
    compared = 0
    for line in lines:
        name, dim, value, *numbers = line.split()
        if name != "coloring":
            continue
        x, gradient = np.array(numbers, dtype=float).reshape(2, int(dim))
        score, slope = density.value_and_gradient(x)
        # The engine rounds terms of log densities to a grid; a thousand terms stay within 1e-9.
        assert score == pytest.approx(float(value), abs=1e-9)
        assert slope == pytest.approx(gradient, abs=1e-9 * np.abs(gradient).max())
        compared += 1
    assert compared == 3
