"""Scores of scenes: sketches as values that multiply. You choose a score when you run a model, not inside of it.

    score = no_self_intersection() * match_volume(target, voxel=0.25)
    score = no_self_intersection() * floor(0) * avoid("wall.obj") * match_image("skyline.png", "cam.json")

Log scores add. Sketches are evaluated in order: cheap ones that may forbid a scene come first.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import isfinite, sqrt
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine, targets
from niwaki.errors import InputError
from niwaki.errors.schema import Unfit, shown
from niwaki.errors.settings import bad, real
from niwaki.targets.camera import Camera
from niwaki.targets.target import Receiver, Target
from niwaki.targets.thin import is_thin

if TYPE_CHECKING:
    from niwaki.draw.scene import Scene
    from niwaki.targets.images import Image

    Place = str | PathLike[str]
    CameraLike = Camera | Place | Mapping[str, Any]

#: The rule under which parts may overlap: no sketch forbids it.
FREE = "none"
RULES = ("solid", "surface")

#: Which cells count in `match_volume`: all cells of the grid, or those that the target or the scene fills.
CELL_WEIGHTS = ("cells", "balanced")

#: The name of a sketch, and its arguments.
Ask = tuple[str, dict[str, Any]]

#: Low and high corner of a part of the plane, (x, y) each, scene units.
Window = tuple[tuple[float, float], tuple[float, float]]

#: The number of cells of a grid without a given size: a compromise of detail and cost.
CELLS = 65_000


@dataclass(frozen=True)
class View:
    """An image to match, with the view from which its sketch sees a scene.

    Attributes
    ----------
    kind : str
        "image" for a silhouette, "shadow" for the shadow on a receiver, "drawing" for a drawing in the plane.
    camera : Camera or None
        The camera that sees the image; None for a drawing.
    image : (rows, columns) bool
        The pixels that should be on.
    receiver : Receiver or None
        The surface that the shadow falls on.
    light : tuple of float or None
        Direction in which the light travels.
    window : tuple or None
        Low and high corner of the part of the plane that a drawing shows.
    """

    kind: str
    camera: Camera | None
    image: NDArray[np.bool_]
    picture: _engine.Picture | _engine.Drawing
    receiver: Receiver | None = None
    light: tuple[float, float, float] | None = None
    window: Window | None = None

    def check_sees(self, target: Target) -> None:
        """Refuse a target that is wholly behind the camera."""
        if self.camera is None:
            return
        forward = np.subtract(self.camera.look_at, self.camera.position)
        depth = (target.vertices - np.asarray(self.camera.position)) @ forward
        if depth.max() <= 0:
            raise InputError(
                "behind-camera",
                name=target.name,
                position=self.camera.position,
                look_at=self.camera.look_at,
            )

    def mask(self, scene: Scene) -> NDArray[np.bool_]:
        """Return the mask of the pixels that are on in a scene, (rows, columns)."""
        return self.picture.mask([shape for part in scene.parts for shape in part.shapes])


@dataclass(frozen=True)
class SketchCall:
    """One sketch: the function of this module that creates it, its arguments, and its specification in the engine.

    Attributes
    ----------
    grid : Target of the engine, or None
        The cells of its mesh.
    """

    function: str
    arguments: Mapping[str, Any]
    spec: _engine.SketchSpec
    grid: _engine.Target | None = None


@dataclass(frozen=True)
class Score:
    """A product of sketches.

    Attributes
    ----------
    asks : tuple of SketchCall
        The sketches, in the order of evaluation.
    target : Target or None
        The target that the scene should fill, for pictures.
    views : tuple of View
        Images that the scene or its shadow should match, for pictures.
    """

    asks: tuple[SketchCall, ...] = ()
    target: Target | None = None
    views: tuple[View, ...] = ()

    @property
    def specs(self) -> list[_engine.SketchSpec]:
        """The sketches' specifications in the engine."""
        return [sketch.spec for sketch in self.asks]

    @property
    def window(self) -> Window | None:
        """The part of the plane that its drawings show, or None. With a window, scenes are drawn, not built."""
        return next(
            (sketch.arguments["window"] for sketch in self.asks if "window" in sketch.arguments), None
        )

    @property
    def surroundings(self) -> dict[str, Any]:
        """The solids that scenes avoid and the height of the floor, as settings of pictures; empty without them."""
        obstacles = [call.arguments["obstacle"] for call in self.asks if call.function == "avoid"]
        heights = [call.arguments["y"] for call in self.asks if call.function == "floor"]
        return ({"obstacles": obstacles} if obstacles else {}) | ({"ground": max(heights)} if heights else {})

    def data(self, write: Callable[[Any], Any]) -> list[dict[str, Any]]:
        """Return the sketches as plain data; `write` converts arguments."""
        return [
            {
                "sketch": sketch.function,
                "given": {name: write(value) for name, value in sketch.arguments.items()},
            }
            for sketch in self.asks
        ]

    @classmethod
    def of_data(cls, data: Sequence[Mapping[str, Any]], read: Any) -> Score:
        """Read sketches from plain data; `read.table` converts arguments."""
        score = cls()
        for number, entry in enumerate(data):
            make = SKETCHES.get(entry["sketch"])
            if make is None:
                raise Unfit(f"$[{number}].sketch", f"one of {', '.join(SKETCHES)}", shown(entry["sketch"]))
            score *= make(**read.table(entry["given"], f"[{number}].given"))
        return score

    def __mul__(self, other: Score) -> Score:
        if not isinstance(other, Score):
            return NotImplemented
        target = self.target if self.target is not None else other.target
        views = self.views + other.views
        if target is not None:
            for view in views:
                view.check_sees(target)
        return Score(self.asks + other.asks, target, views)

    def __repr__(self) -> str:
        return " * ".join(sketch.spec.name for sketch in self.asks) or "no score"


