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


def corners(kind: Kind, found: list[Drawn]) -> Any:
    """Corners of all draws, (chains, draws, numbers)."""
    least = min(len(chain.values) for chain in found)
    return np.array([[corners_of(kind, chain.choices(draw)) for draw in range(least)] for chain in found])


def corners_of(kind: Kind, choices: dict[str, float]) -> Any:
    made: Any = nw.run(kind.model, width=kind.width, choices=choices).best.value
    return np.array([[list(point) for point in block] for block in made.blocks]).reshape(-1)


def summary(kind: Kind, sampler: str, folder: Path) -> dict[str, Any] | None:
    """One row; None where nothing was judged."""
    rows = list(Verdicts(folder, kind.name, sampler))
    found = chains(folder, kind.name, sampler)
    if not rows or not found:
        return None
    failed = [one for one in rows if not passes(one)]
    margins = [one["margin"] for one in rows if "margin" in one]
    sizes = [one["litres"] for one in rows if "litres" in one]
    return {
        "model": kind.name,
        "sampler": sampler,
        "width": kind.width,
        "choices": len(found[0].addresses),
        "draws": len(rows),
        "chains": len(found),
        "effective": effective(corners(kind, found)),
        "holds": sum(one.get("holds", False) for one in rows),
        "stands": sum(one.get("stands", False) for one in rows),
        "refused": sum("refused" in one for one in rows),
        "failed": len(failed),
        "mended": sum(passes(one.get("polished", {})) for one in failed),
        "margin": float(np.median(margins)) if margins else None,
        "litres": float(np.median(sizes)) if sizes else None,
        "start_seconds": sum(one.start_seconds for one in found),
        "warmup_seconds": sum(one.warmup_seconds for one in found),
        "seconds": sum(one.seconds for one in found),
        "gradients": sum(one.gradients for one in found),
        "acceptance": float(np.mean([one.acceptance for one in found])),
    }


def line(one: dict[str, Any]) -> str:
    """A row of the table."""
    margin = "" if one["margin"] is None else f"{100 * one['margin']:.1f} %"
    litres = "" if one["litres"] is None else f"{one['litres']:.3g}"
    mended = f"{one['mended']} of {one['failed']}" if one["failed"] else ""
    return (
        f"| `{one['model']}` | {one['sampler']} | {one['width']:g} | {one['draws']} "
        f"| {one['effective']:.0f} | {one['holds']} | {one['stands']} | {mended} | {margin} | {litres} "
        f"| {one['seconds']:.0f} | {one['gradients']} |"
    )


def table(folder: Path, samplers: tuple[str, ...]) -> str:
    """All rows that there are."""
    found = [summary(kind, sampler, folder) for sampler in samplers for kind in KINDS.values()]
    return "\n".join([*HEAD, *(line(one) for one in found if one)])
