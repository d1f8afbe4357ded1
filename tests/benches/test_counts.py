"""Claim: the committed table of instruction counts has each path of the bench, and constants keep their kinds."""

from __future__ import annotations

import json

import niwaki as nw
from counts import ALLOWED, PATHS, TABLE, constant


def test_the_table_has_each_path_and_no_other():
    table = json.loads(TABLE.read_text())
    assert list(table) == list(PATHS)
    assert all(isinstance(count, int) and count > 0 for count in table.values())
    assert 0.0 < ALLOWED <= 0.02


def test_constants_keep_their_kinds():
    data = json.loads(json.dumps(constant((1, 2.0, [nw.vec(1, 2, 3)]))))
    assert data == {"tuple": [1, 2.0, {"list": [{"vec": [1.0, 2.0, 3.0]}]}]}
    assert [type(part) for part in data["tuple"][:2]] == [int, float]
