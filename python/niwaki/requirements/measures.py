"""How far a form violates each requirement.

A measure is a function of what is required and of a form. It returns the violations, and what there is in words.
Amounts are lengths; a share counts as this share of the form's size.
"""

from __future__ import annotations

from itertools import chain

import numpy as np

from niwaki import _engine
from niwaki.requirements.boxes import EXACT, TOUCHING, Array, depths, overlaps
from niwaki.requirements.form import Form, Mesh
from niwaki.requirements.rows import Violation
from niwaki.shares import percent
from niwaki.targets.pieces import joined
from niwaki.targets.sketches import no_self_intersection

Measured = tuple[list[Violation], str]
Corner = tuple[float, float, float]

#: Points this close to the lowest point, as a share of the height, touch the ground.
CONTACT = 0.01
#: The most parts that are compared with one another, and the most that a text names.
PARTS, SHOWN = 1_000, 3
#: What a share is measured against, where there is none.
NO_TARGET = "there is no target"


def covered(least: float, form: Form) -> Measured:
    """Measure the share of the target that the form fills."""
    if form.fit is None:
        return [Violation("covered", (), form.size)], NO_TARGET
    lack = (least - form.fit.covered) * form.size
    words = f"{percent(form.fit.covered)} covered"
    return [Violation("covered", (), lack)] if lack > 0.0 else [], words


def outside(most: float, form: Form) -> Measured:
    """Measure the share of the form outside of the target."""
    if form.fit is None:
        return [Violation("outside", (), form.size)], NO_TARGET
    excess = (form.fit.outside - most) * form.size
    words = f"{percent(form.fit.outside)} outside"
    return [Violation("outside", (), excess)] if excess > 0.0 else [], words


def height(limits: tuple[float, float], form: Form) -> Measured:
    """Measure the height of all parts together; the highest part is named."""
    low, high = limits
    tops, bottoms = form.boxes[:, 1, form.up], form.boxes[:, 0, form.up]
    high_now = float(tops.max() - bottoms.min()) if len(tops) else 0.0
    amount = max(low - high_now, high_now - high)
    top = (form.names[int(np.argmax(tops))],) if len(tops) else ()
    violations = [Violation("height", top, amount)] if amount > EXACT * form.size else []
    return violations, f"height {high_now:.4g}"


def within(corners: tuple[Corner, Corner], form: Form) -> Measured:
    """Measure how far each part reaches out of a box."""
    low, high = np.array(corners)
    off = np.maximum(low - form.boxes[:, 0], form.boxes[:, 1] - high).max(axis=1, initial=-np.inf)
    return _of_parts("within", form, off, EXACT, "reaches {:.4g} outside", "all parts inside")


def supported(_: bool, form: Form) -> Measured:
    """Measure how far each part is above the ground, or above the highest part below its middle."""
    up, flat = form.up, [axis for axis in range(3) if axis != form.up]
    bottom, top, middle = form.boxes[:, 0, up], form.boxes[:, 1, up], form.boxes.mean(axis=1)[:, flat]
    off = np.abs(bottom)
    for number in range(len(off)):
        over = ((middle[number] >= form.boxes[:, 0, flat]) & (middle[number] <= form.boxes[:, 1, flat])).all(
            axis=1
        )
        over[number] = False
        if over.any():
            off[number] = min(off[number], float(np.abs(bottom[number] - top[over]).min()))
    return _of_parts("supported", form, off, TOUCHING, "hangs by {:.4g}", "all parts supported")


def thinnest(least: float, form: Form) -> Measured:
    """Measure the thinnest solid of each part."""
    rows = [(width, name) for width, name in zip(form.widths, form.names, strict=True) if width < np.inf]
    if not rows:
        return [], "no parts"
    # A width is a difference of coordinates, which rounds.
    violations = [
        Violation("thinnest", (name,), least - width) for width, name in rows if width < least * (1.0 - EXACT)
    ]
    width, name = min(rows)
    return violations, f"{form.label(name)} is {width:.4g} thick"


