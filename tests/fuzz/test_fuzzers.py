"""The fuzzers run, and a few of their inputs are tried in every `make test`; `make fuzz` and `make soak` try many."""

from __future__ import annotations

from pathlib import Path

import fuzzers
import pytest
import sources
from reports import Report


def test_mutated_sources_are_models_or_messages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sources, "BATCH", 60)
    tried = Report("sources")
    sources.batch(7, 60, tmp_path, tried)
    assert not tried.found, tried.found
    # Some are models.
    assert tried.counts.total() == 60 and tried.counts["refused"] < 55


def test_a_mutator_gives_the_same_sources_again() -> None:
    first, second = sources.Mutator(5), sources.Mutator(5)
    mutants = [first.source() for _ in range(20)]
    assert mutants == [second.source() for _ in range(20)]
    assert len(set(mutants)) == 20


def test_targets_have_sources_and_corpora() -> None:
    for name in fuzzers.engine_targets():
        assert (fuzzers.ENGINE / "targets" / f"{name}.rs").exists()
        packed = fuzzers.ENGINE / "corpora" / f"{name}.zip"
        assert packed.exists() and packed.stat().st_size < fuzzers.PACKED, name
    assert {"sources", "agreement"} <= set(fuzzers.python_targets())
