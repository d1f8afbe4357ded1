"""Claim: our targets are closed, have the sizes that models need, and survive writing and reading."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from niwaki.targets import examples as targets
from niwaki.targets.target import Target
from numpy.typing import NDArray


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("bent_tube", (6.5, 25.9, 13.5)),
        ("crescent", (25.5, 12.0, 17.9)),
        ("dart", (11.2, 1.3, 12.8)),
        ("downtown", (26.8, 24.0, 26.8)),
        ("emblem", (10.0, 1.5, 10.0)),
        ("fan", (12.0, 11.0, 4.4)),
        ("forked_tree", (28.0, 24.8, 11.2)),
        ("funnel", (27.6, 22.8, 19.8)),
        ("gem", (15.2, 17.9, 15.2)),
        ("ledges", (12.2, 22.8, 18.6)),
        ("niwaki", (17.3, 19.9, 8.4)),
        ("ship", (18.0, 2.75, 15.0)),
        ("umbrella", (30.0, 23.3, 14.8)),
    ],
)
def test_closed_and_sized(name: str, size: tuple[float, float, float]) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        target = targets.TARGETS[name]()
    assert target.open_edges == 0
    assert np.allclose(target.size, size, atol=0.1)
    assert target.volume > 0
    if name not in ("ship", "dart", "emblem"):
        assert target.bounds[0, 1] == pytest.approx(0.0, abs=1e-9), "stands on the ground"


@pytest.mark.parametrize("name", targets.TARGETS)
def test_sines_of_another_processor_give_the_same_bytes(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    target = targets.TARGETS[name]()
    for function in (np.sin, np.cos):
        # The least number above each result stands for the rounding of another processor.
        monkeypatch.setattr(np, function.__name__, lambda x, real=function: np.nextafter(real(x), 2.0))
    again = targets.TARGETS[name]()
    assert again.vertices.tobytes() == target.vertices.tobytes()
    assert again.faces.tobytes() == target.faces.tobytes()


def test_written_targets_read_back(tmp_path: Path) -> None:
    written = targets.write_all(tmp_path)
    assert sorted(path.name for path in written) == sorted(
        [f"{name}.obj" for name in targets.TARGETS] + [f"{name}.png" for name in targets.IMAGES]
    )
    for path in written[: len(targets.TARGETS)]:
        again, target = Target.load(path), targets.TARGETS[path.stem]()
        assert again.open_edges == 0
        assert np.allclose(again.bounds, target.bounds, atol=1e-6)
        assert again.volume == pytest.approx(target.volume, rel=1e-5)


def test_the_list_is_of_all_targets() -> None:
    assert sorted(targets.TARGETS) == [
        name for name in sorted(targets.TARGETS) if targets.TARGETS[name]().name == name
    ]


def on(name: str) -> NDArray[np.bool_]:
    return np.asarray(targets.image(name)) > 0


@pytest.mark.parametrize(
    ("name", "side", "share"),
    [
        ("digits", 250, 0.09),
        ("face", 250, 0.32),
        ("face_stroke", 250, 0.08),
        ("ship_front", 250, 0.09),
        ("skyline", 200, 0.3),
    ],
)
def test_images_have_the_size_and_the_weight_of_the_originals(name: str, side: int, share: float) -> None:
    assert on(name).shape == (side, side)
    assert on(name).mean() == pytest.approx(share, abs=0.01)


def test_images_fit_their_experiments() -> None:
    # Pipes start above the middle of the floor and can only fill what is one piece.
    assert on("digits")[125, 125]
    assert pieces(on("digits")) == pieces(on("face")) == pieces(on("ship_front")) == 1
    # The ship is mirror-symmetric, but for edges rounded to one side.
    front = on("ship_front")
    assert (front != front[:, ::-1]).mean() < 0.002
    # The stroke runs along the face's edge: half of it lies on either side.
    stroke = on("face_stroke")
    assert on("face")[stroke].mean() == pytest.approx(0.5, abs=0.1)
    # The town is on row 128 of pixels, as its camera sees the ground.
    rows = np.flatnonzero(on("skyline").any(axis=1))
    assert rows.max() == 128


def pieces(pixels: NDArray[np.bool_]) -> int:
    """Count 4-connected pieces: the least label spreads until nothing changes."""
    label = np.where(pixels, np.arange(1, pixels.size + 1).reshape(pixels.shape), 0)
    while True:
        padded = np.pad(label, 1)
        near = [padded[1:-1, 1:-1], padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]]
        spread = np.where(pixels, np.maximum.reduce(near), 0)
        if (spread == label).all():
            return len(np.unique(label[pixels]))
        label = spread
