"""One studio for the tests of a file, and a script that speaks to it."""

from collections.abc import Iterator

import pytest
from studio_fixtures import pile, served
from studio_process import Served

__all__ = ["connected", "pile", "served"]


@pytest.fixture
def connected(served: Served) -> Iterator[object]:
    """A script's connection."""
    # The extra `studio` may be missing, where these tests are skipped.
    studio = pytest.importorskip("niwaki.studio")
    with studio.connect(served.url, served.key) as one:
        yield one
