"""Generators for tests of `nw.fit`: blocks of plain arrays, and functions that fail in every way."""

from __future__ import annotations

import hashlib
import os
import signal
import time
from pathlib import Path

import numpy as np
from niwaki.words.distributions import Bernoulli, DiscreteUniform, Uniform

#: The widths of the calls of `restless` in this process.
CALLS: list[float] = []

CORNERS = np.array(
    [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4]]
    + [[1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
)


def block(width, height, depth, y=0.0):
    """A box on the height `y`, as vertices and faces."""
    x, z, v = width / 2, depth / 2, y + height
    rows = [(-x, y, -z), (x, y, -z), (x, v, -z), (-x, v, -z), (-x, y, z), (x, y, z), (x, v, z), (-x, v, z)]
    return np.array(rows), CORNERS


def tower(width=Uniform(0.5, 2.0), floors=DiscreteUniform(1, 4), lid=Bernoulli(0.5)):
    parts = [block(width * 0.8**number, 0.5, 1.0, 0.5 * number) for number in range(floors)]
    return [*parts, block(0.4, 0.3, 0.4, 0.5 * floors)] if lid else parts


def share(*values):
    """A number from 0 to 99 that the parameters decide."""
    return int.from_bytes(hashlib.sha256(repr(values).encode()).digest()[:4], "big") % 100


def hostile(width=Uniform(0.5, 2.0), floors=DiscreteUniform(1, 4), lid=Bernoulli(0.5)):
    """Raises in 20 % of calls, hangs in 5 %, and crashes in 2 %."""
    fate = share(width, floors, lid)
    if fate < 20:
        raise RuntimeError("the shape would tear")
    if fate < 25:
        while True:
            time.sleep(60.0)
    if fate < 27:
        os.kill(os.getpid(), signal.SIGSEGV)
    return tower(width, floors, lid)


def deadly(width=Uniform(0.5, 2.0), floors=DiscreteUniform(1, 4), lid=Bernoulli(0.5)):
    """Kills the program that asked for it at some of its calls, which a file counts."""
    counter = Path(os.environ["FIT_COUNTER"])
    with counter.open("ab") as file:
        file.write(b".")
    if counter.stat().st_size in (5, 13, 18):
        os.kill(os.getppid(), signal.SIGKILL)
    return tower(width, floors, lid)


def broken(width=Uniform(0.5, 2.0)):
    raise ValueError("never")


def restless(width=Uniform(0.5, 2.0)):
    CALLS.append(width)
    return block(width / len(CALLS), 1.0, 1.0)


def by_run(d):
    floors = d.whole("floors", 0, 4)
    width = d.real("width", 0.5, 2.0)
    parts = [block(width, 0.5, 1.0, 0.5 * number) for number in range(floors)]
    if d.switch("lid"):
        size = d.real("size", 0.2, 0.6)
        parts.append(block(size, 0.3, size, 0.5 * floors))
    kind = d.choice("kind", ["plain", "stepped"])
    if kind == "stepped":
        parts.append(block(width + d.real("step", 0.1, 0.5), 0.2, 1.0))
    return parts
