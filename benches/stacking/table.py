"""The rows of the manual's table, from the files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np

from stacking.effective import effective
from stacking.files import Drawn, Verdicts, chains
from stacking.judging import passes
from stacking.kinds import KINDS, Kind

HEAD = (
    "| model | sampler | width | draws | effective | balance | stand | polished | margin | litres | CPU s "
    "| gradients |",
    "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
)


def corners(kind: Kind, records: list[Drawn]) -> Any:
    """Corners of all draws, (chains, draws, numbers)."""
    least = min(len(chain.values) for chain in records)
    return np.array([[corners_of(kind, chain.choices(draw)) for draw in range(least)] for chain in records])


def corners_of(kind: Kind, choices: dict[str, float]) -> Any:
    stack: Any = nw.run(kind.model, width=kind.width, choices=choices).best.value
    return np.array([[list(point) for point in block] for block in stack.blocks]).reshape(-1)


def summary(kind: Kind, sampler: str, folder: Path) -> dict[str, Any] | None:
    """One row; None where nothing was judged."""
    rows = list(Verdicts(folder, kind.name, sampler))
    records = chains(folder, kind.name, sampler)
    if not rows or not records:
        return None
    failed = [row for row in rows if not passes(row)]
    margins = [row["margin"] for row in rows if "margin" in row]
    sizes = [row["litres"] for row in rows if "litres" in row]
    return {
        "model": kind.name,
        "sampler": sampler,
        "width": kind.width,
        "choices": len(records[0].addresses),
        "draws": len(rows),
        "chains": len(records),
        "effective": effective(corners(kind, records)),
        "holds": sum(row.get("holds", False) for row in rows),
        "stands": sum(row.get("stands", False) for row in rows),
        "refused": sum("refused" in row for row in rows),
        "failed": len(failed),
        "mended": sum(passes(row.get("polished", {})) for row in failed),
        "margin": float(np.median(margins)) if margins else None,
        "litres": float(np.median(sizes)) if sizes else None,
        "start_seconds": sum(chain.start_seconds for chain in records),
        "warmup_seconds": sum(chain.warmup_seconds for chain in records),
        "seconds": sum(chain.seconds for chain in records),
        "gradients": sum(chain.gradients for chain in records),
        "acceptance": float(np.mean([chain.acceptance for chain in records])),
    }


def line(row: dict[str, Any]) -> str:
    """A row of the table."""
    margin = "" if row["margin"] is None else f"{100 * row['margin']:.1f} %"
    litres = "" if row["litres"] is None else f"{row['litres']:.3g}"
    mended = f"{row['mended']} of {row['failed']}" if row["failed"] else ""
    return (
        f"| `{row['model']}` | {row['sampler']} | {row['width']:g} | {row['draws']} "
        f"| {row['effective']:.0f} | {row['holds']} | {row['stands']} | {mended} | {margin} | {litres} "
        f"| {row['seconds']:.0f} | {row['gradients']} |"
    )


def table(folder: Path, samplers: tuple[str, ...]) -> str:
    """All rows that there are."""
    rows = [summary(kind, sampler, folder) for sampler in samplers for kind in KINDS.values()]
    return "\n".join([*HEAD, *(line(row) for row in rows if row)])
