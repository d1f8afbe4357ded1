"""Rows with names as a file, CSV or Parquet: the one place that writes tables.

Numbers in CSV have all their digits, and what a row lacks is empty. A column of Parquet has the type of its values.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

from niwaki.errors.extras import optional
from niwaki.errors.files import write_whole
from niwaki.errors.settings import bad

Row = dict[str, Any]


class Unsigned(int):
    """The type of a column of whole numbers up to 2^64 - 1."""


#: The types of columns.
TYPES = (int, Unsigned, float, str, bool)

#: Rows that are in memory at once, for Parquet.
BLOCK = 10_000


def kind(values: Iterable[Any]) -> type:
    """Return the type of a column: that of all values but None, `float` for whole and real ones, else text."""
    kinds = {type(value) for value in values} - {type(None)}
    if kinds == {int, float}:
        return float
    only = kinds.pop() if len(kinds) == 1 else str
    return only if only in TYPES else str


def write(place: Path, columns: Mapping[str, type], rows: Iterable[Row]) -> Path:
    """Write rows as the ending of the file says.

    Parameters
    ----------
    place
        A file that ends in .csv or .parquet.
    columns
        The names of the columns, with their types.
    rows
        The rows; None for what a row lacks.

    Raises
    ------
    InputError
        `bad-setting`: another ending.
    FileError
        PyArrow is not installed, or the file cannot be written.
    """
    if place.suffix == ".csv":
        return write_csv(place, columns, rows)
    if place.suffix == ".parquet":
        return write_parquet(place, columns, rows)
    raise bad("path", str(place), "a name that ends in .csv or .parquet", "such a name")


def write_csv(place: Path, columns: Mapping[str, type], rows: Iterable[Row]) -> Path:
    """Write rows as CSV."""
    text = io.StringIO()
    lines = csv.DictWriter(text, list(columns), lineterminator="\n")
    lines.writeheader()
    lines.writerows(rows)
    return write_whole(place, text.getvalue().encode())


def write_parquet(place: Path, columns: Mapping[str, type], rows: Iterable[Row]) -> Path:
    """Write rows as Parquet, block by block."""
    arrow = optional("pyarrow", "writing Parquet", "parquet")
    parquet = optional("pyarrow.parquet", "writing Parquet", "parquet")
    types = (arrow.int64(), arrow.uint64(), arrow.float64(), arrow.string(), arrow.bool_())
    named = dict(zip(TYPES, types, strict=True))
    schema = arrow.schema([(name, named[type_]) for name, type_ in columns.items()])
    data = io.BytesIO()
    with parquet.ParquetWriter(data, schema) as writer:
        for block in _blocks(rows):
            typed = [
                {
                    name: str(row[name]) if type_ is str and row[name] is not None else row[name]
                    for name, type_ in columns.items()
                }
                for row in block
            ]
            writer.write_table(arrow.Table.from_pylist(typed, schema=schema))
    return write_whole(place, data.getvalue())


def _blocks(rows: Iterable[Row]) -> Iterator[list[Row]]:
    left = iter(rows)
    while block := list(islice(left, BLOCK)):
        yield block
