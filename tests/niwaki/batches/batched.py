"""Small models and searches of the tests of batches; and a batch for a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import niwaki as nw
from niwaki import batches, box, condition, emit, factor, flip, gaussian, host, model, uniform


@model
def pile(y=0.0, width=2.0):
    height = uniform(0.5, 1.5)
    emit(box((0, y + height / 2, 0), (width, height, width)))
    factor(-abs(y + height - 3.0))
    if flip(0.6):
        pile(y + height, width * uniform(0.6, 1.0))


@model
def often_impossible():
    condition(flip(0.5))
    return 1


@model
def bump():
    x = gaussian(0.0, 1.0)
    factor(-((x - 1.0) ** 2))
    return x


#: Beyond this a value is deadly.
LIMIT = 0.65


@host
def slow(value: float) -> float:
    """Takes the milliseconds that the environment names."""
    time.sleep(float(os.environ.get("SLOW", "0")) / 1000.0)
    return value


@host
def deadly(value: float) -> float:
    """Ends the process for some values, where the environment says so."""
    if value > LIMIT and "DEADLY" in os.environ:
        os._exit(7)
    return value


@host
def starting(value: float) -> float:
    """Starts a process that goes on for long, and forks one that comes back; both leave their number in a folder."""
    folder = Path(os.environ["STARTED"])
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    (folder / str(child.pid)).touch()
    if os.fork() == 0:
        (folder / str(os.getpid())).touch()
    return slow(value)


@model
def prolific():
    factor(starting(uniform(0.0, 1.0)))


@model
def waiting():
    x = uniform(0.0, 1.0)
    factor(slow(x))
    return x


@model
def dangerous():
    x = uniform(0.0, 1.0)
    factor(deadly(x))
    return x


#: Searches of the two kinds of piles.
PILES = [nw.Search(pile, (0.0, width), method=nw.smc(20), keep="best") for width in (1.0, 2.0)]
#: How many results they have in most tests, and by how many seeds.
SEEDS, COUNT = 30, 60

#: So long searches wait that are killed.
WAITING = nw.Search(waiting, method=nw.importance(1))
#: Searches that leave processes behind.
PROLIFIC = nw.Search(prolific, method=nw.importance(1))


def whole(folder: Path) -> str:
    """The hash of all results in a folder."""
    return batches.Store(folder).hash()


def main(folder: str, seeds: str = "200", search: nw.Search = WAITING) -> None:
    """Search in the folder, by two processes, in chunks of a tenth of a second; print the hash."""
    outcomes: Any = list(nw.batch(search, seeds=int(seeds), folder=folder, processes=2, chunk=0.1))
    print(len(outcomes), whole(Path(folder)))


def on_cluster(engine: str, folder: str, seeds: str) -> None:
    """Run the batch on a cluster of this machine."""
    with batches.clusters.ENGINES[engine](2) as executor:
        outcomes = list(
            nw.batch(WAITING, seeds=int(seeds), folder=folder, executor=executor, processes=2, chunk=0.1)
        )
    print(len(outcomes), whole(Path(folder)))
