"""Fixtures: a studio for the tests of a file, and a script that is connected to it."""

from collections.abc import Iterator

import pytest
from studio_fixtures import pile, served
from studio_process import Served

__all__ = ["connected", "pile", "served"]


@pytest.fixture
def connected(served: Served) -> Iterator[object]:
    """A connection of a script."""
    # Without the extra `studio` these tests are skipped.
    studio = pytest.importorskip("niwaki.studio")
    with studio.connect(served.url, served.key) as connection:
        yield connection
