"""Claim: `niwaki batch` does what a file asks for, goes on by the same command, and writes tables, pictures and meshes
that do not depend on how the batch was computed.
"""

from __future__ import annotations

import csv
import json
import warnings
from pathlib import Path
from typing import Any

import pytest
from niwaki import batches
from niwaki.shell import batch_files
from niwaki.shell.main import app
from niwaki.shell.progress import batch_progress, duration
from PIL import Image
from typer.testing import CliRunner

TOWER = """
from niwaki import box, emit, factor, host, model, uniform

@host
def liked(height):
    return -abs(height - 2.0)

@model
def tower(width: float = 1.0):
    height = uniform(1.0, 3.0)
    factor(liked(height))
    emit(box((0, height / 2, 0), (width, height, width)))
"""

PILLAR = """v 0 0 0\nv 1 0 0\nv 0 3 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"""

SPEC = """
model = "garden.py:tower"
seeds = 4

[grow]
target = "pillar.obj"
voxel = 0.5
max-memory = 512

[vary.grow]
particles = [5, 10]

[vary.arguments]
width = [0.5, 1.0]
"""


def run(*words: Any) -> Any:
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "specs"
    folder.mkdir()
    (folder / "garden.py").write_text(TOWER)
    (folder / "pillar.obj").write_text(PILLAR)
    (folder / "towers.toml").write_text(SPEC)
    monkeypatch.chdir(tmp_path)
    return folder / "towers.toml"


def test_a_batch_by_its_file_and_what_is_exported(place: Path, tmp_path: Path) -> None:
    done = run("batch", place, "--processes", "1")
    assert done.exit_code == 0, done.output
    assert "16 searches; files in towers" in done.output
    again = run("batch", place)
    assert again.exit_code == 0 and "16 searches; files in towers" in again.output
    # The host function is Python: nothing runs it unless that was said.
    refused = run("batch", "export", "towers", "--format", "csv")
    assert refused.exit_code != 0 and "untrusted-function" in str(refused.exception)
    flags = ["--format", "csv,png,glb", "-n", 3, "--choices", "--model", place.with_name("garden.py")]
    written = run("batch", "export", "towers", *flags)
    assert written.exit_code == 0, written.output
    assert f"16 of 16 searches, hash {batches.Store(Path('towers')).hash()}" in written.output
    with open("towers/results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [(row["particles"], row["width"], row["seed"]) for row in rows] == [
        (particles, width, str(seed))
        for particles in ("5", "10")
        for width in ("0.5", "1.0")
        for seed in range(4)
    ]
    assert 1.0 <= json.loads(rows[0]["choices"])["height"] <= 3.0
    with Image.open("towers/sheet.png") as image:
        assert image.size[0] > 300
    best = sorted(rows, key=lambda row: -float(row["log_score"]))[:3]
    assert sorted(file.name for file in Path("towers/meshes").iterdir()) == sorted(
        f"case-{row['case']}-seed-{row['seed']}.glb" for row in best
    )
    # Two parts, in other processes, make the same table.
    for part in ("1/2", "2/2"):
        assert run("batch", place, "-o", "parts", "--shard", part, "--processes", "1").exit_code == 0
    run("batch", "export", "parts", *flags)
    assert Path("parts/results.csv").read_bytes() == Path("towers/results.csv").read_bytes()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("seeds = 4", "sedes = 4"), "`$.sedes`"),
        (("seeds = 4", 'seeds = "4"'), "a whole number or a list"),
        (("voxel = 0.5", "voxle = 0.5"), "expected `voxel`"),
        (("voxel = 0.5", 'voxel = "small"'), "`$.grow.voxel`"),
        (("particles = [5, 10]", "particles = 5"), "`$.vary.grow.particles`"),
        (("particles = [5, 10]", "particles = []"), "a list of 0"),
        (("particles = [5, 10]", "voxel = [0.5]"), "a name that is"),
        (("width = [0.5, 1.0]", "widht = [0.5]"), "did you mean `width`"),
        (("width = [0.5, 1.0]", 'width = ["wide"]'), "`width` cannot be"),
        (("voxel = 0.5", "runs = 3"), "`$.grow.runs`"),
    ],
)
def test_a_file_that_is_no_batch_has_a_message(change: tuple[str, str], message: str, place: Path) -> None:
    place.write_text(SPEC.replace(*change))
    done = run("batch", place, "--processes", "1")
    assert done.exit_code != 0 and message in str(done.exception), str(done.exception)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--shard", "5/4"], "shard"),
        (["--engine", "slurm"], "local, ray, dask"),
        (["--cluster", "tcp://there"], "--engine ray"),
        (["--processes", "0"], "--processes"),
        (["--chunk", "-1"], "chunk"),
    ],
)
def test_flags_that_make_no_sense_have_a_message(words: list[str], message: str, place: Path) -> None:
    done = run("batch", place, *words)
    assert done.exit_code != 0 and message in str(done.exception), str(done.exception)


def test_a_folder_of_other_results_is_refused(place: Path, tmp_path: Path) -> None:
    (tmp_path / "used").mkdir()
    (tmp_path / "used" / "run.json").write_text("{}")
    assert "already-there" in str(run("batch", place, "-o", "used").exception)
    assert "no-batch" in str(run("batch", "export", "used").exception)


def test_every_flag_of_a_search_can_be_written(place: Path) -> None:
    text = SPEC.replace(
        'target = "pillar.obj"', 'avoid = ["pillar.obj"]\nfloor = 0\nwithin = [-5, 0, -5, 5, 10, 5]'
    )
    place.write_text(
        text.replace("voxel = 0.5", 'target = "pillar.obj"\nmethod = "smc"\npower = 8\nkernels = 1')
    )
    with pytest.raises(Exception, match=r"\$.grow.kernels"):
        batch_files.load(place)
    place.write_text(text.replace("voxel = 0.5", 'target = "pillar.obj"\nmethod = "smc"\npower = 8'))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        batch = batch_files.load(place)
    (first, *_) = batch.table.searches
    names = [spec.name for spec in first.score.specs]
    assert names == [
        "no_self_intersection",
        "floor",
        "avoid",
        "overshoot",
        "match_volume",
    ]
    assert first.method.power == 8.0 and first.max_memory == 512 << 20


def test_how_far_a_batch_is() -> None:
    now = batches.BatchProgress(
        done=300, total=1000, earlier=100, faults=2, lost=0, seconds=100.0, cpu_seconds=400.0
    )
    assert (
        batch_progress(now) == "300 of 1,000 searches, 2 failed, 2 a second, 7 min of processors, 6 min left"
    )
    assert [duration(seconds) for seconds in (1.25, 90.0, 600.0, 90_000.0)] == [
        "1.2 s",
        "90 s",
        "10 min",
        "25.0 h",
    ]
