"""A replay runs no Python, unless its model calls host functions and a person says that their file may be run."""

from __future__ import annotations

import hashlib
import json
import re
import sys
from pathlib import Path
from typing import Any

import pytest
from niwaki.errors import NiwakiError
from niwaki.shell.main import app
from niwaki.shell.trust import hosts
from typer.testing import CliRunner

GOLDEN = Path(__file__).parents[2] / "golden"

#: Leaves a mark when it is run.
MODEL = """
from pathlib import Path
from niwaki import box, emit, host, model, uniform

with Path({mark!r}).open("a") as file:
    file.write("run ")

@host
def doubled(x):
    return 2.0 * x

@model
def tower():
    {line}
    emit(box((0, 1, 0), (1, size, 1)))
"""
CALLS, ALONE = "size = doubled(uniform(0.5, 1.5))", "size = uniform(0.5, 1.5)"
TARGET = "v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"

pytestmark = pytest.mark.filterwarnings("ignore:the best result scores")


def run(*words: object) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


def grown(folder: Path, line: str) -> tuple[Path, Path, Path]:
    """A run of a model in a file of that folder: the file, its run.json, and the mark that running the file leaves."""
    file, mark, target = folder / "garden.py", folder / "mark", folder / "pillar.obj"
    file.write_text(MODEL.format(mark=str(mark), line=line))
    target.write_text(TARGET)
    done = run(
        "grow",
        f"{file}:tower",
        "--target",
        target,
        "--particles",
        "5",
        "--seed",
        "1",
        "--no-picture",
        "-o",
        folder / "out",
    )
    assert done.exit_code == 0, (done.output, done.exception)
    assert mark.read_text() == "run "
    mark.unlink()
    sys.modules.pop("garden", None)
    return file, folder / "out" / "run.json", mark


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    sys.modules.pop("garden", None)


def test_a_run_file_has_the_hash_of_the_bytes_that_were_run(folder: Path) -> None:
    file, saved, _ = grown(folder, ALONE)
    assert json.loads(saved.read_text())["file_hash"] == hashlib.sha256(file.read_bytes()).hexdigest()


def test_a_replay_without_host_functions_runs_nothing_whatever_is_allowed(folder: Path) -> None:
    file, saved, mark = grown(folder, ALONE)
    assert list(hosts(json.loads(saved.read_text()))) == []
    for words in ([], ["--trust"], ["--model", file]):
        done = run("replay", saved, "-o", "again", "--no-picture", *words)
        assert done.exit_code == 0, done.exception
    assert not mark.exists()


def test_a_file_is_run_only_where_a_person_allows_it(folder: Path) -> None:
    _, saved, mark = grown(folder, CALLS)
    refused = run("replay", saved, "-o", "again", "--no-picture")
    assert isinstance(refused.exception, NiwakiError) and refused.exception.code == "untrusted-file"
    assert not mark.exists() and not Path("again").exists()
    done = run("replay", saved, "-o", "again", "--no-picture", "--trust")
    assert done.exit_code == 0, done.exception
    assert mark.read_text() == "run "
    assert Path("again/best.glb").read_bytes() == (saved.parent / "best.glb").read_bytes()


def test_a_changed_file_is_not_run_on_trust(folder: Path) -> None:
    file, saved, mark = grown(folder, CALLS)
    file.write_text(file.read_text() + "\nPath('stolen').touch()\n")
    refused = run("replay", saved, "-o", "again", "--no-picture", "--trust")
    assert isinstance(refused.exception, NiwakiError) and refused.exception.code == "changed-model-file"
    assert not mark.exists() and not Path("stolen").exists()
    # Who names it has read it: the function that is called is as it was.
    done = run("replay", saved, "-o", "again", "--no-picture", "--model", file)
    assert done.exit_code == 0, done.exception
    assert Path("stolen").exists()
    assert Path("again/best.glb").read_bytes() == (saved.parent / "best.glb").read_bytes()


def test_a_changed_host_function_is_never_called(folder: Path) -> None:
    file, saved, _ = grown(folder, CALLS)
    file.write_text(file.read_text().replace("2.0 * x", "3.0 * x"))
    refused = run("replay", saved, "-o", "again", "--no-picture", "--model", file)
    assert isinstance(refused.exception, NiwakiError) and refused.exception.code == "untrusted-function"


def test_a_run_file_imports_no_module(folder: Path) -> None:
    file, saved, _ = grown(folder, CALLS)
    Path("other.py").write_text(f"open({str(folder / 'imported')!r}, 'w')\n")
    saved.write_text(saved.read_text().replace('"module": "garden"', '"module": "other"'))
    refused = run("replay", saved, "-o", "again", "--no-picture", "--model", file)
    assert isinstance(refused.exception, NiwakiError) and not Path("imported").exists()


def test_messages(folder: Path, golden: Any) -> None:
    file, saved, _ = grown(folder, CALLS)
    text, texts = file.read_text(), []
    changed = text.replace("2.0 * x", "3.0 * x")
    for name, source, words in (
        ("nobody allowed it", text, []),
        ("another line has changed", text + "\nX = 1\n", ["--trust"]),
        ("the host function has changed", changed, ["--trust"]),
        ("the host function has changed, and a person named the file", changed, ["--model", file]),
        ("no Python any more", text + "\ndef (", ["--trust"]),
        ("no such file", text, ["--model", "none.py"]),
    ):  # fmt: skip
        file.write_text(source)
        refused = run("replay", saved, "-o", "again", *words)
        assert isinstance(refused.exception, NiwakiError), (name, refused.exception)
        texts.append(
            f"## {name}\n\n{refused.exception}\n".replace(str(folder.resolve()), "FOLDER").replace(
                str(folder), "FOLDER"
            )
        )
    # The file has the folder's name in it, and so another hash each time.
    golden(GOLDEN / "trust.txt", re.sub(r"[0-9a-f]{12}\.\.\.", "HASH...", "\n".join(texts)))
