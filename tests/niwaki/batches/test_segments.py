"""Claim: whatever ends a writer or damages a segment, every record that is whole is read, and nothing else is."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from niwaki.batches.segments import HEAD, Segment, record, records
from niwaki.errors import FileError


def random_records(count: int, seed: int) -> list[tuple[bytes, bytes]]:
    """Keys and bodies, some of which hold the mark of a record, or a whole one."""
    chance = random.Random(seed)
    bodies = [b"", b"nwk\x01", record(b"k" * 32, b"inner"), b"{}"]
    return [
        (chance.randbytes(32), chance.choice([*bodies, chance.randbytes(chance.randrange(60))]))
        for _ in range(count)
    ]


def read(place: Path) -> list[tuple[bytes, bytes]]:
    data = place.read_bytes()
    return [(key, data[at : at + length]) for key, at, length in records(place)]


def test_what_was_written_is_read_while_it_grows(tmp_path: Path) -> None:
    expected, segment = random_records(30, 1), Segment(tmp_path)
    for end in range(0, 30, 10):
        places = segment.append(expected[end : end + 10], ["{}"])
        data = segment.path.read_bytes()
        assert [data[at : at + len(body)] for at, (_, body) in zip(places, expected[end:], strict=False)] == [
            body for _, body in expected[end : end + 10]
        ]
        assert read(segment.path) == expected[: end + 10]
    segment.close()
    assert segment.log.read_text() == "{}\n" * 3


def test_a_segment_that_was_cut_anywhere_has_the_records_before(tmp_path: Path) -> None:
    expected, place = random_records(12, 2), tmp_path / "seg-cut"
    data = b"".join(record(*entry) for entry in expected)
    ends = [sum(HEAD.size + len(body) for _, body in expected[:n]) for n in range(len(expected) + 1)]
    for cut in range(len(data) + 1):
        place.write_bytes(data[:cut])
        whole = sum(end <= cut for end in ends) - 1
        # A record inside of the body that was cut may be whole, and is read; its key is nobody's.
        assert [entry for entry in read(place) if entry[0] != b"k" * 32] == expected[:whole]


def test_a_changed_byte_costs_one_record(tmp_path: Path) -> None:
    expected, place, chance = random_records(12, 3), tmp_path / "seg-changed", random.Random(3)
    data = b"".join(record(*entry) for entry in expected)
    for _ in range(300):
        at = chance.randrange(len(data))
        changed = bytearray(data)
        changed[at] ^= 1 << chance.randrange(8)
        place.write_bytes(changed)
        remaining = [entry for entry in read(place) if entry[0] != b"k" * 32]
        assert (
            len(remaining) == len(expected) - 1
            and [entry for entry in expected if entry in remaining] == remaining
        )


def test_a_folder_that_is_gone_has_a_message(tmp_path: Path) -> None:
    segment = Segment(tmp_path / "gone")
    with pytest.raises(FileError, match="cannot be written"):
        segment.append(random_records(1, 4))
