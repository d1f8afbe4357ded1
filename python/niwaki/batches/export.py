"""Files of a batch for other tools: a table (CSV, Parquet), a contact sheet, meshes.

The table has a row for each search, in the order of the batch, with the same bytes however the batch was computed. Its
columns are the case, the varied values, the seed, and numbers of the best run.
"""

from __future__ import annotations

import heapq
import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from niwaki import draw
from niwaki.batches import tables
from niwaki.batches.body import Outcome
from niwaki.batches.entry import outcomes
from niwaki.batches.store import Store
from niwaki.errors import InputError
from niwaki.errors.files import ensure_folder
from niwaki.result import caption
from niwaki.search.data import mesh_hash

#: The columns of every table, after the columns of varied values, with their types.
COLUMNS: dict[str, type] = {
    "seed": tables.Unsigned,
    "log_score": float,
    "log_prior": float,
    "log_evidence": float,
    "similarity": float,
    "covered": float,
    "outside": float,
    "primitives": int,
    "samples": int,
    "fault": str,
}


def numbers(outcome: Outcome, choices: bool = False) -> dict[str, Any]:
    """Return the row of a search: the varied values, and the numbers of its best run; None for missing numbers.

    Parameters
    ----------
    outcome
        The outcome of the search.
    choices
        Whether to add the choices of the best run by their addresses, as JSON.
    """
    row: dict[str, Any] = {
        "case": outcome.case,
        **outcome.labels,
        **dict.fromkeys(COLUMNS),
        "seed": outcome.seed,
    }
    if choices:
        row["choices"] = None
    if outcome.fault is not None:
        return row | {"fault": outcome.fault}
    row |= {"samples": len(outcome.result), "log_evidence": outcome.result.log_evidence}
    try:
        best = outcome.best
    except InputError as error:
        if error.code != "no-runs":
            raise
        return row
    fits = best.fit
    row |= {name: getattr(best, name) for name in ("log_score", "log_prior", "similarity", "primitives")}
    row |= {name: None if fits is None else getattr(fits, name) for name in ("covered", "outside")}
    if choices:
        row["choices"] = json.dumps(best.choices)
    return row


def write_csv(place: Path, store: Store, trust: tuple[str, ...] = (), choices: bool = False) -> Path:
    """Write the table as CSV; numbers have all their digits.

    Raises
    ------
    FileError
        The file cannot be written.
    """
    return tables.write_csv(place, *_table(store, trust, choices))


def write_parquet(place: Path, store: Store, trust: tuple[str, ...] = (), choices: bool = False) -> Path:
    """Write the table as Parquet.

    Raises
    ------
    FileError
        PyArrow is not installed, or the file cannot be written.
    """
    return tables.write_parquet(place, *_table(store, trust, choices))


def _table(
    store: Store, trust: tuple[str, ...], choices: bool
) -> tuple[dict[str, type], Iterator[dict[str, Any]]]:
    """Return the columns of a table with their types, and its rows."""
    cases = store.whole.cases
    labels = {name: tables.kind(case.labels.get(name) for case in cases) for name in cases[0].labels}
    columns = {"case": int, **labels, **COLUMNS, **({"choices": str} if choices else {})}
    return columns, (numbers(outcome, choices) for outcome in outcomes(store, trust))


def best_of(store: Store, count: int, trust: tuple[str, ...] = ()) -> list[Outcome]:
    """Return the searches with the best log scores, best first."""
    scenes = (
        outcome for outcome in outcomes(store, trust) if outcome.fault is None and outcome.best.primitives > 0
    )

    def rank(outcome: Outcome) -> tuple[float, int, int]:
        score = outcome.best.log_score
        return (-math.inf if math.isnan(score) else score, -outcome.case, -outcome.seed)

    return heapq.nlargest(count, scenes, key=rank)


def write_sheet(place: Path, outcomes: list[Outcome]) -> Path:
    """Draw searches side by side, each with its number in the list, its scores and its case.

    The target is drawn as a ghost if it is the same for all searches.
    """
    targets = [outcome.best.target for outcome in outcomes]
    has_same_target = len({None if target is None else mesh_hash(target) for target in targets}) == 1
    captions = [
        f"{caption(outcome.best, number)}   case {outcome.case}" for number, outcome in enumerate(outcomes, 1)
    ]
    scenes = [outcome.best.scene for outcome in outcomes]
    return draw.sheet.save(place, scenes, captions, targets[0] if has_same_target else None, size=(320, 240))


def write_meshes(folder: Path, outcomes: list[Outcome]) -> list[Path]:
    """Write the best run of each search as GLB, `case-0-seed-12.glb`, or as SVG for a drawing."""
    ensure_folder(folder)
    places = []
    for outcome in outcomes:
        suffix = "glb" if outcome.search.score.window is None else "svg"
        places.append(outcome.best.export(folder / f"case-{outcome.case}-seed-{outcome.seed}.{suffix}"))
    return places
