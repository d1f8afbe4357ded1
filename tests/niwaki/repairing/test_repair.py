"""Claim: few numbers of a script repair it, the patch is readable, and nothing is written before it is accepted."""

from __future__ import annotations

import json
import re
import shutil
import tomllib
from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
import pytest
from niwaki.errors import InputError
from niwaki.fitting.meshes import mesh_of
from niwaki.repairing.literals import literals
from niwaki.repairing.prediction import Rules, changes, derivatives
from niwaki.repairing.result import edits_of
from niwaki.repairing.writing import rounded, written
from niwaki.shell.app import app
from typer.testing import CliRunner

SCRIPTS = Path(__file__).parents[3] / "benches" / "repairs"

ROOM = '''"""A room."""
from niwaki import box

gap = 0.05        # from the table to a chair
parts = {
    "table": box((0.2, 0.375, 0.0), (1.4, 0.75, 0.8)),
    "chair": box((0.2 - 0.7 + gap, 0.45, 0.0), (0.45, 0.9, 0.45)),  # at its left end
    "shelf": box((1.3, 1.0, -1.0), (0.6, 2.0, 0.3)),
}
'''
KEEP = nw.Keep(collisions=False, within=((-1.5, 0.0, -1.5), (1.5, 2.6, 1.5)))


@pytest.fixture
def room(tmp_path: Path) -> Path:
    place = tmp_path / "room.py"
    place.write_text(ROOM)
    return place


def keep_in(text: str) -> nw.Keep:
    """The requirements in the comments of a script."""
    table = tomllib.loads("\n".join(re.findall(r"^(?:#|//) keep: (.*)$", text, re.MULTILINE)))
    if "within" in table:
        table["within"] = tuple(tuple(corner) for corner in table["within"])
    return nw.Keep(**table)


def test_a_patch_changes_few_numbers_and_keeps_the_rest_of_the_text(room: Path) -> None:
    repair = nw.repair(room, KEEP, workers=0)
    assert {row.key for row in repair.before} == {
        ("collisions", ("table", "chair")),
        ("within", ("shelf",)),
    }
    patch = repair.best
    assert patch is not None and patch.repairs and patch.numbers == 2
    assert room.read_text() == ROOM, "written before it was accepted"
    removed = [line[1:] for line in patch.difference().splitlines()[2:] if line.startswith("-")]
    added = [line[1:] for line in patch.difference().splitlines()[2:] if line.startswith("+")]
    assert len(removed) == len(added) == 2
    for before, after in zip(removed, added, strict=True):
        assert re.sub(r"[-+\d.]", "", before) == re.sub(r"[-+\d.]", "", after)
    # Numbers as a person writes them.
    assert all(len(edit.after.lstrip("+- ")) <= 5 for edit in patch.edits)
    patch.apply()
    assert room.read_text() == patch.changed
    again = nw.repair(room, KEEP, workers=0)
    assert again.repaired and not again.before and not again.patches and again.evaluations == 1


def test_a_file_that_changed_meanwhile_is_not_written(room: Path) -> None:
    patch = nw.repair(room, KEEP, workers=0).best
    assert patch is not None
    room.write_text(ROOM + "# mine\n")
    with pytest.raises(InputError, match="edited-meanwhile"):
        patch.apply()
    assert room.read_text() == ROOM + "# mine\n"


def test_patches_differ_in_what_changes_and_the_best_is_first(room: Path) -> None:
    patches = nw.repair(room, KEEP, workers=0, patches=4).patches
    places = [frozenset((edit.line, edit.column) for edit in patch.edits) for patch in patches]
    assert len(patches) > 1 and not any(a <= b for a in places for b in places if a is not b)
    assert [patch.cost for patch in patches] == sorted(patch.cost for patch in patches)
    assert all(patch.repairs for patch in patches)


def test_processes_change_no_result(room: Path) -> None:
    here, there = (nw.repair(room, KEEP, workers=number).report() for number in (0, 1))
    assert here == there


@pytest.mark.parametrize("name", ["bedroom", "kitchen", "flat", "office", "garage", "dining", "steps"])
def test_scripts_of_the_bench_are_repaired(name: str) -> None:
    place = SCRIPTS / f"{name}.py"
    repair = nw.repair(place, keep_in(place.read_text()), workers=0)
    assert repair.before and repair.repaired and repair.best is not None
    assert repair.best.numbers <= 4 and repair.evaluations <= 60


@pytest.mark.skipif(shutil.which("openscad") is None, reason="needs OpenSCAD")
@pytest.mark.parametrize("name", ["posts", "box"])
def test_scripts_of_openscad_are_repaired(name: str) -> None:
    place = SCRIPTS / f"{name}.scad"
    repair = nw.repair(place, keep_in(place.read_text()), workers=0)
    assert repair.before and repair.repaired and repair.best is not None
    assert repair.best.numbers <= 2


