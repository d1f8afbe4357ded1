"""Commands: messages from a client, one for each action of the page."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import UNSET, Meta, Struct, UnsetType, defstruct, field
from msgspec.structs import fields

from niwaki.studio.messages.document import (
    Address,
    Addresses,
    Ask,
    Color,
    Count,
    Key,
    Number,
    Point,
    Seed,
    Settings,
    Strength,
    TargetAsk,
    Text,
)

Side = Annotated[float, Meta(gt=0.0, le=1e5)]


class Command(Struct, kw_only=True, forbid_unknown_fields=True, tag_field="kind"):
    """A message from a client."""

    id: Number = 0


class Hello(Command, tag="hello"):
    """Begin a connection; the answer is the whole state."""

    protocol: int


class ChooseModel(Command, tag="model"):
    """Choose a model: a name of the gallery, or a reference to a file that was named at the start."""

    reference: Text


def _changes(kind: type[Struct]) -> type[Struct]:
    """Make a struct with the fields of a part of the document, all of them optional."""
    members = [(member.name, member.type | UnsetType, UNSET) for member in fields(kind)]
    return defstruct(f"{kind.__name__}Fields", members, frozen=True, forbid_unknown_fields=True)


class AskChange(_changes(Ask)):  # type: ignore[misc]
    """New values of some fields of `Ask`; a target replaces a sketch, and a sketch replaces a target."""


class SetAsk(Command, tag="ask"):
    """Change the goals of the search; other goals stay."""

    ask: AskChange


class SettingsChange(_changes(Settings)):  # type: ignore[misc]
    """New values of some fields of `Settings`."""


class Set(Command, tag="set"):
    """Set arguments by name, or settings; other values stay."""

    arguments: Annotated[dict[str, Any], Meta(max_length=200)] | None = None
    settings: SettingsChange | None = None


class Look(Command, tag="look"):
    """Request fields of the state by name, such as `models`, `targets` or `results`."""

    fields: Annotated[list[Text], Meta(min_length=1, max_length=40)] = field(
        default_factory=lambda: [
            "model",
            "arguments",
            "ask",
            "settings",
            "results",
            "picked",
            "held",
            "problem",
        ]
    )


class Read(Command, tag="read"):
    """Read a text file below the folder that was named at the start."""

    path: Text


class Write(Command, tag="write"):
    """Write a file below the folder that was named at the start: a model (`.py`, `.scad`) or a note (`.md`).

    A model is checked at once. A file of requirements belongs to a person: no message changes it.
    """

    path: Text
    text: Annotated[str, Meta(max_length=200_000)]


class Check(Command, tag="check"):
    """Compile a model; report its functions and choices, advice, and the requirements that its results must keep.

    Attributes
    ----------
    reference
        The model; the present model when left out.
    key
        The result that is held against the requirements; when left out, runs without a target tell how often each of
        them holds.
    """

    reference: Text = ""
    key: Key | None = None


class Preview(Command, tag="preview"):
    """Run the present model without a target, `count` times; the answer has a picture of these runs side by side."""

    count: Annotated[int, Meta(ge=1, le=12)] = 6
    seed: Seed | None = None


class Explain(Command, tag="explain"):
    """Change one choice of a run of the present model, and count the calls that each strategy runs again.

    Attributes
    ----------
    choice
        The address of a choice, or a pattern.
    """

    choice: Address
    seed: Seed | None = None


class Fit(Command, tag="fit"):
    """Fit the parameters of somebody else's model, `file.py:function` or an OpenSCAD file, to a target.

    Attributes
    ----------
    evaluations
        Evaluations in all; the same message with more evaluations goes on.
    align
        Whether the place, turn and size of the mesh are searched, too.
    """

    reference: Text
    target: TargetAsk
    evaluations: Annotated[int, Meta(ge=1, le=10_000)] = 100
    seed: Seed = 0
    align: bool = False


class Run(Command, tag="run"):
    """Start a search; held parts stay. A running search is stopped first and its results are dropped."""


class Stop(Command, tag="stop"):
    """Stop the search and keep its results so far."""


class HoldParts(Command, tag="hold"):
    """Hold parts of the active result in further searches."""

    parts: Addresses
    #: The colour of held regions of a drawing; None for their colours in the active result.
    color: Color | None = None


class FreeParts(Command, tag="free"):
    """Free held parts; all parts if none is named."""

    parts: Addresses = field(default_factory=list)


class Reroll(Command, tag="reroll"):
    """Grow a part of the active result again, in place; `count` times, with consecutive seeds.

    Attributes
    ----------
    strength
        Choose among twice as many: the forms that look most like the present one (0) or least like it (1). When left
        out, all forms are kept in their order.
    """

    part: Address
    count: Count = 1
    strength: Strength | None = None


class Choose(Command, tag="choose"):
    """Set a choice of the active result. During the move only the shape is shown; the end adds a result."""

    address: Address
    #: A word, if the choice is among words; a colour, if the address is a region of a drawing.
    value: float | int | bool | Text
    phase: Literal["move", "end"] = "end"


class Drag(Command, tag="drag"):
    """Drag a part of the active result to a point. During the move only the shape is shown; the end adds a result.

    Attributes
    ----------
    grab
        The point of the part under the pointer; the middle of the part when left out.
    along
        The direction in which the camera looks: distances along it do not count.
    phase
        "move" is skipped if a newer command waits; "cancel" ends the drag without a change.
    follow
        Whether the rest of the scene grows again around the part at the end.
    """

    part: Address
    to: Point
    grab: Point | None = None
    along: Point | None = None
    phase: Literal["move", "end", "cancel"] = "end"
    follow: bool = False


class Propose(Command, tag="propose"):
    """Request a change of the model's file that makes the present arguments its defaults."""


