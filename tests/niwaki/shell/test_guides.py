"""Claim: the shell trains guides, shows them and searches with them, and writes words."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from niwaki.methods import Guide
from niwaki.search.shipped import FOLDER
from niwaki.shell.main import app
from PIL import Image
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

NOTICE = "the guide shipped with `vines` draws the choices (--guide none turns it off)\n"
GROW = ["grow", "vines", "--match-image", "scribbles/008", "--seed", "1", "--no-picture"]


def run(*words: Any) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


def searched(folder: Path) -> dict[str, Any]:
    """The method of a run."""
    method: dict[str, Any] = json.loads((folder / "run.json").read_text())["search"]["method"]
    return method


@pytest.fixture(scope="module")
def pictures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pictures")
    for number in range(4):
        page = np.full((100, 100), 255, dtype=np.uint8)
        page[10:90, 30 + 4 * number : 45 + 4 * number] = 0
        Image.fromarray(page).save(folder / f"{number}.png")
    (folder / "notes.txt").write_text("not a picture")
    return folder


@pytest.fixture(scope="module")
def trained(pictures: Path) -> tuple[Path, Any]:
    out = pictures / "made" / "lines.guide"
    words = [
        "guide",
        "train",
        "lightning",
        "--targets",
        pictures,
        "-o",
        out,
        "--searches",
        "6,4",
        "--seed",
        "1",
    ]
    return out, run(*words)


def test_a_guide_is_trained_on_a_folder(trained: tuple[Path, Any]) -> None:
    out, done = trained
    assert done.exit_code == 0, done.output
    # On a slow machine there are lines of progress, too.
    lines = [line for line in done.stderr.splitlines() if not line.startswith("training ")]
    assert [line.partition(":")[0] for line in lines] == ["round 1", "round 2"]
    assert re.fullmatch(
        r".*lines\.guide: <guide of lightning: 5 choices, .*> *, \d+ kB, \d+ s, seed 1\n", done.stdout
    )
    report = Guide.load(out).report
    assert (report["targets"], report["held_out"], report["seed"]) == (6, 1, 1)


def test_a_guide_is_shown_and_gone_on_with(trained: tuple[Path, Any], pictures: Path, tmp_path: Path) -> None:
    out, _ = trained
    shown = run("guide", "show", out)
    assert shown.exit_code == 0
    assert "bolt/angle: gaussian, a mixture of 4" in shown.stdout
    assert re.search(r"round 2: \d traces; held out: mean 0\.\d+", shown.stdout)
    more = run(
        *("guide", "train", "lightning", "--targets", pictures, "--start", out),
        *("-o", tmp_path / "more.guide", "--searches", "4", "--no-mirror", "--seed", "1"),
    )
    assert more.exit_code == 0, more.output
    assert "the guide of --start; held out" in run("guide", "show", tmp_path / "more.guide").stdout


def test_a_guide_is_taught_to_look_ahead(pictures: Path, tmp_path: Path) -> None:
    out = tmp_path / "far.guide"
    train = ("guide", "train", "lightning", "--targets", pictures, "-o", out, "--searches", "6")
    done = run(*train, "--seed", "1", "--searches-ahead", "24")
    assert done.exit_code == 0, done.output
    assert Guide.load(out).report["look_ahead"]["rises"][0] > 20
    assert "looks ahead: " in run("guide", "show", out).stdout
    grow = ("grow", "lightning", "--match-image", pictures / "0.png", "--seed", "1", "--no-picture")
    grown = run(*grow, "--guide", out, "--look-ahead", "0.2", "--particles", "5", "-o", tmp_path)
    assert grown.exit_code == 0, grown.output
    method = searched(tmp_path)
    assert (method["look_ahead"], method["particles"]) == (0.2, 5)


def test_grow_takes_the_guide_that_comes_with_the_model(tmp_path: Path) -> None:
    grown = run(*GROW, "-o", tmp_path)
    assert grown.exit_code == 0 and grown.stderr == NOTICE
    method = searched(tmp_path)
    assert (method["method"], method["particles"], method["power"]) == ("improve", 100, 16.0)
    assert "guided" in json.dumps(method["proposal"])
    again = run("replay", tmp_path / "run.json", "-o", tmp_path / "again", "--no-picture")
    assert again.exit_code == 0
    assert (tmp_path / "again" / "best.svg").read_bytes() == (tmp_path / "best.svg").read_bytes()


@pytest.mark.parametrize(
    ("flags", "has_notice", "name", "particles"),
    [
        (["--particles", "12"], True, "smc", 12),
        (["--method", "smc"], True, "smc", 50),
        (["--guide", "none", "--particles", "12"], False, "smc", 12),
        (["--rounds", "1"], True, "improve", 100),
        (["--guide", "none", "--rounds", "1"], False, "improve", 200),
        (["--weights", "absolute", "--particles", "12", "--resampling", "systematic"], False, "smc", 12),
        (["--method", "pimh", "--sweeps", "2", "--particles", "12"], False, "pimh", 12),
        (["--method", "pimh", "--sweeps", "2", "--guide", FOLDER / "vines.guide"], False, "pimh", 50),
    ],
)
def test_other_settings_decide(
    tmp_path: Path, flags: list[Any], has_notice: bool, name: str, particles: int
) -> None:
    grown = run(*GROW, "-o", tmp_path, *flags)
    assert grown.exit_code == 0, grown.output
    assert (NOTICE in grown.stderr) == has_notice
    method = searched(tmp_path)
    assert (method["method"], method["particles"]) == (name, particles)
    assert (method.get("proposal") is not None) == (has_notice or FOLDER / "vines.guide" in flags)


def test_json_is_alone_on_stdout() -> None:
    grown = run(*GROW, "--json", "--particles", "5")
    assert grown.stderr == NOTICE and list(json.loads(grown.stdout)) == ["runs"]


def test_a_word_is_written(tmp_path: Path) -> None:
    done = run(
        "letters",
        "Hi",
        "-o",
        tmp_path,
        "--seed",
        "1",
        "--particles",
        "10",
        "--searches",
        "2",
        "--width",
        "160",
    )
    assert done.exit_code == 0, done.output
    assert sorted(place.name for place in tmp_path.iterdir()) == ["growth.gif", "word.png", "word.svg"]
    assert re.match(
        r"H 0\.\d\d  i 0\.\d\d\n"
        r"2 letters in [\d.]+ s, pictures in [\d.]+ s, seed 1; word\.png, word\.svg, growth\.gif in ",
        done.stdout,
    )
    with Image.open(tmp_path / "word.png") as picture:
        assert picture.width == 160


def test_what_is_refused(
    pictures: Path, tmp_path: Path, reviewed: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "one").mkdir()
    Image.new("L", (9, 9), 0).save(tmp_path / "one" / "black.png")
    (tmp_path / "blank").mkdir()
    for name in ("a.png", "b.png"):
        Image.new("L", (9, 9), 255).save(tmp_path / "blank" / name)
    vines = FOLDER / "vines.guide"

    def refused(*words: Any) -> Any:
        result = run(*words)
        return lambda: (_ for _ in ()).throw(result.exception)

    train = ["guide", "train", "vines", "-o", "x.guide", "--targets"]
    reviewed(
        GOLDEN / "guides-shell.txt",
        {
            "drawings that judge": refused(*train, "glyphs"),
            "one target": refused(*train, "one"),
            "pictures without ink": refused(*train, "blank"),
            "rounds that are no numbers": refused(*train, pictures, "--searches", "many"),
            "an objective that is none": refused(*train, pictures, "--objective", "evidence"),
            "rounds without examples": refused(*train, pictures, "--objective", "bound", "--searches", "4"),
            "a search that draws no choices by a guide": refused(*GROW, "--method", "ais", "--guide", vines),
            "a guide that has not learned to look ahead": refused(
                *GROW, "--guide", vines, "--look-ahead", "0.2"
            ),
            "look-ahead without a guide": refused(*GROW, "--guide", "none", "--look-ahead", "0.2"),
            "look-ahead of another method": refused(*GROW, "--method", "improve", "--look-ahead", "0.2"),
            "a score that the guide does not see": refused("grow", "circuit", "--guide", vines),
            "a character that the font lacks": refused("letters", "木"),
            "nothing to write": refused("letters", " "),
            "a style that does not write": refused("letters", "A", "--style", "circuit"),
        },
    )
