"""Files of JSON lines that are only added to: a bench that was stopped goes on from what it has."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any


class Lines:
    """The rows of a file.

    Parameters
    ----------
    path
        Created with its first row, in a folder that is created where it is missing.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.rows: list[dict[str, Any]] = []
        if path.exists():
            text = path.read_text()
            # A line that was cut short by a stop is measured again.
            whole = text[: text.rfind("\n") + 1]
            if whole != text:
                path.write_text(whole)
            self.rows = [json.loads(line) for line in whole.splitlines()]

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return iter(self.rows)

    def add(self, row: dict[str, Any]) -> None:
        """Write a row."""
        self.rows.append(row)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a") as lines:
            lines.write(json.dumps(row) + "\n")
