"""Sizes and axes: whether a target fits a model in size, direction and place, and placements that make it fit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from niwaki.result import Sample
from niwaki.search.warnings import gap, times_as_large
from niwaki.studio.messages import Placing, Sizes, TargetAsk
from niwaki.studio.worker import asks
from niwaki.studio.worker.thinning import stood

#: The least gain of a turn: the factor by which the slenderness of target and model agree better.
GAIN = 1.6
#: A mesh whose lowest point is this near 0, as a share of its size, stands on the plane of its other axes.
FOOT = 0.01


def sizes(run: Sample | None, ask: TargetAsk | None, bounds: NDArray[np.float64] | None) -> Sizes:
    """Compare a run of the model with its target.

    Parameters
    ----------
    run
        A run of the model without a target.
    ask, bounds
        The target, and its bounds at its place.
    """
    home = None if run is None else np.asarray(run.scene.bounds, dtype=np.float64)
    length = None if home is None else _point(home[1] - home[0])
    if ask is None or bounds is None:
        return Sizes(length)
    offers: list[Placing] = []
    if home is not None:
        is_upload = Path(ask.source).is_absolute()
        offers = _turned(ask, bounds, home) if is_upload else []
        offers += _resized(ask, bounds, home) or _moved(ask, bounds, home)
    return Sizes(length, _point(bounds[1] - bounds[0]), offers)


def _turned(ask: TargetAsk, bounds: NDArray[np.float64], home: NDArray[np.float64]) -> list[Placing]:
    """Offer to stand up a mesh that lies: its z axis points up."""
    if ask.up == "z":
        return []
    size = bounds[1] - bounds[0]
    upright = np.abs(stood(np.array([size]))[0])
    natural = _slenderness(home[1] - home[0])
    here, there = (abs(np.log(_slenderness(side) / natural)) for side in (size, upright))
    # A printer's mesh stands on z = 0, and not on y = 0.
    raw = asks.shown(TargetAsk(ask.source))[0].bounds
    near = FOOT * float(np.ptp(raw, axis=0).max())
    stands_on_z = abs(raw[0][2]) <= near < abs(raw[0][1])
    if not (stands_on_z and there <= here) and here - there < np.log(GAIN):
        return []
    text = "The mesh seems to lie on its side: its z axis points up."
    return [Placing(text, "Stand it up", msgspec.structs.replace(ask, up="z"))]


def _resized(ask: TargetAsk, bounds: NDArray[np.float64], home: NDArray[np.float64]) -> list[Placing]:
    """Offer to scale a target to the size of the model, and to move it there."""
    length, goal = float((home[1] - home[0]).max()), float((bounds[1] - bounds[0]).max())
    times = times_as_large(length, goal)
    if times is None:
        return []
    factor = float(f"{length / goal:.3g}")
    x, y, z = ask.scale
    scaled = msgspec.structs.replace(ask, scale=(x * factor, y * factor, z * factor))
    foot = _foot(bounds)
    after = foot + (bounds - foot) * factor
    moved = _moved(scaled, after, home)
    larger, smaller = ("model", "target") if length > goal else ("target", "model")
    text = f"The {larger} is {times:.0f} times as large as the {smaller}."
    return [Placing(text, "Scale to fit", moved[0].target if moved else scaled)]


def _moved(ask: TargetAsk, bounds: NDArray[np.float64], home: NDArray[np.float64]) -> list[Placing]:
    """Offer to move a target to a model that begins far from it."""
    away = gap(home, bounds)
    if away <= max(float((bounds[1] - bounds[0]).max()), float((home[1] - home[0]).max())):
        return []
    move = np.array(ask.move) + _foot(home) - _foot(bounds)
    text = f"The target is far from the model: {away:.3g} away."
    return [Placing(text, "Move it here", msgspec.structs.replace(ask, move=_point(move)))]


def _foot(bounds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the middle of the base of a box."""
    low, high = bounds
    return np.array([(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2])


def _slenderness(size: NDArray[np.float64]) -> float:
    """Return the height of a box over the mean of its other sides."""
    wide, high, deep = np.maximum(size, 1e-12)
    return float(high / np.sqrt(wide * deep))


def _point(values: NDArray[Any]) -> tuple[float, float, float]:
    x, y, z = (float(f"{value:.6g}") for value in values)
    return x, y, z