def test_a_script_that_cannot_be_repaired_says_what_stands_against_what() -> None:
    place = SCRIPTS / "impossible.py"
    repair = nw.repair(place, keep_in(place.read_text()), workers=0)
    assert not repair.repaired
    (conflict,) = repair.conflicts
    assert conflict.requirement == "within (lamp)"
    # The lamp has room where the sofa is, or would be if the sofa left the niche.
    assert conflict.against and set(conflict.against) <= {"collisions (sofa, lamp)", "within (sofa)"}
    assert "stands against" in conflict.reason


def test_sizes_stay_unless_they_are_named(tmp_path: Path) -> None:
    place = tmp_path / "sofa.py"
    place.write_text(
        "from niwaki import box\nlong = 2.4\nparts = {'sofa': box((0.0, 0.4, 0.0), (long, 0.8, 0.9))}\n"
    )
    keep = nw.Keep(within=((-1.0, 0.0, -1.0), (1.0, 2.0, 1.0)))
    fixed = nw.repair(place, keep, workers=0)
    assert not fixed.repaired and not any("long" in patch.difference() for patch in fixed.patches)
    freed = nw.repair(place, keep, workers=0, free=["long"])
    assert freed.repaired and freed.best is not None and "+long = 2.0" in freed.best.difference()


def test_a_word_replaces_another_where_numbers_stay(tmp_path: Path) -> None:
    place = tmp_path / "words.py"
    place.write_text("side = LEFT\nat = 2\n")

    def run(text: str) -> nw.Output:
        x = 1.5 if "RIGHT" in text else -0.5
        boxes = {"a": np.array([[x, 0, 0], [x + 1, 1, 1]]), "b": np.array([[0.0, 0, 0], [1, 1, 1]])}
        return nw.Output(boxes, [] if x > 1 else [nw.Violation("apart", ("a", "b"), 0.5)])

    repair = nw.repair(place, run=run, words=[{"LEFT", "RIGHT"}], workers=0)
    assert repair.best is not None and repair.best.changed == "side = RIGHT\nat = 2\n"


def test_kinds_of_literals() -> None:
    text = (
        "n = 3\nx = 1.5\nfor k in range(n):\n    y = k * 2 + x / 2 - 0.25\n"
        "box(size=(1.0, 2.0), angle=30, seed=4)\npoints[0] = rotate(45.0)\nif x > 0.5: z = -1.5e-3\ncolor = [0.5]\n"
        "mean = (a + b) / 2.0 + 3.1416\n"
    )
    rows = {(row.line, row.text): row for row in literals(text)}
    kinds = {key: (row.kind, row.is_fixed) for key, row in rows.items()}
    assert kinds == {
        (1, "3"): ("count", True),
        (2, "1.5"): ("length", False),
        (4, "2"): ("length", True),
        (4, "0.25"): ("length", False),
        (5, "1.0"): ("size", True),
        (5, "2.0"): ("size", True),
        (5, "30"): ("angle", False),
        (5, "4"): ("length", True),
        (6, "0"): ("length", True),
        (6, "45.0"): ("angle", False),
        (7, "-1.5e-3"): ("length", False),
        (8, "0.5"): ("colour", True),
        (9, "2.0"): ("length", True),
        (9, "3.1416"): ("length", True),
    }
    assert rows[(4, "0.25")].value == -0.25


def test_a_number_that_changes_its_sign_turns_the_operator_before_it() -> None:
    text = "ä = 'é'; x = b - 0.5  # half\ny = -2\n"
    rows = {row.key: row for row in literals(text)}
    half, two = rows.values()
    new = written(text, rows, {half.key: 0.75, two.key: 3.0})
    assert new == "ä = 'é'; x = b + 0.75  # half\ny = 3\n"
    edits = edits_of(text, list(rows.values()), {half.key: 0.75, two.key: 3.0})
    assert nw.repairing.result.FileChange("f", edits, text).changed == new


def test_values_are_rounded_away_from_what_is_wrong() -> None:
    for start, value in ((0.5, 0.7334), (0.5, -0.2111), (10.0, 33.3), (0.2, 0.2003)):
        for result in rounded(start, value):
            assert abs(result - start) >= abs(value - start) - 1e-9
            assert abs(result - value) <= 0.2 * abs(value - start) + 1e-9
    assert rounded(0.5, 0.7334)[0] == 0.75


def test_few_runs_give_the_derivatives_of_many_numbers() -> None:
    random = np.random.default_rng(5)
    true = np.zeros((40, 60))
    for column in range(60):
        true[random.choice(40, column % 4, replace=False), column] = random.choice([-1.0, 0.5, 1.0, 3.2])
    steps = changes(40, 12)
    slopes, explained = derivatives(steps, steps @ true)
    assert explained.all()
    np.testing.assert_allclose(slopes, true, atol=1e-9)


