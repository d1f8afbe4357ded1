"""Events: messages to a client."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

from niwaki.shell.reports import CheckReport, ShowReport
from niwaki.studio.messages.document import Ask, HeldPart, Key, Outcome, Point, RulesAsk, Settings, TargetAsk


class Place(Struct):
    """A place in a model's file; lines and columns count from 1, and the end is excluded."""

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
    """A parameter of a model; `default` is present only for numbers, texts and truth values."""

    name: str
    default: Any = None
    is_required: bool = False
    #: Whether the parameter is a whole number: by its annotation, or else by its default.
    is_whole: bool = False


class RegionInfo(Struct):
    """A region of a drawing: its share of the picture, and its colour in the file."""

    name: str
    share: float
    color: str


class ModelInfo(Struct):
    """An entry of the list of models: a model, or a drawing to colour.

    Attributes
    ----------
    kind
        "structure" for a model of blocks that stand, "coloring" for a drawing.
    regions, rules
        The regions of a drawing, and the rules that come with it.
    """

    reference: str
    title: str = ""
    parameters: list[Parameter] = []
    #: The usual target of the model, as a `source`.
    target: str | None = None
    #: The style of its drawings; None for models of solids.
    draws: str | None = None
    is_file: bool = False
    kind: Literal["scene", "structure", "coloring"] = "scene"
    regions: list[RegionInfo] = []
    rules: RulesAsk | None = None


class ChoiceInfo(Struct):
    """A choice of a result: its value; its options if they are words, else the range of its slider if it has one."""

    address: str
    family: str
    value: Any
    options: list[str] = []
    low: float | None = None
    high: float | None = None
    is_whole: bool = False
    place: Place | None = None


class PartInfo(Struct):
    """A primitive of a result, and the line that emits it."""

    address: str
    place: Place | None = None


class Searching(Struct):
    """The progress of the running search."""

    run: int
    done: int = 0
    best: float | None = None
    seconds: float = 0.0
    #: The fit of the best, as a person reads it; empty without a target.
    fit: str = ""


class Placing(Struct, frozen=True):
    """An offered placement of the target: why, in a sentence, and the target at its new place."""

    text: str
    #: The words of its button.
    label: str
    target: TargetAsk


class Sizes(Struct, frozen=True):
    """The size of a run of the model without a target, the size of the target, and offered placements."""

    model: Point | None = None
    target: Point | None = None
    offers: list[Placing] = []


class View(Struct):
    """The state that every window shows; a patch has some of its fields."""

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
    #: Whether a search was running when the studio ended.
    interrupted: bool
    undo: int
    redo: int
    #: A note on rules of a drawing that cannot all hold; empty if they can.
    note: str = ""
    #: A note on partial runs of the last search that became impossible, and on the parts; empty without such runs.
    losses: str = ""
    sizes: Sizes = Sizes()


class Event(Struct, tag_field="kind"):
    """A message to a client."""

    id: int = 0


class State(Event, tag="state"):
    """The whole state; `rev` counts the patches."""

    session: str = ""
    rev: int = 0
    view: View | None = None


class Patch(Event, tag="patch"):
    """The changes since the revision before."""

    rev: int = 0
    changes: dict[str, Any] = {}


class Described(Event, tag="described"):
    """The choices and parts of a result, in the order of its run.

    Attributes
    ----------
    labels
        The label of every choice and part, and of the calls and iterations around them, those around first: the number
        of the row around it (-1 for the outermost), the component of addresses, the label as it is read below the row
        around it, and whether it takes that row's place in a whole label (`niwaki.lang.labels.Labels.tree`).
    """

    key: Key | None = None
    choices: list[ChoiceInfo] = []
    parts: list[PartInfo] = []
    labels: list[tuple[int, str, str, bool]] = []


