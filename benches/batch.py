"""Claim: a batch that is killed ten times has the bytes of one left alone, and costs little beyond its searches.

Input: `SHIPS` ships of the gallery by 50 particles, on two processes. The judge of the bytes is one thread. CPU seconds
are those of all processes (`getrusage`), of which those of the searches are in the log; what starting costs is measured
by a batch of four ships and subtracted. Run by `make bench-batch`.
"""

from __future__ import annotations

import json
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import niwaki as nw
from niwaki import batches, gallery

SHIPS, KILLS, SEED = 1000, 10, 1


def ships(count: int, folder: Path, **options: Any) -> str:
    """The hash of a batch of ships."""
    entry = gallery.entry("spaceship")
    assert entry is not None
    for _ in nw.batch(
        entry.model, entry.target(), seeds=count, particles=50, voxel=0.5, folder=folder, **options
    ):
        pass
    return batches.Store(folder).hash()


def started(count: int, folder: Path, chunk: float) -> subprocess.Popen[str]:
    words = [sys.executable, __file__, str(count), str(folder), str(chunk)]
    return subprocess.Popen(words, stdout=subprocess.PIPE, text=True)


def searched(folder: Path) -> float:
    """CPU seconds of the searches, by the logs."""
    lines = [line for log in folder.glob("*/log-*") for line in log.read_text().splitlines()]
    return sum(json.loads(line).get("cpu_seconds", 0.0) for line in lines)


def cost(count: int, folder: Path, chunk: float) -> tuple[float, float]:
    """CPU seconds of a batch in processes of its own, and of its searches."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with started(count, folder, chunk) as child:
        child.communicate()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, searched(folder)


def killed(folder: Path) -> tuple[str, list[int]]:
    """The hash of a batch that is killed at random moments after new results, and how many there were each time."""
    chance, there = random.Random(SEED), [0]
    while True:
        with started(SHIPS, folder, 0.5) as child:
            while len(there) <= KILLS and child.poll() is None and known(folder) <= there[-1]:
                time.sleep(0.05)
            try:
                output, _ = child.communicate(
                    timeout=chance.uniform(0.0, 0.5) if len(there) <= KILLS else None
                )
                return output.strip(), there[1:]
            except subprocess.TimeoutExpired:
                child.send_signal(signal.SIGKILL)
                child.communicate()
                there.append(known(folder))


def known(folder: Path) -> int:
    """How many results there are."""
    return len(batches.Store(folder)) if batches.is_batch(folder) else 0


def main() -> None:
    with tempfile.TemporaryDirectory() as place:
        root, start = Path(place), time.perf_counter()
        with ThreadPoolExecutor(1) as thread:
            expected = ships(SHIPS, root / "alone", executor=thread)
        print(f"{SHIPS} ships in one thread: {time.perf_counter() - start:.1f} s, hash {expected[:16]}")
        after_kills, kills = killed(root / "killed")
        verdict = "equal" if after_kills == expected else "ANOTHER"
        print(f"killed {len(kills)} times, with {kills} ships: hash {after_kills[:16]}, {verdict}")
        empty = cost(4, root / "few", 1.0)
        for chunk in (0.1, 1.0):
            whole, searching = cost(SHIPS, root / f"cost-{chunk}", chunk)
            beyond = (whole - searching) - (empty[0] - empty[1])
            print(
                f"chunks of {chunk:g} s: {whole:.1f} CPU s, searches {searching:.1f}, "
                f"starting {empty[0] - empty[1]:.1f}, beyond them {beyond:.2f} s, {100 * beyond / searching:.1f} %"
            )


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(ships(int(sys.argv[1]), Path(sys.argv[2]), processes=2, chunk=float(sys.argv[3])))
    else:
        main()
