"""Claim: a table says what the results are, whatever varies and whatever failed; Parquet and CSV say the same."""

from __future__ import annotations

import csv
import importlib.util
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import batched
import niwaki as nw
import pytest
from niwaki import batches
from niwaki.batches import export, tables


def stored(folder: Path) -> batches.Store:
    """Searches some of which fail, labels of mixed kinds, the largest seed."""
    possible = nw.Search(batched.bump, method=nw.smc(3))
    perhaps = nw.Search(batched.often_impossible, method=nw.smc(1))
    table = batches.Table([possible, perhaps], [{"size": 1, "name": "bump"}, {"size": 2.5, "name": 7}])
    store = batches.Store(folder, table.spec([0, 1, 2, 3, 2**64 - 1]))
    with ThreadPoolExecutor(1) as thread:
        list(table.run(store, (1, 1), batches.Workers(thread)))
    return store


def test_the_table_has_what_the_results_have(tmp_path: Path) -> None:
    store = stored(tmp_path)
    with open(export.write_csv(tmp_path / "results.csv", store, choices=True), newline="") as file:
        rows = list(csv.DictReader(file))
    outcomes = list(batches.outcomes(store))
    assert [int(row["seed"]) for row in rows] == [outcome.seed for outcome in outcomes]
    for row, outcome in zip(rows, outcomes, strict=True):
        assert row["fault"] == (outcome.fault or "")
        if outcome.fault is None:
            assert float(row["log_score"]) == outcome.best.log_score and int(row["samples"]) == len(
                outcome.result
            )
    assert {row["fault"] for row in rows} == {"", "everything-impossible"}
    assert [row["name"] for row in rows[::5]] == ["bump", "7"]


@pytest.mark.skipif(importlib.util.find_spec("pyarrow") is None, reason="pyarrow is not installed")
def test_parquet_has_the_same(tmp_path: Path) -> None:
    import pyarrow.parquet

    store = stored(tmp_path)
    rows = pyarrow.parquet.read_table(export.write_parquet(tmp_path / "results.parquet", store)).to_pylist()
    expected = [export.numbers(outcome) for outcome in batches.outcomes(store)]
    assert [{**row, "name": str(row["name"])} for row in expected] == rows
    assert rows[4]["seed"] == 2**64 - 1 and rows[0]["size"] == 1.0


@pytest.mark.skipif(importlib.util.find_spec("pyarrow") is not None, reason="pyarrow is installed")
def test_without_the_library_there_is_a_message(tmp_path: Path) -> None:
    with pytest.raises(nw.NiwakiError, match=r"niwaki\[parquet\]"):
        export.write_parquet(tmp_path / "results.parquet", stored(tmp_path))


@pytest.mark.parametrize(
    ("values", "kind"),
    [
        ([1, None, 2], int),
        ([1, 2.5], float),
        ([True, False], bool),
        ([True, 1], str),
        (["a", None], str),
        ([(1, 2)], str),
        ([None], str),
    ],
)
def test_a_column_has_the_type_of_its_values(values: list[object], kind: type) -> None:
    assert tables.kind(values) is kind


def test_a_table_has_another_ending(tmp_path: Path) -> None:
    with pytest.raises(nw.NiwakiError, match="ends in .csv or .parquet"):
        tables.write(tmp_path / "table.txt", {"a": int}, [])
    assert not (tmp_path / "table.txt").exists()