class Rewrite(Command, tag="rewrite"):
    """Write one of the last offered changes of the model's file, named by its difference."""

    difference: Annotated[str, Meta(max_length=200_000)]


class Describe(Command, tag="describe"):
    """Request the choices of a result, with their places in the source."""

    key: Key


class Show(Command, tag="show"):
    """Request the shape of a result, as a mesh (`light`, `fine`) or as a small picture (`picture`)."""

    key: Key
    detail: Literal["light", "fine", "picture"] = "light"


class ShowDifference(Command, tag="difference"):
    """Request the difference between a result and its target."""

    key: Key


class Pick(Command, tag="pick"):
    """Make a result the active result."""

    key: Key


class Star(Command, tag="star"):
    """Star a result, or remove its star."""

    key: Key
    on: bool = True


class Judge(Command, tag="judge"):
    """Request a check of whether a structure of blocks stands: its forces and, on request, a simulated fall."""

    key: Key
    simulate: bool = False


class Undo(Command, tag="undo"):
    """Undo the last step."""


class Redo(Command, tag="redo"):
    """Redo the last undone step."""


class Export(Command, tag="export"):
    """Write a result as a file, or as a recipe (`json`), which `niwaki replay` repeats.

    For a structure, `dxf` and `svg` are the boards with the pieces to cut, and `assembly` is a drawing of the assembly.
    For a drawing, `toml` has its rules.
    """

    key: Key
    format: Literal["glb", "obj", "ply", "stl", "3mf", "svg", "png", "json", "dxf", "assembly", "toml"]
    scale: Annotated[float, Meta(gt=0.0, le=1e9)] | None = None
    #: Width and height of a board, and the width of the saw cut, millimetres.
    board: tuple[Side, Side] = (600.0, 400.0)
    kerf: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.2


AnyCommand = (
    Hello
    | ChooseModel
    | SetAsk
    | Set
    | Look
    | Read
    | Write
    | Check
    | Preview
    | Explain
    | Fit
    | Run
    | Stop
    | HoldParts
    | FreeParts
    | Reroll
    | Choose
    | Drag
    | Propose
    | Rewrite
    | Describe
    | Show
    | ShowDifference
    | Pick
    | Star
    | Judge
    | Undo
    | Redo
    | Export
)