def no_self_intersection(rule: str = "solid") -> Score:
    """Forbid scenes in which two primitives intersect.

    Parameters
    ----------
    rule
        "solid": solids intersect when they overlap, touching is free; "surface": when their surfaces do, also where
        they only touch.
    """
    if rule not in RULES:
        raise InputError(
            "bad-setting",
            name="rule",
            found=repr(rule),
            expected='"solid" or "surface"',
            suggestion='"solid"',
        )
    return _score("no_self_intersection", {"rule": rule}, {"rule": rule})


def match_volume(
    target: Target | Place, voxel: float | None = None, sigma: float = 0.02, weight: str = "cells"
) -> Score:
    """Score a scene by how well it fills a target, cell by cell.

    Parameters
    ----------
    target
        The volume to fill: a `Target`, or a mesh file.
    voxel
        Size of a cell, scene units. By default, there are about 65 thousand cells around the target.
    sigma
        Standard deviation of the share of cells that may be wrong: smaller is stricter.
    weight
        "cells": all cells around the target count, so its similarity is the share that agrees (dissertation 5.5.1).
        "balanced": only cells that the target or the scene fills, so it is the cells of both over the cells of either
        (the Jaccard index), with a standard deviation of `5 * sigma`. Around thin targets most cells are empty, and
        "balanced" does not count them.
    """
    solid = Target.of(target)
    size = real("voxel", automatic_voxel(solid) if voxel is None else voxel, 0)
    real("sigma", sigma, 0)
    if weight not in CELL_WEIGHTS:
        raise bad("weight", weight, '"cells" or "balanced"', '"balanced"')
    with geometry_errors(solid, size):
        grid = _engine.Target(solid.vertices, solid.faces, size)
    arguments: dict[str, Any] = {"target": solid, "voxel": size, "sigma": sigma}
    settings: dict[str, Any] = {"sigma": sigma}
    if weight != "cells":
        # Without a weight all cells count: the hashes and files of such scores name none.
        arguments["weight"] = settings["weight"] = weight
    return _score("match_volume", arguments, settings, grid=grid, target=solid)