def test_parts_that_overlap_without_a_violation_may_do_so() -> None:
    boxes = np.array(
        [[[0, 0, 0], [2, 0.1, 2]], [[0.5, 0, 0.5], [1, 1, 1]], [[0.9, 0, 0.5], [1.5, 1, 1]]], float
    )
    rules = Rules(("rug", "table", "chair"), boxes, 1, 2.0)
    rules.learn(boxes, [nw.Violation("collisions", ("table", "chair"), 0.3)])
    cost = rules.pairs(boxes, boxes, np.arange(3))
    assert cost[1, 2] == pytest.approx(0.3) and not cost[0].any()


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


def test_the_command_shows_a_patch_and_writes_the_accepted_one(
    room: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(room.parent)
    Path("requirements.toml").write_text("collisions = false\n")
    shown = run("repair", "room.py", "--workers", 0)
    assert shown.exit_code == 0, shown.output
    assert "violated: collisions: table, chair" in shown.output and "+++ room.py" in shown.output
    assert room.read_text() == ROOM
    report = json.loads(run("repair", "room.py", "--workers", 0, "--json", "--write", 1).stdout)
    assert report["repaired"] and report["patches"][0]["violations"] == []
    assert room.read_text() != ROOM
    assert "nothing is violated" in run("repair", "room.py", "--workers", 0).output


def test_the_command_says_why_there_is_no_patch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(SCRIPTS)
    keep = tmp_path / "keep.toml"
    keep.write_text("collisions = false\nwithin = [[-1, 0, -1], [1, 2.5, 1]]\n")
    done = run("repair", "impossible.py", "--keep", keep, "--workers", 0)
    assert done.exit_code == 1 and "`within (lamp)` stands against" in done.output


@pytest.mark.parametrize("text", ["height = [3, 2]\n", "within = [[1, 0, 0], [0, 1, 1]]\n", "x = 1\n", ""])
def test_requirements_that_a_repair_cannot_keep_are_refused(text: str, room: Path) -> None:
    keep = room.parent / "keep.toml"
    keep.write_text(text)
    with pytest.raises(InputError, match="bad-requirements"):
        nw.repair(room, keep, workers=0)


TABLE = """from niwaki import box
thickness = 0.01
parts = {
    "top": box((0.0, 0.7, 0.0), (1.4, thickness, 0.8)),
    "legs": [box((x, 0.35, 0.0), (0.05, 0.68, 0.6)) for x in (-0.5, 0.5)],
}
"""
ARM = """from niwaki import box
reach = 1.6
parts = {"foot": box((0, 0.25, 0), (0.5, 0.5, 0.5)), "arm": box((reach, 0.7, 0), (2, 0.4, 0.3))}
"""


def test_a_part_that_is_too_thin_gets_its_thickness_once_that_is_freed(room: Path) -> None:
    room.write_text(TABLE)
    keep = nw.Keep(thinnest=0.03)
    stays = nw.repair(room, keep, workers=0, evaluations=10)
    # The legs are two solids of one part, each as thick as it is required.
    assert [row.key for row in stays.before] == [("thinnest", ("top",))]
    assert "sizes stay as they are unless they are freed: thickness" in stays.conflicts[0].reason
    trials: list[Any] = []
    patch = nw.repair(room, keep, workers=0, free=["thickness"], progress=trials.append).best
    assert patch is not None and [edit.after for edit in patch.edits] == ["0.03"]
    # The first plan is right: the thickness of a part that is stretched is predicted.
    assert trials[0].values == trials[-1].values and not trials[0].failed


def test_what_falls_over_is_moved_above_its_feet(room: Path) -> None:
    room.write_text(ARM)
    repair = nw.repair(room, nw.Keep(stands=True, supported=True), workers=0, fix=[3])
    assert {row.requirement for row in repair.before} == {"stands", "supported"}
    patch = repair.best
    assert patch is not None and patch.repairs and [edit.line for edit in patch.edits] == [2]


def test_the_share_of_a_target_is_measured_where_there_is_one(room: Path) -> None:
    room.write_text(
        "from niwaki import box\nx = 0.4\nparts = {'cube': box((x, 0.5, 0.0), (1.0, 1.0, 1.0))}\n"
    )
    target = nw.Target(*mesh_of(nw.box((0.0, 0.5, 0.0), (1.0, 1.0, 1.0))))
    keep = nw.Keep(covered=0.95, outside=0.05)
    repair = nw.repair(room, keep, workers=0, target=target)
    assert [row.title for row in repair.before] == ["covered", "outside"]
    assert repair.best is not None and repair.best.repairs
    for goal, solid in ((keep, None), (nw.Keep(stands=True), target)):
        with pytest.raises(InputError, match="flag-alone"):
            nw.repair(room, goal, workers=0, target=solid)


def test_a_script_that_fails_or_has_nothing_to_change_says_so(tmp_path: Path) -> None:
    place = tmp_path / "bad.py"
    for text, code in (
        ("x = 1.0\nraise ValueError('no')\n", "script-failed"),
        ("x = 1.0\n", "script-failed"),
        ("x = (\n", "script-failed"),
        ("parts = []\n", "no-literals"),
    ):
        place.write_text(text)
        with pytest.raises(InputError, match=code):
            nw.repair(place, KEEP, workers=0)
