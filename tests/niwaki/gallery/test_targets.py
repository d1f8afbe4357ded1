"""Claim: our targets are closed, have the sizes that models count on, and survive writing and reading."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from niwaki.gallery import targets
from niwaki.target import Target


@pytest.mark.parametrize(
    ("name", "size"),
    [("ship", (18.0, 2.75, 15.0)), ("crescent", (25.1, 12.0, 17.8)), ("niwaki", (17.3, 19.9, 8.4))],
)
def test_closed_and_sized(name: str, size: tuple[float, float, float]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        target = targets.TARGETS[name]()
    assert target.open_edges == 0
    assert np.allclose(target.size, size, atol=0.1)
    assert target.volume > 0
    if name != "ship":
        assert target.bounds[0, 1] == pytest.approx(0.0, abs=1e-9), "stands on the ground"


def test_written_targets_read_back(tmp_path: Path) -> None:
    for path in targets.write_all(tmp_path):
        again, made = Target.load(path), targets.TARGETS[path.stem]()
        assert again.open_edges == 0
        assert np.allclose(again.bounds, made.bounds, atol=1e-6)
        assert again.volume == pytest.approx(made.volume, rel=1e-5)
