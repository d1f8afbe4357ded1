"""Colourings keep rules and held colours, differ, depend only on the seed, and are written to files."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from niwaki import explore, mh
from niwaki.color import Drawing, Rules, color, lab
from niwaki.color.search import default_method, farthest
from niwaki.errors import InputError
from niwaki.shell.main import app
from PIL import Image
from typer.testing import CliRunner

pytest.importorskip("resvg_py")

QUICK = mh(steps=600, chains=3, warmup=400, keep=3)
BODY = (
    '<rect class="sky" width="60" height="40"/><rect class="roof" x="10" y="10" width="20" height="9"/>'
    '<rect class="wall" x="10" y="19" width="20" height="21"/><rect class="door" x="15" y="30" width="5" height="10"/>'
)


@pytest.fixture
def small(tmp_path):
    place = tmp_path / "small.svg"
    place.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 40">{BODY}</svg>', encoding="utf-8"
    )
    (tmp_path / "rules.toml").write_text(
        'lightness = [["wall", "roof"]]\nsame-chroma = [["roof", "door"]]\nsame-hue = [["wall", "sky"]]\n'
        'lighter = [["sky", "door"]]\n[muted]\nall = 60\nsky = 20\n[held]\nwall = "#e8d9b0"\n',
        encoding="utf-8",
    )
    return place


def test_pinned_colours_stay_and_rules_are_kept(small, tmp_path) -> None:
    rules = Rules.load(tmp_path / "rules.toml")
    colorings = color(small, rules, 3, method=mh(steps=4000, chains=4, warmup=2000, keep=4), seed=1)
    assert len({coloring.colors["sky"] for coloring in colorings}) == 3
    for coloring in colorings:
        assert coloring.colors["wall"] == "#e8d9b0"
        kinds = [row.rule.kind for row in coloring.report]
        assert kinds == ["lightness", "lighter", "same-chroma", "same-hue", "muted", "muted", "muted"]
        labs = {name: lab.of_hex(code) for name, code in coloring.colors.items()}
        relation, lighter, chroma, hue, sky, *_ = coloring.report
        # Bytes round colours by about half a unit.
        assert relation.value == pytest.approx(labs["wall"][0] - labs["roof"][0], abs=0.6)
        assert relation.residual == pytest.approx(relation.value - 15.0, abs=1e-9)
        assert lighter.value == pytest.approx(labs["sky"][0] - labs["door"][0], abs=0.6)
        distance = np.hypot(labs["roof"][1] - labs["door"][1], labs["roof"][2] - labs["door"][2])
        assert chroma.value == pytest.approx(distance, abs=1.2)
        assert sky.rule.first == "sky" and sky.goal == pytest.approx(20.0)
        assert sky.value == pytest.approx(np.hypot(*labs["sky"][1:]), abs=0.6)
        # The width of 5 acts like 0.5; the limit is six such widths.
        assert abs(relation.residual) < 3.0 and chroma.residual < 3.0


def test_the_seed_determines_the_colours(small) -> None:
    first, again, other = (
        [coloring.colors for coloring in color(small, count=2, method=QUICK, seed=seed)] for seed in (1, 1, 2)
    )
    assert first == again != other


def test_the_choice_is_farthest_in_the_better_half() -> None:
    """Points on a line at 0 (best), 1, 2, 10 and 99 (worst): 10 is farther than 2, and 99 is not good enough."""
    labs = np.zeros((8, 1, 3))
    labs[:, 0, 0] = [0, 1, 2, 10, 99, 98, 97, 96]
    scores = np.array([8, 7, 6, 5, 4, 3, 2, 1.0])
    assert farthest(labs, scores, [1.0], 3) == [0, 3, 2]
    assert farthest(labs, scores, [1.0], 5)[:2] == [0, 4]


def test_a_count_above_the_samplers_draws_gives_an_error(small) -> None:
    with pytest.raises(InputError, match="count"):
        color(small, count=500, method=QUICK, seed=1)


@pytest.mark.parametrize("strictness", [0, -1.0, float("nan"), float("inf"), True])
def test_strictness_is_a_number_above_zero(small, strictness: float) -> None:
    with pytest.raises(InputError, match="strictness"):
        color(small, strictness=strictness, count=1, seed=1)


def test_the_default_is_many_short_chains_that_follow_the_gradient() -> None:
    assert default_method(12) == explore(draws=1, chains=36)


def test_the_command_writes_the_files_that_it_names(small, tmp_path) -> None:
    out = tmp_path / "out"
    result = CliRunner().invoke(
        app,
        ["color", str(small), "--rules", str(tmp_path / "rules.toml"), "-n", "2", "-o", str(out)]
        + ["--side", "120", "--seed", "1"],
        catch_exceptions=False,
    )
    assert result.exit_code == 0 and "2 colourings" in result.stdout
    names = ["01.png", "01.svg", "02.png", "02.svg", "colors.json", "residuals.csv", "sheet.png"]
    assert sorted(path.name for path in out.iterdir()) == names
    colors = json.loads((out / "colors.json").read_text())
    with Image.open(out / "01.png") as image:
        assert image.size == (120, 80)
    painted = Drawing.load(out / "01.svg")
    sky = painted.picture({}, 120).getpixel((2, 2))
    assert "#" + "".join(f"{part:02x}" for part in sky[:3]) == colors["01"]["sky"]
    with (out / "residuals.csv").open() as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["rule", "first", "second", "wanted", "01", "02"] and len(rows) == 8
    assert rows[1][:4] == ["lightness", "wall", "roof", "15"]


def test_ascent_keeps_rules_better_and_pinned_colours_unchanged(small, tmp_path) -> None:
    rules = Rules.load(tmp_path / "rules.toml")
    left, moved = (color(small, rules, 3, method=QUICK, settle=steps, seed=5) for steps in (0, 200))
    assert min(coloring.log_score for coloring in moved) > max(coloring.log_score for coloring in left)
    worst = [
        max(abs(row.residual) for coloring in colorings for row in coloring.report)
        for colorings in (left, moved)
    ]
    assert worst[1] < 0.2 * worst[0]
    assert {coloring.colors["wall"] for coloring in moved} == {"#e8d9b0"}


@pytest.mark.parametrize("name", ["robot", "house", "bug", "rocket"])
def test_twelve_colourings_of_the_packages_drawings_keep_the_rules_and_differ(name: str) -> None:
    colorings = color(name, count=12, seed=2)
    for coloring in colorings:
        for row in coloring.report:
            # The limits are three effective widths: 0.5 CIELAB units, and 3 degrees of hue.
            limit = 9.0 if row.rule.kind == "same-hue" else 1.5
            assert abs(row.residual) < limit, row
    labs = np.array([[lab.of_hex(code) for code in coloring.colors.values()] for coloring in colorings])
    weights = np.sqrt(colorings[0].drawing.areas)
    for k in range(12):
        for j in range(k):
            # 10 units are a visible difference.
            assert np.linalg.norm(labs[k] - labs[j], axis=1) @ weights / weights.sum() > 10.0
