"""What a client asks: a command for each thing that the page does."""

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
    Settings,
    Strength,
    Text,
)

Side = Annotated[float, Meta(gt=0.0, le=1e5)]


class Command(Struct, kw_only=True, forbid_unknown_fields=True, tag_field="kind"):
    """What a client asks."""

    id: Number = 0


class Hello(Command, tag="hello"):
    """The first message: the whole state is the answer."""

    protocol: int


class ChooseModel(Command, tag="model"):
    """Take a model: a name of the gallery, or a reference of a file that was named at the start."""

    reference: Text


def _changes(kind: type[Struct]) -> type[Struct]:
    """The fields of a part of the document, each of which may be left out."""
    members = [(one.name, one.type | UnsetType, UNSET) for one in fields(kind)]
    return defstruct(f"{kind.__name__}Fields", members, frozen=True, forbid_unknown_fields=True)


class AskChange(_changes(Ask)):  # type: ignore[misc]
    """Other values of some fields of `Ask`; a target takes the place of a sketch, and a sketch that of a target."""


class SetAsk(Command, tag="ask"):
    """Say what the scene should be like; what is left out stays."""

    ask: AskChange


class SettingsChange(_changes(Settings)):  # type: ignore[misc]
    """Other values of some fields of `Settings`."""


class Set(Command, tag="set"):
    """Set arguments by name, or settings; what is left out stays."""

    arguments: Annotated[dict[str, Any], Meta(max_length=200)] | None = None
    settings: SettingsChange | None = None


class Run(Command, tag="run"):
    """Search; what is held stays. A search that runs is stopped first, and nothing of it is kept."""


class Stop(Command, tag="stop"):
    """Stop the search; what it has found becomes results."""


class HoldParts(Command, tag="hold"):
    """Hold parts of the picked result in what follows."""

    parts: Addresses
    #: Of a drawing's regions: the colour that they shall have; None for the picked result's.
    color: Color | None = None


class FreeParts(Command, tag="free"):
    """Hold them no more; all, where none is named."""

    parts: Addresses = field(default_factory=list)


class Reroll(Command, tag="reroll"):
    """Grow a part of the picked result again, in place; `count` times, by seeds that follow one another.

    Attributes
    ----------
    strength
        Of twice as many those that look most like it (0) or least (1); as they come when left out.
    """

    part: Address
    count: Count = 1
    strength: Strength | None = None


class Choose(Command, tag="choose"):
    """Give a choice of the picked result a value; while it moves only its shape is shown, at the end it is a result."""

    address: Address
    #: A colour where the address is a drawing's region.
    value: float | int | bool | Color
    phase: Literal["move", "end"] = "end"


class Drag(Command, tag="drag"):
    """Drag a part of the picked result to a point: while it moves only its shape is shown, at the end it is a result.

    Attributes
    ----------
    grab
        The point of the part that is held; its middle, where left out.
    along
        The direction in which a camera looks: distances along it do not count.
    phase
        A command that moves is left out where a newer one waits; "cancel" ends the drag with the result as it was.
    follow
        Whether the rest is grown again at the end, around the part.
    """

    part: Address
    to: Point
    grab: Point | None = None
    along: Point | None = None
    phase: Literal["move", "end", "cancel"] = "end"
    follow: bool = False


class Propose(Command, tag="propose"):
    """Ask for the change of the model's file that makes the arguments, as they are set, its defaults."""


class Rewrite(Command, tag="rewrite"):
    """Write a change of the model's file that was offered last; the difference is the one that was shown."""

    difference: Annotated[str, Meta(max_length=200_000)]


class Describe(Command, tag="describe"):
    """Ask for the choices of a result, with places in the source."""

    key: Key


class Show(Command, tag="show"):
    """Ask for the shape of a result."""

    key: Key
    detail: Literal["light", "fine"] = "light"


class ShowDifference(Command, tag="difference"):
    """Ask where a result differs from what is wanted."""

    key: Key


class Pick(Command, tag="pick"):
    """Go on with this result."""

    key: Key


class Star(Command, tag="star"):
    """Mark a result, or take the mark away."""

    key: Key
    on: bool = True


class Judge(Command, tag="judge"):
    """Ask whether a structure of blocks stands: what holds it, and where let go in a simulation, what falls."""

    key: Key
    simulate: bool = False


class Undo(Command, tag="undo"):
    """Take the last step back."""


class Redo(Command, tag="redo"):
    """Take the step again that was taken back."""


class Export(Command, tag="export"):
    """Write a result as a file, or its recipe (`json`), which `niwaki replay` repeats.

    Of a structure `dxf` and `svg` are the boards of which its pieces are cut, and `assembly` is how they are put
    together; of a drawing `toml` is its rules.
    """

    key: Key
    format: Literal["glb", "obj", "ply", "stl", "3mf", "svg", "png", "json", "dxf", "assembly", "toml"]
    scale: Annotated[float, Meta(gt=0.0, le=1e9)] | None = None
    #: Width and height of a board, and what the saw takes, millimetres.
    board: tuple[Side, Side] = (600.0, 400.0)
    kerf: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.2


AnyCommand = (
    Hello
    | ChooseModel
    | SetAsk
    | Set
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
