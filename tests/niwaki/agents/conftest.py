"""A client for the tests of a file."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

pytest.importorskip("mcp")

from agent import Agent
from agent import agent as opened


@pytest.fixture(scope="module")
def agent(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Agent]:
    """A client of an empty folder."""
    with opened(tmp_path_factory.mktemp("models")) as client:
        yield client