def stands(_: bool, form: Form) -> Measured:
    """Measure whether a form stands: blocks by the forces between them, else as one solid on its lowest points."""
    if form.balance is not None:
        holds, words = form.balance()
        return [] if holds else [Violation("stands", (), form.size)], words
    if not len(form.boxes):
        return [Violation("stands", (), form.size)], "the scene is empty"
    vertices, faces = joined(list(chain.from_iterable(form.solids)))
    heights, flat = vertices[:, form.up], [axis for axis in range(3) if axis != form.up]
    low, high = heights.min(), heights.max()
    feet = vertices[heights <= low + CONTACT * (high - low)][:, flat]
    over = _overhang(feet, _middle((vertices, faces))[flat])
    if over <= 0.0:
        return [], "its weight is above its feet"
    return [Violation("stands", (), over)], f"its weight is {over:.4g} beside its feet"


def collisions(_: bool, form: Form) -> Measured:
    """Measure parts that intersect, by the side of a cube as large as what their boxes share."""
    boxes, shapes = form.boxes[:PARTS], form.shapes()
    deep, shared = depths(boxes[:, None], boxes[None]), overlaps(boxes[:, None], boxes[None])
    sketch = _engine.Sketch(no_self_intersection().specs)
    out = []
    for a, b in np.argwhere(np.triu(deep >= 0.0, 1)):
        both = sketch.fork()
        both.add(shapes[a])
        if both.add(shapes[b]) is not None:
            out.append(Violation("collisions", (form.names[a], form.names[b]), float(shared[a, b])))
    if not out:
        return [], "no parts intersect"
    involved = {name for row in out for name in row.parts}
    names = [form.label(name) for name in form.names if name in involved]
    return out, f"{', '.join(names[:SHOWN])} intersect"


def _of_parts(name: str, form: Form, amounts: Array, share: float, words: str, good: str) -> Measured:
    """Return the parts whose amounts are above a share of the form's size; the worst of them in words."""
    bad = np.flatnonzero(amounts > share * form.size)
    violations = [Violation(name, (form.names[n],), float(amounts[n])) for n in bad]
    if not violations:
        return [], good
    worst = max(violations, key=lambda row: row.amount)
    return violations, f"{form.label(worst.parts[0])} {words.format(worst.amount)}"


def _middle(mesh: Mesh) -> Array:
    """Return the centre of mass of closed surfaces of one density."""
    vertices, faces = mesh
    a, b, c = (vertices[faces[:, corner]] for corner in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    if not abs(volumes.sum()) > 0.0:
        return np.asarray(vertices.mean(axis=0), dtype=np.float64)
    middle: Array = ((a + b + c) * volumes[:, None]).sum(axis=0) / (4.0 * volumes.sum())
    return middle


def _overhang(points: Array, at: Array) -> float:
    """Return how far a point of the plane lies outside of the convex hull of points; 0 or less inside."""
    hull = _hull(points)
    if len(hull) < 3:
        start, along = hull[0], hull[-1] - hull[0]
        share = np.clip((at - start) @ along / max(along @ along, 1e-300), 0.0, 1.0)
        return float(np.linalg.norm(at - start - share * along))
    edges = np.roll(hull, -1, axis=0) - hull
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / np.linalg.norm(edges, axis=1)[:, None]
    return float(((at - hull) * normals).sum(axis=1).max())


def _hull(points: Array) -> Array:
    """Return the corners of the convex hull of points of the plane, counterclockwise (Andrew's monotone chain)."""
    ordered = np.unique(points, axis=0)
    chains = []
    for row in (ordered, ordered[::-1]):
        corners: list[Array] = []
        for point in row:
            while len(corners) > 1:
                (ax, ay), (bx, by) = corners[-1] - corners[-2], point - corners[-2]
                if ax * by - ay * bx > 0.0:
                    break
                corners.pop()
            corners.append(point)
        chains += corners[:-1]
    return np.array(chains) if chains else ordered
