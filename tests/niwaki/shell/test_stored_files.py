"""Claim: a stored file of a batch or a checkpoint with anything wrong in it gives a message, also where its hash is
right, and so does whatever the disk refuses while they are written.

The mutations here are of the content, and the hashes of the file are those of what was made of it: whoever edits a file
can do so. `test_run_files.py` has those of run.json, of the JSON of a search and of guides.
"""

from __future__ import annotations

import hashlib
import json
import random
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from batched import pile
from faults import trials
from mutated import mutated, tracebacks
from niwaki import batches
from niwaki.batches import export
from niwaki.batches.segments import record, records
from niwaki.batches.spec import Spec
from niwaki.errors import FileError
from niwaki.search.checkpoint import FORMAT, MAGIC, Stored
from niwaki.shell import resume
from niwaki.shell.main import app
from typer.testing import CliRunner

pytestmark = pytest.mark.filterwarnings("ignore::niwaki.search.warnings.SearchWarning")

#: Mutations of each kind of file in the long form.
MANY = 3000


SEARCHES = [
    nw.Search(pile, (0.0, 1.5), nw.match_volume(nw.targets.examples.ship(), 2.0), nw.smc(5), keep="best"),
    nw.Search(pile, method=nw.mh(20, chains=2)),
    nw.Search(pile, method=nw.improve(5, rounds=1)),
]


def batch_in(folder: Path) -> None:
    with ThreadPoolExecutor(1) as thread:
        list(nw.batch(SEARCHES, seeds=1, folder=folder, executor=thread))


def read_batch(folder: Path) -> None:
    """Read all that a batch has, as `niwaki batch export` does."""
    store = batches.Store(folder)
    export.best_of(store, 2)
    for outcome in batches.stored(folder):
        export.numbers(outcome, choices=True)
        _ = outcome.result.info, outcome.best.scene


class Kind:
    """A kind of file: its mutations, and what reads it.

    Attributes
    ----------
    place
        The file; or a name that stands for files whose names have their hash.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        batch_in(folder)
        (self.spec,) = folder.glob("spec-*")
        (self.segment,) = folder.glob("1-of-1/seg-*")
        self.place = folder.with_name(f"{folder.name}.tried")


class Specs(Kind):
    """Specs, their names with the right hash."""

    def tries(self, count: int, chance: random.Random) -> Iterable[tuple[str, bytes]]:
        data = json.loads(self.spec.read_bytes())
        return (mutated(data, chance) for _ in range(count))

    def read(self, place: Path) -> None:
        for spec in self.folder.glob("spec-*"):
            spec.unlink()
        text = place.read_bytes()
        (self.folder / Spec.name_of(text)).write_bytes(text)
        read_batch(self.folder)


class Bodies(Kind):
    """Results, with the right checksum."""

    def tries(self, count: int, chance: random.Random) -> Iterable[tuple[str, bytes]]:
        data = self.segment.read_bytes()
        entries = [(key, data[at : at + length]) for key, at, length in records(self.segment)]
        for _ in range(count):
            key, body = chance.choice(entries)
            change, text = mutated(json.loads(body), chance)
            if chance.random() < 0.5:
                # Runs are texts with a form of their own.
                change, text = "a text", torn(body, chance)
            yield change, record(key, text)

    def read(self, place: Path) -> None:
        self.segment.write_bytes(place.read_bytes())
        read_batch(self.folder)


class Segments(Kind):
    """Segments whose bytes were changed."""

    def tries(self, count: int, chance: random.Random) -> Iterable[tuple[str, bytes]]:
        data = self.segment.read_bytes()
        return (("bytes", torn(data, chance)) for _ in range(count))

    read = Bodies.read


class Checkpoints:
    """Checkpoints, with the right hash in their first line."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        self.files = []
        for number, search in enumerate(SEARCHES):
            place = folder / f"{number}.checkpoint"
            search.run(checkpoint=nw.Checkpoint(place, every=0.0))
            self.files.append((search, place.read_bytes()))
        self.place = folder / "tried"
        self.search = SEARCHES[0]

    def tries(self, count: int, chance: random.Random) -> Iterable[tuple[str, bytes]]:
        for _ in range(count):
            self.search, data = chance.choice(self.files)
            _, _, rest = data.partition(b"\n")
            head, _, parts = rest.partition(b"\n")
            if chance.random() < 0.5:
                change, head = mutated(json.loads(head), chance)
            else:
                change, parts = "the parts", torn(parts, chance)
            rest = head + b"\n" + parts
            yield change, f"{MAGIC} {FORMAT} {hashlib.sha256(rest).hexdigest()}\n".encode() + rest

    def read(self, place: Path) -> None:
        Stored.read(place)
        self.search.run(checkpoint=nw.Checkpoint(place, every=1e9))


