"""What is asked, as what `niwaki.grow` takes: a target, a score, and the arguments that a drawing gives."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import cos, dist, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from PIL import Image, ImageDraw

import niwaki as nw
from niwaki import targets
from niwaki.errors import InputError
from niwaki.guides import shipped
from niwaki.lang.compiled import arguments as positional
from niwaki.shell.references import ModelReference
from niwaki.studio.messages import Ask, Question, Sketch, TargetAsk
from niwaki.studio.worker.models import reference
from niwaki.studio.worker.thinning import Ghost

Point = tuple[float, float, float]

#: Pixels of the height of a mask that was drawn by hand, and of the longer side of a drawing in the plane.
MASK_HEIGHT, DRAWING_SIDE = 96, 50

#: Primitives to build a target from: unit size, on the ground.
PRIMITIVES = {
    "box": lambda: trimesh.creation.box((1.0, 1.0, 1.0)),
    "ball": lambda: trimesh.creation.icosphere(3, 0.5),
    "column": lambda: trimesh.creation.cylinder(0.5, 1.0, sections=48),
}


def search(question: Question) -> tuple[ModelReference, dict[str, Any]]:
    """The model, and the settings of `niwaki.grow` that say what is asked of it."""
    found = reference(question.model)
    ask = question.ask
    options: dict[str, Any] = {"floor": ask.floor, "avoid": [placed(one) for one in ask.obstacles]}
    if ask.sketch is not None:
        options |= _drawn(ask, ask.sketch)
    elif ask.target is not None and ask.target != usual(found):
        options["target"] = placed(ask.target)
    asked = found.asked(options)
    guide = shipped(found.model) if found.style is not None and "camera" not in options else None
    return found, {
        "score": targets.asks.score(asked),
        "guide": guide,
        **found.start(asked),
        **question.arguments,
    }


def arguments(question: Question) -> tuple[Any, ...]:
    """The model's arguments by position: those that are set, and those that a drawing gives."""
    found = reference(question.model)
    given = search(question)[1] if found.follows else question.arguments
    own = {name: value for name, value in given.items() if name not in ("score", "guide")}
    return tuple(positional(found.model, (), own))


def usual(found: ModelReference) -> TargetAsk | None:
    """The target of a gallery's model."""
    entry = found.entry
    return None if entry is None or entry.target_name is None else TargetAsk(f"gallery:{entry.target_name}")


def _drawn(ask: Ask, sketch: Sketch) -> dict[str, Any]:
    """The options of a drawing in the plane, of a silhouette, or of a shadow on the floor."""
    if sketch.camera is None:
        return {"match_image": mask(sketch, DRAWING_SIDE)}
    wanted, seen_by = mask(sketch, MASK_HEIGHT), camera(sketch)
    if sketch.kind == "silhouette":
        return {"match_image": wanted, "camera": seen_by}
    # As far as the camera can see it well.
    (x, _, z), reach = seen_by.look_at, 4.0 * dist(seen_by.position, seen_by.look_at)
    ground = nw.Receiver.floor(ask.floor or 0.0, (x - reach, z - reach), (x + reach, z + reach))
    return {"match_shadow": wanted, "camera": seen_by, "light": ask.light, "receiver": ground}


def mask(sketch: Sketch, height: int) -> NDArray[np.bool_]:
    """Where the strokes are, (height, columns)."""
    fine = 4 * height
    picture = Image.new("L", (max(8, round(fine * sketch.aspect)), fine), 0)
    pen = ImageDraw.Draw(picture)
    for stroke in sketch.strokes:
        wide = stroke.width * fine
        points = [(x * fine, y * fine) for x, y in stroke.points]
        if len(points) > 1:
            pen.line(points, fill=255, width=max(1, round(wide)), joint="curve")
        for x, y in (points[0], points[-1]):
            pen.ellipse((x - wide / 2, y - wide / 2, x + wide / 2, y + wide / 2), fill=255)
    small = picture.resize((max(2, round(height * sketch.aspect)), height), Image.Resampling.BOX)
    return np.asarray(small) > 127


def camera(sketch: Sketch) -> nw.Camera:
    """The camera over whose view a sketch was drawn."""
    eye = sketch.camera
    assert eye is not None
    return nw.Camera.perspective(eye.position, eye.look_at, eye.up, fov_degrees=eye.fov)


def placed(ask: TargetAsk) -> nw.Target:
    """A target where it is placed."""
    base = _named(ask.source)
    place = Placing(ask, base.bounds)
    return base if place.is_at_rest else nw.Target(place(base.vertices), base.faces, base.name)


def shown(ask: TargetAsk) -> tuple[Ghost, Point]:
    """What is shown of a target where it is placed, and the middle of its base, about which it is turned and scaled."""
    mesh = Path(ask.source)
    base = (Ghost.beside(mesh) if mesh.is_absolute() else None) or Ghost.of(_named(ask.source))
    place = Placing(ask, base.bounds)
    corners = np.array(
        [[x, y, z] for x in base.bounds[:, 0] for y in base.bounds[:, 1] for z in base.bounds[:, 2]]
    )
    bounds = base.bounds
    if not place.is_at_rest:
        moved = place(base.vertices if ask.turn else corners)
        bounds = np.array([moved.min(axis=0), moved.max(axis=0)])
    return replace(base, vertices=place(base.vertices), bounds=bounds), place.foot


class Placing:
    """How a target is scaled and turned about the middle of its base, and moved."""

    def __init__(self, ask: TargetAsk, bounds: NDArray[np.float64]) -> None:
        low, high = bounds
        self._ask = ask
        self._base = np.array([(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2])
        self.is_at_rest = (ask.move, ask.scale, ask.turn) == ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), 0.0)

    @property
    def foot(self) -> Point:
        """Where the middle of the base stands."""
        x, y, z = (self._base + np.array(self._ask.move)).tolist()
        return x, y, z

    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points where they are placed."""
        if self.is_at_rest:
            return points
        angle = radians(self._ask.turn)
        turn = np.array([[cos(angle), 0.0, sin(angle)], [0.0, 1.0, 0.0], [-sin(angle), 0.0, cos(angle)]])
        moved: NDArray[np.float64] = ((points - self._base) * np.array(self._ask.scale)) @ turn.T
        moved += np.array(self.foot)
        return moved


@lru_cache(maxsize=4)
def _named(source: str) -> nw.Target:
    """The target of a source: a primitive, one of the gallery, or a file that was sent."""
    if source in PRIMITIVES:
        mesh = PRIMITIVES[source]()
        if source == "column":
            # From along z to along y.
            mesh.apply_transform([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
        mesh.apply_translation((0.0, -mesh.bounds[0][1], 0.0))
        return nw.Target(mesh.vertices, mesh.faces, source)
    if source.startswith("gallery:"):
        return nw.Target.find(source)
    # The server has put the file's path in place of `upload:HASH`.
    if not Path(source).is_file():
        raise InputError("no-target", name=source)
    return nw.Target.load(source)
