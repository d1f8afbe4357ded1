"""A batch as files for other tools: a table (CSV, Parquet), a contact sheet, meshes.

The table has a line for each search, in the order of the batch, and the same bytes however the batch was computed. Its
columns are the case, what varies, the seed, and numbers of the best run.
"""

from __future__ import annotations

import csv
import heapq
import io
import json
import math
from itertools import islice
from pathlib import Path
from typing import Any

from niwaki import draw
from niwaki.batches.body import Outcome
from niwaki.batches.entry import outcomes
from niwaki.batches.store import Store
from niwaki.errors import InputError
from niwaki.errors.extras import optional
from niwaki.errors.files import ensure_folder, write_whole
from niwaki.result import caption

#: The columns that every table has, after those of what varies, with their kind.
COLUMNS: dict[str, type] = {
    "seed": int,
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

#: Lines of a table that are kept at once, for Parquet.
BLOCK = 10_000


def numbers(one: Outcome, choices: bool = False) -> dict[str, Any]:
    """The line of a search: what varies, and the numbers of its best run; None for what it has not.

    Parameters
    ----------
    one
        The search.
    choices
        Also the choices of the best run by their addresses, as JSON.
    """
    found: dict[str, Any] = {"case": one.case, **one.labels, **dict.fromkeys(COLUMNS), "seed": one.seed}
    if choices:
        found["choices"] = None
    if one.fault is not None:
        return found | {"fault": one.fault}
    found |= {"samples": len(one.result), "log_evidence": one.result.log_evidence}
    try:
        best = one.best
    except InputError as error:
        if error.code != "no-runs":
            raise
        return found
    fits = best.fit
    found |= {name: getattr(best, name) for name in ("log_score", "log_prior", "similarity", "primitives")}
    found |= {name: None if fits is None else getattr(fits, name) for name in ("covered", "outside")}
    if choices:
        found["choices"] = json.dumps(best.choices)
    return found


def write_csv(place: Path, store: Store, trust: tuple[str, ...] = (), choices: bool = False) -> Path:
    """Write the table as text with commas; numbers have all their digits.

    Raises
    ------
    FileError
        The file cannot be written.
    """
    text = io.StringIO()
    lines: Any = None
    for one in outcomes(store, trust):
        found = numbers(one, choices)
        if lines is None:
            lines = csv.DictWriter(text, list(found), lineterminator="\n")
            lines.writeheader()
        lines.writerow(found)
    return write_whole(place, text.getvalue().encode())


def write_parquet(place: Path, store: Store, trust: tuple[str, ...] = (), choices: bool = False) -> Path:
    """Write the table as Parquet.

    Raises
    ------
    FileError
        PyArrow is not installed, or the file cannot be written.
    """
    arrow = optional("pyarrow", "writing Parquet", "parquet")
    parquet = optional("pyarrow.parquet", "writing Parquet", "parquet")
    kinds = {int: arrow.int64(), float: arrow.float64(), str: arrow.string(), bool: arrow.bool_()}
    fields = {"case": int, **_kinds(store), **COLUMNS, **({"choices": str} if choices else {})}
    # Seeds go up to 2**64 - 1.
    schema = arrow.schema(
        [(name, arrow.uint64() if name == "seed" else kinds[kind]) for name, kind in fields.items()]
    )
    data = io.BytesIO()
    rows = (numbers(one, choices) for one in outcomes(store, trust))
    with parquet.ParquetWriter(data, schema) as writer:
        while block := list(islice(rows, BLOCK)):
            writer.write_table(arrow.Table.from_pylist([_typed(row, fields) for row in block], schema=schema))
    return write_whole(place, data.getvalue())


def _kinds(store: Store) -> dict[str, type]:
    """The kind of each label: that of all its values, or a text."""
    cases = store.whole.cases
    found: dict[str, type] = {}
    for name in cases[0].labels:
        types = {type(case.labels.get(name)) for case in cases}
        found[name] = types.pop() if len(types) == 1 else float if types == {int, float} else str
        found[name] = found[name] if found[name] in (int, float, str, bool) else str
    return found


def _typed(row: dict[str, Any], fields: dict[str, type]) -> dict[str, Any]:
    """A line whose texts are texts."""
    return {
        name: str(value) if fields[name] is str and value is not None else value
        for name, value in row.items()
    }


def best_of(store: Store, count: int, trust: tuple[str, ...] = ()) -> list[Outcome]:
    """The searches with the best log scores, best first."""
    scenes = (one for one in outcomes(store, trust) if one.fault is None and one.best.primitives > 0)

    def rank(one: Outcome) -> tuple[float, int, int]:
        score = one.best.log_score
        return (-math.inf if math.isnan(score) else score, -one.case, -one.seed)

    return heapq.nlargest(count, scenes, key=rank)


def write_sheet(place: Path, found: list[Outcome]) -> Path:
    """Draw these searches side by side, each with its number in the list and its scores."""
    target = found[0].best.target if found else None
    same = all(one.case == found[0].case for one in found)
    captions = [caption(one.best, number) for number, one in enumerate(found, 1)]
    scenes = [one.best.scene for one in found]
    return draw.sheet.save(place, scenes, captions, target if same else None, size=(320, 240))


def write_meshes(folder: Path, found: list[Outcome]) -> list[Path]:
    """Write the best run of each of these as GLB: `case-0-seed-12.glb`; of a drawing as SVG."""
    ensure_folder(folder)
    places = []
    for one in found:
        suffix = "glb" if one.search.score.window is None else "svg"
        places.append(one.best.export(folder / f"case-{one.case}-seed-{one.seed}.{suffix}"))
    return places
