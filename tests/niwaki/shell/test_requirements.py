"""Requirements beside a model: read, held against runs, and kept by searches of the shell and of the studio."""

from __future__ import annotations

import json
from pathlib import Path

import niwaki as nw
import numpy as np
import pytest
from niwaki import InputError, _engine, box, cylinder, emit, model, rotation, run
from niwaki.draw.scene import Scene
from niwaki.methods import Forward
from niwaki.requirements import Keep
from niwaki.requirements.form import Form, pieces, thickness
from niwaki.requirements.keep import REQUIREMENTS
from niwaki.shell import requirements
from niwaki.shell.app import app
from typer.testing import CliRunner

TOWER = """from niwaki import box, emit, model, uniform


@model
def tower():
    height = uniform(1.0, 4.0)
    emit(box((0, height / 2, 0), (1, height, 1)))
"""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a model and a target."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tower.py").write_text(TOWER)
    Scene([("target", [box((0, 1.5, 0), (1, 3, 1))])]).export(tmp_path / "target.obj")
    return tmp_path


@model
def leaning(x=0.0, width=1.0):
    emit(box((0, 0.5, 0), (1, 1, 1)))
    emit(box((x, 1.5, 0), (width, 1, 1)))


ALL = Keep(
    covered=0.9,
    outside=0.1,
    height=(1.9, 2.0),
    within=((-0.5, 0.0, -0.5), (1.0, 2.0, 0.5)),
    thinnest=0.25,
    stands=True,
    supported=True,
    collisions=False,
)


def judged(rules: Keep, program=leaning, **arguments):
    """Return what holds, by name."""
    sample = run(program, method=Forward(), seed=1, **arguments).best
    return {row.name: row.holds for row in rules.judged(sample)}


@pytest.mark.parametrize(
    ("arguments", "name", "holds"),
    [
        ({"x": 0.9}, "stands", True),
        ({"x": 1.1}, "stands", False),
        ({"width": 0.3}, "thinnest", True),
        ({"width": 0.2}, "thinnest", False),
        ({}, "height", True),
        ({}, "covered", False),
        ({}, "collisions", True),
        ({"x": 0.4}, "within", True),
        ({"x": 0.6}, "within", False),
        ({"x": 0.4}, "supported", True),
        ({"x": 0.6}, "supported", False),
    ],
)
def test_a_run_is_held_against_each_requirement(arguments, name, holds):
    assert judged(ALL, **arguments)[name] is holds


def test_each_requirement_has_a_field_and_a_measure_that_an_empty_scene_can_be_held_against():
    assert list(REQUIREMENTS) == list(Keep.__struct_fields__) == [name for name, _, _ in ALL.active()]
    empty = Form([], np.zeros((0, 2, 3)), list)
    kept = [row.name for row in ALL.judged(empty) if row.holds]
    assert kept == ["within", "thinnest", "supported", "collisions"]
    assert {row.requirement for row in ALL.violations(empty)} == {"covered", "outside", "height", "stands"}
    assert Keep(stands=False, supported=False, collisions=True).rows() == []


def test_solids_of_one_mesh_are_measured_apart():
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    two = np.concatenate([corner, 0.5 * corner + 5.0]), np.concatenate([faces, faces + 4])
    soup = two[0][two[1]].reshape(-1, 3), np.arange(24).reshape(8, 3)
    for mesh in (two, soup):
        wide, narrow = (thickness(piece) for piece in pieces(*mesh))
        assert np.isclose(wide, 3**-0.5) and np.isclose(narrow, 0.5 * wide)


@model
def crossing():
    emit(box((0, 0.5, 0), (1, 1, 1)))
    emit(box((0.5, 0.7, 0.2), (1, 1, 1)))


def test_parts_that_intersect_are_named():
    sample = run(crossing, method=Forward(), seed=1).best
    (text,) = Keep(collisions=False).unmet(sample)
    assert text == "no parts intersect: Box 1, Box 2 intersect"
    assert Keep(height=(0.5, 1.0)).unmet(sample) == ["height 0.5 to 1: height 1.2"]


