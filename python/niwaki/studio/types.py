"""Types of the page: `python -m niwaki.studio.types FILE` writes the messages as TypeScript."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any, get_args

from msgspec import inspect as look

from niwaki.draw.palette import OBSTACLE
from niwaki.studio import messages

HEADER = (
    "// Written by `make studio-page` from python/niwaki/studio/messages, and python/niwaki/draw/palette.py:"
    " change these files instead.\n"
)


def typescript() -> str:
    """Write every message as an interface, and the unions of commands and of events."""
    commands = get_args(messages.AnyCommand)
    members = vars(messages.events) | vars(messages.modes)
    events = [member for member in members.values() if _is_event(member)]
    known: dict[str, look.StructType] = {}
    for kind in (*commands, *events, messages.View):
        _collect(look.type_info(kind), known)
    blocks = [_interface(kind) for kind in known.values()]
    blocks.append(_union("Command", commands))
    blocks.append(_union("Event", events))
    return "\n".join([HEADER, f"export const PROTOCOL = {messages.PROTOCOL};\n", _colors(), *blocks])


def _colors() -> str:
    """Write the colour of obstacles, the same as in pictures."""
    numbers = [
        f"{theme}: 0x{bytes(round(255 * c) for c in color).hex()}" for theme, color in OBSTACLE.items()
    ]
    return f"/** The colour of obstacles in each theme. */\nexport const OBSTACLE = {{ {', '.join(numbers)} }};\n"


def _is_event(member: Any) -> bool:
    return isinstance(member, type) and issubclass(member, messages.Event) and member is not messages.Event


def _union(name: str, kinds: Any) -> str:
    return f"export type {name} =\n" + "\n".join(f"  | {kind.__name__}" for kind in kinds) + ";\n"


def _collect(kind: look.Type, known: dict[str, look.StructType]) -> None:
    """Collect the structs that a type names, after the structs that they need."""
    if isinstance(kind, look.StructType):
        if kind.cls.__name__ in known:
            return
        for field in kind.fields:
            _collect(field.type, known)
        known[kind.cls.__name__] = kind
    elif isinstance(kind, look.UnionType):
        for member in kind.types:
            _collect(member, known)
    elif isinstance(kind, look.ListType):
        _collect(kind.item_type, known)


def _interface(kind: look.StructType) -> str:
    lines = [
        f"/** {(kind.cls.__doc__ or '').partition(chr(10))[0]} */",
        f"export interface {kind.cls.__name__} {{",
    ]
    is_sent = issubclass(kind.cls, messages.Command) or kind.forbid_unknown_fields
    if kind.tag_field is not None:
        lines.append(f'  {kind.tag_field}: "{kind.tag}";')
    for field in kind.fields:
        mark = "?" if is_sent and not field.required else ""
        lines.append(f"  {field.encode_name}{mark}: {_type(field.type)};")
    return "\n".join([*lines, "}", ""])


def _type(kind: look.Type) -> str:
    match kind:
        case look.StructType():
            return kind.cls.__name__
        case look.UnionType():
            members = [member for member in kind.types if not isinstance(member, look.CustomType)]
            return " | ".join(dict.fromkeys(_type(member) for member in members))
        case look.ListType():
            inner = _type(kind.item_type)
            return f"({inner})[]" if "|" in inner else f"{inner}[]"
        case look.TupleType():
            return f"[{', '.join(_type(member) for member in kind.item_types)}]"
        case look.DictType():
            return f"Record<string, {_type(kind.value_type)}>"
        case look.LiteralType():
            return " | ".join(f'"{value}"' for value in kind.values)
        case look.IntType() | look.FloatType():
            return "number"
        case look.StrType():
            return "string"
        case look.BoolType():
            return "boolean"
        case look.NoneType():
            return "null"
        case look.AnyType():
            return "any"
    raise TypeError(f"no TypeScript for {kind}")


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(typescript())
