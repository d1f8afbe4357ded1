"""A session on a failing or full disk, with damaged files, or with links in place of files."""

from __future__ import annotations

import asyncio
import json
import os
import random
import shutil
import stat
import subprocess
import sys
import tracemalloc
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from faults import injected, trials
from mutated import HOSTILE, mutated
from niwaki.errors import FileError, InputError, NiwakiError
from niwaki.studio import messages as m
from niwaki.studio.journal import Journal
from niwaki.studio.session import Session, obey
from niwaki.studio.window import Window
from studio_process import Served, serving

STORED = Path(__file__).parents[2] / "golden" / "studio-session"
UNIX = pytest.mark.skipif(os.name == "nt", reason="Unix only")

#: Mutations of each file in the suite, and in `make soak`.
QUICK, LONG = 200, 3_000
#: Bytes that opening a damaged session of some kB may take.
MEMORY = 64 << 20


def stored_state(folder: Path) -> tuple[str, int, int, int | None]:
    """Open a session on the disk again and return its state."""
    journal = Journal(folder)
    try:
        return state_of(journal)
    finally:
        journal.close()


def state_of(journal: Journal) -> tuple[str, int, int, int | None]:
    return journal.document().hash, journal.undoable, journal.redoable, journal.running


def events(window: Window) -> list[dict]:
    return [json.loads(data) for data in window._waiting.values() if isinstance(data, str)]


# ---- a disk that fails


def test_what_was_shown_is_on_a_disk_that_fails_at_any_call(tmp_path):
    """Try each fault at each call of a session: a step that failed is absent, all other steps are present."""
    calls = lost = 0
    work = [
        lambda journal: journal.step("model", {"model": "a"}),
        lambda journal: journal.step("model", {"model": "b" * 5_000}),
        lambda journal: journal.undo(),
        lambda journal: journal.run(),
        lambda journal: journal.redo(),
        lambda journal: journal.end_run(),
        lambda journal: journal.step("model", {"model": "c"}),
    ]
    shown: dict[Path, object] = {}

    def live(folder: Path) -> None:
        # The studio does not start, or some commands fail and it continues.
        journal = Journal(folder)
        try:
            for action in work:
                before = state_of(journal)
                try:
                    action(journal)
                except FileError:
                    assert state_of(journal) == before
            shown[folder] = state_of(journal)
        finally:
            journal.close()

    for trial in trials(tmp_path, live):
        calls += 1
        assert trial.error is None or isinstance(trial.error, FileError), trial
        for line in (
            (trial.folder / "journal.jsonl").read_bytes().splitlines() if trial.folder in shown else ()
        ):
            json.loads(line)
        stored = stored_state(trial.folder)
        lost += stored != shown.get(trial.folder, stored)
        assert stored == shown.get(trial.folder, stored), trial
    assert calls > 100 and lost == 0


def test_a_line_that_could_not_be_cut_back_is_cut_before_the_next_one(tmp_path, monkeypatch):
    journal = Journal(tmp_path)
    journal.step("model", {"model": "a"})
    cut = os.ftruncate

    def fails(number: int, length: int) -> None:
        raise OSError(5, "Input/output error")

    with injected(tmp_path) as calls:
        calls._files.add((os.fstat(journal._number).st_dev, os.fstat(journal._number).st_ino))
        calls.fault, calls.at = "full", 0
        monkeypatch.setattr(os, "ftruncate", fails)
        with pytest.raises(FileError, match="No space left"):
            journal.step("model", {"model": "b"})
    assert not (tmp_path / "journal.jsonl").read_bytes().endswith(b"\n")
    monkeypatch.setattr(os, "ftruncate", cut)
    journal.step("model", {"model": "c"})
    journal.close()
    again = Journal(tmp_path)
    assert again.document().model == "c" and again.undoable == 2 and not again.loss
    again.close()


def test_a_step_on_a_full_disk_is_refused_with_a_message_and_the_session_goes_on(tmp_path):
    async def work() -> None:
        session, window = Session(tmp_path, []), Window()
        session.ready.set()
        await obey(session, window, m.Hello(protocol=m.PROTOCOL, id=1))
        number = os.fstat(session.journal._number)
        with injected(tmp_path) as calls:
            calls._files.add((number.st_dev, number.st_ino))
            calls.fault = "full"
            for k in range(3):
                await obey(session, window, m.Set(settings=m.SettingsChange(count=2 + k), id=2 + k))
            await obey(session, window, m.Run(id=7))
        problems = {event["id"]: event["problem"] for event in events(window) if event["kind"] == "error"}
        assert set(problems) == {2, 3, 4, 7}
        assert "No space left on device" in problems[2]["text"] and problems[2]["code"] == "file-unwritable"
        assert session.document.settings.count == 8 and session.searching is None
        await obey(session, window, m.Set(settings=m.SettingsChange(count=3), id=9))
        assert events(window)[-1] == {"kind": "done", "id": 9, "interrupted": False}
        await session.end()

    asyncio.run(work())
    journal = Journal(tmp_path)
    assert journal.document().settings.count == 3 and journal.undoable == 1
    journal.close()


# ---- damage


