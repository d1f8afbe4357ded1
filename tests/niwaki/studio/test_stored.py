"""Files that a studio stores beside its steps (runs, uploads, exports): damaged, or on a failing disk."""

from __future__ import annotations

import asyncio
import json
import random
import shutil
import threading
import time
import warnings
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")

import niwaki as nw
import numpy as np
import trimesh
from faults import trials
from mutated import mutated
from niwaki import Target
from niwaki.errors import FileError, NiwakiError
from niwaki.shell import run_files
from niwaki.shell.references import find
from niwaki.studio import messages as m
from niwaki.studio.problems import CommandError
from niwaki.studio.session import Session, exporting
from niwaki.studio.window import Window
from niwaki.studio.worker import asks, loop, runs, thinning, uploads
from niwaki.studio.worker.thinning import Ghost

STORED = Path(__file__).parents[2] / "golden" / "studio-session"
#: Mutations of each file in the suite, and in `make soak`.
QUICK, LONG = 25, 3_000
#: The longest time that a file may take, seconds.
LONGEST = 10.0

KEY = m.Key(0)


def ignore(*_: Any) -> None:
    """Receive a report."""


def grown(folder: Path) -> Path:
    """Fill a session's folder with a scene in runs/0.json and a colouring in runs/1.json."""
    (folder / "runs").mkdir(parents=True, exist_ok=True)
    question = m.Question("spaceship", {}, m.Ask(), m.Settings(count=1, effort=0.1))
    file = folder / "runs" / "0.json"
    loop.do(m.Grow(question=question, run=0, seed=1, file=str(file)), ignore, loop.StopFlag())
    shutil.copy(next(iter(sorted((STORED / "runs").glob("*.json")))), folder / "runs" / "1.json")
    return folder


def jobs(source: Path, folder: Path, model: str) -> list[m.AnyJob]:
    """List jobs that read a stored run."""
    question, place = m.Question(model, {}, m.Ask(), m.Settings()), {"source": str(source), "number": 0}
    part = "while[0]/length" if model == "spaceship" else "wing"
    return [
        m.ShowRun(**place, key=KEY, detail="light"),
        m.DescribeRun(**place, question=question, key=KEY),
        m.Hold(**place, parts=[part]),
        m.FindDifference(**place, key=KEY),
        m.WriteFile(**place, format="json", folder=str(folder / "files")),
        m.JudgeRun(**place, key=KEY),
    ]


def try_runs(folder: Path, number: int, model: str, count: int, seed: int) -> Counter[str]:
    """Change a stored run; each job with it is done or gives a message."""
    chance, outcomes = random.Random(seed), Counter[str]()
    data = json.loads((folder / "runs" / f"{number}.json").read_bytes())
    for at in range(count):
        change, text = mutated(data, chance)
        # Runs stay in memory by their file, so each change has a file of its own.
        place = folder / "runs" / f"{number}{at:06}.json"
        place.write_bytes(text)
        for job in jobs(place, folder, model):
            start = time.monotonic()
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    loop.do(job, ignore, loop.StopFlag())
                outcomes["done"] += 1
            except (NiwakiError, CommandError):
                outcomes["message"] += 1
            except Exception as error:
                raise AssertionError(f"{type(job).__name__}, {change}: {error!r}\n{text[:2000]!r}") from error
            assert time.monotonic() - start < LONGEST, (change, text[:2000])
        place.unlink()
    return outcomes


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return grown(tmp_path_factory.mktemp("session"))


RUNS = pytest.mark.parametrize(("number", "model"), [(0, "spaceship"), (1, "drawing:bug")])


@RUNS
def test_a_stored_run_that_was_changed_is_shown_or_gives_a_message(session, number, model):
    for job in jobs(session / "runs" / f"{number}.json", session, model)[:3]:
        loop.do(job, ignore, loop.StopFlag())
    outcomes = try_runs(session, number, model, QUICK, 41)
    assert outcomes["message"] and outcomes["done"]


@pytest.mark.soak
@RUNS
def test_many_stored_runs_that_were_changed(session, number, model):
    seed = random.SystemRandom().randrange(2**32)
    print(f"{model}: seed {seed}, {dict(try_runs(session, number, model, LONG, seed))}")


