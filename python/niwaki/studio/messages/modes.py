"""Events about colourings and structures."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

from niwaki.studio.messages.document import Key, Point
from niwaki.studio.messages.events import Event


class RuleResult(Struct):
    """How well a colouring keeps a rule, in words and in units."""

    kind: str
    first: str
    second: str
    text: str
    holds: bool
    #: The distance from holding: CIELAB units; degrees for "same-hue".
    residual: float


class Palette(Event, tag="palette"):
    """The colours of a result by region, and how well it keeps the rules."""

    key: Key | None = None
    colors: dict[str, str] = {}
    rules: list[RuleResult] = []


class Picture(Event, tag="picture"):
    """The header of a frame with a PNG: a drawing in the colours of a result."""

    role: Literal["result", "moving"] = "result"
    key: Key | None = None
    detail: Literal["light", "fine"] = "light"


class Regions(Event, tag="regions"):
    """The header of a frame with the number of each pixel's region in the model's list, (height, width) uint16.

    Pixels without a region have 65535. A PNG of the drawing in its own colours follows.
    """

    role: Literal["ghost"] = "ghost"
    width: int = 0
    height: int = 0


class Arrow(Struct):
    """A force in the scene: its point, and its size and direction in mean weights of a block."""

    at: Point
    force: Point


class Judged(Event, tag="judged"):
    """The check of a structure: whether it stands.

    Attributes
    ----------
    holds
        Whether forces can hold every block.
    tilt
        Degrees by which the ground can be tilted, in the worst direction.
    loose
        Parts without support.
    arrows
        The force at each contact.
    stands, moved, fallen
        Results of the simulation, None without a simulation: whether the structure stands, the largest distance that a
        block moved (a share of its size), and the blocks that moved too far.
    board
        Thickness of the board for cutting the pieces, millimetres; None if they cannot be cut.
    text
        The check in words.
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