def damaged(name: str, chance: random.Random) -> bytes:
    """Change a file of a session: a line of a journal, or the text of another file."""
    data = (STORED / name).read_bytes()
    if name != "journal.jsonl":
        return mutated(json.loads(data), chance)[1]
    lines = data.splitlines()
    at = chance.randrange(len(lines))
    change = chance.choice(["line", "line", "line", "field", "twice", "gone", "swap", "bytes"])
    if change == "line":
        lines[at] = mutated(json.loads(lines[at]), chance)[1]
    elif change == "field":
        step = json.loads(lines[at])
        step[chance.choice(list(step))] = chance.choice([*HOSTILE, 3, 5, 8, 9])
        lines[at] = json.dumps(step).encode()
    elif change == "twice":
        lines.insert(at, lines[at])
    elif change == "gone":
        del lines[at]
    elif change == "swap":
        other = chance.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    whole = bytearray(b"\n".join(lines) + b"\n")
    if change == "bytes":
        for _ in range(chance.randint(1, 3)):
            whole[chance.randrange(len(whole))] = chance.randrange(256)
        whole = whole[: chance.randint(0, len(whole))] if chance.random() < 0.3 else whole
    return bytes(whole)


def try_damage(folder: Path, name: str, count: int, seed: int) -> dict[str, int]:
    """Open damaged sessions; each opens with a document that can be shown and stored, or gives a message."""
    chance, outcomes = random.Random(seed), {"opened": 0, "in part": 0, "message": 0}
    shutil.copytree(STORED, folder)
    tracemalloc.start()
    try:
        for _ in range(count):
            for file in ("journal.jsonl", "session.json"):
                (folder / file).write_bytes((STORED / file).read_bytes())
            text = damaged(name, chance)
            (folder / name).write_bytes(text)
            try:
                journal = Journal(folder)
            except NiwakiError as error:
                assert str(error).startswith("error["), text
                outcomes["message"] += 1
                continue
            outcomes["in part" if journal.loss else "opened"] += 1
            try:
                journal.document()
                while journal.undo():
                    pass
                while journal.redo():
                    pass
                journal.step("model", {"model": "z"})
            finally:
                journal.close()
            assert stored_state(folder) is not None
            (folder / "journal.damaged").unlink(missing_ok=True)
        assert tracemalloc.get_traced_memory()[1] < MEMORY
    finally:
        tracemalloc.stop()
    return outcomes


@pytest.mark.parametrize("name", ["journal.jsonl", "session.json"])
def test_a_damaged_session_opens_with_what_is_whole_or_gives_a_message(tmp_path, name):
    outcomes = try_damage(tmp_path / "session", name, QUICK, 41)
    assert outcomes["message"] and outcomes["opened"]


@pytest.mark.soak
@pytest.mark.parametrize("name", ["journal.jsonl", "session.json"])
def test_many_damaged_sessions(tmp_path, name):
    seed = random.SystemRandom().randrange(2**32)
    print(f"{name}: seed {seed}, {try_damage(tmp_path / 'session', name, LONG, seed)}")


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ('{"head":5}', "line 2: at `$.head` there is 5, expected an earlier step"),
        ('{"head":-1}', "line 2"),
        ('{"step":2,"parent":2,"name":"a","changes":{}}', "expected step 2 after an earlier step"),
        ('{"step":1,"parent":2,"name":"a","changes":{}}', "expected step 2"),
        ('{"step":2,"parent":1,"name":"a","changes":5}', "line 2: at `$.changes`"),
        ('{"step":2,"parent":1,"name":"a","changes":{"results":3}}', "line 2: at `$.changes.results`"),
        ('{"running":1e300}', "line 2"),
        ('{"nothing":1}', "line 2"),
        ("[]", "line 2"),
        ("\x00" * 40, "line 2: it is not JSON"),
    ],
    ids=[
        "head",
        "below",
        "own-parent",
        "circle",
        "changes",
        "results",
        "running",
        "unknown",
        "list",
        "zeros",
    ],
)
def test_a_wrong_line_is_named_or_left_out_where_it_is_the_last(tmp_path, line, reason):
    journal = Journal(tmp_path)
    journal.step("model", {"model": "a"})
    journal.close()
    place = tmp_path / "journal.jsonl"
    first = place.read_bytes()
    place.write_bytes(first + line.encode() + b'\n{"running":1}\n')
    with pytest.raises(InputError, match="bad-session") as caught:
        Journal(tmp_path)
    assert reason in str(caught.value) and "remove line 2 and all after it" in str(caught.value)
    assert place.read_bytes() == first + line.encode() + b'\n{"running":1}\n'
    # The wrong line is now the last line.
    place.write_bytes(first + line.encode() + b"\n")
    again = Journal(tmp_path)
    assert again.document().model == "a" and "damaged" in again.loss
    again.step("model", {"model": "b"})
    again.close()
    assert (tmp_path / "journal.damaged").read_bytes() == first + line.encode() + b"\n"
    assert stored_state(tmp_path)[1] == 2


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("[]", "expected a table of names and values"),
        ("", "it is not JSON"),
        ("{", "it is not JSON"),
        ('{"format": 1}', r"at `\$.session`"),
        ('{"format": 1, "session": 5}', r"at `\$.session` there is 5"),
        ('{"format": 2, "session": "a"}', "it has format 2, this version of Niwaki reads format 1"),
        ('{"session": "a"}', "it has format None"),
        ("x" * 2_000_000, "file-limit"),
    ],
)
def test_a_session_without_its_name_gives_a_message(tmp_path, text, reason):
    (tmp_path / "session.json").write_text(text)
    with pytest.raises(NiwakiError, match=reason):
        Journal(tmp_path)
    assert (tmp_path / "session.json").read_text() == text


