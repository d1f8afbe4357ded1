"""Claim: the manual lists every limit with its value."""

from __future__ import annotations

from pathlib import Path

from niwaki.inputs.limits import LIMITS

MANUAL = Path(__file__).parents[3] / "docs/guide/files.md"


def test_the_manual_lists_the_limits() -> None:
    rows = [f"| {name} | {limit.most:,} {limit.unit} | {limit.reason} |" for name, limit in LIMITS.items()]
    text = MANUAL.read_text(encoding="utf-8")
    assert "\n".join(["| limit | most | why |", "| --- | --- | --- |", *rows]) in text
