"""Fixtures of tests with a studio, by a script or in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from studio_process import PILE, Served, serving


@pytest.fixture(scope="module")
def pile(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with a model."""
    place = tmp_path_factory.mktemp("models") / "pile.py"
    place.write_text(PILE)
    return place


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory, pile: Path) -> Iterator[Served]:
    """A studio for the tests of a file."""
    with serving(tmp_path_factory.mktemp("session"), pile) as studio:
        yield studio
