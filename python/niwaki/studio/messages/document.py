"""The parts of a session's document: what is asked, how it is searched for, and what came of it."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

Text = Annotated[str, Meta(max_length=2_000)]
Address = Annotated[str, Meta(max_length=2_000)]
Share = Annotated[float, Meta(ge=-10.0, le=10.0)]
Length = Annotated[float, Meta(ge=-1e9, le=1e9)]
Point = tuple[Length, Length, Length]
Addresses = Annotated[list[Address], Meta(max_length=10_000)]
Count = Annotated[int, Meta(ge=1, le=48)]
Seed = Annotated[int, Meta(ge=0, lt=2**53)]
Effort = Annotated[float, Meta(gt=0.0, le=64.0)]
#: Values of choices by address, as `niwaki.search.data.Writer` writes them.
Choices = dict[str, Any]


class TargetAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """A solid in the scene, to fill or to avoid: where it comes from, and how it is placed.

    Attributes
    ----------
    source
        `gallery:NAME`, `upload:SHA256`, or a primitive: `box`, `ball`, `column`.
    move, scale
        Scene units; times, along x, y and z. Scaled and turned about the middle of its base, then moved.
    turn
        Degrees about y.
    """

    source: Text
    move: Point = (0.0, 0.0, 0.0)
    scale: tuple[
        Annotated[float, Meta(gt=0.0, le=1e6)],
        Annotated[float, Meta(gt=0.0, le=1e6)],
        Annotated[float, Meta(gt=0.0, le=1e6)],
    ] = (1.0, 1.0, 1.0)
    turn: Length = 0.0


Obstacles = Annotated[list[TargetAsk], Meta(max_length=16)]
Light = tuple[
    Annotated[float, Meta(ge=-1.0, le=1.0)],
    Annotated[float, Meta(ge=-1.0, le=-0.02)],
    Annotated[float, Meta(ge=-1.0, le=1.0)],
]


class Eye(Struct, frozen=True, forbid_unknown_fields=True):
    """A perspective camera; `fov` is vertical, degrees."""

    position: Point
    look_at: Point
    up: Point
    fov: Annotated[float, Meta(gt=0.0, lt=180.0)]


class Stroke(Struct, frozen=True, forbid_unknown_fields=True):
    """A line of a pen: points as shares of the picture's height from its upper left corner, and the pen's width."""

    points: Annotated[list[tuple[Share, Share]], Meta(min_length=1, max_length=20_000)]
    width: Annotated[float, Meta(gt=0.0, le=1.0)] = 0.05


class Sketch(Struct, frozen=True, forbid_unknown_fields=True):
    """A silhouette or a shadow drawn by hand, over the view of a camera.

    Attributes
    ----------
    aspect
        Width of the picture over its height.
    camera
        What saw it; None for a drawing in the plane.
    kind
        What the strokes are: the scene itself as the camera sees it, or its shadow on the floor.
    """

    strokes: Annotated[list[Stroke], Meta(min_length=1, max_length=500)]
    aspect: Annotated[float, Meta(gt=0.1, lt=10.0)]
    camera: Eye | None = None
    kind: Literal["silhouette", "shadow"] = "silhouette"


class Ask(Struct, frozen=True, forbid_unknown_fields=True):
    """What a scene should be like; with no target and no sketch, what the model of the gallery is usually asked.

    Attributes
    ----------
    floor
        Nothing reaches below this height.
    obstacles
        Solids that nothing comes near.
    light
        The direction in which the light travels that casts a shadow.
    """

    target: TargetAsk | None = None
    sketch: Sketch | None = None
    floor: Length | None = None
    obstacles: Obstacles = []
    light: Light = (-0.55, -1.0, -0.5)


class Settings(Struct, frozen=True, forbid_unknown_fields=True):
    """How to search.

    Attributes
    ----------
    count
        How many results that differ.
    seed
        None for a fresh one each time.
    effort
        Rounds of `improve`, in its usual number.
    """

    count: Count = 8
    seed: Seed | None = None
    effort: Effort = 1.0


class Key(Struct, frozen=True, forbid_unknown_fields=True):
    """One result: the number of its run, and its place there."""

    run: Annotated[int, Meta(ge=0)]
    number: Annotated[int, Meta(ge=0)] = 0


class Outcome(Struct, frozen=True):
    """The numbers of a result, as the gallery shows them; scores in nats."""

    key: Key
    log_score: float | None
    similarity: float | None
    primitives: int
    seed: int | None
    #: What it came from: "run", "regrow", "choose" or "reload".
    origin: str = "run"
    #: The reference of its model; the gallery shows those of the present one.
    model: str = ""


class Pin(Struct, frozen=True):
    """A held part: its pattern, and the values of the choices that hold it."""

    part: str
    choices: Choices
