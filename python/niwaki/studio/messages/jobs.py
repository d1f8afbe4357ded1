"""What a worker is given. Its reports are events, how far a search is, and an answer last."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

from niwaki.studio.messages.document import Ask, Choices, HeldPart, Key, Outcome, Point, Settings
from niwaki.studio.messages.events import Described, Difference, Dragged, ModelInfo, Offered, Problem, Shape
from niwaki.studio.messages.modes import Judged, Palette, Picture, Regions


class Question(Struct):
    """What is searched: a model with its arguments, what is asked, and held choices."""

    model: str
    arguments: dict[str, Any]
    ask: Ask
    settings: Settings
    hold: Choices = {}
    #: Of a drawing that was sent: where it is.
    file: str = ""


class Job(Struct, kw_only=True, tag_field="kind"):
    """Work for a worker process."""

    id: int = 0


class ListModels(Job, tag="models"):
    """The models of the gallery and of these files."""

    files: list[str]


class Load(Job, tag="load"):
    """Read a model, perhaps again."""

    reference: str
    file: str = ""


class Ghost(Job, tag="ghost"):
    """The mesh of a target; the regions of a drawing."""

    question: Question


class Grow(Job, tag="grow"):
    """Search; results are written to `file`."""

    question: Question
    run: int
    seed: int
    file: str


class GrowValues(Job, tag="grow-values"):
    """Search for what is asked by values, from another program; results are written to `file`.

    Attributes
    ----------
    asked
        Options of `niwaki.targets.asks` by name, as `niwaki.search.data.Writer` writes them; where they match nothing,
        what is usual for the gallery's model as well.
    """

    model: str
    arguments: dict[str, Any]
    asked: dict[str, Any]
    settings: Settings
    run: int
    seed: int
    file: str


class GrowAgain(Job, tag="grow-again"):
    """Carry out the search of a stored run again; results are written to `file`.

    Attributes
    ----------
    seed, hold, count
        Another seed, other held choices, another number of results that differ; as they were where they are None.
    """

    source: str
    run: int
    file: str
    seed: int | None = None
    hold: Choices | None = None
    count: int | None = None


class Regrow(Job, tag="regrow"):
    """Grow a part of one result again; results are written to `file`."""

    question: Question
    source: str
    number: int
    part: str
    count: int
    strength: float | None
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


class DragPart(Job, tag="drag"):
    """Drag a part of one result: its shape while it moves; answers, written to `file`, where it is named."""

    question: Question
    source: str
    number: int
    part: str
    to: Point
    grab: Point | None
    along: Point | None
    run: int = 0
    file: str = ""


class ProposeDefaults(Job, tag="propose"):
    """The change of the model's file that makes its arguments its defaults."""

    question: Question


class RewriteFile(Job, tag="rewrite"):
    """Write a change that was offered last."""

    difference: str


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


class FindDifference(Job, tag="difference"):
    """Where a result differs from what is wanted."""

    source: str
    number: int
    key: Key


class JudgeRun(Job, tag="judge"):
    """Whether a structure stands."""

    source: str
    number: int
    key: Key
    simulate: bool = False


class WriteFile(Job, tag="write"):
    """Write a result as a file into a folder."""

    source: str
    number: int
    format: str
    folder: str
    scale: float | None = None
    board: tuple[float, float] = (600.0, 400.0)
    kerf: float = 0.2


AnyJob = (
    ListModels
    | Load
    | Ghost
    | Grow
    | GrowValues
    | GrowAgain
    | Regrow
    | Change
    | DragPart
    | ProposeDefaults
    | RewriteFile
    | Hold
    | DescribeRun
    | ShowRun
    | FindDifference
    | JudgeRun
    | WriteFile
)


class Answer(Struct, tag_field="kind", tag="answer"):
    """The end of a job: what it found, or why it failed."""

    id: int = 0
    problem: Problem | None = None
    outcomes: list[Outcome] = []
    models: list[ModelInfo] = []
    targets: list[str] = []
    held: list[HeldPart] = []
    path: str = ""
    interrupted: bool = False
    #: What windows see as `View.note`; of a search, as `View.losses`.
    note: str = ""


class Progressed(Struct, tag_field="kind", tag="progressed"):
    """How far a search is."""

    id: int = 0
    done: int = 0
    best: float | None = None
    seconds: float = 0.0


class Loading(Struct, tag_field="kind", tag="loading"):
    """A file of models begins to run; said again with the line where it is; without a path it has ended."""

    path: str = ""
    line: int = 0


AnyReport = (
    Answer
    | Loading
    | Progressed
    | Shape
    | Described
    | Difference
    | Dragged
    | Offered
    | Palette
    | Judged
    | Picture
    | Regions
)
