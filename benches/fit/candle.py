"""A candle stand by somebody else: `candle_stand.scad`, an example of OpenSCAD by Amarjeet Singh Kapoor (CC0).

Its Customizer gives a range for one number and a list of lengths; the other ranges go from half of a number to twice
it, with rounder ends for three.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import Any

from .parameters import Values, choice, real, switch, whole
from .solids import Part, of_manifold

FILE = Path(__file__).with_name("candle_stand.scad")

# Solved: within 0.085 nats of the hidden stand's score.
CANDLE = [
    choice("length", "70", "50", "30"),
    real("radius", 12.5, 50.0),
    whole("count", 3, 14),
    switch("centerCandle"),
    real("candleSize", 3.5, 14.0),
    real("width", 2.0, 8.0),
    real("holeSize", 1.5, 6.0),
    real("CenterCandleWidth", 2.5, 8.0),
    real("heightOfSupport", 1.5, 6.0),
    real("widthOfSupport", 1.5, 6.0),
    real("heightOfRing", 2.0, 8.0),
    real("widthOfRing", 11.5, 46.0),
]


def candle(p: Values) -> list[Part]:
    import manifold3d
    from openscad_evaluator import Evaluator
    from openscad_lalr_parser import build_scopes, getASTfromString

    nodes: Any = getASTfromString(_written(p))
    bodies, _ = Evaluator().evaluate(nodes, build_scopes(nodes))
    solids = [body.body for body in bodies if body.body is not None]
    return of_manifold(manifold3d.Manifold.batch_boolean(solids, manifold3d.OpType.Add))


@lru_cache(1)
def _text() -> str:
    return FILE.read_text()


def _written(p: Values) -> str:
    text = _text()
    for name, value in p.items():
        word = str(value).lower() if isinstance(value, bool) else str(value)
        text = re.sub(rf"^{name}\s*=[^;]*;", f"{name} = {word};", text, count=1, flags=re.MULTILINE)
    return text
