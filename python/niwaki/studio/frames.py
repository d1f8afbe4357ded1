"""Frames: a header of JSON and bytes in one message.

    u32 length of the header | header, padded with spaces to a multiple of 4 | payload

All numbers are little-endian. A worker's pipe carries frames as well, each after a u64 with its length.
"""

from __future__ import annotations

import struct

HEAD = struct.Struct("<I")
LENGTH = struct.Struct("<Q")
#: The longest message that a pipe may carry, bytes.
LONGEST = 1 << 30


def frame(header: bytes, payload: bytes = b"") -> bytes:
    """Pack a frame."""
    padded = header + b" " * (-len(header) % 4)
    return HEAD.pack(len(padded)) + padded + payload


def unpack(data: bytes) -> tuple[bytes, memoryview]:
    """Unpack the header and the payload of a frame.

    Raises
    ------
    ValueError
        The frame is shorter than its header announces.
    """
    if len(data) < HEAD.size:
        raise ValueError("the frame has no header")
    (length,) = HEAD.unpack_from(data)
    if HEAD.size + length > len(data):
        raise ValueError("the frame is cut short")
    return data[HEAD.size : HEAD.size + length], memoryview(data)[HEAD.size + length :]