def volume_score(
    target: Target | Place, voxel: float | None = None, sigma: float = 0.02, weight: str | None = None
) -> Score:
    """Return the score by which `grow` fills a target: `match_volume`, by default with what a thin target needs.

    Around a thin target it is `match_volume(weight="balanced")` with cells of half the automatic size, if neither a
    size nor a weight is given. Otherwise all cells count by default.
    """
    solid = Target.of(target)
    if voxel is None and weight is None:
        size = automatic_voxel(solid)
        if is_thin(solid, size):
            return match_volume(solid, 0.5 * size, sigma, "balanced")
    return match_volume(solid, voxel, sigma, "cells" if weight is None else weight)


def match_image(
    image: Image,
    camera: CameraLike,
    *,
    weight_image: Image | None = None,
    weight: float = 10.0,
    sigma: float = 0.02,
) -> Score:
    """Score a scene by how well its silhouette, seen by a camera, matches an image.

    Parameters
    ----------
    image
        A file, a Pillow image or an array; a pixel should be covered where red is at least half of the brightest.
    camera
        A `Camera`, its JSON file, or the names and values of one.
    weight_image
        An image of the same size. A white pixel weighs `1 + weight`, a black pixel 1.
    weight
        How much more white weighs than black.
    sigma
        Standard deviation of the share of the weight that may be wrong: smaller is stricter.
    """
    viewpoint = Camera.of(camera)
    on, greys = _wish(image, weight_image)
    real("sigma", sigma, 0)
    with picture_errors():
        picture = _engine.Picture(viewpoint.lens(), on, greys, real("weight", weight, 0, ends="[)"))
    arguments = {"image": on, "camera": viewpoint, "weight_image": greys, "weight": weight, "sigma": sigma}
    return _score("match_image", arguments, {"sigma": sigma}, view=View("image", viewpoint, on, picture))


def match_shadow(
    image: Image,
    light: Sequence[float],
    receiver: Receiver | Place,
    camera: CameraLike | None = None,
    *,
    weight_image: Image | None = None,
    weight: float = 10.0,
    sigma: float = 0.02,
) -> Score:
    """Score a scene by how well its shadow on a receiver matches an image.

    Parameters
    ----------
    image, weight_image, weight, sigma
        As for `match_image`; a pixel should be in shadow where red is at least half of the brightest.
    light
        Direction in which the light travels, of any length: (0, -1, 0) is a sun right above.
    receiver
        The surface that the shadow falls on: a `Receiver`, or a mesh file. It need not be closed or thick.
    camera
        The camera that sees the shadow. By default, an orthographic camera looks along the light at the middle of the
        receiver and shows its whole extent along x.
    """
    on, greys = _wish(image, weight_image)
    real("sigma", sigma, 0)
    floor = Receiver.of(receiver)
    direction = _direction("light", light)
    viewpoint = floor.camera(direction, on.shape[1] / on.shape[0]) if camera is None else Camera.of(camera)
    with picture_errors(floor.name):
        picture = _engine.Picture(
            viewpoint.lens(),
            on,
            greys,
            real("weight", weight, 0, ends="[)"),
            (floor.vertices, floor.faces),
            direction,
        )
    arguments = {
        "image": on,
        "light": direction,
        "receiver": floor,
        "camera": viewpoint,
        "weight_image": greys,
        "weight": weight,
        "sigma": sigma,
    }
    view = View("shadow", viewpoint, on, picture, floor, direction)
    return _score("match_shadow", arguments, {"sigma": sigma}, view=view)


def match_drawing(
    image: Image,
    window: Sequence[Sequence[float]],
    *,
    pixels: int | None = None,
    sigma: float = 0.02 / sqrt(2.0),
) -> Score:
    """Score a scene by how well it draws an image: dark ink on white paper.

    The scene is seen from +z. Its similarity is 1 for the image and 0 for an empty page; contours count more than
    areas, and parts outside of the window lower the score much (dissertation 6.5.2).

    Parameters
    ----------
    image
        A file, a Pillow image or an array of greys; every pixel that is not white is ink.
    window
        Low and high corner of the part of the plane that the image shows, (x, y) each.
    pixels
        Pixels of the longer side: a larger image is made smaller first. None keeps its size.
    sigma
        Standard deviation of the similarity: smaller is stricter.
    """
    shown = check_window(window)
    greys = targets.images.ink(image, None if pixels is None else check_count("pixels", pixels))
    real("sigma", sigma, 0)
    drawing = _engine.Drawing(greys, *shown)
    arguments = {"image": greys, "window": shown, "pixels": None, "sigma": sigma}
    view = View("drawing", None, greys < 255, drawing, window=shown)
    return _score("match_drawing", arguments, {"sigma": sigma}, view=view)


