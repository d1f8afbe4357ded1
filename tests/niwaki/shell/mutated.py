"""JSON with one thing changed: a value, a name, a list, or the text itself; and what reading it ends in."""

from __future__ import annotations

import copy
import json
import random
import sys
import time
import traceback
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from niwaki.errors import NiwakiError

#: The most that a file may take: seconds of the processor, and bytes by which the memory of the process grows.
SECONDS, MEMORY = 5.0, 10**9

#: What stands where something else was expected.
HOSTILE: list[Any] = [
    None, True, False, 0, 1, -1, 2, 7, 255, -(2**31), 2**31, 2**63 - 1, 2**63, 2**64, 10**30, -(10**30), 0.0, -0.0, 0.5,
    -1.5, 1e308, -1e308, 5e-324, "", "a", "nan", "-inf", "x" * 5000, "\0", "../../etc", "\u00e9\u4e2d", "(module",
    [], [[]], [None], [0, "a"], [1] * 50, [[[[[]]]]], {}, {"": None}, {"real": "nan"}, {"real": "inf"},
    {"real": []}, {"vec": []}, {"vec": [1.0, 2.0, "a"]}, {"tuple": [1]}, {"list": {}},
    {"dict": [[{"list": []}, 1]]}, {"range": [0, 10, 0]},
    {"host": {"module": "os", "name": "system", "sha256": ""}}, {"host": 1}, {"shape": "box"}, {"array": "O"},
    {"array": "<f8", "shape": [10**9, 10**9], "bytes": ""}, {"array": "<f8", "shape": [-1], "bytes": "00"},
    {"dist": "Distribution", "parameters": []}, {"dist": "Uniform", "parameters": [1.0]}, {"target": "a", "file": "/"},
    {"record": {"name": "def", "fields": [], "kind": ""}, "fields": {}}, {"camera": {"kind": []}}, {"guide": "zz"},
]  # fmt: skip


def places(data: Any) -> list[tuple[Any, Any]]:
    """Every table or list with each of its keys."""
    pairs: list[tuple[Any, Any]] = []
    waiting = [data]
    while waiting:
        node = waiting.pop()
        keys = list(node) if isinstance(node, dict) else range(len(node)) if isinstance(node, list) else ()
        pairs += [(node, key) for key in keys]
        waiting += [node[key] for key in keys]
    return pairs


def mutated(data: Any, chance: random.Random) -> tuple[str, bytes]:
    """Return a name of the change, and the JSON after it."""
    data = copy.deepcopy(data)
    known = places(data)
    # Deep lists of numbers are most of the places, and alike: prefer those near the root.
    node, key = min(chance.sample(known, min(2, len(known))), key=lambda place: len(str(place[0])) < 40)
    change = chance.choice(["value"] * 6 + ["swap", "gone", "name", "twice", "text"])
    if change == "value":
        node[key] = chance.choice(HOSTILE)
    elif change == "swap":
        other, there = chance.choice(known)
        node[key] = copy.deepcopy(other[there])
    elif change == "gone":
        del node[key]
    elif change == "name" and isinstance(node, dict):
        node[chance.choice(["", "x", "format", "real", "settings"])] = node.pop(key)
    elif change == "twice" and isinstance(node, list):
        node.extend(copy.deepcopy(node))
    text = bytearray(json.dumps(data).encode())
    if change == "text":
        for _ in range(chance.randint(1, 3)):
            at = chance.randrange(len(text))
            text[at : at + chance.randint(0, 8)] = bytes(
                chance.choices(b'[]{}",:0e-9\\u\xff', k=chance.randint(0, 4))
            )
        text = text[: chance.randint(0, len(text))] if chance.random() < 0.3 else text
    return f"{change} at {key!r}", bytes(text)


def tracebacks(tries: Iterable[tuple[str, bytes]], read: Callable[[Path], object], place: Path) -> list[str]:
    """Return the errors of reading that are not messages; also what took long, or much memory."""
    errors = []
    for change, text in tries:
        place.write_bytes(text)
        start, before = time.process_time(), peak()
        try:
            read(place)
        except NiwakiError as error:
            str(error)
        except BaseException as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            errors.append(f"{change}: {type(error).__name__}: {error} ({last.filename}:{last.lineno})")
        if time.process_time() - start > SECONDS:
            errors.append(f"{change}: {time.process_time() - start:.1f} s")
        if peak() - before > MEMORY:
            errors.append(f"{change}: {(peak() - before) / 1e6:.0f} MB")
    return errors


def peak() -> int:
    """The most memory that this process has had, bytes; 0 where the system does not say."""
    try:
        import resource
    except ImportError:
        return 0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
