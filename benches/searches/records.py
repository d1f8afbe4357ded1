"""The file of records: a JSON line for each search, and for each size that a pilot found; lines are only added.

A line has the version of what ran: a hash of the package, the engine and the problems, and the commit for people. A
search with the same version, problem, method and seed is not done again.
"""

from __future__ import annotations

import hashlib
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

import niwaki
from lines import Lines
from niwaki import _engine

from searches.methods import Method

HERE = Path(__file__).parent
#: The files here that decide no search by themselves: a record has its method's settings.
NOT_HASHED = ("complete.py", "methods.py", "records.py", "sheets.py", "table.py")


@cache
def version() -> str:
    """A hash of the package, its engine and the problems, 12 hexadecimal digits."""
    package, hashed = Path(niwaki.__file__).parent, hashlib.sha256()
    hashed_files = [path for path in sorted(HERE.glob("*.py")) if path.name not in NOT_HASHED]
    for path in [*sorted(package.rglob("*.py")), Path(_engine.__file__), *hashed_files]:
        hashed.update(path.name.encode() + path.read_bytes())
    return hashed.hexdigest()[:12]


@cache
def commit() -> str:
    """The commit, with `-dirty` where files differ from it; empty outside of a repository."""
    command = ["git", "-C", str(HERE), "describe", "--always", "--dirty", "--abbrev=12"]
    process = subprocess.run(command, capture_output=True, text=True)
    return process.stdout.strip()


class Records(Lines):
    """The lines of a bench, with the version that each is of."""

    def add(self, row: dict[str, Any]) -> None:
        """Write a line of this version."""
        super().add(row | {"version": version(), "commit": commit()})

    def searches(self, of: str | None = None, times: float = 1.0) -> list[dict[str, Any]]:
        """The searches of a version, with so many times the default's CPU seconds.

        Of this version, or the newest whose hash or commit begins with `of`.
        """
        version_wanted = version()
        if of is not None:
            named = [row["version"] for row in self.rows if is_of(row, of)]
            if not named:
                raise SystemExit(f"{self.path}: no record of {of}; there are {', '.join(self.versions())}")
            version_wanted = named[-1]
        return [
            row
            for row in self.rows
            if (row["version"], row["times"]) == (version_wanted, times) and "seed" in row
        ]

    def has(self, method: Method, problem: str, seed: int, times: float = 1.0) -> bool:
        """Whether this version has searched with these settings and CPU seconds."""
        return any(
            (row["problem"], row["method"], row["seed"]) == (problem, method.name, seed)
            and row["settings"] == method.text(row["size"])
            for row in self.searches(times=times)
        )

    def size(self, problem: str, method: Method, times: float = 1.0) -> dict[str, Any] | None:
        """The size that this version has found for a method on a problem, and the CPU seconds of the pilot."""
        for row in reversed(self.rows):
            known = (row["version"], row["problem"], row["method"], row["times"])
            if (
                known == (version(), problem, method.name, times)
                and "seed" not in row
                and row["settings"] == method.text(row["size"])
            ):
                return row
        return None

    def versions(self) -> list[str]:
        """Hash and commit of each version, oldest first."""
        return list(dict.fromkeys(f"{row['version']} ({row['commit']})" for row in self.rows))


def is_of(row: dict[str, Any], name: str) -> bool:
    """Whether a record's hash or commit begins so."""
    return str(row["version"]).startswith(name) or str(row["commit"]).startswith(name)