class Resumed(Checkpoints):
    """Checkpoints of the shell, from which `--resume` goes on."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        self.place, search = folder / resume.NAME, SEARCHES[0]
        note = {"command": "grow", "model": "pile.py:pile", "file_hash": None, "flags": FLAGS}
        search.run(checkpoint=nw.Checkpoint(self.place, every=0.0, note=note))
        self.files = [(search, self.place.read_bytes())]

    def read(self, place: Path) -> None:
        done = CliRunner().invoke(app, ["grow", "--resume", str(place.parent)])
        if done.exception is not None and not isinstance(done.exception, SystemExit):
            raise done.exception


#: What the shell notes in a checkpoint.
FLAGS = {
    "files": {
        "formats": ["glb"],
        "scale": None,
        "fuse": None,
        "frames": None,
        "size": None,
        "style": None,
    },
    "picture": False,
    "quick": True,
    "export": None,
    "origin": None,
}

KINDS: dict[str, Callable[[Path], Any]] = {
    "specs": Specs,
    "bodies": Bodies,
    "segments": Segments,
    "checkpoints": Checkpoints,
    "resumed": Resumed,
}


def torn(data: bytes, chance: random.Random) -> bytes:
    """Bytes, some of which are changed, cut out or doubled."""
    changed = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5))):
        at = chance.randrange(len(changed) + 1)
        match chance.randrange(4):
            case 0 if changed:
                changed[at % len(changed)] ^= 1 << chance.randrange(8)
            case 1:
                del changed[at : at + chance.choice((1, 4, 40))]
            case 2:
                changed[at:at] = changed[at : at + chance.choice((1, 4, 40))] * chance.choice((1, 2, 50))
            case _:
                changed[at:at] = chance.choice(
                    (b"0", b"-1", b"9" * 30, b"nan", b"\xff", b"\0", b"[", b'"', b"1e999")
                )
    return bytes(changed)


@pytest.mark.parametrize("name", KINDS)
def test_a_stored_file_that_was_changed_gives_a_message(name: str, tmp_path: Path) -> None:
    kind = KINDS[name](tmp_path / "kind")
    assert tracebacks(kind.tries(40, random.Random(f"{name} 1")), kind.read, kind.place) == []


@pytest.mark.soak
@pytest.mark.parametrize("name", KINDS)
def test_many_stored_files_that_were_changed_give_messages(name: str, tmp_path: Path) -> None:
    seed = random.SystemRandom().getrandbits(32)
    print("seed", seed)
    kind = KINDS[name](tmp_path / "kind")
    assert tracebacks(kind.tries(MANY, random.Random(seed)), kind.read, kind.place) == []


def grown(folder: Path, *words: str) -> None:
    line = [
        "grow",
        "coral",
        "--particles",
        "5",
        "--seed",
        "1",
        "--no-picture",
        "-o",
        str(folder / "out"),
        *words,
    ]
    done = CliRunner().invoke(app, line)
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    assert done.exit_code == 0, done.output


#: The suite makes one trial of so many; `make soak` makes all.
STRIDE = 15


@pytest.mark.parametrize("former", [False, True])
@pytest.mark.parametrize("stride", [STRIDE, pytest.param(1, marks=pytest.mark.soak)])
def test_a_folder_of_results_is_whole_after_each_fault_of_the_disk(
    stride: int, former: bool, tmp_path: Path
) -> None:
    expected: dict[int, bytes] = {}
    for seed in (1, 2):
        grown(tmp_path / str(seed), "--seed", str(seed))
        expected[seed] = (tmp_path / str(seed) / "out" / "best.glb").read_bytes()
    (tmp_path / "tried").mkdir()
    before = (lambda folder: grown(folder, "--seed", "2")) if former else (lambda folder: None)
    for trial in trials(tmp_path / "tried", lambda folder: grown(folder, "--force"), before, stride):
        assert trial.error is None or isinstance(trial.error, FileError), trial
        run, best = (trial.folder / "out" / name for name in ("run.json", "best.glb"))
        seed = json.loads(run.read_text())["search"]["seed"] if run.exists() else None
        assert seed is not None or not former, trial
        assert not best.exists() or best.read_bytes() == expected[seed or 1], trial
        grown(trial.folder, "--force")
        assert best.read_bytes() == expected[1] and not list(trial.folder.rglob(".niwaki*")), trial


def test_a_search_goes_on_after_each_fault_of_the_disk(tmp_path: Path) -> None:
    search = SEARCHES[2]
    expected = search.run().best.log_score

    def run(folder: Path) -> float:
        return search.run(checkpoint=nw.Checkpoint(folder / "own.checkpoint", every=0.0)).best.log_score

    for trial in trials(tmp_path, run):
        assert trial.error is None or isinstance(trial.error, FileError), trial
        assert run(trial.folder) == expected, trial
