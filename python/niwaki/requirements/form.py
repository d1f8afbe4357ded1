"""Named parts with their boxes and their solids, on which requirements are measured."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from niwaki import _engine, stacks
from niwaki.draw.scene import Scene
from niwaki.errors import NiwakiError
from niwaki.once import cached_property
from niwaki.requirements.boxes import Array
from niwaki.result import Sample
from niwaki.targets.fit import Fit, fit
from niwaki.targets.sketches import Score
from niwaki.targets.target import Target

#: Places in a unit cube, evenly spread along all axes.
POINTS = np.stack(np.meshgrid(*[(np.arange(12) + 0.5) / 12] * 3), axis=-1).reshape(-1, 3)

#: Vertices and faces of a solid.
Mesh = tuple[Array, NDArray[np.int64]]
#: The name, the vertices and the faces of a part.
Part = tuple[str, Array, NDArray[np.int64]]


class Form:
    """Named parts, as requirements measure them.

    Parameters
    ----------
    names
        The parts.
    boxes
        Their boxes, (parts, 2, 3).
    solids
        Returns the solids of each part.
    shapes
        Returns the shapes of each part, for the engine.
    up
        The axis that points up.
    fit
        Returns how the parts fill a target, None without one.
    label
        Returns the name of a part for people.
    balance
        Returns whether forces hold all blocks, in words; None for parts that are no structure of blocks.
    """

    def __init__(
        self,
        names: Sequence[str],
        boxes: Array,
        solids: Callable[[], Sequence[Sequence[Mesh]]],
        shapes: Callable[[], Sequence[Sequence[_engine.Shape]]] = tuple,
        *,
        up: int = 1,
        fit: Callable[[], Fit | None] = lambda: None,
        label: Callable[[str], str] = str,
        balance: Callable[[], tuple[bool, str]] | None = None,
    ) -> None:
        self.names, self.boxes, self.up = tuple(names), boxes.reshape(-1, 2, 3), up
        self.shapes, self.label, self.balance = shapes, label, balance
        self._solids, self._fit = solids, fit
        self._known: dict[int, float] = {}
        self.target: Target | None = None

    @classmethod
    def of_sample(cls, sample: Sample) -> Form:
        """Return the scene of a run; its parts have their addresses as names."""
        parts = sample.scene.parts
        shapes = [list(part.shapes) for part in parts]
        boxes = [[np.min(rows, axis=0)[0], np.max(rows, axis=0)[1]] for rows in map(_boxes, shapes)]

        def solids() -> list[list[Mesh]]:
            meshes = iter(_engine.meshes([[shape] for row in shapes for shape in row], fine=True))
            return [[_mesh(*next(meshes)[:2]) for _ in row] for row in shapes]

        value = sample.value
        is_stack = hasattr(value, "blocks") and hasattr(value, "contacts")
        return cls(
            [part.address for part in parts],
            np.array(boxes, dtype=np.float64),
            solids,
            lambda: shapes,
            fit=lambda: sample.fit,
            label=sample.search.model.labels.label,
            balance=(lambda: _balance(sample)) if is_stack else None,
        )

    @classmethod
    def of_parts(cls, parts: Sequence[Part], up: int = 1, score: Score | None = None) -> Form:
        """Return parts of meshes, and how they fill the target of a score."""

        def shapes() -> list[list[_engine.Shape]]:
            return [
                [_engine.shape("mesh", np.ascontiguousarray(v), np.ascontiguousarray(f))] if len(f) else []
                for _, v, f in parts
            ]

        names = [name for name, _, _ in parts]
        form = cls(
            names,
            np.array([[v.min(axis=0), v.max(axis=0)] for _, v, _ in parts], dtype=np.float64),
            lambda: [pieces(v, f) for _, v, f in parts],
            shapes,
            up=up,
            fit=lambda: None if score is None else fit(score, _scene(names, shapes())),
        )
        form.target = None if score is None else score.target
        return form

    @classmethod
    def of_target(cls, target: Target) -> Form:
        """Return a target as one part, which fills itself."""
        part = (target.name, target.vertices, target.faces)
        form = cls.of_parts([part])
        form._fit = lambda: Fit(1.0, 0.0)
        return form

    def moved(self, boxes: Array) -> Form:
        """Return the parts moved and stretched into other boxes."""
        old = np.maximum(self.boxes[:, 1] - self.boxes[:, 0], 1e-300)
        scale = (boxes[:, 1] - boxes[:, 0]) / old

        def solids() -> list[list[Mesh]]:
            return [
                [((v - self.boxes[n, 0]) * scale[n] + boxes[n, 0], f) for v, f in row]
                for n, row in enumerate(self.solids)
            ]

        form = Form(self.names, boxes, solids, up=self.up, label=self.label, fit=lambda: self._fit_of(boxes))
        still = np.isclose(scale, 1.0, rtol=1e-12, atol=0.0).all(axis=1)
        # What only moves is as thick as before.
        form._known = {int(n): self.widths[n] for n in np.flatnonzero(still)}
        return form

    def _fit_of(self, boxes: Array) -> Fit | None:
        """Return about how parts in other boxes fill the target: its change is that of the boxes' own fit."""
        if self.fit is None or self.target is None:
            return None
        (covered, outside), (before, astray) = (_filled(self.target, now) for now in (boxes, self.boxes))
        change = (covered - before, outside - astray)
        now = np.clip(np.add((self.fit.covered, self.fit.outside), change), 0.0, 1.0)
        return Fit(float(now[0]), float(now[1]))

    @property
    def size(self) -> float:
        """The longest side of the box of all parts; 1 without parts."""
        if not len(self.boxes):
            return 1.0
        return float((self.boxes[:, 1].max(axis=0) - self.boxes[:, 0].min(axis=0)).max())

    @cached_property
    def solids(self) -> Sequence[Sequence[Mesh]]:
        """The solids of each part."""
        return self._solids()

    @cached_property
    def widths(self) -> list[float]:
        """The thickness of the thinnest solid of each part; infinity for a part without solids."""
        return [
            self._known[n] if n in self._known else min(map(thickness, self.solids[n]), default=np.inf)
            for n in range(len(self.names))
        ]

    @cached_property
    def fit(self) -> Fit | None:
        """How the parts fill the target; None without one."""
        return self._fit()


