"""Where measurements, guides and pictures are kept."""

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from niwaki.methods import Guide

ROOT = Path(__file__).resolve().parents[2]

Row = dict[str, Any]


class Places:
    """A folder of measurements and guides, each made once."""

    def __init__(self, folder: Path, quick: bool) -> None:
        self.folder, self.quick = folder / "quick" if quick else folder, quick
        self.pictures = self.folder if quick else ROOT / "docs/pictures/guides"
        for place in (self.folder, self.pictures):
            place.mkdir(parents=True, exist_ok=True)

    def rows(self) -> list[Row]:
        """All that was measured."""
        stored = []
        for place in sorted(self.folder.glob("*.jsonl")):
            stored += [json.loads(line) for line in place.read_text().splitlines() if line]
        return stored

    def row(self, part: str, key: Mapping[str, Any], measure: Callable[[], Row]) -> Row:
        """Return the measurement under a key; measure it if there is none."""
        place = self.folder / f"{part}.jsonl"
        for row in self.rows():
            if all(row.get(name) == value for name, value in key.items()):
                return row
        row = dict(key) | measure()
        with place.open("a") as lines:
            lines.write(json.dumps(row) + "\n")
        return row

    def guide(self, name: str, train: Callable[[], Guide]) -> Guide:
        """The guide of this name, or the one that is trained."""
        place = self.folder / f"{name}.guide"
        if not place.exists():
            train().save(place)
        return Guide.load(place)

    def has(self, name: str) -> bool:
        """Whether there is a guide of this name."""
        return (self.folder / f"{name}.guide").exists()
