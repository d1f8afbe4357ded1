"""Segments: files of records that only grow. Each writer has a segment of its own.

A record is a head and a body. The head has four bytes that mark a record, the key (32 bytes), the length of the body
and the CRC-32 of the key and the body (both big-endian, 32 bits). Readers skip a record that a kill or a full disk left
incomplete, and continue at the next mark. So a segment can be read while another process writes it, and needs no
repair.
"""

from __future__ import annotations

import mmap
import os
import secrets
import struct
import time
import zlib
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from pathlib import Path

from niwaki.errors.files import sync_folder, unreadable, unwritable, write_all
from niwaki.inputs import regular

#: The first bytes of a record.
MARK = b"nwk\x01"

#: Mark, key, length of the body, CRC-32.
HEAD = struct.Struct(">4s32sII")

#: Prefixes of the names of segments and of the logs beside them.
SEGMENT, LOG = "seg-", "log-"

#: Seconds between two calls of fsync for a segment.
SYNC = 1.0


def record(key: bytes, body: bytes) -> bytes:
    """Return the bytes of a record."""
    return HEAD.pack(MARK, key, len(body), _crc(key, body)) + body


def records(place: Path) -> Iterator[tuple[bytes, int, int]]:
    """Yield the complete records of a segment in order: the key, and place and length of the body in bytes.

    Raises
    ------
    FileError
        The segment cannot be read.
    """
    with unreadable(place, "a segment"), regular(place).open("rb") as file:
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
    """A segment of one writer, with its log; both files are created with the first record.

    Parameters
    ----------
    folder
        The folder of both files.
    """

    def __init__(self, folder: Path) -> None:
        name = secrets.token_hex(8)
        self.path, self.log = folder / f"{SEGMENT}{name}", folder / f"{LOG}{name}.jsonl"
        self._numbers: list[int] = []
        self._synced = 0.0

    def append(self, entries: Iterable[tuple[bytes, bytes]], lines: Iterable[str] = ()) -> list[int]:
        """Add records, and lines to the log; return the places of the bodies.

        Raises
        ------
        FileError
            The folder cannot be written to, or the disk is full.
        """
        whole, places = bytearray(), []
        try:
            for place in (self.path, self.log)[len(self._numbers) :]:
                self._numbers.append(_create(place))
                sync_folder(self.path.parent)
            # The true end of the file, also after a write that failed half-way.
            end = os.lseek(self._numbers[0], 0, os.SEEK_END)
            for key, body in entries:
                places.append(end + len(whole) + HEAD.size)
                whole += record(key, body)
            write_all(self._numbers[0], bytes(whole))
            write_all(self._numbers[1], "".join(f"{line}\n" for line in lines).encode())
            if time.monotonic() - self._synced >= SYNC:
                os.fsync(self._numbers[0])
                self._synced = time.monotonic()
        except OSError as error:
            raise unwritable(self.path, error) from error
        return places

    def close(self) -> None:
        """Flush both files to the disk, and close them.

        Raises
        ------
        FileError
            The disk refuses the data.
        """
        numbers, self._numbers = self._numbers, []
        with ExitStack() as stack:
            for number in numbers:
                stack.callback(os.close, number)
            try:
                for number in numbers:
                    os.fsync(number)
            except OSError as error:
                raise unwritable(self.path, error) from error


def _create(place: Path) -> int:
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND | getattr(os, "O_BINARY", 0)
    return os.open(place, flags, 0o666)