class Shape(Event, tag="shape"):
    """The header of a frame with a mesh: see `niwaki.studio.worker.shapes`.

    Attributes
    ----------
    role
        "best" for the best of a running search, "result", "moving" while a choice or a part moves, "ghost" for the
        target, "obstacle", "prior" for a run of the model without a target, or "glimpse" for such a run of a model of
        the list.
    number
        The number of the obstacle.
    parts
        Addresses of the parts; the mesh has the number of the part for each triangle.
    """

    role: Literal["best", "result", "moving", "ghost", "obstacle", "prior", "glimpse"] = "result"
    number: int = 0
    key: Key | None = None
    detail: Literal["light", "fine"] = "light"
    vertices: int = 0
    triangles: int = 0
    parts: list[str] = []
    low: Point = (0.0, 0.0, 0.0)
    high: Point = (0.0, 0.0, 0.0)
    #: The source of a ghost or an obstacle, None without a target; the reference of the model of a glimpse.
    source: str | None = None
    #: The point about which a ghost is turned and scaled.
    pivot: Point = (0.0, 0.0, 0.0)
    is_flat: bool = False
    note: str = ""
    #: The grabbed point of a dragged part; the note tells why this point is not at the pointer.
    held: Point | None = None
    #: The distance from this point to the pointer, as a share of the scene's size.
    left: float = 0.0


class Shifted(Struct):
    """A choice before and after a drag; None if the run has no such choice."""

    address: str
    before: Any
    after: Any


class Offer(Struct):
    """An offered change of the model's file: numbers that explain a drag, or arguments as defaults.

    Attributes
    ----------
    label
        The change in words.
    difference
        The change as a unified difference.
    is_instead
        Whether the change of the file replaces the changed choices; otherwise both change.
    """

    label: str
    difference: str
    is_instead: bool = True


class Looked(Event, tag="looked"):
    """The answer to `look`: fields of the state."""

    values: dict[str, Any] = {}


class FileText(Event, tag="text"):
    """The text of a file that was read or written."""

    path: str = ""
    text: str = ""


class Checked(Event, tag="checked"):
    """The answer to `check`: what `niwaki check --json` prints."""

    report: CheckReport | None = None


class Previewed(Event, tag="previewed"):
    """The answer to `preview`: what `niwaki show --json` prints."""

    report: ShowReport | None = None


class Explained(Event, tag="explained"):
    """The answer to `explain`: a changed choice, and the calls that each strategy runs again for it.

    Attributes
    ----------
    calls
        The number of calls.
    strategies
        Calls that are run, resumed, skipped, created and removed, by strategy.
    """

    choice: str = ""
    before: str = ""
    after: str = ""
    calls: int = 0
    strategies: dict[str, dict[str, int]] = {}


class Fitted(Event, tag="fitted"):
    """The answer to `fit`: what `niwaki fit --json` prints."""

    report: dict[str, Any] = {}


class Dragged(Event, tag="dragged"):
    """The end of a drag: the changes of the first answer, or the reason why the part is not at the pointer.

    Attributes
    ----------
    share
        The distance that is left to the pointer, as a share of the scene's size.
    """

    part: str = ""
    share: float = 0.0
    reason: str = ""
    changes: list[Shifted] = []
    offers: list[Offer] = []


class Offered(Event, tag="offered"):
    """The answer to `propose`: offered changes of the model's file."""

    offers: list[Offer] = []


class Difference(Event, tag="difference"):
    """The header of a frame with a byte for each cell of a target, or each pixel of a picture.

    1 is target and scene, 2 is target only, 3 is scene only; x runs fastest, then y, then z. A picture has its first
    row on top.

    Attributes
    ----------
    size
        Cells along x, y and z; columns, rows and 1.
    low, high
        Corners of the grid, or of the window of a drawing; equal for a picture seen by a camera.
    """

    key: Key | None = None
    size: tuple[int, int, int] = (0, 0, 0)
    low: Point = (0.0, 0.0, 0.0)
    high: Point = (0.0, 0.0, 0.0)
    is_picture: bool = False


class Mask(Event, tag="mask"):
    """The header of a frame with a byte for each pixel of a sketch, as it is scored: 1 is inside. No size: no sketch.

    The picture has the sketch's aspect; its first row is on top.
    """

    width: int = 0
    height: int = 0


class Done(Event, tag="done"):
    """A command is done."""

    interrupted: bool = False


class File(Event, tag="file"):
    """A file to fetch from `/file/HASH`."""

    hash: str = ""
    name: str = ""
    #: Where the session keeps the file.
    path: str = ""


class Failed(Event, tag="error"):
    """A command was refused or failed."""

    problem: Problem | None = None