def ball(folder: Path) -> Path:
    """Store an uploaded mesh with its ghost."""
    mesh = trimesh.creation.icosphere(3, 1.0)
    place = folder / f"{'a' * 64}.stl"
    place.write_bytes(thinning.stl(mesh.vertices, mesh.faces))
    Ghost.of(Target(mesh.vertices, mesh.faces)).save(place)
    return place


def try_meshes(folder: Path, suffix: str, count: int, seed: int) -> Counter[str]:
    """Change a file of an uploaded mesh; the mesh is shown or gives a message."""
    chance, outcomes = random.Random(seed), Counter[str]()
    whole = ball(folder)
    data = whole.with_suffix(suffix).read_bytes()
    for at in range(count):
        place = folder / f"{at:064x}.stl"
        # Without a ghost the full mesh is read.
        for other in (".stl", ".light.stl", ".json") if suffix != ".stl" else (".stl",):
            shutil.copy(whole.with_suffix(other), place.with_suffix(other))
        if suffix == ".json":
            text = mutated(json.loads(data), chance)[1]
        else:
            changed = bytearray(data)
            for _ in range(chance.randint(1, 8)):
                changed[chance.randrange(len(changed)) if chance.random() < 0.7 else chance.randrange(84)] = (
                    chance.randrange(256)
                )
            text = bytes(changed[: chance.randint(0, len(data))] if chance.random() < 0.3 else changed)
        place.with_suffix(suffix).write_bytes(text)
        start = time.monotonic()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                shown, foot = asks.shown(m.TargetAsk(str(place)))
            assert np.shape(shown.bounds) == (2, 3) and len(foot) == 3
            outcomes["shown"] += 1
        except NiwakiError:
            outcomes["message"] += 1
        assert time.monotonic() - start < LONGEST
        for other in (".stl", ".light.stl", ".json"):
            place.with_suffix(other).unlink(missing_ok=True)
    return outcomes


@pytest.mark.parametrize("suffix", [".json", ".light.stl", ".stl"])
def test_a_mesh_whose_files_were_changed_is_shown_or_gives_a_message(tmp_path, suffix):
    assert try_meshes(tmp_path, suffix, QUICK, 41)["shown"]


@pytest.mark.soak
@pytest.mark.parametrize("suffix", [".json", ".light.stl", ".stl"])
def test_many_meshes_whose_files_were_changed(tmp_path, suffix):
    seed = random.SystemRandom().randrange(2**32)
    print(f"{suffix}: seed {seed}, {dict(try_meshes(tmp_path, suffix, LONG, seed))}")


# ---- a disk that fails


def try_faults(
    place: Path,
    attempt: Callable[[Path], object],
    prepare: Callable[[Path], object],
    whole: Callable[[Path], object],
) -> int:
    """Try each fault at each call: it gives a message, files are complete, and no partial files are left."""
    count = 0
    for trial in trials(place, attempt, prepare):
        count += 1
        assert trial.error is None or isinstance(trial.error, FileError), (trial, repr(trial.error))
        assert not list(trial.folder.rglob(".niwaki-*")), trial
        whole(trial.folder)
    return count


@pytest.mark.parametrize(
    "kinds",
    [
        ("json", "glb", "colouringsvg"),
        pytest.param(("stl", "obj", "colouringjson", "colouringtoml"), marks=pytest.mark.soak),
    ],
)
def test_files_of_results_are_whole_on_a_disk_that_fails(kinds, session, tmp_path):
    def prepare(folder: Path) -> None:
        shutil.copytree(session / "runs", folder / "runs")

    def write(kind: str) -> Callable[[Path], None]:
        def attempt(folder: Path) -> None:
            number, format = ("1", kind[9:]) if kind.startswith("colouring") else ("0", kind)
            job = m.WriteFile(
                source=str(session / "runs" / f"{number}.json"),
                number=0,
                format=format,
                folder=str(folder / "files"),
            )
            loop.do(job, ignore, loop.StopFlag())

        return attempt

    for kind in kinds:
        (tmp_path / kind).mkdir()
        sizes = set()

        def whole(folder: Path, sizes: set[tuple[str, bytes]] = sizes) -> None:
            for file in (folder / "files").glob("*") if (folder / "files").is_dir() else ():
                sizes.add((file.name, file.read_bytes()))

        assert try_faults(tmp_path / kind, write(kind), prepare, whole) >= 12
        # In every trial a file that exists has the same bytes.
        assert len(sizes) == len({name for name, _ in sizes})


