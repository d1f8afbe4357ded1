"""The journal of a session: undo, redo, and a line that was cut short."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

pytest.importorskip("msgspec")

from niwaki import studio
from niwaki.studio.journal import Journal
from studio_process import serving

#: A session of the first format: two colourings of a bug, the second starred and active, one region held.
STORED = Path(__file__).parents[2] / "golden" / "studio-session"


@pytest.fixture
def session(tmp_path):
    """A function that opens the journal of one folder, also several times."""
    journals = []

    def open_journal():
        journals.append(Journal(tmp_path))
        return journals[-1]

    yield open_journal
    for journal in journals:
        journal.close()


def steps(journal, *names):
    for name in names:
        journal.step(name, {"model": name})


def test_ten_undos_and_redos_restore_the_same_hashes(session):
    journal = session()
    hashes = [journal.document().hash]
    for name in "abcdefghij":
        steps(journal, name)
        hashes.append(journal.document().hash)
    assert len(set(hashes)) == 11
    for place in range(9, -1, -1):
        assert journal.undo() and journal.document().hash == hashes[place]
    assert not journal.undo()
    for place in range(1, 11):
        assert journal.redo() and journal.document().hash == hashes[place]
    assert not journal.redo() and (journal.undoable, journal.redoable) == (10, 0)


def test_a_step_after_undo_replaces_the_undone_step(session):
    journal = session()
    steps(journal, "a", "b")
    journal.undo()
    steps(journal, "c")
    assert not journal.redo() and journal.document().model == "c"
    journal.undo()
    assert journal.document().model == "a" and journal.redo() and journal.document().model == "c"


def test_a_second_journal_reads_the_same_state(session):
    journal = session()
    steps(journal, "a", "b", "c")
    journal.undo()
    assert journal.run() == 0 and journal.run() == 1
    again = session()
    assert again.document().hash == journal.document().hash and again.name == journal.name
    assert (again.undoable, again.redoable, again.running) == (2, 1, 1)
    again.end_run()
    assert session().running is None and session().run() == 2


@pytest.mark.parametrize("cut", [1, 5, 20])
def test_a_last_line_that_is_cut_short_is_left_out(session, tmp_path, cut):
    journal = session()
    steps(journal, "a", "b")
    place = tmp_path / "journal.jsonl"
    place.write_bytes(place.read_bytes()[:-cut])
    again = session()
    assert again.document().model == "a"
    steps(again, "c")
    assert session().document().model == "c"


def test_a_session_of_the_first_format_opens_with_results_and_undo(tmp_path):
    pytest.importorskip("starlette")
    shutil.copytree(STORED, tmp_path / "stored")
    with serving(tmp_path / "stored") as served, studio.connect(served.url, served.key) as script:
        while script.view["model"] is None:
            script.read(10)
        first, second = script.view["results"]
        assert script.view["model"]["reference"] == "drawing:bug" and script.view["picked"] == second["key"]
        assert script.view["stars"] == [second["key"]] and (script.view["undo"], script.view["redo"]) == (
            7,
            1,
        )
        (part,) = script.view["held"]
        colors = script.ask("describe", key=second["key"])["colors"]
        assert colors[part["part"]] == part["choices"][part["part"]]
        script.ask("redo")
        assert script.view["held"] == []
        for _ in range(8):
            script.ask("undo")
        assert script.view["results"] == [] and script.view["stars"] == []
        # A search keeps the starred result of the stored session.
        for _ in range(7):
            script.ask("redo")
        script.ask("run")
        assert script.view["results"][0]["key"] == second["key"] and len(script.view["results"]) > 1
