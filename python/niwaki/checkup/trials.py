"""What must work, tried: an exact search, a scene grown into a target, and its files.

A trial returns nothing, or raises an error that says what does not work.
"""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from niwaki import _engine
from niwaki.lang.models import model
from niwaki.methods import enumerate_all, smc
from niwaki.search import run
from niwaki.targets.sketches import match_volume
from niwaki.targets.target import Target
from niwaki.words import box, condition, emit, flip, uniform


@model
def coins() -> Any:
    """Two coins that do not both show tails: whether the first shows heads."""
    first = flip(0.5)
    condition(first or flip(0.5))
    return first


@model
def block() -> Any:
    """A block of any width."""
    width = uniform(0.5, 2.0)
    emit(box((0.0, 0.0, 0.0), (width, 1.0, 1.0)))
    return width


def exact() -> None:
    """Compile a model and enumerate its runs; the first coin shows heads in two of three."""
    found = run(coins, method=enumerate_all()).to_its_end().distribution()[True]
    if not math.isclose(found, 2.0 / 3.0, rel_tol=1e-9):
        raise ArithmeticError(f"the probability of two of three is {found!r}")


def grown() -> None:
    """Grow a block into a target, draw it and write it as a mesh."""
    target = Target.of_shapes(box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)))
    result = run(block, method=smc(20), score=match_volume(target, voxel=0.125), seed=1).to_its_end()
    with TemporaryDirectory(prefix="niwaki-doctor-") as folder:
        files = [
            result.best.save(Path(folder, "block.png"), size=(32, 24)),
            result.export(Path(folder, "block.glb")),
        ]
        for file in files:
            if file.stat().st_size == 0:
                raise OSError(f"{file.name} is empty")


def one_version(package: str) -> None:
    """Hold the version of the engine against that of the package."""
    if _engine.__version__ != package:
        raise ImportError(f"the engine is of version {_engine.__version__}, the package of version {package}")
