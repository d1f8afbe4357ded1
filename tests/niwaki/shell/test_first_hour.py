"""Claim: what a new user does in the first hour works from the shell alone, and what goes wrong is said."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from niwaki import box
from niwaki.draw.scene import Scene
from niwaki.errors import NiwakiError
from niwaki.shell import arguments, selection
from niwaki.shell.main import app
from niwaki.shell.references import find, names_in
from PIL import Image
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

MODEL = """
from niwaki import box, condition, emit, flip, model, uniform

def arm(y, width, n):
    size = uniform(0.5, 1.5)
    emit(box((0, y + size / 2, 0), (width, size, width)))
    if n > 0 and flip(0.8):
        arm(y + size, width, n - 1)

@model
def tower(width=1.0, count: int = 5, name="oak", tall=True, ends=(1, 2)):
    arm(0.0, width, count)
    hat(width)

def hat(width):
    side = uniform(0.2, 0.8)
    emit(box((0, -side / 2, 0), (side, side, width)))

@model
def never():
    condition(uniform(0.0, 1.0) > 2.0)

@model
def number(n):
    return n + uniform(0.0, 1.0)
"""


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "garden.py").write_text(MODEL)
    (tmp_path / "wide.toml").write_text("width = 2\ncount = 3\n")
    (tmp_path / "bad.toml").write_text("width = = 2\n")
    Scene([("pillar", [box((0, 2, 0), (1, 4, 1))])]).export(tmp_path / "pillar.obj")
    return tmp_path


GROW = ["grow", "garden.py:tower", "--target", "pillar.obj", "--seed", "1", "--quick"]


def grown(*words: object) -> Any:
    done = run(*GROW, *words)
    assert done.exit_code == 0, (done.output, done.exception)
    return done


def data(folder: str = "out") -> dict[str, Any]:
    return dict(json.loads(Path(folder, "run.json").read_text()))


@pytest.mark.parametrize("output", ["sheet.txt", "v1.2", "garden.py/sheet.png", "garden.py"])
def test_show_looks_at_the_name_of_its_picture_before_it_runs(place: Path, output: str) -> None:
    done = run("show", "garden.py:tower", "-n", "4", "--seed", "1", "-o", output)
    assert done.exit_code != 0 and "#1" not in done.stdout


def test_show_draws_runs_without_a_target(place: Path) -> None:
    done = run("show", "garden.py:tower", "width=2", "-n", "4", "--seed", "1")
    assert done.exit_code == 0, (done.output, done.exception)
    assert [line.split()[:3] for line in done.stdout.splitlines()[:4]] == [
        [f"#{k}", "seed", f"{k}"] for k in (1, 2, 3, 4)
    ]
    with Image.open("show.png") as sheet:
        assert sheet.size[0] > sheet.size[1] > 480
    # Without shapes there are the values.
    assert "#2   seed 6   5." in run("show", "garden.py:number", "n=5", "-n", "2", "--seed", "5").stdout
    # A model that follows a drawing begins where its own does.
    assert run("show", "vines", "-n", "1", "--quick").exit_code == 0


def test_arguments_have_the_types_of_the_signature(place: Path) -> None:
    tower = find("garden.py:tower").model
    words = ["width=3", "count=2", "name=3", "tall=no", "ends=(3, 4)"]
    expected = {"width": 3.0, "count": 2, "name": "3", "tall": False, "ends": (3, 4)}
    values = arguments.read(tower, words)
    assert values == expected and type(values["width"]) is float
    assert arguments.read(tower, ["width=4.5"], Path("wide.toml")) == {"width": 4.5, "count": 3}


def test_run_json_keeps_the_arguments(place: Path) -> None:
    grown("width=1.5", "--preset", "wide.toml", "-o", "a")
    assert data("a")["search"]["args"] == [{"real": 1.5}, 3] or data("a")["search"]["args"] == [1.5, 3]
    sampled = run("sample", "garden.py:number", "n=7", "--steps", "20", "--chains", "1", "-o", "b")
    assert sampled.exit_code == 0, (sampled.output, sampled.exception)
    assert data("b")["search"]["args"] == [7]
    assert "arguments   width=1.0, count=5" in run("check", "garden.py:tower", "width=2").stdout


def test_one_number_in_lines_and_files(place: Path) -> None:
    done = grown("--runs", "3", "--export", "1,3")
    lines = [line.split()[0] for line in done.stdout.splitlines() if line.startswith("#")]
    assert lines == ["#1", "#2", "#3"]
    names = {"run.json", "best.glb", "best.png", "sheet.png", "run-1.glb", "run-3.glb"}
    assert {file.name for file in Path("out").iterdir()} == names
    assert set(data()["files"]) == names - {"run.json"}
    assert run("replay", "out/run.json", "--run", "3", "-o", "three", "--no-picture").exit_code == 0
    assert Path("three/best.glb").read_bytes() == Path("out/run-3.glb").read_bytes()
    again = run("replay", "out/run.json", "--export", "all", "--format", "obj", "-o", "all", "--no-picture")
    assert again.exit_code == 0, (again.output, again.exception)
    assert {f"run-{k}.obj" for k in (1, 2, 3)} < {file.name for file in Path("all").iterdir()}
    assert selection.exported("#2, 1", 2) == [2, 1]


def test_no_folder_is_replaced_without_a_word(place: Path) -> None:
    grown()
    first = Path("out/run.json").read_bytes()
    grown("--seed", "2")
    assert Path("out/run.json").read_bytes() == first and Path("out-2/run.json").exists()
    refused = run(*GROW, "-o", "out")
    assert isinstance(refused.exception, NiwakiError) and "already-there" in str(refused.exception)
    assert Path("out/run.json").read_bytes() == first
    grown("--seed", "2", "-o", "out", "--force")
    assert Path("out/run.json").read_bytes() != first
    # A file of a person's own that a result would replace is a result, too.
    Path("mine").mkdir()
    Path("mine/best.glb").write_text("mine")
    assert isinstance(run(*GROW, "-o", "mine").exception, NiwakiError)
    assert Path("mine/best.glb").read_text() == "mine"


def choices(folder: str, number: int = 0) -> dict[str, Any]:
    return {choice["address"]: choice["value"] for choice in data(folder)["runs"][number]["choices"]}


def test_what_is_held_stays_and_a_reroll_keeps_the_rest(place: Path) -> None:
    grown("--runs", "2", "-o", "a")
    before = choices("a", 1)
    grown("--from", "a/run.json", "--run", "2", "--hold", "hat", "-o", "b", "--seed", "5")
    hat = [address for address in before if address.startswith("hat/")]
    assert hat and all(choices("b")[address] == before[address] for address in hat)
    assert choices("b") != before
    (size,) = [address for address in before if address == "hat/side"]
    grown("--hold", f"{size}=0.5", "-o", "e")
    assert choices("e")[size] == 0.5
    grown("--hold", f"{size}=0.5", "--from", "a/run.json", "--run", "2", "--hold", "arm/size", "-o", "f")
    assert choices("f")[size] == 0.5
    assert isinstance(run(*GROW, "--hold", f"{size}=wide").exception, NiwakiError)
    grown("--from", "a/run.json", "--run", "2", "--reroll", "hat", "-o", "c", "--seed", "5", "--runs", "2")
    after = choices("c")
    assert all(after[address] != before[address] for address in hat)
    assert {k: v for k, v in after.items() if k not in hat} == {
        k: v for k, v in before.items() if k not in hat
    }
    assert choices("c", 1) != after
    assert data("c")["origin"]["run"] == 2 and data("c")["origin"]["reroll"] == ["hat"]
    assert run("replay", "c/run.json", "-o", "d", "--no-picture").exit_code == 0
    assert Path("d/best.glb").read_bytes() == Path("c/best.glb").read_bytes()


def test_a_replay_of_a_changed_model_keeps_what_fits(place: Path) -> None:
    grown("-o", "a")
    before = choices("a")
    # Another line, another support, a choice less and one more.
    (place / "garden.py").write_text(
        "# A comment.\n"
        + MODEL.replace("side = uniform(0.2, 0.8)", "side = uniform(2.0, 3.0)\n    tilt = uniform(0.0, 1.0)")
    )
    done = run("replay", "a/run.json", "--anyway", "-o", "b", "--no-picture")
    assert done.exit_code == 0, (done.output, done.exception)
    total = len(before)
    assert done.stdout.splitlines()[:3] == [
        f"{total - 1} of {total} choices fit",
        "  not possible: Hat › side",
        "  drawn: Hat › side, Hat › tilt",
    ]
    after = choices("b")
    assert {k: v for k, v in after.items() if not k.startswith("hat")} == {
        k: v for k, v in before.items() if not k.startswith("hat")
    }
    assert 2.0 < after["hat/side"] < 3.0
    # What was written is a run of the model as it is.
    assert run("replay", "b/run.json", "-o", "c", "--no-picture").exit_code == 0
    # Without --anyway nothing is run.
    (place / "garden.py").write_text("raise SystemExit(9)")
    assert run("replay", "a/run.json", "-o", "d", "--no-picture").exit_code == 0


def test_one_result_has_no_sheet_and_an_image_is_seen_from_its_camera(place: Path) -> None:
    image = Image.new("L", (60, 30), 0)
    image.paste(255, (27, 6, 33, 30))
    image.save("wide.png")
    camera = {"kind": "orthographic", "position": [0, 2, 20], "look_at": [0, 2, 0], "height": 5.0}
    Path("cam.json").write_text(json.dumps(camera))
    words = [
        "grow",
        "garden.py:tower",
        "--match-image",
        "wide.png",
        "--camera",
        "cam.json",
        "--particles",
        "20",
    ]
    assert run(*words, "--seed", "1", "-o", "a", "--quick").exit_code == 0
    assert not Path("a/sheet.png").exists()
    assert run(*words, "--seed", "1", "-o", "b", "--quick", "--runs", "2").exit_code == 0
    with Image.open("b/sheet.png") as sheet:
        # Cells of the image's own shape.
        assert sheet.size[0] == pytest.approx(2 * 720, abs=10)


def test_the_last_line_says_where_the_time_went(place: Path) -> None:
    command = [sys.executable, "-m", "niwaki.shell.main", *GROW]
    last = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1]
    seconds = {part.split()[0]: float(part.split()[1]) for part in last.partition(": ")[2].split(", ")}
    assert list(seconds) == ["start", "compile", "target", "search", "pictures", "files"]
    assert seconds["start"] > 0.05
    assert sum(seconds.values()) == pytest.approx(float(last.split()[0]), abs=0.05)


def test_messages(place: Path, golden: Any) -> None:
    grown("-o", "a")
    failing = {
        "an argument that the model does not have": ["show", "garden.py:tower", "widht=3"],
        "an argument that is not like any": ["grow", "garden.py:tower", "zzz=3", "--target", "pillar.obj"],
        "a word that is no argument": ["show", "garden.py:tower", "3"],
        "a text for a number": [*GROW, "width=wide"],
        "a real number for a whole one": [*GROW, "count=2.5"],
        "a truth value that is none": [*GROW, "tall=perhaps"],
        "an argument that is missing": ["show", "garden.py:number"],
        "a preset that is no TOML": [*GROW, "--preset", "bad.toml"],
        "a preset that is not there": [*GROW, "--preset", "none.toml"],
        "runs that are never possible": ["show", "garden.py:never", "--seed", "1"],
        "a folder with results": [*GROW, "-o", "a"],
        "a hold without a result": [*GROW, "--hold", "hat"],
        "a result and nothing to keep": [*GROW, "--from", "a/run.json"],
        "a hold and a reroll": [*GROW, "--from", "a/run.json", "--hold", "hat", "--reroll", "arm"],
        "a hold of nothing": [*GROW, "--from", "a/run.json", "--hold", "hut"],
        "a reroll of nothing": [*GROW, "--from", "a/run.json", "--reroll", "hut", "-o", "c"],
        "a result that is not there": ["replay", "a/run.json", "--run", "2", "-o", "b"],
        "an export of what is not there": [*GROW, "--runs", "3", "--export", "1,4", "-o", "b"],
    }
    texts = []
    for name, words in failing.items():
        failed = run(*words)
        assert isinstance(failed.exception, NiwakiError), (name, failed.output, failed.exception)
        text = str(failed.exception).replace(str(place.resolve()), "FOLDER").replace(str(place), "FOLDER")
        texts.append(f"## {name}\n\n{text}\n")
    golden(GOLDEN / "first-hour.txt", "\n".join(texts))


def test_the_model_of_a_file_is_its_own_where_it_has_one(place: Path) -> None:
    Path("both.py").write_text(
        "from niwaki.gallery.spaceship import spaceship\n" + MODEL.split("@model\ndef never")[0]
    )
    assert find("both.py").model.name == "tower"
    Path("one.py").write_text("from niwaki.gallery.spaceship import spaceship\n")
    assert find("one.py").model.name == "spaceship"
    Path("two.py").write_text(
        "from niwaki.gallery import spaceship, building\n\nfly = spaceship.spaceship\nlive = building.building\n"
    )
    with pytest.raises(NiwakiError, match="defines fly, live"):
        find("two.py")


def test_a_result_alone_gives_the_model_the_target_and_the_settings_of_a_new_search(place: Path) -> None:
    grown("--rounds", "2", "-o", "a")
    before, search = choices("a"), data("a")["search"]
    # A run of the model's file is not needed, and it may be gone.
    Path("garden.py").rename("gone.py")
    done = run("grow", "--from", "a/run.json", "--reroll", "hat", "--no-picture", "-o", "b", "--seed", "5")
    assert done.exit_code == 0, done.output
    after = choices("b")
    hat = [address for address in before if address.startswith("hat/")]
    assert all(after[address] != before[address] for address in hat)
    assert {k: v for k, v in after.items() if k not in hat} == {
        k: v for k, v in before.items() if k not in hat
    }
    again = data("b")["search"]
    assert (again["score"], again["method"]) == (search["score"], search["method"])
    held = ("grow", "--from", "a/run.json", "--hold", "hat", "--no-picture", "--rounds", "1", "-o", "c")
    assert run(*held).exit_code == 0
    assert data("c")["search"]["score"] == search["score"]
    assert data("c")["search"]["method"] != search["method"]
    assert all(choices("c")[address] == before[address] for address in hat)


def test_of_several_models_of_a_file_the_one_with_its_name_is_meant(place: Path) -> None:
    (place / "tower.py").write_text(MODEL)
    assert find("tower.py").name.endswith("tower.py:tower")
    assert run("show", "tower.py", "--runs", "1", "--quick", "-o", "tower.png").exit_code == 0
    error = run("show", "garden.py").exception
    assert isinstance(error, NiwakiError) and "garden.py:tower" in str(error)
    names = [str(place / "garden.py") + f":{name}" for name in ("tower", "never", "number")]
    assert names_in(str(place / "garden.py")) == names
    (place / "one.py").write_text(MODEL.partition("@model\ndef never")[0])
    assert names_in("one.py") == ["one.py"] and names_in("one.py:tower") == ["one.py:tower"]