def fill_drawing(
    window: Sequence[Sequence[float]],
    size: Sequence[int] = (50, 50),
    share: float = 0.5,
    sigma: float = 0.01 / sqrt(2.0),
) -> Score:
    """Score a scene by how it fills a part of the plane: to a certain share, with as many edges as possible.

    The scene is seen from +z. With long straight strokes this makes circuits (dissertation 6.5.3). Parts outside of the
    window lower the score much.

    Parameters
    ----------
    window
        Low and high corner of the part of the plane, (x, y) each.
    size
        Columns and rows of the pixels that measure edges and fill.
    share
        Share of the pixels that should be touched, above 0 and at most 1.
    sigma
        Standard deviation of the score: smaller is stricter.
    """
    shown = check_window(window)
    columns, rows = (check_count("size", number) for number in size)
    real("sigma", sigma, 0)
    share = real("share", share, 0, 1, "(]")
    arguments = {"window": shown, "size": (columns, rows), "share": share, "sigma": sigma}
    return _score("fill_drawing", arguments, arguments)


def avoid(obstacle: Target | Place, voxel: float | None = None) -> Score:
    """Forbid scenes that come near an obstacle: no cell may be filled by both.

    Parameters
    ----------
    obstacle
        A solid: a `Target`, or a mesh file.
    voxel
        Size of a cell, scene units; the scene keeps up to two cells away. By default, there are about 65 thousand cells
        around the obstacle.
    """
    solid = Target.of(obstacle)
    size = real("voxel", automatic_voxel(solid) if voxel is None else voxel, 0)
    with geometry_errors(solid, size):
        grid = _engine.Target(solid.vertices, solid.faces, size)
    return _score("avoid", {"obstacle": solid, "voxel": size}, {}, grid=grid)


def floor(y: float = 0.0) -> Score:
    """Forbid scenes that reach below the height `y`. A scene may stand on it."""
    arguments = {"y": real("y", y)}
    return _score("floor", arguments, arguments)


def overshoot(
    domain: Target | tuple[Sequence[float], Sequence[float]] | NDArray[np.float64], sigma: float = 0.02
) -> Score:
    """Score a scene by how far it reaches out of a box.

    `match_volume` includes this term. Use it with images and shadows, which do not see parts outside of them.

    Parameters
    ----------
    domain
        The low and the high corner, or a target for its box.
    sigma
        Standard deviation of the lengths outside, summed over the six sides, as shares of the box.
    """
    real("sigma", sigma, 0)
    low, high = _box("domain", domain.bounds if isinstance(domain, Target) else domain)
    arguments = {"domain": (low, high), "sigma": sigma}
    return _score("overshoot", arguments, arguments)


def limits(
    height: tuple[float, float] | None = None,
    within: tuple[Sequence[float], Sequence[float]] | None = None,
    sigma: float = 0.02,
) -> Score:
    """Score a scene by whether it keeps limits: 0 where it does; at least 12 nats less where it does not.

    Searches ask for it where a `requirements.toml` has these requirements.

    Parameters
    ----------
    height
        The least and the largest height of the scene, along y.
    within
        The low and the high corner of a box that all parts stay in.
    sigma
        Standard deviation of what is beyond the limits, as a share of them: smaller is stricter.
    """
    arguments: dict[str, Any] = {"sigma": real("sigma", sigma, 0)}
    if height is not None:
        low, high = (real("height", number, 0, ends="[)") for number in height)
        if low > high:
            raise bad("height", height, "the least height first", "(2.0, 3.0)")
        arguments["height"] = (low, high)
    if within is not None:
        arguments["within"] = _box("within", within)
    return _score("limits", arguments, arguments)


