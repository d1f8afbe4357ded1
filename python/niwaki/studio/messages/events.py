"""What clients are told."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

from niwaki.studio.messages.document import Ask, HeldPart, Key, Outcome, Point, RulesAsk, Settings


class Place(Struct):
    """A place in a model's file, counted from 1; the end is excluded."""

    path: str
    line: int
    column: int
    end_line: int
    end_column: int


class Problem(Struct):
    """An error as the shell prints it."""

    code: str
    text: str
    place: Place | None = None


class Parameter(Struct):
    """A parameter of a model; `default` only where it is a number, a text or a truth value."""

    name: str
    default: Any = None
    is_required: bool = False


class RegionInfo(Struct):
    """A region of a drawing: its share of the picture, and the colour that it has there."""

    name: str
    share: float
    color: str


class ModelInfo(Struct):
    """What can be chosen: a model, or a drawing to colour.

    Attributes
    ----------
    kind
        A "structure" is a model of blocks that stand; a "coloring" is a drawing.
    regions, rules
        Of a drawing; the rules that come with it.
    """

    reference: str
    title: str = ""
    parameters: list[Parameter] = []
    #: The target that it is usually grown into, as a `source`.
    target: str | None = None
    #: The style of its drawings; None for models in space.
    draws: str | None = None
    is_file: bool = False
    kind: Literal["scene", "structure", "coloring"] = "scene"
    regions: list[RegionInfo] = []
    rules: RulesAsk | None = None


class ChoiceInfo(Struct):
    """A choice of a result: its value, and the range of a slider where it has one."""

    address: str
    family: str
    value: Any
    low: float | None = None
    high: float | None = None
    is_whole: bool = False
    place: Place | None = None


class PartInfo(Struct):
    """A primitive of a result, and the line that emits it."""

    address: str
    place: Place | None = None


class Searching(Struct):
    """The search that is running."""

    run: int
    done: int = 0
    best: float | None = None
    seconds: float = 0.0


class View(Struct):
    """All that every window shows; a patch has some of its fields."""

    model: ModelInfo | None
    arguments: dict[str, Any]
    ask: Ask
    settings: Settings
    results: list[Outcome]
    picked: Key | None
    held: list[HeldPart]
    stars: list[Key]
    models: list[ModelInfo]
    targets: list[str]
    problem: Problem | None
    searching: Searching | None
    #: A search that was running when the studio ended.
    interrupted: bool
    undo: int
    redo: int
    #: Of a drawing: which rules cannot all hold, and by how much; empty where they can.
    note: str = ""
    #: Which partial runs of the last search became impossible, and by which parts; empty where none did.
    losses: str = ""


class Event(Struct, tag_field="kind"):
    """What a client is told."""

    id: int = 0


class State(Event, tag="state"):
    """The whole state; `rev` counts the patches."""

    session: str = ""
    rev: int = 0
    view: View | None = None


class Patch(Event, tag="patch"):
    """What has changed since the revision before."""

    rev: int = 0
    changes: dict[str, Any] = {}


class Described(Event, tag="described"):
    """The choices and parts of a result, in the order in which its run makes them."""

    key: Key | None = None
    choices: list[ChoiceInfo] = []
    parts: list[PartInfo] = []


class Shape(Event, tag="shape"):
    """The header of a frame with a mesh: see `niwaki.studio.worker.shapes`.

    Attributes
    ----------
    what
        "best" of a running search, a "result", a choice or a part that is "moving", the "ghost" of the target, or an
        "obstacle".
    number
        Of the obstacle.
    parts
        Addresses; the mesh has the number of its part for each triangle.
    """

    what: Literal["best", "result", "moving", "ghost", "obstacle"] = "result"
    number: int = 0
    key: Key | None = None
    detail: Literal["light", "fine"] = "light"
    vertices: int = 0
    triangles: int = 0
    parts: list[str] = []
    low: Point = (0.0, 0.0, 0.0)
    high: Point = (0.0, 0.0, 0.0)
    #: Of a ghost or an obstacle: the solid that it shows; None where there is no target.
    source: str | None = None
    #: Of a ghost: the point about which it is turned and scaled, where it stands.
    pivot: Point = (0.0, 0.0, 0.0)
    is_flat: bool = False
    note: str = ""
    #: Of a part that is dragged: where its held point is; the note says why it is not at the pointer.
    held: Point | None = None
    #: What is left from there to the pointer, as a share of the scene's size.
    left: float = 0.0


class Shifted(Struct):
    """A choice before and after a drag; None where the run has no such choice."""

    address: str
    before: Any
    after: Any


class Offer(Struct):
    """A change of the model's file: one that explains a drag, or arguments as defaults.

    Attributes
    ----------
    difference
        The change as a unified difference.
    is_instead
        Whether it takes the place of the changed choices; else they change with it.
    """

    says: str
    difference: str
    is_instead: bool = True


class Dragged(Event, tag="dragged"):
    """The end of a drag: what has changed in the first answer; or why the part is not there.

    Attributes
    ----------
    share
        What is left to the pointer, as a share of the scene's size.
    """

    part: str = ""
    share: float = 0.0
    reason: str = ""
    changes: list[Shifted] = []
    offers: list[Offer] = []


class Offered(Event, tag="offered"):
    """A change of the model's file that was asked for."""

    offers: list[Offer] = []


class Difference(Event, tag="difference"):
    """The header of a frame with a byte for each cell of a target, or each pixel of a picture.

    1 is wanted and filled, 2 is wanted only, 3 is filled only; x runs fastest, then y, then z. A picture has its first
    row on top.

    Attributes
    ----------
    size
        Cells along x, y and z; columns, rows and 1.
    low, high
        Corners of the grid, or of the window of a drawing; both are the same for a picture seen by a camera.
    """

    key: Key | None = None
    size: tuple[int, int, int] = (0, 0, 0)
    low: Point = (0.0, 0.0, 0.0)
    high: Point = (0.0, 0.0, 0.0)
    is_picture: bool = False


class Done(Event, tag="done"):
    """A command has done its work."""

    interrupted: bool = False


class File(Event, tag="file"):
    """A file to fetch from `/file/HASH`."""

    hash: str = ""
    name: str = ""


class Failed(Event, tag="error"):
    """A command was refused, or its work failed."""

    problem: Problem | None = None
