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
    ask, entry = question.ask, found.entry
    score, start, guide = nw.Score(), dict[str, Any](), None
    if ask.floor is not None:
        score *= nw.floor(ask.floor)
    for obstacle in ask.obstacles:
        score *= nw.avoid(placed(obstacle))
    if ask.sketch is not None and ask.sketch.camera is not None:
        score *= _seen(ask, ask.sketch)
    elif entry is not None and entry.draws is not None and entry.window is not None:
        score, start = _drawn(found, ask)
        guide = shipped(found.model)
    aim = None if ask.sketch is not None else ask.target or usual(found)
    voxel = entry.voxel if entry is not None and aim == usual(found) else None
    asked = {"target": target(aim), "score": score, "voxel": voxel, "guide": guide}
    return found, {**asked, **start, **question.arguments}


def arguments(question: Question) -> tuple[Any, ...]:
    """The model's arguments by position: those that are set, and those that a drawing gives."""
    found, settings = search(question)
    given = {name: settings[name] for name in settings if name not in ("target", "score", "voxel", "guide")}
    return tuple(positional(found.model, (), given))


def usual(found: ModelReference) -> TargetAsk | None:
    """The target of a gallery's model."""
    entry = found.entry
    return None if entry is None or entry.target_name is None else TargetAsk(f"gallery:{entry.target_name}")


def _drawn(found: ModelReference, ask: Ask) -> tuple[nw.Score, dict[str, Any]]:
    """The score of a model that draws in the plane, and where it starts."""
    entry = found.entry
    assert entry is not None and entry.window is not None
    if ask.sketch is not None:
        drawing = targets.drawing.Drawing.load(mask(ask.sketch, DRAWING_SIDE), None)
    elif entry.drawing_name is not None:
        drawing = targets.drawings.find(entry.drawing_name)
    else:
        assert entry.score is not None
        return entry.score(), {}
    start: dict[str, Any] = {}
    if {one for one in ("x", "y", "ahead")} <= set(found.model.core().parameters):
        start = dict(zip(("x", "y", "ahead"), drawing.place(entry.window), strict=True))
    return drawing.score(entry.window), start


def _seen(ask: Ask, sketch: Sketch) -> nw.Score:
    """The score of a silhouette, or of a shadow on the floor."""
    wanted, seen_by = mask(sketch, MASK_HEIGHT), camera(sketch)
    if sketch.kind == "silhouette":
        return nw.match_image(wanted, seen_by)
    # As far as the camera can see it well.
    (x, _, z), reach = seen_by.look_at, 4.0 * dist(seen_by.position, seen_by.look_at)
    ground = nw.Receiver.floor(ask.floor or 0.0, (x - reach, z - reach), (x + reach, z + reach))
    return nw.match_shadow(wanted, ask.light, ground, seen_by)


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


def target(ask: TargetAsk | None) -> nw.Target | None:
    """A target where it is placed; the very one that was named where it has not been moved."""
    return None if ask is None else placed(ask)


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
