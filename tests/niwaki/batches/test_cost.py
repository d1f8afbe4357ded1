"""Claim: giving out searches costs little. The limits are three times what was measured on a busy machine, or more.

CPU time of this process is counted, which collects: what workers do beyond their searches is in `make bench-batch`.
"""

from __future__ import annotations

import time
from pathlib import Path

import batched
import niwaki as nw
from niwaki.batches import Standing


def test_a_chunk_that_does_nothing_costs_less_than_three_milliseconds(tmp_path: Path) -> None:
    search = nw.Search(batched.bump, method=nw.importance(1))
    outcomes = nw.batch(search, seeds=1000, folder=tmp_path, processes=1, chunk=0.0)
    next(outcomes)
    begin = time.process_time()
    assert sum(1 for _ in outcomes) == 999
    assert time.process_time() - begin < 999 * 0.003


def test_collecting_costs_a_twentieth_of_the_searches(tmp_path: Path) -> None:
    search = nw.Search(batched.pile, (0.0, 2.0), method=nw.smc(4000), keep="best")
    standings: list[Standing] = []
    outcomes = nw.batch(search, seeds=60, processes=2, chunk=1.0, progress=standings.append)
    next(outcomes)
    begin, before = time.process_time(), standings[-1].cpu_seconds
    assert sum(1 for _ in outcomes) == 59
    searches = standings[-1].cpu_seconds - before
    assert searches > 0.5
    assert time.process_time() - begin < searches / 20
