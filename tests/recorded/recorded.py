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
import os
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

# As in the package's tests, searches without rounds are short.
os.environ.setdefault("NIWAKI_ROUNDS", "15")

if __name__ == "__main__":
    sys.path += [str(ROOT / "tests" / name) for name in HELPERS]

from digests import digest  # noqa: E402
from niwaki import _engine  # noqa: E402
from recorded_searches import RESUMED, of_all  # noqa: E402
from recorded_shell import of_commands  # noqa: E402


def rows() -> dict[str, Callable[[], str]]:
    """The digest of every search and command, by name."""
    table: dict[str, Callable[[], str]] = {
        name: lambda search=search: digest(search()) for name, search in of_all().items()
    }
    return table | dict(of_commands())


def hashes(names: Iterable[str], watch: Callable[[str], Any] = lambda _: None) -> dict[str, str]:
    """The digests of these; of a search that fails, what it says."""
    every, digests = rows(), {}
    for name in names:
        watch(name)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                digests[name] = every[name]()
            except Exception as error:
                digests[name] = f"{type(error).__name__}: {error}".splitlines()[0]
    return digests


def differences(now: Mapping[str, str], before: Mapping[str, str]) -> list[str]:
    """A line for each name whose digest is not that of before, or not that of the search that was left alone."""
    lines = []
    for name, digest_now in now.items():
        plain = now.get(name.removesuffix(RESUMED), digest_now)
        if digest_now != before.get(name):
            lines.append(f"{name}: {before.get(name, 'not in the table')} is now {digest_now}")
        if digest_now != plain:
            lines.append(f"{name}: {digest_now}, and {plain} of the search that was not broken off")
    return lines


def main(arguments: Sequence[str]) -> int:
    """Search, compare, print, and return 1 where a hash differs."""
    reading = argparse.ArgumentParser(description="Hashes of what searches give, beside the committed table.")
    reading.add_argument(
        "names", nargs="*", metavar="NAME", help="the beginning of a name; all where none is given"
    )
    reading.add_argument("--write", action="store_true", help="write the table again")
    reading.add_argument("--table", type=Path, default=TABLE, metavar="FILE", help="another table")
    reading.add_argument("--times", action="store_true", help="print the processor seconds of each search")
    options = reading.parse_args(arguments)
    names = [name for name in rows() if not options.names or name.startswith(tuple(options.names))]
    if not names:
        reading.error(f"no search begins with {', '.join(options.names)}")
    stored = json.loads(options.table.read_text(encoding="utf-8")) if options.table.exists() else {}
    before: dict[str, str] = stored.get("searches", {})
    machine = _engine.fingerprint()
    if not options.write and stored.get("machine") != machine:
        print(
            f"{options.table} is of machines with other bits: write one before the change (--write --table FILE)"
        )
        return 2
    seconds, digests = [time.process_time()], {}
    for name in names:
        digests |= hashes([name])
        seconds.append(time.process_time())
        if options.times:
            print(f"{seconds[-1] - seconds[-2]:7.2f}  {name}", flush=True)
    lines = differences(digests, before)
    if options.write:
        kept = {
            name: digests.get(name) or before[name] for name in rows() if name in digests or name in before
        }
        options.table.write_text(
            json.dumps({"machine": machine, "searches": kept}, indent=1) + "\n", encoding="utf-8"
        )
        lines = differences(digests, digests) + [
            f"{name}: {digest_text}" for name, digest_text in digests.items() if " " in digest_text
        ]
    else:
        lines += [
            f"{name}: in the table alone" for name in before if not options.names and name not in digests
        ]
    for line in lines:
        print(line, file=sys.stderr)
    print(f"{len(digests)} searches, {len(lines)} differ; {seconds[-1] - seconds[0]:.0f} s of the processor")
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
