"""Tells whether a change of the code changed the bits of any result: hashes of searches, beside the committed table.

    make recorded                              # or: .venv/bin/python tests/recorded/recorded.py [--write] [NAME ...]

Before and after a change that must not change bits. Every method, kernel, gallery model and command of the shell is
searched with, limited by counts, in half a minute of one processor. `searches.json` has a hash of all that each gives:
choices, scores, weights and evidence to the bit, meshes, and files without times, paths and versions.

A hash that differs is named, and ends this with 1. So does a search that was broken off and gone on with and differs
from the one that was left alone. Whoever means to change results writes the table again (`--write`), and the commit
says why. NAME is the beginning of a name: those alone.

Results are the same to the bit on machines with the same fingerprint (`niwaki doctor`, `bits`). On a machine with
another one than the table's, write a table before the change and compare with that (`--table FILE`).
"""

from __future__ import annotations

import argparse
import json
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
TABLE = Path(__file__).with_name("searches.json")
#: Folders with the models and helpers of other tests.
HELPERS = ("agreement", "answers", "niwaki/search", "studio")

if __name__ == "__main__":
    sys.path += [str(ROOT / "tests" / name) for name in HELPERS]

from digests import digest  # noqa: E402
from niwaki import _engine  # noqa: E402
from recorded_searches import RESUMED, of_all  # noqa: E402
from recorded_shell import of_commands  # noqa: E402


def rows() -> dict[str, Callable[[], str]]:
    """The digest of every search and command, by name."""
    found: dict[str, Callable[[], str]] = {
        name: lambda search=search: digest(search()) for name, search in of_all().items()
    }
    return found | dict(of_commands())


def hashes(names: Iterable[str], watch: Callable[[str], Any] = lambda _: None) -> dict[str, str]:
    """The digests of these; of a search that fails, what it says."""
    every, found = rows(), {}
    for name in names:
        watch(name)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                found[name] = every[name]()
            except Exception as error:
                found[name] = f"{type(error).__name__}: {error}".splitlines()[0]
    return found


def differences(now: Mapping[str, str], before: Mapping[str, str]) -> list[str]:
    """A line for each name whose digest is not that of before, or not that of the search that was left alone."""
    said = []
    for name, one in now.items():
        plain = now.get(name.removesuffix(RESUMED), one)
        if one != before.get(name):
            said.append(f"{name}: {before.get(name, 'not in the table')} is now {one}")
        if one != plain:
            said.append(f"{name}: {one}, and {plain} of the search that was not broken off")
    return said


def main(arguments: Sequence[str]) -> int:
    """Search, compare, print, and return 1 where a hash differs."""
    reading = argparse.ArgumentParser(description="Hashes of what searches give, beside the committed table.")
    reading.add_argument(
        "names", nargs="*", metavar="NAME", help="the beginning of a name; all where none is given"
    )
    reading.add_argument("--write", action="store_true", help="write the table again")
    reading.add_argument("--table", type=Path, default=TABLE, metavar="FILE", help="another table")
    reading.add_argument("--times", action="store_true", help="print the processor seconds of each search")
    given = reading.parse_args(arguments)
    names = [name for name in rows() if not given.names or name.startswith(tuple(given.names))]
    if not names:
        reading.error(f"no search begins with {', '.join(given.names)}")
    stored = json.loads(given.table.read_text(encoding="utf-8")) if given.table.exists() else {}
    before: dict[str, str] = stored.get("searches", {})
    machine = _engine.fingerprint()
    if not given.write and stored.get("machine") != machine:
        print(
            f"{given.table} is of machines with other bits: write one before the change (--write --table FILE)"
        )
        return 2
    seconds, found = [time.process_time()], {}
    for name in names:
        found |= hashes([name])
        seconds.append(time.process_time())
        if given.times:
            print(f"{seconds[-1] - seconds[-2]:7.2f}  {name}", flush=True)
    said = differences(found, before)
    if given.write:
        kept = {name: found.get(name) or before[name] for name in rows() if name in found or name in before}
        given.table.write_text(
            json.dumps({"machine": machine, "searches": kept}, indent=1) + "\n", encoding="utf-8"
        )
        said = differences(found, found) + [f"{name}: {one}" for name, one in found.items() if " " in one]
    else:
        said += [f"{name}: in the table alone" for name in before if not given.names and name not in found]
    for line in said:
        print(line, file=sys.stderr)
    print(f"{len(found)} searches, {len(said)} differ; {seconds[-1] - seconds[0]:.0f} s of the processor")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
