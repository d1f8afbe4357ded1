"""The files between runs: a file of draws for each chain, and a line for each draw that was judged.

    KIND-SAMPLER-CHAIN.json   addresses, values (draws, choices), seconds, gradients
    KIND-SAMPLER.jsonl        chain, draw, and the judges' results

A stopped run continues where it was: a chain that has a file is not drawn again, a draw that has a line is not
judged again.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from lines import Lines


@dataclass(frozen=True)
class Drawn:
    """The draws of a chain.

    `values` is (draws, choices). `warmup_seconds` and `seconds` are CPU seconds, `gradients` counts evaluations after
    the warm-up, `acceptance` is their mean, `settings` are those of the sampler.
    """

    addresses: list[str]
    values: Any
    start_seconds: float
    warmup_seconds: float
    seconds: float
    gradients: int
    acceptance: float
    divergences: int
    settings: str

    def choices(self, draw: int) -> dict[str, float]:
        return dict(zip(self.addresses, map(float, self.values[draw]), strict=True))

    def save(self, path: Path) -> None:
        whole = asdict(self) | {"values": [[float(f"{x:.12g}") for x in row] for row in self.values]}
        part = path.with_suffix(".part")
        part.write_text(json.dumps(whole))
        part.replace(path)

    @classmethod
    def load(cls, path: Path) -> Drawn:
        fields = json.loads(path.read_text())
        fields["values"] = np.array(fields["values"])
        return cls(**fields)


def chain_file(folder: Path, kind: str, sampler: str, chain: int) -> Path:
    return folder / f"{kind}-{sampler}-{chain}.json"


def chains(folder: Path, kind: str, sampler: str) -> list[Drawn]:
    """The chains that there are."""
    records = []
    while (path := chain_file(folder, kind, sampler, len(records))).exists():
        records.append(Drawn.load(path))
    return records


class Verdicts(Lines):
    """Lines of judged draws."""

    def __init__(self, folder: Path, kind: str, sampler: str) -> None:
        super().__init__(folder / f"{kind}-{sampler}.jsonl")

    def has(self, chain: int, draw: int) -> bool:
        return any(row["chain"] == chain and row["draw"] == draw for row in self.rows)
