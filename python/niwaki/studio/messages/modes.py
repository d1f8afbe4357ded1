"""What clients are told of drawings that are coloured and of structures that stand."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

from niwaki.studio.messages.document import Key, Point
from niwaki.studio.messages.events import Event


class KeptRule(Struct):
    """How well a colouring keeps a rule, in words and in units."""

    kind: str
    first: str
    second: str
    text: str
    holds: bool
    #: How far it is from holding: CIELAB units, of "same-hue" degrees.
    residual: float


class Palette(Event, tag="palette"):
    """The colours of a result by region, and its rules."""

    key: Key | None = None
    colors: dict[str, str] = {}
    kept: list[KeptRule] = []


class Picture(Event, tag="picture"):
    """The header of a frame with a PNG: a drawing in the colours of a result."""

    what: Literal["result", "moving"] = "result"
    key: Key | None = None
    detail: Literal["light", "fine"] = "light"


class Regions(Event, tag="regions"):
    """The header of a frame with the number of each pixel's region in the model's list, (height, width) uint16.

    Pixels of no region have 65535. After them comes a PNG of the drawing in its own colours.
    """

    what: Literal["ghost"] = "ghost"
    width: int = 0
    height: int = 0


class Arrow(Struct):
    """A force in the scene: where it acts, and its size and direction in mean weights of a block."""

    at: Point
    force: Point


class Judged(Event, tag="judged"):
    """Whether a structure stands.

    Attributes
    ----------
    holds
        Whether there are forces that hold every block.
    tilt
        Degrees by which its ground can be tilted, in the worst direction.
    loose
        Parts that nothing holds.
    arrows
        What each contact carries.
    stands, moved, fallen
        Of the simulation, None where there was none: whether it stands, how far the farthest block went (a share of its
        size), and which went too far.
    board
        Thickness of the board that its pieces are cut of, millimetres; None where they cannot be cut.
    text
        All of this in words.
    """

    key: Key | None = None
    holds: bool = False
    tilt: float = 0.0
    loose: list[str] = []
    arrows: list[Arrow] = []
    stands: bool | None = None
    moved: float | None = None
    fallen: list[str] = []
    board: float | None = None
    text: str = ""