def test_a_run_is_stored_whole_on_a_disk_that_fails(session, tmp_path):
    sample = runs.sample(str(session / "runs" / "0.json"), 0)
    result = run_files.Result(sample.search, [sample], 1)
    reference = run_files.ModelReference("spaceship", sample.search.model)

    def whole(folder: Path) -> None:
        if (folder / "0.json").exists():
            run_files.load(folder / "0.json")

    count = try_faults(
        tmp_path,
        lambda folder: runs.store(result, reference, 0, str(folder / "0.json"), "run"),
        lambda folder: None,
        whole,
    )
    assert count >= 20


def test_what_was_sent_is_kept_whole_on_a_disk_that_fails(tmp_path, monkeypatch):
    monkeypatch.setattr(uploads, "bound", lambda **_: None)
    monkeypatch.setattr(thinning, "GHOST_TRIANGLES", 100)
    monkeypatch.setattr(uploads, "GHOST_TRIANGLES", 100)
    lines: list[str] = []
    monkeypatch.setattr("builtins.print", lambda text, *_, **__: lines.append(text))
    sphere = trimesh.creation.icosphere(2, 1.0)
    mesh = thinning.stl(sphere.vertices, sphere.faces)

    def prepare(folder: Path) -> None:
        (folder / "sent.stl").write_bytes(mesh)
        (folder / "sent.svg").write_bytes(
            (Path(uploads.__file__).parents[2] / "color/drawings/bug.svg").read_bytes()
        )

    for suffix in ("stl", "svg"):
        (tmp_path / suffix).mkdir()
        count = 0
        for trial in trials(
            tmp_path / suffix,
            lambda folder, suffix=suffix: uploads.main(
                str(folder / f"sent.{suffix}"), str(folder / f"read.{suffix}")
            ),
            prepare,
        ):
            count += 1
            report = json.loads(lines[-1])
            assert trial.error is None, trial
            if "error" not in report:
                assert (trial.folder / f"read.{suffix}").read_bytes(), trial
                assert suffix == "svg" or Ghost.beside(trial.folder / "read.stl") is not None, trial
        assert count >= 20


def test_a_file_that_is_fetched_is_whole_on_a_disk_that_fails(tmp_path):
    """Try the server's part of an export, and the files that it then serves by hash."""

    async def exported(folder: Path) -> None:
        session, window = Session(folder / "session", []), Window()
        (folder / "session" / "runs" / "0.json").write_text("{}")

        async def do(job: Any) -> m.Answer:
            place = folder / "best.glb"
            place.write_bytes(b"glb" * 10_000)
            return m.Answer(path=str(place))

        session.desk.do = do
        try:
            await exporting.export(session, window, m.Export(KEY, "glb"))
        finally:
            await session.end()

    (tmp_path / "all").mkdir()
    for trial in trials(tmp_path / "all", lambda folder: asyncio.run(exported(folder))):
        assert trial.error is None or isinstance(trial.error, (FileError, OSError)), trial
        for place in (trial.folder / "session" / "files").rglob("best.glb"):
            assert place.read_bytes() == b"glb" * 10_000, trial
    assert threading.active_count() < 50


def test_a_choice_among_words_has_its_options_and_takes_a_word(tmp_path):
    question, vines = m.Question("vines", {}, m.Ask(), m.Settings(count=1)), find("vines")
    file, sent = tmp_path / "0.json", []
    runs.store(nw.run(vines.model, nw.forward(1), seed=1), vines, 0, str(file), "run")
    place = {"source": str(file), "number": 0}
    loop.do(m.DescribeRun(**place, question=question, key=KEY), sent.append, loop.StopFlag())
    leaf = next(choice for choice in sent[0].choices if choice.address.endswith("leaf"))
    assert leaf.options == ["none", "left", "right"] and leaf.value in leaf.options and leaf.low is None
    assert all(choice.options == [] for choice in sent[0].choices if not choice.address.endswith("leaf"))
    other = next(word for word in leaf.options if word != leaf.value)
    changed = tmp_path / "1.json"
    job = m.Change(**place, question=question, changes={leaf.address: other}, run=1, file=str(changed))
    loop.do(job, ignore, loop.StopFlag())
    assert runs.sample(str(changed), 0).choices[leaf.address] == other