def pieces(vertices: Array, faces: NDArray[np.int64]) -> list[Mesh]:
    """Return the pieces of a mesh that share no vertex; where no faces share any, corners at one place are one."""
    if not len(faces):
        return []
    if len(np.unique(faces)) == faces.size:
        vertices, places = np.unique(vertices, axis=0, return_inverse=True)
        faces = places.reshape(-1)[faces]
    labels, known = np.arange(len(vertices)), np.zeros(0, np.int64)
    while not np.array_equal(labels, known):
        known = labels.copy()
        np.minimum.at(labels, faces, labels[faces].min(axis=1)[:, None])
        labels = labels[labels]
    of_faces = labels[faces[:, 0]]
    return [_mesh(vertices, faces[of_faces == label]) for label in np.unique(of_faces)]


def thickness(mesh: Mesh) -> float:
    """Return the least width of a solid along the normals of its faces: of a hollow one, not that of its wall."""
    vertices, faces = mesh
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = np.unique(np.round(normals[lengths > 0] / lengths[lengths > 0, None], 9), axis=0)
    if not len(normals):
        return 0.0
    along = vertices @ normals.T
    return float((along.max(axis=0) - along.min(axis=0)).min())


def _mesh(vertices: Array, faces: NDArray[Any]) -> Mesh:
    """Return a mesh without vertices that no face has."""
    used, corners = np.unique(faces, return_inverse=True)
    return vertices[used], corners.reshape(faces.shape)


def _scene(names: Sequence[str], shapes: Sequence[Sequence[_engine.Shape]]) -> Scene:
    return Scene([(name, row) for name, row in zip(names, shapes, strict=True) if row])


def _filled(target: Target, boxes: Array) -> tuple[float, float]:
    """Return the share of a target's box that boxes fill, and the share of the boxes outside of it."""
    low, high = target.bounds
    points = low + (high - low) * POINTS
    inside = ((points[:, None] >= boxes[:, 0]) & (points[:, None] <= boxes[:, 1])).all(axis=2).any(axis=1)
    share = float(inside.mean())
    volume = float(np.prod(boxes[:, 1] - boxes[:, 0], axis=1).sum())
    return share, max(0.0, 1.0 - share * float(np.prod(high - low)) / volume) if volume > 0.0 else 0.0


def _boxes(shapes: Sequence[_engine.Shape]) -> Array:
    return np.array([shape.aabb() for shape in shapes])


def _balance(sample: Sample) -> tuple[bool, str]:
    """Whether forces hold all blocks of a structure."""
    try:
        holds = stacks.balanced(stacks.Structure.of(sample), margin=False).holds
    except NiwakiError as error:
        return False, str(error).partition("\n")[0]
    return holds, "forces hold all blocks" if holds else "no forces hold all blocks"
