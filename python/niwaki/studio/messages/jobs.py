"""Jobs of a worker, and its reports: events, progress, and a final answer."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

from niwaki.studio.messages.document import Ask, Choices, HeldPart, Key, Outcome, Point, Settings, TargetAsk
from niwaki.studio.messages.events import (
    Checked,
    Described,
    Difference,
    Dragged,
    Explained,
    Fitted,
    Mask,
    ModelInfo,
    Offered,
    Previewed,
    Problem,
    Shape,
    Sizes,
)
from niwaki.studio.messages.modes import Judged, Palette, Picture, Regions


class Question(Struct):
    """A search: a model with its arguments, goals, settings and held choices."""

    model: str
    arguments: dict[str, Any]
    ask: Ask
    settings: Settings
    hold: Choices = {}
    #: The path of an uploaded drawing.
    file: str = ""


class Job(Struct, kw_only=True, tag_field="kind"):
    """A job for a worker process."""

    id: int = 0


class ListModels(Job, tag="models"):
    """List the models of the gallery and of these files."""

    files: list[str]


class Load(Job, tag="load"):
    """Load a model, or load it again."""

    reference: str
    file: str = ""


class CheckModel(Job, tag="check"):
    """Compile a model, and report on it; a result of `source` is held against the requirements beside the model."""

    reference: str
    arguments: dict[str, Any] = {}
    source: str = ""
    number: int = 0


class PreviewRuns(Job, tag="preview"):
    """Run a model without a target."""

    question: Question
    count: int
    seed: int


class ExplainChange(Job, tag="explain"):
    """Change one choice of a run, and count the calls that each strategy runs again."""

    question: Question
    choice: str
    seed: int


class FitParameters(Job, tag="fit"):
    """Fit the parameters of a model that somebody else wrote; its evaluations are stored in `folder`."""

    reference: str
    target: TargetAsk
    evaluations: int
    seed: int
    align: bool
    folder: str


class Ghost(Job, tag="ghost"):
    """Send the mesh of a target with a run of the model beside it, or the regions of a drawing."""

    question: Question


class Glimpse(Job, tag="glimpse"):
    """Send a run of a model of the list."""

    reference: str


class Grow(Job, tag="grow"):
    """Search, and write the results to `file`.

    Attributes
    ----------
    source, number
        A result from which the search begins, where a search of the kind of model can; else it begins anew.
    """

    question: Question
    run: int
    seed: int
    file: str
    source: str = ""
    number: int = 0


class GrowValues(Job, tag="grow-values"):
    """Search with goals that another program gives as values, and write the results to `file`.

    Attributes
    ----------
    options
        Options of `niwaki.targets.asks` by name, as `niwaki.search.data.Writer` writes them. Without a target or a
        sketch, a model of the gallery has its usual goals as well.
    """

    model: str
    arguments: dict[str, Any]
    options: dict[str, Any]
    settings: Settings
    run: int
    seed: int
    file: str


class GrowAgain(Job, tag="grow-again"):
    """Repeat the search of a stored run, and write the results to `file`.

    Attributes
    ----------
    seed, hold, count
        A new seed, new held choices, a new number of results that differ; None keeps the stored value.
    """

    source: str
    run: int
    file: str
    seed: int | None = None
    hold: Choices | None = None
    count: int | None = None


class Regrow(Job, tag="regrow"):
    """Grow a part of a result again, and write the results to `file`."""

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
    """Run a model with the choices of a result, some of them changed; write the result to `file` if it is named."""

    question: Question
    source: str
    number: int
    changes: Choices
    run: int
    file: str = ""
    origin: str = "choose"


class DragPart(Job, tag="drag"):
    """Drag a part of a result: send its shape during the move; if `file` is named, write the answers to it."""

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
    """Offer a change of the model's file that makes the arguments its defaults."""

    question: Question


class RewriteFile(Job, tag="rewrite"):
    """Write one of the last offered changes."""

    difference: str


class Hold(Job, tag="hold"):
    """Return the choices that hold parts of a result."""

    source: str
    number: int
    parts: list[str]


class DescribeRun(Job, tag="describe"):
    """Send the choices and parts of a result."""

    question: Question
    source: str
    number: int
    key: Key


class ShowRun(Job, tag="show"):
    """Send the shape of a result."""

    source: str
    number: int
    key: Key
    detail: Literal["light", "fine", "picture"]


class FindDifference(Job, tag="difference"):
    """Send the difference between a result and its target."""

    source: str
    number: int
    key: Key


class JudgeRun(Job, tag="judge"):
    """Check whether a structure stands."""

    source: str
    number: int
    key: Key
    simulate: bool = False


class WriteFile(Job, tag="write"):
    """Write a result as a file in a folder."""

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
    | CheckModel
    | PreviewRuns
    | ExplainChange
    | FitParameters
    | Ghost
    | Glimpse
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
    """The end of a job: its results, or the reason of its failure."""

    id: int = 0
    problem: Problem | None = None
    outcomes: list[Outcome] = []
    models: list[ModelInfo] = []
    targets: list[str] = []
    held: list[HeldPart] = []
    path: str = ""
    interrupted: bool = False
    #: The text of `View.note`; for a search, of `View.losses`.
    note: str = ""
    sizes: Sizes = Sizes()


class Progressed(Struct, tag_field="kind", tag="progressed"):
    """The progress of a search."""

    id: int = 0
    done: int = 0
    best: float | None = None
    seconds: float = 0.0
    #: The fit of the best, as a person reads it.
    fit: str = ""


class Loading(Struct, tag_field="kind", tag="loading"):
    """A file of models is loading, at this line; without a path, it has been loaded."""

    path: str = ""
    line: int = 0


AnyReport = (
    Answer
    | Loading
    | Progressed
    | Shape
    | Described
    | Checked
    | Previewed
    | Explained
    | Fitted
    | Difference
    | Dragged
    | Offered
    | Palette
    | Judged
    | Picture
    | Regions
    | Mask
)
