"""Requirements that the parts of a script can keep: who violates each of them, and how far.

    collisions = false                          # whether parts may intersect
    within = [[-2, 0, -2], [2, 2.6, 2]]         # the lowest and the highest corner of the room
    supported = true                            # whether each part has to stand on the ground or on another part
    height = [2.0, 2.6]                         # the least and the largest height

They are the part of a `requirements.toml` that needs no search (`niwaki.shell.requirements` has the rest). Lengths are
in units of the scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from msgspec import Meta, Struct

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.schema import Unfit, fitted
from niwaki.errors.settings import bad
from niwaki.inputs.files import text_of
from niwaki.inputs.texts import toml_of
from niwaki.repairing.prediction import TOUCHING, Array, depths, overlaps
from niwaki.repairing.scripts import Violation, shapes_of
from niwaki.targets.sketches import no_self_intersection

Length = Annotated[float, Meta(ge=0.0)]
Corner = tuple[float, float, float]

#: What `repair` leaves to other commands.
ELSEWHERE = ("covered", "outside", "thinnest", "stands")


class Keep(Struct, frozen=True, forbid_unknown_fields=True):
    """Requirements for the parts of a script; None for those that do not count.

    Attributes
    ----------
    collisions : bool or None
        False: no two parts intersect.
    within : pair of corners or None
        Every part lies between the lowest and the highest corner.
    supported : bool or None
        True: every part stands on the ground (0 along the axis that points up) or on another part.
    height : pair of float or None
        The least and the largest height of all parts together.
    """

    collisions: bool | None = None
    within: tuple[Corner, Corner] | None = None
    supported: bool | None = None
    height: tuple[Length, Length] | None = None

    def violations(self, parts: Sequence[tuple[str, Any, Any]], boxes: Array, up: int) -> list[Violation]:
        """Return what parts violate.

        Parameters
        ----------
        parts
            Name, vertices and faces of each.
        boxes
            Their boxes, (parts, 2, 3).
        up
            The axis that points up.
        """
        names = [name for name, _, _ in parts]
        size = float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
        collisions = _collisions(parts, boxes, size) if self.collisions is False else []
        return collisions + self.of_boxes(names, boxes, up)

    def of_boxes(self, names: Sequence[str], boxes: Array, up: int) -> list[Violation]:
        """Return what boxes violate: all but collisions, which need the meshes."""
        size = float((boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)).max())
        out: list[Violation] = []
        if self.within is not None:
            low, high = np.array(self.within)
            off = np.maximum(low - boxes[:, 0], boxes[:, 1] - high).max(axis=1)
            out += [
                Violation("within", (name,), float(far))
                for name, far in zip(names, off, strict=True)
                if far > 1e-9 * size
            ]
        if self.supported:
            off = _unsupported(boxes, up)
            out += [
                Violation("supported", (name,), float(far))
                for name, far in zip(names, off, strict=True)
                if far > TOUCHING * size
            ]
        if self.height is not None:
            top = int(np.argmax(boxes[:, 1, up]))
            height = float(boxes[:, 1, up].max() - boxes[:, 0, up].min())
            amount = max(self.height[0] - height, height - self.height[1])
            if amount > 1e-9 * size:
                out.append(Violation("height", (names[top],), amount))
        return out


def keep_of(goal: Any) -> Keep:
    """Return requirements, read from a file if they are a path.

    Raises
    ------
    InputError
        `bad-requirements`.
    """
    if isinstance(goal, Keep):
        return goal
    if not isinstance(goal, str | PathLike):
        raise bad(
            "goal", goal, "`nw.Keep(...)`, the path of a requirements.toml, or a function", "`nw.Keep(...)`"
        )
    place = Path(goal)
    table = toml_of(text_of(place, "preset", "requirements"), place)
    try:
        other = next((name for name in ELSEWHERE if name in table), None)
        if other is not None:
            raise Unfit(f"$.{other}", "`collisions`, `within`, `supported` or `height`", f"`{other}`")
        rules: Keep = fitted(table, Keep)
        if rules.height is not None and rules.height[0] > rules.height[1]:
            raise Unfit("$.height", "the least height first", str(list(rules.height)))
        if rules.within is not None and not all(a < b for a, b in zip(*rules.within, strict=True)):
            raise Unfit("$.within", "the lowest corner first", str([list(corner) for corner in rules.within]))
        if rules == Keep():
            raise Unfit("$", "a requirement", "none")
    except Unfit as error:
        raise InputError("bad-requirements", path=place, reason=str(error)) from error
    return rules


def _collisions(parts: Sequence[tuple[str, Any, Any]], boxes: Array, size: float) -> list[Violation]:
    """Return the parts that intersect, by the side of a cube as large as what their boxes share."""
    deep, shared = depths(boxes[:, None], boxes[None]), overlaps(boxes[:, None], boxes[None])
    sketch = _engine.Sketch(no_self_intersection().specs)
    shapes = [shape for _, shape in shapes_of(parts)]
    if len(shapes) != len(parts):
        return []
    out = []
    for a, b in np.argwhere(np.triu(deep > 1e-9 * size, 1)):
        both = sketch.fork()
        if both.add(shapes[a]) is None and both.add(shapes[b]) is not None:
            out.append(Violation("collisions", (parts[a][0], parts[b][0]), float(shared[a, b])))
    return out


def _unsupported(boxes: Array, up: int) -> Array:
    """Return how far each part is above the ground, or above the highest part below its middle."""
    flat = [axis for axis in range(3) if axis != up]
    bottom, top, middle = boxes[:, 0, up], boxes[:, 1, up], boxes.mean(axis=1)[:, flat]
    out = np.abs(bottom)
    for number in range(len(boxes)):
        over = ((middle[number] >= boxes[:, 0, flat]) & (middle[number] <= boxes[:, 1, flat])).all(axis=1)
        over[number] = False
        if over.any():
            out[number] = min(out[number], float(np.abs(bottom[number] - top[over]).min()))
    return np.asarray(out)
