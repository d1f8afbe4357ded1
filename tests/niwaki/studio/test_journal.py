"""A session is on the disk before it is shown: undo, redo, and a line that was cut short."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("msgspec")

from niwaki.errors import InputError
from niwaki.studio.journal import Journal


@pytest.fixture
def session(tmp_path):
    """A function that opens the journal of one folder, again and again."""
    found = []

    def opened():
        found.append(Journal(tmp_path))
        return found[-1]

    yield opened
    for one in found:
        one.close()


def steps(journal, *names):
    for name in names:
        journal.step(name, {"model": name})


def test_ten_steps_back_and_again_give_the_same_hash(session):
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


def test_a_step_after_undo_takes_the_place_of_what_was_undone(session):
    journal = session()
    steps(journal, "a", "b")
    journal.undo()
    steps(journal, "c")
    assert not journal.redo() and journal.document().model == "c"
    journal.undo()
    assert journal.document().model == "a" and journal.redo() and journal.document().model == "c"


def test_another_process_reads_the_same(session):
    journal = session()
    steps(journal, "a", "b", "c")
    journal.undo()
    assert journal.run() == 0 and journal.run() == 1
    again = session()
    assert again.document().hash == journal.document().hash and again.name == journal.name
    assert (again.undoable, again.redoable, again.running) == (2, 1, 1)
    again.ended()
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


def test_a_line_that_is_wrong_is_named(session, tmp_path):
    journal = session()
    steps(journal, "a")
    with open(tmp_path / "journal.jsonl", "a") as file:
        file.write(json.dumps({"nothing": 1}) + "\n")
    with pytest.raises(InputError, match="line 2"):
        session()
