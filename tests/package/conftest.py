"""The wheel and the sdist in the folder that `NIWAKI_PACKAGE` names (`make package`); without it no test is here."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

FOLDER = os.environ.get("NIWAKI_PACKAGE")
collect_ignore_glob = [] if FOLDER else ["test_*.py"]


def _only(pattern: str) -> Path:
    files = sorted(Path(FOLDER or "").resolve().glob(pattern))
    assert len(files) == 1, f"{FOLDER} has {len(files)} files {pattern}"
    return files[0]


@pytest.fixture(scope="session")
def wheel() -> Path:
    return _only("niwaki-*.whl")


@pytest.fixture(scope="session")
def sdist() -> Path:
    return _only("niwaki-*.tar.gz")