def test_a_window_receives_a_message_about_the_lost_step(tmp_path):
    shutil.copytree(STORED, tmp_path / "stored")
    with open(tmp_path / "stored" / "journal.jsonl", "ab") as file:
        file.write(b'{"step":9,"parent":8,"na\x00\x00\x00\n')
    session, window = Session(tmp_path / "stored", []), Window()
    session.welcome(window, 1)
    (event,) = (event for event in events(window) if event["kind"] == "error")
    assert event["problem"]["code"] == "step-lost" and "journal.damaged" in event["problem"]["text"]
    session.journal.close()


def test_values_that_cannot_be_stored_are_refused_before_writing(tmp_path):
    async def work() -> None:
        session, window = Session(tmp_path, []), Window()
        session.ready.set()
        deep: list = []
        for _ in range(600):
            deep = [deep]
        for number, arguments in enumerate(({"a": deep}, {str(k): 1 for k in range(201)}), 1):
            await obey(session, window, m.Set(arguments=arguments, id=number))
        await obey(session, window, m.Set(arguments={"a": 10**30}, id=3))
        await session.end()
        answers = events(window)
        assert [event["problem"]["code"] for event in answers if event["kind"] == "error"] == [
            "not-stored",
            "too-many",
        ]
        assert answers[-1]["kind"] == "done"

    asyncio.run(work())
    journal = Journal(tmp_path)
    assert journal.undoable == 1 and journal.document().arguments == {"a": 10**30}
    journal.close()


# ---- links and other names


@UNIX
@pytest.mark.parametrize(
    "name", ["journal.jsonl", "session.json", "runs", "runs/0.json", "files/0-0/best.glb"]
)
@pytest.mark.parametrize("is_there", [True, False])
def test_a_link_in_a_session_is_never_followed(tmp_path, name, is_there):
    target, folder = tmp_path / "mine.txt", tmp_path / "session"
    if is_there:
        target.write_text("mine\n")
    place = folder / name
    place.parent.mkdir(parents=True)
    place.symlink_to(target)
    with pytest.raises(NiwakiError, match="it is a link|File exists"):
        Journal(folder)
    assert target.read_text() == "mine\n" if is_there else not target.exists()


@UNIX
def test_a_journal_that_has_another_name_is_copied_first(tmp_path):
    journal = Journal(tmp_path / "one")
    journal.step("model", {"model": "a"})
    journal.close()
    (tmp_path / "two").mkdir()
    os.link(tmp_path / "one" / "journal.jsonl", tmp_path / "two" / "journal.jsonl")
    other = Journal(tmp_path / "two")
    other.step("model", {"model": "b"})
    other.close()
    assert stored_state(tmp_path / "one")[1] == 1 and stored_state(tmp_path / "two")[1] == 2


@UNIX
def test_the_key_is_a_file_of_its_own_for_the_user_alone(tmp_path):
    """An old mode and a link of the name are replaced."""
    target = tmp_path / "mine.txt"
    target.write_text("mine\n")
    for prepare in (
        lambda place: place.symlink_to(target),
        lambda place: os.link(target, place),
        lambda place: (place.write_text("old"), place.chmod(0o666)),
    ):
        folder = tmp_path / "session"
        folder.mkdir()
        prepare(folder / "key")
        with serving(folder):
            status = (folder / "key").lstat()
            assert stat.S_ISREG(status.st_mode) and stat.S_IMODE(status.st_mode) == 0o600
        assert target.read_text() == "mine\n"
        shutil.rmtree(folder)


@UNIX
def test_a_pipe_in_place_of_a_file_does_not_block_the_start(tmp_path):
    for name in ("journal.jsonl", "session.json"):
        folder = tmp_path / name
        folder.mkdir()
        os.mkfifo(folder / name)
        with pytest.raises(FileError, match="file-not-regular"):
            Journal(folder)


def test_the_command_reports_a_session_that_cannot_be_opened(tmp_path):
    (tmp_path / "session.json").write_text("[]")
    command = [
        sys.executable,
        "-m",
        "niwaki.shell.main",
        "studio",
        "--session",
        str(tmp_path),
        "--no-browser",
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "error[bad-session]" in done.stderr and "Traceback" not in done.stderr


def test_all_files_of_a_studio_lie_in_its_folder(tmp_path):
    with serving(tmp_path / "session") as served:
        assert isinstance(served, Served)
        names = {place.name for place in (tmp_path / "session").iterdir()}
    assert names <= {"journal.jsonl", "session.json", "key", "cookie", "runs", "uploads", "files"}
