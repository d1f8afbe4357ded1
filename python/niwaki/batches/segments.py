"""Segments: files of records that only grow. One writer has one segment, and never writes to another's.

A record is a head and a body. The head has four bytes that mark a record, the key (32 bytes), the length of the body
and the CRC-32 of the key and the body (both big-endian, 32 bits). A record that a kill or a full disk left unfinished
is no record: readers look for the next mark after it. So a segment is read while another process writes it, and nothing
has to be repaired.
"""

from __future__ import annotations

import mmap
import os
import secrets
import struct
import time
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from niwaki.errors.files import sync_folder, unwritable
from niwaki.inputs import regular

#: What a record begins with.
MARK = b"nwk\x01"

#: Mark, key, length of the body, CRC-32.
HEAD = struct.Struct(">4s32sII")

#: How the names of segments begin, and of the logs beside them.
SEGMENT, LOG = "seg-", "log-"

#: Seconds between two times at which a segment is brought to the disk.
SYNC = 1.0


def record(key: bytes, body: bytes) -> bytes:
    """The bytes of one record."""
    return HEAD.pack(MARK, key, len(body), _crc(key, body)) + body


def records(place: Path) -> Iterator[tuple[bytes, int, int]]:
    """The whole records of a segment, in its order: key, place of the body and its length, bytes.

    Raises
    ------
    FileError
        The segment cannot be read.
    """
    with regular(place).open("rb") as file:
        if os.fstat(file.fileno()).st_size == 0:
            return
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            at, end = data.find(MARK), len(data)
            while 0 <= at <= end - HEAD.size:
                _, key, length, crc = HEAD.unpack_from(data, at)
                body = at + HEAD.size
                if body + length <= end and _crc(key, data[body : body + length]) == crc:
                    yield key, body, length
                    at = body + length
                    if data[at : at + len(MARK)] == MARK:
                        continue
                else:
                    at += 1
                at = data.find(MARK, at)


def _crc(key: bytes, body: bytes) -> int:
    return zlib.crc32(body, zlib.crc32(key))


class Segment:
    """A segment of one's own, and its log; both are made with the first record.

    Parameters
    ----------
    folder
        Where.
    """

    def __init__(self, folder: Path) -> None:
        name = secrets.token_hex(8)
        self.path, self.log = folder / f"{SEGMENT}{name}", folder / f"{LOG}{name}.jsonl"
        self._numbers: tuple[int, int] | None = None
        self._length, self._synced = 0, 0.0

    def append(self, found: Iterable[tuple[bytes, bytes]], lines: Iterable[str] = ()) -> list[int]:
        """Add records, and lines to the log; the places of the bodies.

        Raises
        ------
        FileError
            The folder cannot be written to, or the disk is full.
        """
        whole, places = bytearray(), []
        for key, body in found:
            places.append(self._length + len(whole) + HEAD.size)
            whole += record(key, body)
        try:
            if self._numbers is None:
                self._numbers = _created(self.path), _created(self.log)
                sync_folder(self.path.parent)
            _write(self._numbers[0], bytes(whole))
            _write(self._numbers[1], "".join(f"{line}\n" for line in lines).encode())
            self._length += len(whole)
            if time.monotonic() - self._synced >= SYNC:
                os.fsync(self._numbers[0])
                self._synced = time.monotonic()
        except OSError as error:
            raise unwritable(self.path, error) from error
        return places

    def close(self) -> None:
        """Bring all of it to the disk."""
        numbers, self._numbers = self._numbers, None
        for number in numbers or ():
            try:
                os.fsync(number)
            finally:
                os.close(number)


def _created(place: Path) -> int:
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND | getattr(os, "O_BINARY", 0)
    return os.open(place, flags, 0o666)


def _write(number: int, data: bytes) -> None:
    left = memoryview(data)
    while left:
        left = left[os.write(number, left) :]
