"""Claim: the shell has every control and every search of chapter 5; flags that contradict one another,
lack another flag or name what cannot be used are refused with a message before anything is searched."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from niwaki import box
from niwaki.draw.scene import Scene
from niwaki.errors import NiwakiError
from niwaki.shell.main import app
from niwaki.targets.views import INK, MISSING
from PIL import Image, ImageDraw
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

MODEL = """
from niwaki import box, emit, future, model, uniform

@model
def towers():
    for _ in range(4):
        future(tower)

@model
def tower():
    x, z, high = uniform(-4.0, 4.0), uniform(-2.0, 2.0), uniform(0.5, 5.0)
    emit(box((x, high / 2, z), (0.6, high, 0.6)))
"""


def run(*words: str) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a model, images, cameras and meshes, where the shell is."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "garden.py").write_text(MODEL)
    image = Image.new("L", (60, 40), 0)
    for left, high in ((5, 15), (20, 28), (40, 20)):
        ImageDraw.Draw(image).rectangle((left, 39 - high, left + 6, 39), 255)
    image.save(tmp_path / "skyline.png")
    image.resize((30, 20)).save(tmp_path / "small.png")
    Image.new("L", (60, 40), 255).save(tmp_path / "white.png")
    Image.new("L", (60, 40), 0).save(tmp_path / "black.png")
    camera = {"kind": "orthographic", "position": [0, 3, 20], "look_at": [0, 3, 0], "height": 6.0}
    (tmp_path / "cam.json").write_text(json.dumps(camera))
    (tmp_path / "bent.json").write_text('{"kind": "fisheye", "position": [0, 0, 1], "look_at": [0, 0, 0]}')
    (tmp_path / "cut.json").write_text('{"kind": "ortho')
    (tmp_path / "ground.obj").write_text("v -6 0 -6\nv 6 0 -6\nv 6 0 6\nv -6 0 6\nf 1 3 2\nf 1 4 3\n")
    Scene([("wall", [box((3.0, 2.0, 0.0), (1.0, 4.0, 6.0))])]).export(tmp_path / "wall.obj")
    Scene([("all", [box((0.0, 2.5, 0.0), (9.0, 9.0, 9.0))])]).export(tmp_path / "everywhere.obj")
    return tmp_path


GROW = ["grow", "garden.py:towers", "--particles", "60", "--seed", "1", "-o", "out"]
IMAGE = ["--match-image", "skyline.png", "--camera", "cam.json"]
SHADOW = ["--match-shadow", "skyline.png", "--light", "-1,-1,0", "--receiver", "ground.obj"]


def grown(*words: str) -> dict[str, Any]:
    done = run(*GROW, *words)
    assert done.exit_code == 0, (done.output, done.exception)
    return dict(json.loads(Path("out/run.json").read_text()))


def test_particles_go_up_a_ladder(place: Path) -> None:
    words = ["--method", "ais", "--powers", "0.1,1", "--moves", "2", "--kernel", "drift(0.2)", "--no-picture"]
    method = grown(*IMAGE, *words)["search"]["method"]
    assert (method["method"], method["powers"], method["moves"]) == ("ais", [0.1, 1.0], 2)
    assert method["kernel"]["name"] == "drift"


def test_an_image_is_matched_beside_a_wall_on_a_floor(place: Path) -> None:
    data = grown(*IMAGE, "--avoid", "wall.obj", "--floor", "0", "--within", "-5,0,-5,5,6,5", "--no-picture")
    sketches = {sketch["sketch"]: sketch["given"] for sketch in data["search"]["score"]}
    assert list(sketches) == ["no_self_intersection", "floor", "avoid", "match_image", "overshoot"]
    assert sketches["avoid"]["obstacle"]["file"] == str(place / "wall.obj") and sketches["floor"]["y"] == 0.0
    assert sketches["match_image"]["camera"]["camera"]["height"] == 6.0
    low, high = trimesh.load_scene("out/best.glb").bounds
    assert low[1] >= -1e-6
    # The wall begins at x = 2.5.
    assert high[0] < 2.5


def test_pictures_from_the_view_of_the_wish_and_from_another(place: Path) -> None:
    grown(*IMAGE, "--weight-image", "white.png", "--weight", "3")
    names = {path.name for path in Path("out").iterdir()}
    assert names == {"best.glb", "best.png", "image.png", "run.json"}
    with Image.open("out/image.png") as picture:
        pixels = np.asarray(picture.convert("RGB"))
    # Where wish and scene agree, and where it misses: there is some of both in a match of 60 particles.
    for color in (INK, MISSING):
        assert (pixels == color).all(axis=2).sum() > 1000


def test_a_shadow_is_matched(place: Path) -> None:
    data = grown(*SHADOW, "--sigma", "0.01")
    settings = data["search"]["score"][-1]["given"]
    assert settings["sigma"] == 0.01 and settings["light"] == {"tuple": [-1.0, -1.0, 0.0]}
    assert Path("out/shadow.png").is_file()


def test_a_drawing_is_followed_from_its_own_start(place: Path) -> None:
    ink = Image.new("L", (300, 300), 255)
    ImageDraw.Draw(ink).rectangle((130, 60, 170, 280), 0)
    ink.save("trunk.png")
    done = run("grow", "vines", "--match-image", "trunk.png", "--particles", "40", "--seed", "1", "-o", "out")
    assert done.exit_code == 0, (done.output, done.exception)
    names = {path.name for path in Path("out").iterdir()}
    assert names == {"best.svg", "best.png", "drawing.png", "run.json"}
    search = json.loads(Path("out/run.json").read_text())["search"]
    (sketch,) = search["score"]
    assert sketch["sketch"] == "match_drawing" and sketch["given"]["image"]["shape"] == [50, 50]
    assert search["method"]["resampling"] == "tempered" and search["method"]["power"] == 1.0
    svg = Path("out/best.svg").read_bytes()
    again = run("replay", "out/run.json", "-o", "again")
    assert again.exit_code == 0 and Path("again/best.svg").read_bytes() == svg
    done_from_start = run(
        "grow",
        "circuit",
        "--particles",
        "10",
        "--seed",
        "1",
        "-o",
        "board",
        "--format",
        "svg,gif",
        "--size",
        "60x60",
    )
    assert done_from_start.exit_code == 0 and Path("board/growth.gif").is_file(), (
        done_from_start.output,
        done_from_start.exception,
    )


@pytest.mark.parametrize(
    "words",
    [
        ["--method", "particle-gibbs", "--sweeps", "3"],
        ["--method", "pimh", "--sweeps", "3", "--resampling", "residual"],
        ["--populations", "3", "--anneal", "1,4,16"],
        ["--weights", "absolute"],
        ["--rejuvenate", "cycle(prior(), drift(0.1))", "--moves", "2", "--at", "resampled"],
        ["--rejuvenate", "prior()", "--moves", "3", "--at", "end", "--draws", "4", "--chains", "2"],
        ["--method", "particle-gibbs", "--sweeps", "2", "--no-ancestors"],
        ["--polish", "50"],
    ],
    ids=lambda words: "-".join(words[:2]),
)
def test_every_search_runs_and_can_be_replayed(place: Path, words: list[str]) -> None:
    data = grown(*IMAGE, *words, "--no-picture")
    assert data["search"]["method"]["method"] == (
        words[1].replace("-", "_") if words[0] == "--method" else "smc"
    )
    first = Path("out/best.glb").read_bytes()
    assert run("replay", "out/run.json", "-o", "again", "--no-picture").exit_code == 0
    assert Path("again/best.glb").read_bytes() == first


def test_a_chain_goes_on_from_the_best(place: Path) -> None:
    plain = grown(*IMAGE, "--no-picture")
    chain = ["--polish", "300", "--polish-kernel", "mixture(prior(), drift(0.1))"]
    data = grown(*IMAGE, *chain, "--no-picture", "--force")
    assert data["runs"][0]["log_score"] > plain["runs"][0]["log_score"]
    polish = data["search"]["polish"]
    assert polish["steps"] == 300 and [part["name"] for part in polish["kernel"]["parts"]] == [
        "prior",
        "drift",
    ]
    assert data["plan"] == plain["plan"] == [60] and plain["search"]["polish"] is None


def test_results_that_differ(place: Path) -> None:
    data = grown(*IMAGE, "--diverse", "3", "--no-picture")
    assert len(data["runs"]) == 3
    values = [{(c["address"], str(c["value"])) for c in row["choices"]} for row in data["runs"]]
    assert all(len(a & b) <= len(a) / 2 for k, a in enumerate(values) for b in values[:k])
    assert run("replay", "out/run.json", "--run", "2", "-o", "third", "--no-picture").exit_code == 0
    assert Path("third/best.glb").read_bytes() != Path("out/best.glb").read_bytes()


def test_states_of_chains_that_differ(place: Path) -> None:
    moves = ["--rejuvenate", "cycle(repeat(4, prior()), block(0.01))", "--moves", "5", "--at", "end"]
    data = grown(*IMAGE, *moves, "--draws", "12", "--diverse", "3", "--no-picture")
    assert len(data["runs"]) == 3 and len(data["plan"]) == 1
    assert (
        data["search"]["method"]["rejuvenate"]["name"] == "cycle" and data["search"]["method"]["draws"] == 12
    )


def test_a_time_instead_of_particles(place: Path) -> None:
    words = ["grow", "garden.py:towers", "--seed", "1", "-o", "out", "--no-picture"]
    assert run(*words, *IMAGE, "--seconds", "0.3").exit_code == 0
    data = json.loads(Path("out/run.json").read_text())
    assert data["search"]["method"]["seconds"] == 0.3 and data["rounds"] >= 1 and not data["plan"]
    assert run(*words, *IMAGE, "--method", "smc", "--seconds", "0.3", "--force").exit_code == 0
    data = json.loads(Path("out/run.json").read_text())
    assert len(data["plan"]) >= 1 and data["rounds"] == 0


@pytest.mark.filterwarnings("ignore::niwaki.draw.solid.PrintWarning")  # towers do not touch
def test_every_format_from_a_search_and_from_its_record(place: Path) -> None:
    both = ["--format", "glb,stl,3mf,obj,ply,gif,apng", "--scale", "10", "--frames", "2", "--size", "64x48"]
    grown(*IMAGE, *both, "--no-picture")
    files = {"best.glb", "best.stl", "best.3mf", "best.obj", "best.ply", "growth.gif", "growth.apng"}
    assert {path.name for path in Path("out").iterdir()} == files | {"run.json"}
    assert run("replay", "out/run.json", *both, "-o", "again", "--no-picture").exit_code == 0
    assert all(Path("out", name).read_bytes() == Path("again", name).read_bytes() for name in files)
    assert trimesh.load_mesh("out/best.stl").is_watertight


REFUSALS = {
    "an image without a camera": ["--match-image", "skyline.png"],
    "a camera without an image": ["--camera", "cam.json"],
    "a shadow without a light": ["--match-shadow", "skyline.png", "--receiver", "ground.obj"],
    "a shadow without a receiver": ["--match-shadow", "skyline.png", "--light", "0,-1,0"],
    "a light without a shadow": ["--target", "wall.obj", "--light", "0,-1,0"],
    "an image and a shadow": [*IMAGE, *SHADOW],
    "a weight without its image": [*IMAGE, "--weight", "3"],
    "a weight image and nothing to weigh": ["--target", "wall.obj", "--weight-image", "white.png"],
    "a light of two numbers": [
        "--match-shadow",
        "skyline.png",
        "--light",
        "0,-1",
        "--receiver",
        "ground.obj",
    ],
    "a light along the floor": [
        "--match-shadow",
        "skyline.png",
        "--light",
        "1,0,0",
        "--receiver",
        "ground.obj",
    ],
    "an image that is not there": ["--match-image", "skylne.png", "--camera", "cam.json"],
    "an image that is none": ["--match-image", "wall.obj", "--camera", "cam.json"],
    "an image of one colour": ["--match-image", "white.png", "--camera", "cam.json"],
    "a weight image of another size": [*IMAGE, "--weight-image", "small.png"],
    "a camera that is not there": ["--match-image", "skyline.png", "--camera", "none.json"],
    "a camera cut short": ["--match-image", "skyline.png", "--camera", "cut.json"],
    "a camera of another kind": ["--match-image", "skyline.png", "--camera", "bent.json"],
    "a wall that is not there": [*IMAGE, "--avoid", "none.obj"],
    "a wall that covers everything": [*IMAGE, "--avoid", "everywhere.obj"],
    "a box of five numbers": [*IMAGE, "--within", "0,0,0,1,1"],
    "a box inside out": [*IMAGE, "--within", "0,0,0,1,-1,1"],
    "nothing to match": ["--floor", "0"],
    "a method that nobody has": [*IMAGE, "--method", "gibbs"],
    "a setting of another method": [*IMAGE, "--method", "pimh", "--diverse", "3"],
    "sweeps of a population": [*IMAGE, "--sweeps", "3"],
    "a time and a number of particles": [*IMAGE, "--seconds", "1"],
    "a kernel that nobody has": [*IMAGE, "--rejuvenate", "drifts()"],
    "moves of nothing": [*IMAGE, "--moves", "3"],
    "a moment that never comes": [*IMAGE, "--rejuvenate", "prior()", "--at", "noon"],
    "chains without draws": [*IMAGE, "--rejuvenate", "prior()", "--chains", "2"],
    "moves of a chain of whole runs": [*IMAGE, "--method", "pimh", "--rejuvenate", "prior()"],
    "moves of what has no law": [*IMAGE, "--rejuvenate", "prior()", "--weights", "absolute"],
    "a chain of no proposals": [*IMAGE, "--polish", "0"],
    "a kernel of no chain": [*IMAGE, "--polish-kernel", "prior()"],
    "a chain from results that differ": [*IMAGE, "--diverse", "3", "--polish", "10"],
    "ancestors of a population": [*IMAGE, "--no-ancestors"],
    "a way that is none": [*IMAGE, "--anneal", "slowly"],
    "a format that nobody writes": [*IMAGE, "--format", "glb,fbx"],
    "a scale of nothing printed": [*IMAGE, "--scale", "10"],
    "a scale of zero": [*IMAGE, "--format", "stl", "--scale", "0"],
    "a size in centimetres": [*IMAGE, "--format", "gif", "--size", "10cm"],
    "frames of nothing moving": [*IMAGE, "--frames", "10"],
    "a window of no drawing": ["--target", "wall.obj", "--window", "0,0,1,1"],
    "a window without inside": ["--match-image", "skyline.png", "--window", "0,0,0,1"],
    "pixels of a silhouette": [*IMAGE, "--pixels", "50"],
    "a drawing that is black": ["--match-image", "black.png", "--window", "0,0,1,1"],
    "a solid as a drawing": [*IMAGE, "--format", "svg"],
}


def test_messages(place: Path, golden: Any) -> None:
    texts = []
    for name, words in REFUSALS.items():
        failed = run(*GROW, *words)
        assert isinstance(failed.exception, NiwakiError), (name, failed.output, failed.exception)
        text = str(failed.exception).replace(str(place.resolve()), "FOLDER").replace(str(place), "FOLDER")
        texts.append(f"## {name}\n\n{text}\n")
        assert not Path("out").exists(), name
    golden(GOLDEN / "flags.txt", "\n".join(texts))


def test_a_run_that_is_not_among_the_results(place: Path) -> None:
    grown(*IMAGE, "--no-picture")
    failed = run("replay", "out/run.json", "--run", "4")
    assert isinstance(failed.exception, NiwakiError)
    assert "expected the number 1, the only result" in str(failed.exception)


@pytest.mark.filterwarnings("ignore:the best result scores")  # a sail beside a wall
def test_a_file_that_fails_leaves_the_others(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (place / "sail.py").write_text(
        "import numpy as np\nfrom niwaki import emit, mesh, model\n"
        "CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])\n"
        "FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3]])\n\n"
        "@model\ndef sail():\n    emit(mesh(CORNERS, FACES))\n"
    )
    words = ["grow", "sail.py:sail", "--target", "wall.obj", "--particles", "2", "-o", "out", "--no-picture"]
    failed = run(*words, "--format", "stl,glb")
    assert isinstance(failed.exception, NiwakiError) and failed.exception.code == "not-a-solid"
    assert {path.name for path in Path("out").iterdir()} == {"run.json", "best.glb"}