def width_of(shape):
    """The width of a shape's fine mesh."""
    ((vertices, faces, *_),) = _engine.meshes([[shape]], fine=True)
    return thickness((vertices, faces))


def test_the_width_of_a_turned_box_and_of_a_rod():
    turned = box((0, 0, 0), (3.0, 0.2, 2.0), rotation((0, 0, 1), 0.7))
    assert np.isclose(width_of(turned), 0.2)
    assert np.isclose(width_of(cylinder((0, 0, 0), 0.05, 5.0)), 0.1, rtol=0.01)


def test_a_scene_on_one_edge_does_not_stand():
    @model
    def wedge(angle=0.5):
        emit(box((0, 2, 0), (1, 1, 1), rotation((0, 0, 1), angle)))

    assert judged(Keep(stands=True), wedge) == {"stands": False}
    assert judged(Keep(stands=True), wedge, angle=0.0) == {"stands": True}


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("hight = [2, 3]", "hight"),
        ("height = [3.0, 2.0]", "least height first"),
        ("covered = 1.5", "covered"),
        ("stands = 1", "stands"),
        ("within = [[0, 0, 0], [nan, 1, 1]]", "lowest corner first"),
        ("  hight = [2, 3]  # metres", "did you mean `height`?"),
    ],
)
def test_a_file_with_a_fault_says_where(tmp_path: Path, text: str, reason: str):
    (tmp_path / "requirements.toml").write_text(text)
    with pytest.raises(InputError, match="does not describe requirements") as caught:
        Keep.load(tmp_path / "requirements.toml")
    margin = len(text) - len(text.lstrip())
    assert reason in str(caught.value) and f"requirements.toml:1:{margin + 1}" in str(caught.value)
    assert f"  | {' ' * margin}{'^' * len(text.split('#')[0].strip())}" in str(caught.value)


def shell(*words: str) -> tuple[int, str]:
    """Run a command; return its exit code and its standard output."""
    answer = CliRunner().invoke(app, list(words), catch_exceptions=False)
    return answer.exit_code, answer.stdout


GROW = ("grow", "tower.py", "--target", "target.obj", "--seed", "1", "--particles", "100")


def test_a_search_keeps_the_requirements_or_says_which_it_does_not(place: Path):
    (place / "requirements.toml").write_text("height = [2.5, 3.5]\nstands = true\n")
    code, output = shell(*GROW, "--json")
    (row,) = json.loads(output)["runs"]
    assert code == 0 and row["unmet"] == [] and row["covered"] > 0.8
    (place / "requirements.toml").write_text("height = [5.0, 6.0]\n")
    code, output = shell(*GROW, "--json")
    (row,) = json.loads(output)["runs"]
    assert code == 1 and row["unmet"][0].startswith("height 5 to 6: height ")


def test_a_search_looks_for_a_height_that_few_runs_have_and_no_target_has(place: Path):
    (place / "requirements.toml").write_text("height = [1.1, 1.2]\nwithin = [[-1, 0, -1], [1, 2, 1]]\n")
    command = "grow tower.py --target target.obj --seed 3 --rounds 2 --json".split()
    answer = CliRunner().invoke(app, command, catch_exceptions=False)
    assert answer.exit_code == 0 and "another search" not in answer.stderr


def test_a_score_has_the_limits_that_a_search_can_see_and_no_former_ones():
    first = Keep(height=(1.0, 2.0), stands=True).aims(nw.floor(0.0))
    assert [call.function for call in first.asks] == ["floor", "limits"]
    # Without an end or without an inside, limits are judged alone.
    second = Keep(height=(1.0, np.inf), within=((-1, 0, 0), (1, 2, 0))).aims(first)
    assert [call.function for call in second.asks] == ["floor", "limits"]
    assert second.asks[1].arguments["height"][0] == 1.0 and "within" not in second.asks[1].arguments
    for keep in (Keep(within=((-np.inf, 0, 0), (1, 2, 1))), Keep(stands=True)):
        assert [call.function for call in keep.aims(second).asks] == ["floor"]


