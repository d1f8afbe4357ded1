"""Tests of the core: an exact search, a scene that grows into a target, and its files.

A test that fails raises an error with the reason.
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
    """Toss two coins that do not both show tails; return whether the first shows heads."""
    first = flip(0.5)
    condition(first or flip(0.5))
    return first


@model
def block() -> Any:
    """Emit a block of a random width."""
    width = uniform(0.5, 2.0)
    emit(box((0.0, 0.0, 0.0), (width, 1.0, 1.0)))
    return width


def exact() -> None:
    """Compile a model and enumerate its runs; the first coin shows heads with probability 2/3."""
    probability = run(coins, method=enumerate_all()).to_its_end().distribution()[True]
    if not math.isclose(probability, 2.0 / 3.0, rel_tol=1e-9):
        raise ArithmeticError(f"the probability is {probability!r}, not 2/3")


def growth() -> None:
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


def same_version(package: str) -> None:
    """Compare the version of the engine with the version of the package."""
    if _engine.__version__ != package:
        raise ImportError(f"the engine has version {_engine.__version__}, the package has version {package}")
