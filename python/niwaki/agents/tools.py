"""Tools: one for each command of the studio, with the command's docstring and the JSON Schema of its fields."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Any, get_args

import msgspec

from niwaki.studio import messages as m

#: The tool that asks for the rest of an answer, and for the end of a command that takes long.
ANSWER = "answer"

_DECODER = msgspec.json.Decoder(m.AnyCommand)


@dataclass(frozen=True)
class Tool:
    """A tool: its name, its description, and the JSON Schema of its arguments."""

    name: str
    description: str
    schema: dict[str, Any]


def tools() -> list[Tool]:
    """Return a tool for each command, and the tool that asks for an answer again."""
    return [*(_tool(kind) for kind in commands().values()), _ANSWER]


def commands() -> dict[str, type[m.Command]]:
    """Return the commands by name; a connection begins by itself, so `hello` is left out."""
    kinds = [kind for kind in get_args(m.AnyCommand) if kind is not m.Hello]
    return {str(kind.__struct_config__.tag): kind for kind in kinds}


def command(name: str, arguments: dict[str, Any], number: int) -> m.AnyCommand:
    """Return the command of a call.

    Raises
    ------
    msgspec.ValidationError
        There is no such tool, or an argument does not fit its schema.
    """
    if name not in commands():
        raise msgspec.ValidationError(f"there is no tool `{name}`: there are {', '.join(commands())}")
    if name == "show":
        # A tool shows pictures, not meshes.
        arguments = {"detail": "picture", **arguments}
    decoded: m.AnyCommand = _DECODER.decode(msgspec.json.encode({**arguments, "kind": name, "id": number}))
    return decoded


def _tool(kind: type[m.Command]) -> Tool:
    # A schema of its own for each tool: definitions that other structs need stand beside it.
    _, definitions = msgspec.json.schema_components([kind], ref_template="#/$defs/{name}")
    whole = dict(definitions.pop(kind.__name__))
    properties = {name: field for name, field in whole["properties"].items() if name not in ("id", "kind")}
    required = [name for name in whole.get("required", ()) if name in properties]
    whole = {"type": "object", "properties": properties, "additionalProperties": False}
    if required:
        whole["required"] = required
    if definitions:
        whole["$defs"] = _without_unused(properties, definitions)
    return Tool(str(kind.__struct_config__.tag), inspect.cleandoc(kind.__doc__ or ""), whole)


def _without_unused(properties: Any, definitions: dict[str, Any]) -> dict[str, Any]:
    """Return the definitions that properties name, directly or through other definitions."""
    used: dict[str, Any] = {}
    waiting = [properties]
    while waiting:
        for name in _named(waiting.pop()):
            if name not in used:
                used[name] = definitions[name]
                waiting.append(definitions[name])
    return used


def _named(data: Any) -> list[str]:
    if isinstance(data, dict):
        here = [data["$ref"].rpartition("/")[2]] if isinstance(data.get("$ref"), str) else []
        return here + [name for value in data.values() for name in _named(value)]
    return [name for value in data for name in _named(value)] if isinstance(data, list) else []


_ANSWER = Tool(
    ANSWER,
    """Ask for the answer of an earlier call again: for its end, if the call takes longer than a second, or for a page.

Attributes
----------
id
    The number of the call, which its answer names.
page
    The page of the answer; the first is 1.""",
    {
        "type": "object",
        "properties": {
            "id": {"type": "integer", "minimum": 1},
            "page": {"type": "integer", "minimum": 1, "default": 1},
        },
        "required": ["id"],
        "additionalProperties": False,
    },
)
