"""The parts of a session's document: goals, settings and results."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct
from msgspec.structs import force_setattr

from niwaki.shares import coverage

Text = Annotated[str, Meta(max_length=2_000)]
Address = Annotated[str, Meta(max_length=2_000)]
Share = Annotated[float, Meta(ge=-10.0, le=10.0)]
Length = Annotated[float, Meta(ge=-1e9, le=1e9)]
Point = tuple[Length, Length, Length]
Addresses = Annotated[list[Address], Meta(max_length=10_000)]
Color = Annotated[str, Meta(pattern="^#[0-9a-fA-F]{6}$")]
Count = Annotated[int, Meta(ge=1, le=48)]
#: Whole numbers that JavaScript represents exactly.
Number = Annotated[int, Meta(ge=0, lt=2**53)]
Seed = Number
Strength = Annotated[float, Meta(ge=0.0, le=1.0)]
Effort = Annotated[float, Meta(gt=0.0, le=64.0)]
#: Values of choices by address, as `niwaki.search.data.Writer` writes them.
Choices = dict[str, Any]


class TargetAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """A solid to fill or to avoid: its source and its placement.

    Attributes
    ----------
    source
        `gallery:NAME`, `upload:SHA256`, a primitive (`box`, `ball`, `column`), or a mesh file below the folder that was
        named at the start.
    move, scale
        A translation in scene units, and factors along x, y and z. The solid is scaled and turned about the middle of
        its base, then moved.
    turn
        Degrees about y.
    up
        The axis of the mesh that points up: "z" for meshes of printers and CAD programs, which are stood up first.
    """

    source: Text
    move: Point = (0.0, 0.0, 0.0)
    scale: tuple[
        Annotated[float, Meta(gt=0.0, le=1e6)],
        Annotated[float, Meta(gt=0.0, le=1e6)],
        Annotated[float, Meta(gt=0.0, le=1e6)],
    ] = (1.0, 1.0, 1.0)
    turn: Length = 0.0
    up: Literal["y", "z"] = "y"


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
    """A pen stroke: points and width as shares of the picture's height, from its upper left corner."""

    points: Annotated[list[tuple[Share, Share]], Meta(min_length=1, max_length=20_000)]
    width: Annotated[float, Meta(gt=0.0, le=1.0)] = 0.05


class Sketch(Struct, frozen=True, forbid_unknown_fields=True):
    """A drawing by hand over the view of a camera: a silhouette or a shadow.

    Attributes
    ----------
    aspect
        Width of the picture over its height.
    camera
        The camera of the view; None for a drawing in the plane.
    kind
        The meaning of the strokes: the scene as the camera sees it, or its shadow on the floor.
    inside
        Whether closed outlines mean their inside; open strokes always mean themselves.
    """

    strokes: Annotated[list[Stroke], Meta(min_length=1, max_length=500)]
    aspect: Annotated[float, Meta(gt=0.1, lt=10.0)]
    camera: Eye | None = None
    kind: Literal["silhouette", "shadow"] = "silhouette"
    inside: bool = False


class RuleAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """A rule about regions of a drawing, as in `niwaki.color.Rules`.

    Attributes
    ----------
    regions
        A chain, the lightest region first; for "muted" the regions of the rule (`all`: regions without a number).
    most
        For "muted": the largest distance from grey, CIELAB units.
    """

    kind: Literal["lightness", "lighter", "same-chroma", "same-hue", "muted"]
    regions: Annotated[list[Text], Meta(min_length=1, max_length=256)]
    most: Annotated[float, Meta(ge=0.0, le=200.0)] = 30.0


class RulesAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """The rules of a drawing.

    Attributes
    ----------
    background
        The region behind all others; None for the region at the picture's edge.
    weight
        The strictness of the rules.
    """

    rules: Annotated[list[RuleAsk], Meta(max_length=1_000)] = []
    background: Text | None = None
    weight: Annotated[float, Meta(gt=0.0, le=1e6)] = 100.0


class Ask(Struct, frozen=True, forbid_unknown_fields=True):
    """The goals of a search. Without a target and a sketch, a model of the gallery has its usual goals.

    Attributes
    ----------
    floor
        The height below which no part may reach.
    obstacles
        Solids that all parts avoid.
    light
        The direction of the light that casts a shadow.
    rules
        Rules of a drawing to colour; None for the rules that come with the drawing.
    """

    target: TargetAsk | None = None
    sketch: Sketch | None = None
    floor: Length | None = None
    obstacles: Obstacles = []
    light: Light = (-0.55, -1.0, -0.5)
    rules: RulesAsk | None = None


class Settings(Struct, frozen=True, forbid_unknown_fields=True):
    """The settings of a search.

    Attributes
    ----------
    count
        The number of results that differ.
    seed
        The seed; None for a fresh seed each time.
    effort
        The factor of the usual work of a search, as for `improve`.
    strength
        The choice among the results of a search: 0 for the best, 1 for the most different.
    by
        What tells results apart: their kind, or their look.
    """

    count: Count = 8
    seed: Seed | None = None
    effort: Effort = 1.0
    strength: Strength = 0.0
    by: Literal["kind", "look"] = "kind"


class Key(Struct, frozen=True, forbid_unknown_fields=True):
    """The key of a result: the number of its run, and its place in the run."""

    run: Number
    number: Number = 0


class Outcome(Struct, frozen=True):
    """A result in the gallery: its key and its numbers; scores in nats."""

    key: Key
    log_score: float | None
    similarity: float | None
    primitives: int
    seed: int | None
    #: The kind of step that made the result: "run", "regrow", "choose" or "reload".
    origin: str = "run"
    #: The reference of its model; the gallery shows only results of the present model.
    model: str = ""
    #: The share of the target that the result fills; the share of the result outside the target.
    covered: float | None = None
    outside: float | None = None
    #: A note that the gallery shows in place of these shares.
    note: str = ""
    #: What tells it apart from the other results of its run, in words.
    kind: str = ""
    #: These shares as a person reads them.
    fit: str = ""
    #: The requirements beside the model that the result does not keep, in words.
    unmet: list[str] = []

    def __post_init__(self) -> None:
        """Write the shares."""
        if self.covered is not None and self.outside is not None:
            force_setattr(self, "fit", coverage(self.covered, self.outside))


class HeldPart(Struct, frozen=True):
    """A held part: its pattern, and the values of its held choices."""

    part: str
    choices: Choices
