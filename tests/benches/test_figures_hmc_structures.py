"""The structures of chapter 4 can be drawn: a smoke run makes a page, the table, and every line of what it measures."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

for module in ("matplotlib", "mujoco", "scipy"):
    pytest.importorskip(module)

BENCHES = Path(__file__).resolve().parents[2] / "benches"


def test_a_smoke_run_draws_and_measures(tmp_path: Path) -> None:
    settings = {name: value for name, value in os.environ.items() if name != "STACKS"} | {"QUICK": "1"}
    command = [sys.executable, str(BENCHES / "figures_hmc"), str(tmp_path), "structures"]
    subprocess.run(command, check=True, env=settings, stdout=subprocess.DEVNULL)
    rows = [json.loads(line) for line in (tmp_path / "structures.jsonl").read_text().splitlines()]
    assert [(row["model"], row["sampler"], row["draws"]) for row in rows] == [
        ("stack", "nuts", 6),
        ("stack", "mh-original", 6),
        ("stack", "mh-adaptive", 6),
    ]
    assert all(row["choices"] == 118 and row["seconds"] > 0 for row in rows)
    assert (tmp_path / "figure-4-8.png").stat().st_size > 10_000
    assert "stack (nuts)" in (tmp_path / "figure-4-10.md").read_text()
    # A second run finds everything there.
    before = sorted((path.name, path.stat().st_mtime_ns) for path in (tmp_path / "stacks").iterdir())
    subprocess.run(command, check=True, env=settings, stdout=subprocess.DEVNULL)
    after = sorted((path.name, path.stat().st_mtime_ns) for path in (tmp_path / "stacks").iterdir())
    assert before == after
