"""Goals as arguments of `niwaki.grow`: a target, a score, and the arguments that a drawing sets."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import cos, dist, radians, sin
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

import niwaki as nw
from niwaki import targets
from niwaki.errors import InputError
from niwaki.lang.compiled import arguments as positional
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import Ask, Question, Sketch, Stroke, TargetAsk
from niwaki.studio.worker.models import reference
from niwaki.studio.worker.primitives import PRIMITIVES, primitive
from niwaki.studio.worker.thinning import Ghost, stood

Point = tuple[float, float, float]

#: Pixels: the height of a mask drawn by hand, and the longer side of a drawing in the plane.
MASK_HEIGHT, DRAWING_SIDE = 96, 50
#: The gap between the ends of a closed outline, as a share of its length; the grey of all that is outside outlines.
GAP, OUTSIDE = 0.12, 100


def search(question: Question) -> tuple[ModelReference, dict[str, Any]]:
    """Return the model of a question, and the settings of `niwaki.grow` with its goals."""
    model = reference(question.model)
    ask = question.ask
    options: dict[str, Any] = {"floor": ask.floor, "avoid": [placed(solid) for solid in ask.obstacles]}
    if ask.sketch is not None:
        options |= _sketch_options(ask, ask.sketch)
    elif ask.target is not None and ask.target != usual(model):
        options["target"] = placed(ask.target)
    goals = model.terms(options)
    return model, {
        "score": targets.asks.score(goals, targets.sketches.volume_score),
        **model.start(goals),
        **question.arguments,
    }


def arguments(question: Question) -> tuple[Any, ...]:
    """Return the model's arguments by position: the user's arguments, and the arguments that a drawing sets."""
    model = reference(question.model)
    values = search(question)[1] if model.follows else question.arguments
    named = {name: value for name, value in values.items() if name != "score"}
    return tuple(positional(model.model, (), named))


def usual(model: ModelReference) -> TargetAsk | None:
    """Return the usual target of a model of the gallery."""
    entry = model.entry
    return None if entry is None or entry.target_name is None else TargetAsk(f"gallery:{entry.target_name}")


def _sketch_options(ask: Ask, sketch: Sketch) -> dict[str, Any]:
    """Return the options for a drawing in the plane, a silhouette, or a shadow on the floor."""
    if sketch.camera is None:
        return {"match_image": mask(sketch)}
    image, seen_by = mask(sketch), camera(sketch)
    if sketch.kind == "silhouette":
        return {"match_image": image, "camera": seen_by}
    # The part of the floor that the camera sees well.
    (x, _, z), reach = seen_by.look_at, 4.0 * dist(seen_by.position, seen_by.look_at)
    ground = nw.Receiver.floor(ask.floor or 0.0, (x - reach, z - reach), (x + reach, z + reach))
    return {"match_shadow": image, "camera": seen_by, "light": ask.light, "receiver": ground}


def mask(sketch: Sketch) -> NDArray[np.bool_]:
    """Draw a sketch as the mask that is scored, (rows, columns)."""
    height = DRAWING_SIDE if sketch.camera is None else MASK_HEIGHT
    fine = 4 * height
    picture = Image.new("L", (max(8, round(fine * sketch.aspect)), fine), 0)
    pen = ImageDraw.Draw(picture)
    for stroke in sketch.strokes:
        wide = stroke.width * fine
        points = [(x * fine, y * fine) for x, y in stroke.points]
        if sketch.inside and _is_closed(stroke):
            points.append(points[0])
        if len(points) > 1:
            pen.line(points, fill=255, width=max(1, round(wide)), joint="curve")
        for x, y in (points[0], points[-1]):
            pen.ellipse((x - wide / 2, y - wide / 2, x + wide / 2, y + wide / 2), fill=255)
    if sketch.inside:
        picture = _filled(picture)
    small = picture.resize((max(2, round(height * sketch.aspect)), height), Image.Resampling.BOX)
    return np.asarray(small) > 127


def _is_closed(stroke: Stroke) -> bool:
    """Whether a stroke ends near its beginning, so that it is an outline: hands rarely meet the point itself."""
    points = np.array(stroke.points)
    gap = float(np.linalg.norm(points[-1] - points[0]))
    length = float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    return length > 4.0 * stroke.width and gap <= max(1.5 * stroke.width, GAP * length)


def _filled(picture: Image.Image) -> Image.Image:
    """Fill what strokes enclose: all that the edge of the picture does not reach."""
    wide, high = picture.size
    around = Image.new("L", (wide + 2, high + 2), 0)
    around.paste(picture, (1, 1))
    ImageDraw.floodfill(around, (0, 0), OUTSIDE)
    return around.point([0 if level == OUTSIDE else 255 for level in range(256)]).crop(
        (1, 1, wide + 1, high + 1)
    )


def camera(sketch: Sketch) -> nw.Camera:
    """Return the camera of a sketch."""
    eye = sketch.camera
    assert eye is not None
    return nw.Camera.perspective(eye.position, eye.look_at, eye.up, fov_degrees=eye.fov)


def placed(ask: TargetAsk) -> nw.Target:
    """Return a target at its place."""
    base = _load(ask.source, ask.up)
    place = Placement(ask, base.bounds)
    return base if place.is_at_rest else nw.Target(place(base.vertices), base.faces, base.name)


def shown(ask: TargetAsk) -> tuple[Ghost, Point]:
    """Return the ghost of a target at its place, and the middle of its base, about which it is turned and scaled."""
    mesh = Path(ask.source)
    beside = Ghost.beside(mesh) if mesh.is_absolute() else None
    base = Ghost.of(_load(ask.source, ask.up)) if beside is None else beside.stood(ask.up)
    place = Placement(ask, base.bounds)
    corners = np.array(
        [[x, y, z] for x in base.bounds[:, 0] for y in base.bounds[:, 1] for z in base.bounds[:, 2]]
    )
    bounds = base.bounds
    if not place.is_at_rest:
        moved = place(base.vertices if ask.turn else corners)
        bounds = np.array([moved.min(axis=0), moved.max(axis=0)])
    return replace(base, vertices=place(base.vertices), bounds=bounds), place.foot


class Placement:
    """The placement of a target: scaled and turned about the middle of its base, then moved."""

    def __init__(self, ask: TargetAsk, bounds: NDArray[np.float64]) -> None:
        low, high = bounds
        self._ask = ask
        self._base = np.array([(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2])
        self.is_at_rest = (ask.move, ask.scale, ask.turn) == ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), 0.0)

    @property
    def foot(self) -> Point:
        """The point at which the middle of the base stands."""
        x, y, z = (self._base + np.array(self._ask.move)).tolist()
        return x, y, z

    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Move points to the place of the target."""
        if self.is_at_rest:
            return points
        angle = radians(self._ask.turn)
        turn = np.array([[cos(angle), 0.0, sin(angle)], [0.0, 1.0, 0.0], [-sin(angle), 0.0, cos(angle)]])
        moved: NDArray[np.float64] = ((points - self._base) * np.array(self._ask.scale)) @ turn.T
        moved += np.array(self.foot)
        return moved


@lru_cache(maxsize=4)
def _load(source: str, up: Literal["y", "z"]) -> nw.Target:
    """Load the target of a source, and stand it up if its z axis points up."""
    target = _target(source)
    return target if up == "y" else nw.Target(stood(target.vertices), target.faces, target.name)


def _target(source: str) -> nw.Target:
    """Load the target of a source: a primitive, a target of the gallery, or an uploaded file."""
    if source in PRIMITIVES:
        return primitive(source)
    if source.startswith("gallery:"):
        return nw.Target.find(source)
    # The server has replaced `upload:HASH` by the path of the file.
    if not Path(source).is_file():
        raise InputError("no-target", name=source)
    return nw.Target.load(source)
