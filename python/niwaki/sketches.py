"""What a scene should be like: sketches as values that multiply, given by whoever runs a model and not by the model.

    score = no_self_intersection() * volume_match(target, voxel=0.25)

Log scores add. The order is the order of asking: cheap questions that may forbid a scene come first.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from niwaki import _engine
from niwaki.errors import InputError

if TYPE_CHECKING:
    from niwaki.target import Target

RULES = ("solid", "surface")

#: Cells of a grid whose size nobody gave: as fine as the eye wants, as coarse as the search likes.
CELLS = 65_000


@dataclass(frozen=True)
class Score:
    """A product of sketches.

    Attributes
    ----------
    specs : tuple of SketchSpec
        The engine's sketches, in the order of asking.
    settings : dict
        What they were made with, for the record of a run.
    target : Target or None
        What the scene should fill, for pictures.
    """

    specs: tuple[_engine.SketchSpec, ...] = ()
    settings: dict[str, Any] = field(default_factory=dict)
    target: Target | None = None

    def __mul__(self, other: Score) -> Score:
        if not isinstance(other, Score):
            return NotImplemented
        target = self.target if self.target is not None else other.target
        return Score(self.specs + other.specs, {**self.settings, **other.settings}, target)

    def __repr__(self) -> str:
        return " * ".join(spec.name for spec in self.specs) or "no score"


def no_self_intersection(rule: str = "solid") -> Score:
    """Forbids scenes in which two primitives intersect.

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
    return Score((_engine.no_self_intersection(rule),), {"rule": rule})


def volume_match(target: Target, voxel: float | None = None, sigma: float = 0.02) -> Score:
    """Scores a scene by how well it fills a target, cell by cell.

    Parameters
    ----------
    target
        What to fill.
    voxel
        Size of a cell, scene units; about 65 thousand cells around the target when left out.
    sigma
        Standard deviation of the share of cells that may be wrong: smaller is stricter.
    """
    size = check_positive("voxel", automatic_voxel(target) if voxel is None else voxel)
    check_positive("sigma", sigma)
    with geometry_errors(target, size):
        grid = _engine.Target(target.vertices, target.faces, size)
        spec = _engine.volume_match(grid, sigma)
    return Score((spec,), {"voxel": size, "sigma": sigma}, target)


def automatic_voxel(target: Target) -> float:
    """A cell size that gives about `CELLS` cells, to two digits."""
    x, y, z = (float(length) for length in target.size)
    return float(f"{(x * y * z / CELLS) ** (1 / 3):.2g}")


def check_positive(name: str, value: float) -> float:
    """The number, when it is finite and above zero."""
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if not number or not 0 < value < float("inf"):
        raise InputError(
            "bad-setting",
            name=name,
            found=repr(value),
            expected="a finite number above 0",
            suggestion="a positive number",
        )
    return float(value)


@contextmanager
def geometry_errors(target: Target, size: float) -> Iterator[None]:
    """Inside, what geometry refuses is raised as an `InputError`."""
    name, cells = target.name, " x ".join(f"{length / size:.0f}" for length in target.size)
    try:
        yield
    except ValueError as error:
        code = getattr(error, "code", "")
        codes = {"no-cell-filled": "no-cell-filled", "large-grid": "too-many-cells"}
        if code not in codes:
            raise
        raise InputError(codes[code], path=name, size=f"{size:g}", found=cells) from None
