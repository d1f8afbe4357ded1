"""Claim: a sheet has a cell for each scene, and bad settings give an error."""

from __future__ import annotations

import pytest
from niwaki import _engine
from niwaki.draw.scene import Scene
from niwaki.draw.sheet import sheet
from niwaki.errors import FileError, InputError


def blocks(count: int) -> list[Scene]:
    return [Scene([("block", [_engine.shape("box", (0, 0, 0), (1, 1 + k, 1))])]) for k in range(count)]


def test_rows_and_columns() -> None:
    settings = {"size": (80, 60), "samples": 1}
    assert sheet(blocks(5), **settings).size == (3 * 82 - 2, 2 * 62 - 2)
    assert sheet(blocks(3), columns=1, **settings).size == (80, 3 * 62 - 2)
    named = sheet(blocks(2), ["one", "a caption that is far too long for its cell"], **settings)
    assert named.size[1] > 60


def test_bad_settings_are_refused() -> None:
    with pytest.raises(FileError, match="scene-empty"):
        sheet([])
    with pytest.raises(FileError, match="captions"):
        sheet(blocks(2), ["one"])
    with pytest.raises(InputError, match="columns"):
        sheet(blocks(2), columns=0)