def test_a_target_that_contradicts_a_requirement_is_named_and_so_are_two_requirements(place: Path):
    (place / "requirements.toml").write_text("height = [5.0, 6.0]\n")
    code, output = shell(*GROW, "--json")
    assert code == 1
    assert json.loads(output)["conflicts"] == ["`height 5 to 6` stands against the target (height 3)"]
    shorter = run(leaning, method=Forward(), seed=1, x=2.0)
    taller = run(crossing, method=Forward(), seed=1)
    rules = Keep(height=(1.5, 2.5), within=((-1.0, 0.0, -1.0), (1.5, 1.9, 1.5)))
    attempts = iter((shorter, taller, shorter))
    _, conflicts = requirements.keeping(rules, lambda seed, candidates: next(attempts), 8, 1)
    assert conflicts == [
        "`within (-1, 0, -1) and (1.5, 1.9, 1.5)` stands against `height 1.5 to 2.5`: "
        "results that keep the one break the other"
    ]


def test_further_searches_have_more_results_to_choose_from(place: Path):
    sample = run(leaning, method=Forward(), seed=1)
    attempts = []

    def attempt(seed: int, candidates: int):
        attempts.append((seed, candidates))
        return run(leaning, method=Forward(), seed=1, x=0.0 if seed == 9 else 1.2)

    kept, _ = requirements.keeping(Keep(stands=True), attempt, 8, 2)
    assert attempts == [(8, 2), (9, 12)]
    assert kept.best.scene.bounds.tolist() == sample.best.scene.bounds.tolist()
    attempts.clear()
    requirements.keeping(Keep(height=(9.0, 9.0)), attempt, 8, 20)
    assert attempts == [(8, 20), (9, 20), (10, 20)]


STOOL = """from niwaki import box, cylinder, emit, flip, model, uniform


@model
def stool():
    top = uniform(0.5, 1.0)
    if flip(0.5):
        emit(box((0, 0.5, 0), (top, 1.0, top)))
    else:
        for k in range(2):
            emit(box((k * 0.8 - 0.4, 0.45, 0), (0.05, 0.9, 0.05)))
        emit(box((0, 0.95, 0), (1.0, 0.1, 1.0)))
"""


def test_a_kind_that_fits_less_is_chosen_where_the_best_does_not_keep_the_requirements(place: Path):
    (place / "stool.py").write_text(STOOL)
    two = [box((x, 0.45, 0), (0.05, 0.9, 0.05)) for x in (-0.4, 0.4)]
    Scene([("target", [*two, box((0, 0.95, 0), (1.0, 0.1, 1.0))])]).export(place / "stool.obj")
    grow = "grow stool.py --target stool.obj --seed 1 --method improve --rounds 5 --json".split()
    _, output = shell(*grow)
    (thin,) = json.loads(output)["runs"]
    (place / "requirements.toml").write_text("thinnest = 0.2\n")
    code, output = shell(*grow)
    (thick,) = json.loads(output)["runs"]
    assert code == 0 and thick["unmet"] == [] and thick["log_score"] < thin["log_score"] - 10.0


def test_check_says_how_often_each_requirement_holds_and_holds_a_result_against_them(place: Path):
    (place / "requirements.toml").write_text("height = [2.0, 3.0]\n")
    code, output = shell("check", "tower.py")
    assert code == 0 and "requires    height 2 to 3: (kept by " in output
    shell(*GROW, "-o", "out")
    code, output = shell("check", "tower.py", "--result", "out/run.json", "--json")
    (row,) = json.loads(output)["requirements"]
    assert code == 0 and row["holds"] is True and row["value"].startswith("height ")
    (place / "requirements.toml").write_text("height = [0.0, 1.0]\n")
    assert shell("check", "tower.py", "--result", "out/run.json")[0] == 1
