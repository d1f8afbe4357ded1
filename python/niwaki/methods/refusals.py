"""Checks of settings by the engine, and errors about settings that it refuses."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from math import isfinite
from typing import Any

from niwaki import _engine
from niwaki.errors.settings import is_number, refused


def check_settings(
    check: Callable[[str], None], data: Any, values: Mapping[str, Any], defaults: Mapping[str, Any]
) -> None:
    """Let the engine check settings.

    Parameters
    ----------
    check
        The check, a function of the engine that takes a text.
    data
        The settings as data.
    values, defaults
        The settings as in the call, and their defaults, by name, for the message.

    Raises
    ------
    InputError
        The first setting that has a value it cannot have.
    """
    try:
        check(json.dumps(_readable(data)))
    except _engine.EngineFault as fault:
        raise refused(fault, values, defaults) from None


def _readable(value: Any) -> Any:
    """Replace each part that JSON cannot express by an empty list, which every range refuses."""
    match value:
        case dict():
            return {str(key): _readable(part) for key, part in value.items()}
        case list() | tuple():
            return [_readable(part) for part in value]
        case None | bool():
            return value
        case str():
            return value.encode(errors="replace").decode()
        case _:
            return value if is_number(value) and isfinite(value) else []


def as_real(value: Any) -> Any:
    """Convert a whole number to a real number; return anything else unchanged."""
    return float(value) if is_number(value) else value
