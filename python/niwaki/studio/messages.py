"""Every message of the studio: what a page or a script can ask, what it is told, and what a worker is given.

This file is the protocol. The page's types are written from it (`niwaki.studio.types`), and whatever arrives is decoded
into one of these structs or refused. On the socket each message is JSON with its `kind`; a struct that carries geometry
is the header of a frame (`niwaki.studio.frames`).

`id` is a number of the sender's own choice; the answers to a command repeat it.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct, field

PROTOCOL = 1

Text = Annotated[str, Meta(max_length=2_000)]
Address = Annotated[str, Meta(max_length=2_000)]
Share = Annotated[float, Meta(ge=-10.0, le=10.0)]
Length = Annotated[float, Meta(ge=-1e9, le=1e9)]
Point = tuple[Length, Length, Length]
Addresses = Annotated[list[Address], Meta(max_length=10_000)]
Count = Annotated[int, Meta(ge=1, le=48)]
Seed = Annotated[int, Meta(ge=0, lt=2**53)]
#: Values of choices by address, as `niwaki.search.data.Writer` writes them.
Choices = dict[str, Any]


# ---- what is searched for: the parts of the document


class TargetAsk(Struct, frozen=True, forbid_unknown_fields=True):
    """A volume to fill: where it comes from, and how it is placed.

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
    """A silhouette drawn by hand, over the view of a camera.

    Attributes
    ----------
    aspect
        Width of the picture over its height.
    camera
        What saw it; None for a drawing in the plane.
    """

    strokes: Annotated[list[Stroke], Meta(min_length=1, max_length=500)]
    aspect: Annotated[float, Meta(gt=0.1, lt=10.0)]
    camera: Eye | None = None


class Ask(Struct, frozen=True, forbid_unknown_fields=True):
    """What a scene should be like; with nothing in it, what the model of the gallery is usually asked."""

    target: TargetAsk | None = None
    sketch: Sketch | None = None
    floor: Length | None = None


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
    effort: Annotated[float, Meta(gt=0.0, le=64.0)] = 1.0


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


# ---- commands


class Command(Struct, kw_only=True, forbid_unknown_fields=True, tag_field="kind"):
    """What a client asks."""

    id: int = 0


class Hello(Command, tag="hello"):
    """The first message: the whole state is the answer."""

    protocol: int


class ChooseModel(Command, tag="model"):
    """Take a model: a name of the gallery, or a reference that was named at the start."""

    reference: Text


class SetAsk(Command, tag="ask"):
    """Say what the scene should be like."""

    ask: Ask


class Set(Command, tag="set"):
    """Set arguments by name, or settings; what is left out stays."""

    arguments: Annotated[dict[str, Any], Meta(max_length=200)] | None = None
    settings: Settings | None = None


class Run(Command, tag="run"):
    """Search; pinned parts are held. A search that runs is stopped first, and nothing of it is kept."""


class Stop(Command, tag="stop"):
    """Stop the search; what it has found becomes results."""


class PinParts(Command, tag="pin"):
    """Hold parts of the picked result in what follows."""

    parts: Addresses


class FreeParts(Command, tag="free"):
    """Hold them no more; all, where none is named."""

    parts: Addresses = field(default_factory=list)


class Reroll(Command, tag="reroll"):
    """Grow a part of the picked result again, in place; `count` times, by seeds that follow one another."""

    part: Address
    count: Count = 1


class Choose(Command, tag="choose"):
    """Give a choice of the picked result a value; while it moves only its shape is shown, at the end it is a result."""

    address: Address
    value: float | int | bool
    phase: Literal["move", "end"] = "end"


class Describe(Command, tag="describe"):
    """Ask for the choices of a result, with places in the source."""

    key: Key


class Show(Command, tag="show"):
    """Ask for the shape of a result."""

    key: Key
    detail: Literal["light", "fine"] = "light"


class Pick(Command, tag="pick"):
    """Go on with this result."""

    key: Key


class Star(Command, tag="star"):
    """Mark a result, or take the mark away."""

    key: Key
    on: bool = True


class Undo(Command, tag="undo"):
    """Take the last step back."""


class Redo(Command, tag="redo"):
    """Take the step again that was taken back."""


class Export(Command, tag="export"):
    """Write a result as a file, or its recipe (`json`), which `niwaki replay` repeats."""

    key: Key
    format: Literal["glb", "obj", "ply", "stl", "3mf", "svg", "png", "json"]
    scale: Annotated[float, Meta(gt=0.0, le=1e9)] | None = None


