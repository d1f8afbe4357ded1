"""Claim: a user's file replaces no module, whatever its name, and stored searches find its host functions again."""

from __future__ import annotations

import json
import os
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki.inputs.modules import files, modules, public, run_file
from niwaki.search import Search
from niwaki.search.data import host_reference
from niwaki.shell.references import find
from PIL import Image

MODEL = """
import json, logging, packaging, platform
from niwaki import batches, box, emit, host, model, uniform

assert json.loads("1") == 1 and logging.INFO == 20 and platform.system() and packaging.__version__

@host
def doubled(x):
    import neighbour_of_a_model
    return neighbour_of_a_model.FACTOR * x

@model
def tower():
    emit(box((0, 1, 0), (1, doubled(uniform(0.5, 1.5)), 1)))
"""
NAMES = [
    "json",
    "logging",
    "platform",
    "packaging",
    "niwaki",
    "numpy",
    "typing",
    "my.tower",
    "2nd",
    "a b",
    "main",
]


@pytest.fixture
def folder(tmp_path: Path) -> Any:
    (tmp_path / "neighbour_of_a_model.py").write_text("FACTOR = 2.0\n")
    yield tmp_path
    sys.modules.pop("neighbour_of_a_model", None)
    sys.path[:] = [entry for entry in sys.path if entry != str(tmp_path)]


@pytest.mark.parametrize("name", NAMES)
def test_a_file_replaces_no_module(folder: Path, name: str) -> None:
    place = folder / f"{name}.py"
    place.write_text(MODEL)
    before = {module_name: module for module_name, module in sys.modules.items()}
    reference = find(f"{place}:tower")
    assert all(sys.modules[module_name] is module for module_name, module in before.items())
    assert sys.path[0] != str(folder) and not any("_Elsewhere" in repr(finder) for finder in sys.meta_path)
    # Stored data have the file's public name.
    module = reference.model.function.__module__
    assert public(module) == name and files([name]) == ((name, place),)
    assert host_reference(modules(name)[0].doubled)["module"] == name
    # The function imports a neighbour of the file when it is called.
    result = nw.run(reference.model, seed=1)
    search = result.search
    assert search.host_modules == (name,)
    again = Search.of_json(search.json("inside"), (name,)).run()
    assert again.best.log_score == result.best.log_score and again.best.choices == result.best.choices


@pytest.mark.parametrize("name", ["json", pytest.param("packaging", marks=pytest.mark.soak)])
def test_every_command_runs_such_a_file(folder: Path, name: str) -> None:
    place, out = folder / f"{name}.py", folder / "out"
    # TIFF files are read in a separate process, here while the model file runs.
    Image.new("L", (2, 1)).save(folder / "page.tif")
    load = f"niwaki.targets.pixels.load({str(folder / 'page.tif')!r})"
    place.write_text(f"{MODEL}\nimport niwaki.targets.pixels\nassert {load}.channels.shape[:2] == (1, 2)\n")
    (folder / "pillar.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
    )
    (folder / "spec.toml").write_text(
        f'model = "{place}:tower"\nseeds = [0, 4]\n[grow]\ntarget = "pillar.obj"\nparticles = 5\n'
    )
    commands = (
        ["show", f"{place}:tower", "-n", "1", "-o", folder / "show.png", "--quick"],
        ["check", place],
        [
            "grow",
            place,
            "--target",
            "pillar.obj",
            "--particles",
            "5",
            "--seed",
            "1",
            "--no-picture",
            "-o",
            out,
        ],
        ["replay", out / "run.json", "--trust", "-o", folder / "again", "--no-picture"],
        ["batch", "run", "spec.toml", "-o", folder / "batch", "--processes", "2"],
        ["batch", "export", folder / "batch", "--model", place, "--format", "csv"],
    )
    for words in commands:
        done = shell(words, folder)
        assert done.returncode == 0, (words, done.stderr)
    assert (folder / "again" / "best.glb").read_bytes() == (out / "best.glb").read_bytes()
    assert name in json.dumps(json.loads((out / "run.json").read_text())["search"])


def test_a_library_is_imported_and_not_the_file_of_its_name(folder: Path) -> None:
    # Nothing else imports this library, so that the file does so first.
    place = folder / "packaging.py"
    place.write_text(MODEL)
    done = shell(["check", place], folder)
    assert done.returncode == 0, done.stderr


def shell(words: Any, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    # `-P`: like the console script, do not import from the current folder.
    program = [sys.executable, "-P", "-c", "from niwaki.shell.main import main; main()", *map(str, words)]
    return subprocess.run(
        program, cwd=folder, capture_output=True, text=True, env={**os.environ, **environment}
    )


def test_a_pickled_search_finds_the_file_again(folder: Path) -> None:
    place = folder / "platform.py"
    place.write_text(MODEL)
    search = nw.run(find(f"{place}:tower").model, seed=1).search
    program = "import pickle, sys; print(pickle.load(sys.stdin.buffer).run().best.log_score)"
    done = subprocess.run([sys.executable, "-c", program], input=pickle.dumps(search), capture_output=True)
    assert done.returncode == 0, done.stderr.decode()
    assert float(done.stdout) == search.run().best.log_score


def test_two_files_of_one_name_are_two_modules(folder: Path) -> None:
    for number in (1, 2):
        (folder / str(number)).mkdir()
        (folder / str(number) / "tower.py").write_text(f"NUMBER = {number}\nclass Kind: pass\n")
    first, second = (run_file(folder / number / "tower.py")[0] for number in ("1", "2"))
    assert (first.NUMBER, second.NUMBER) == (1, 2) and first.__name__ != second.__name__
    assert modules("tower")[0] is second
    kind = pickle.loads(pickle.dumps(first.Kind))
    assert kind is first.Kind