def _box(name: str, corners: Any) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Return the corners of a box that has an inside, else refuse them."""
    try:
        low, high = (_direction(name, corner, zero=True) for corner in corners)
    except (TypeError, ValueError):
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(corners),
            expected="a target, or the low and the high corner of a box",
            suggestion="such a box, for instance ((-5, 0, -5), (5, 10, 5))",
        ) from None
    if not all(a < b for a, b in zip(low, high, strict=True)):
        raise InputError(
            "bad-setting",
            name=name,
            found=f"{low} to {high}",
            expected="a low corner below the high one along x, y and z",
            suggestion="such a box, for instance ((-5, 0, -5), (5, 10, 5))",
        )
    return low, high


#: The functions that make sketches, by name, in the order of the engine's table. `niwaki.targets.asks` multiplies them
#: in this order: those that may forbid a scene come first. A name without a function above is a `KeyError`.
SKETCHES: dict[str, Callable[..., Score]] = {name: globals()[name] for name in _engine.SKETCHES}


def _score(
    function: str,
    arguments: dict[str, Any],
    settings: dict[str, Any],
    *,
    grid: _engine.Target | None = None,
    target: Target | None = None,
    view: View | None = None,
) -> Score:
    """Make the score of one sketch from its settings in the engine; `target` is the volume to fill."""
    seen = None if view is None else view.picture
    picture = seen if isinstance(seen, _engine.Picture) else None
    drawing = seen if isinstance(seen, _engine.Drawing) else None
    spec = _engine.SketchSpec(json.dumps({function: settings}), grid, picture, drawing)
    return Score((SketchCall(function, arguments, spec, grid),), target, () if view is None else (view,))


def _wish(image: Image, weight_image: Image | None) -> tuple[NDArray[np.bool_], NDArray[np.uint8] | None]:
    on = targets.images.silhouette(image)
    return on, None if weight_image is None else targets.images.weights(weight_image, on)


def _direction(name: str, value: Any, zero: bool = False) -> tuple[float, float, float]:
    try:
        x, y, z = (float(number) for number in value)
    except (TypeError, ValueError):
        x = y = z = float("nan")
    if not all(map(isfinite, (x, y, z))) or (not zero and x == y == z == 0):
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(value),
            expected="three finite numbers" + ("" if zero else ", not all zero"),
            suggestion="such numbers, for instance (0, -1, 0)",
        )
    return (x, y, z)


@contextmanager
def picture_errors(receiver: str = "") -> Iterator[None]:
    """Raise errors of views as `InputError` inside of this context."""
    try:
        yield
    except ValueError as error:
        code = getattr(error, "code", "")
        if code not in ("receiver-unseen", "light-grazes", "bad-camera"):
            raise
        raise InputError(code, reason=str(error), receiver=receiver) from None


def automatic_voxel(target: Target) -> float:
    """Return a cell size that gives about `CELLS` cells, to two digits."""
    x, y, z = (float(length) for length in target.size)
    return float(f"{(x * y * z / CELLS) ** (1 / 3):.2g}")


def check_count(name: str, value: int) -> int:
    """Return the number if it is an integer above zero, else refuse it."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
        raise bad(name, value, "a whole number of pixels, 1 or more", "such a number, for instance 50")
    return int(value)


def check_window(window: Any) -> Window:
    """Return two corners of the plane if the first is lower along x and y than the second, else refuse them."""
    try:
        (left, low), (right, high) = ((float(x), float(y)) for x, y in window)
    except (TypeError, ValueError):
        left = low = right = high = float("nan")
    inside = all(map(isfinite, (left, low, right, high))) and left < right and low < high
    if not inside:
        raise bad(
            "window",
            window,
            "a low corner (x, y) and a higher one",
            "such corners, for instance ((-12, -2), (12, 22))",
        )
    return (left, low), (right, high)


@contextmanager
def geometry_errors(target: Target, size: float) -> Iterator[None]:
    """Raise errors of geometry as `InputError` inside of this context."""
    name, cells = target.name, " x ".join(f"{length / size:.0f}" for length in target.size)
    try:
        yield
    except ValueError as error:
        code = getattr(error, "code", "")
        if code not in ("no-cell-filled", "too-many-cells"):
            raise
        raise InputError(code, path=name, size=f"{size:g}", found=cells) from None