AnyCommand = (
    Hello
    | ChooseModel
    | SetAsk
    | Set
    | Run
    | Stop
    | PinParts
    | FreeParts
    | Reroll
    | Choose
    | Describe
    | Show
    | Pick
    | Star
    | Undo
    | Redo
    | Export
)


# ---- what clients are told


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


class ModelInfo(Struct):
    """A model that can be chosen."""

    reference: str
    title: str = ""
    parameters: list[Parameter] = []
    #: The target that it is usually grown into, as a `source`.
    target: str | None = None
    #: The style of its drawings; None for models in space.
    draws: str | None = None
    is_file: bool = False


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
    pins: list[Pin]
    stars: list[Key]
    models: list[ModelInfo]
    targets: list[str]
    problem: Problem | None
    searching: Searching | None
    #: A search that was running when the studio ended.
    interrupted: bool
    undo: int
    redo: int


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
    """The choices and parts of a result."""

    key: Key | None = None
    choices: list[ChoiceInfo] = []
    parts: list[PartInfo] = []


class Shape(Event, tag="shape"):
    """The header of a frame with a mesh: see `niwaki.studio.worker.shapes`.

    Attributes
    ----------
    what
        "best" of a running search, a "result", a choice that is "moving", or the "ghost" of the target.
    parts
        Addresses; the mesh has the number of its part for each triangle.
    """

    what: Literal["best", "result", "moving", "ghost"] = "result"
    key: Key | None = None
    detail: Literal["light", "fine"] = "light"
    vertices: int = 0
    triangles: int = 0
    parts: list[str] = []
    low: Point = (0.0, 0.0, 0.0)
    high: Point = (0.0, 0.0, 0.0)
    #: Of a ghost: the point about which it is turned and scaled, where it stands.
    pivot: Point = (0.0, 0.0, 0.0)
    is_flat: bool = False
    note: str = ""


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


# ---- what a worker is given; its answers are those events, and `Answer` last


class Question(Struct):
    """What is searched: a model with its arguments, what is asked, and held choices."""

    model: str
    arguments: dict[str, Any]
    ask: Ask
    settings: Settings
    lock: Choices = {}


class Job(Struct, kw_only=True, tag_field="kind"):
    """Work for a worker process."""

    id: int = 0


class ListModels(Job, tag="models"):
    """The models of the gallery and of these files."""

    files: list[str]


class Load(Job, tag="load"):
    """Read a model, perhaps again."""

    reference: str


class Ghost(Job, tag="ghost"):
    """The mesh of a target."""

    question: Question


class Grow(Job, tag="grow"):
    """Search; results are written to `file`."""

    question: Question
    run: int
    seed: int
    file: str


class Regrow(Job, tag="regrow"):
    """Grow a part of one result again; results are written to `file`."""

    question: Question
    source: str
    number: int
    part: str
    count: int
    run: int
    seed: int
    file: str


class Change(Job, tag="change"):
    """Run a model again with the choices of a result, some of them changed; written to `file` where it is named."""

    question: Question
    source: str
    number: int
    changes: Choices
    run: int
    file: str = ""
    origin: str = "choose"


class Hold(Job, tag="hold"):
    """The choices that hold these parts of a result."""

    source: str
    number: int
    parts: list[str]


class DescribeRun(Job, tag="describe"):
    """The choices and parts of a result."""

    question: Question
    source: str
    number: int
    key: Key


class ShowRun(Job, tag="show"):
    """The shape of a result."""

    source: str
    number: int
    key: Key
    detail: Literal["light", "fine"]


class WriteFile(Job, tag="write"):
    """Write a result as a file into a folder."""

    source: str
    number: int
    format: str
    folder: str
    scale: float | None = None


AnyJob = ListModels | Load | Ghost | Grow | Regrow | Change | Hold | DescribeRun | ShowRun | WriteFile


class Answer(Struct, tag_field="kind", tag="answer"):
    """The end of a job: what it found, or why it failed."""

    id: int = 0
    problem: Problem | None = None
    outcomes: list[Outcome] = []
    models: list[ModelInfo] = []
    targets: list[str] = []
    pins: list[Pin] = []
    path: str = ""
    interrupted: bool = False


class Progressed(Struct, tag_field="kind", tag="progressed"):
    """How far a search is."""

    id: int = 0
    done: int = 0
    best: float | None = None
    seconds: float = 0.0


AnyReport = Answer | Progressed | Shape | Described
