"""Two judges of each draw: the linear program and the simulation, with the same settings for every kind."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import niwaki as nw
import numpy as np
from niwaki import stacks

from stacking.files import Drawn, Verdicts, chains
from stacking.kinds import Kind

#: The margin takes eight programs: it is looked for in every so many draws.
MARGINS = 5
#: Columns of a row that a polish has of its own.
JUDGED = ("refused", "residual", "moved", "block")


def judge(kind: Kind, sampler: str, folder: Path, polish: bool = True) -> None:
    """Judge all draws that have no line yet."""
    verdicts = Verdicts(folder, kind.name, sampler)
    for chain, drawn in enumerate(chains(folder, kind.name, sampler)):
        for draw in range(len(drawn.values)):
            if not verdicts.has(chain, draw):
                verdicts.add(row(kind, drawn, chain, draw, polish))


def row(kind: Kind, drawn: Drawn, chain: int, draw: int, polish: bool) -> dict[str, Any]:
    """What the judges say of a draw, and of its polish where it fails."""
    choices = drawn.choices(draw)
    record = {"chain": chain, "draw": draw} | verdict(kind, choices, draw % MARGINS == 0)
    if polish and not passes(record):
        better = stacks.polished(kind.model, choices, kind.width)
        record["polished"] = verdict(kind, better, False)
    return record


def verdict(kind: Kind, choices: dict[str, Any], margin: bool) -> dict[str, Any]:
    """Residual, margin and movement of one structure; why, where it is none."""
    sample = nw.run(kind.model, width=kind.width, choices=choices).best
    try:
        structure = stacks.Structure.of(sample)
    except nw.NiwakiError as fault:
        return {"refused": getattr(fault, "code", type(fault).__name__)}
    balance = stacks.balanced(structure, margin=margin)
    drop = stacks.simulated(structure)
    record = {
        "residual": balance.residual,
        "holds": balance.holds,
        # A structure that flies apart has no number for it.
        "moved": min(drop.moved, 1e3),
        "block": drop.block,
        "stands": drop.stands,
        "litres": round(1e3 * float(structure.solids()[0].sum()), 6),
    }
    return record | ({"margin": balance.margin} if margin and np.isfinite(balance.margin) else {})


def passes(record: dict[str, Any]) -> bool:
    return bool(record.get("holds") and record.get("stands"))
