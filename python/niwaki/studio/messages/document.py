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
Color = Annotated[str, Meta(pattern="^#[0-9a-fA-F]{6}$")]
Count = Annotated[int, Meta(ge=1, le=48)]
#: Whole numbers that a page's script can hold.
Number = Annotated[int, Meta(ge=0, lt=2**53)]
Seed = Number
Strength = Annotated[float, Meta(ge=0.0, le=1.0)]
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


class RuleAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """A rule about regions of a drawing: those of `niwaki.color.Rules`.

    Attributes
    ----------
    regions
        A chain, the lightest first; of "muted" those that it is about (`all`: each without a number of its own).
    most
        Of "muted": the largest distance from grey, CIELAB units.
    """

    kind: Literal["lightness", "lighter", "same-chroma", "same-hue", "muted"]
    regions: Annotated[list[Text], Meta(min_length=1, max_length=256)]
    most: Annotated[float, Meta(ge=0.0, le=200.0)] = 30.0


class RulesAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """Rules of a drawing.

    Attributes
    ----------
    background
        The region that the others lie on; None for the one at the picture's edge.
    weight
        How strict they are.
    """

    rules: Annotated[list[RuleAsk], Meta(max_length=1_000)] = []
    background: Text | None = None
    weight: Annotated[float, Meta(gt=0.0, le=1e6)] = 100.0


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
    rules
        Of a drawing to colour; None for those that come with it.
    """

    target: TargetAsk | None = None
    sketch: Sketch | None = None
    floor: Length | None = None
    obstacles: Obstacles = []
    light: Light = (-0.55, -1.0, -0.5)
    rules: RulesAsk | None = None


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
    strength
        Which results are shown of those that were found: 0 the best, 1 those that look most different.
    """

    count: Count = 8
    seed: Seed | None = None
    effort: Effort = 1.0
    strength: Strength = 0.0


class Key(Struct, frozen=True, forbid_unknown_fields=True):
    """One result: the number of its run, and its place there."""

    run: Number
    number: Number = 0


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
    #: Of what is wanted, the share that it fills; of it, the share that is elsewhere.
    covered: float | None = None
    outside: float | None = None
    #: What is said of it in the gallery, where that is not how much it covers.
    note: str = ""


class HeldPart(Struct, frozen=True):
    """A held part: its pattern, and the values of the choices that hold it."""

    part: str
    choices: Choices
