"""Goals, arguments and settings."""

from __future__ import annotations

import sys
from typing import Any

import msgspec

from niwaki.studio import messages as m
from niwaki.studio.session import loading, reshaping
from niwaki.studio.session.state import CommandError, Session
from niwaki.studio.window import Window

#: The most arguments of a model.
ARGUMENTS = 200


def set_ask(session: Session, window: Window, command: m.SetAsk) -> None:
    """Change the goals of the search."""
    changes = _set_fields(command.ask)
    if changes.get("target") is not None:
        changes.setdefault("sketch", None)
    if changes.get("sketch") is not None:
        changes.setdefault("target", None)
    ask = msgspec.structs.replace(session.document.ask, **changes)
    for solid in (ask.target, *ask.obstacles):
        if solid is not None and session.file_of(solid.source) is None:
            raise CommandError("no-target", f"there is no target `{solid.source}`")
    if ask != session.document.ask:
        session.step("ask", {"ask": ask})
    session.start(loading.load_ghost(session, window))


def set_values(session: Session, window: Window, command: m.Set) -> None:
    """Set arguments or settings; new arguments also change the active result."""
    changes: dict[str, Any] = {}
    if command.settings is not None:
        settings = msgspec.structs.replace(session.document.settings, **_set_fields(command.settings))
        changes["settings"] = settings
    if command.arguments is not None:
        changes["arguments"] = {**session.document.arguments, **_typed(session, command.arguments)}
        if len(changes["arguments"]) > ARGUMENTS:
            raise CommandError("too-many", f"a model has at most {ARGUMENTS} arguments")
    if changes:
        session.step("set", changes)
    if command.arguments is not None:
        if session.document.picked is not None:
            session.start(reshaping.reshape(session))
        session.start(loading.load_ghost(session, window))


def _typed(session: Session, arguments: dict[str, Any]) -> dict[str, Any]:
    """Return arguments with the types of their parameters: a page writes the real number 4.0 as 4."""
    listed = (model for model in session.models if model.reference == session.document.model)
    model = next(listed, session.model)
    parameters = {} if model is None else {parameter.name: parameter for parameter in model.parameters}
    return {name: _as_number(parameters.get(name), value) for name, value in arguments.items()}


def _as_number(parameter: m.Parameter | None, value: Any) -> Any:
    """Return the number of a parameter as a whole or as a real number; any other value stays."""
    if parameter is None or not (_is_number(value) and _is_number(parameter.default)):
        return value
    if not parameter.is_whole:
        # A larger whole number has no float.
        return float(value) if abs(value) <= sys.float_info.max else value
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _set_fields(changes: msgspec.Struct) -> dict[str, Any]:
    """Collect the fields that have a value."""
    return {
        name: value for name, value in msgspec.structs.asdict(changes).items() if value is not msgspec.UNSET
    }
