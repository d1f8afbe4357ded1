"""Claim: whatever the disk refuses, a batch ends with a message that says so, keeps each result that was whole, and
goes on to the bytes of one that was left alone.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import batched
import niwaki as nw
import pytest
from faults import trials
from niwaki import batches
from niwaki.batches import export
from niwaki.batches.segments import Segment, records
from niwaki.errors import FileError


@pytest.fixture
def thread() -> Iterator[ThreadPoolExecutor]:
    with ThreadPoolExecutor(1) as executor:
        yield executor


@pytest.mark.parametrize("has_results", [False, True])
def test_a_batch_goes_on_after_each_fault_of_the_disk(
    has_results: bool, tmp_path: Path, thread: ThreadPoolExecutor
) -> None:
    def search(folder: Path, seeds: int = 2) -> None:
        # A chunk for each search: several appends.
        list(nw.batch(batched.PILES, seeds=seeds, folder=folder, executor=thread, chunk=0.0))

    (tmp_path / "alone").mkdir()
    search(tmp_path / "alone")
    expected, kinds = batched.whole(tmp_path / "alone"), set()
    (tmp_path / "tried").mkdir()
    for trial in trials(
        tmp_path / "tried", search, lambda folder: search(folder, 1) if has_results else None
    ):
        assert trial.error is None or isinstance(trial.error, FileError), trial
        kinds.add((trial.call, trial.error is None))
        if trial.error is not None:
            message = str(trial.error)
            assert (
                "No space left" in message
                or "Input/output error" in message
                or "Permission denied" in message
            )
        if batches.is_batch(trial.folder):
            assert len(batches.Store(trial.folder)) >= 2 * has_results
        search(trial.folder)
        assert batched.whole(trial.folder) == expected, trial
    assert {call for call, _ in kinds} >= {"open", "write", "fsync", "mkdir", "replace"}


def test_a_full_disk_is_named_and_no_worker_is_blamed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("niwaki.batches.segments.write_all", full)
    with pytest.raises(FileError, match="No space left on device") as error:
        list(nw.batch(batched.PILES, seeds=8, folder=tmp_path, processes=2))
    assert "worker" not in str(error.value)


def test_a_segment_goes_on_after_a_write_that_failed(tmp_path: Path) -> None:
    for trial in trials(tmp_path, lambda folder: Segment(folder).append([(b"k" * 32, b"first")], ["{}"])):
        assert trial.error is None or isinstance(trial.error, FileError), trial
    segment = Segment(tmp_path)
    segment.append([(b"a" * 32, b"first")])
    with pytest.MonkeyPatch.context() as changed:
        changed.setattr("niwaki.batches.segments.write_all", _half)
        with pytest.raises(FileError):
            segment.append([(b"b" * 32, b"second")])
    (place,) = segment.append([(b"c" * 32, b"third")])
    segment.close()
    data = segment.path.read_bytes()
    assert data[place : place + 5] == b"third"
    assert [key[:1] for key, _, _ in records(segment.path)] == [b"a", b"c"]


def test_the_files_of_an_export_are_whole_after_each_fault(
    tmp_path: Path, thread: ThreadPoolExecutor
) -> None:
    list(nw.batch(batched.PILES, seeds=1, folder=tmp_path / "batch", executor=thread))
    store = batches.Store(tmp_path / "batch")

    def exported(folder: Path) -> None:
        best = export.best_of(store, 1)
        export.write_csv(folder / "results.csv", store)
        export.write_meshes(folder / "meshes", best)

    exported(tmp_path)
    whole = {name: (tmp_path / name).read_bytes() for name in ("results.csv", "meshes/case-0-seed-0.glb")}
    (tmp_path / "tried").mkdir()
    for trial in trials(tmp_path / "tried", exported):
        assert trial.error is None or isinstance(trial.error, FileError), trial
        for file in trial.folder.rglob("*.*"):
            assert file.read_bytes() == whole[str(file.relative_to(trial.folder))], trial


def _half(number: int, data: bytes) -> None:
    os.write(number, data[: len(data) // 2])
    raise OSError(28, "No space left on device")
