"""The choices of a part of a run, to hold them in another search.

A part is a call or an iteration of a loop: what is at and below its address. What decides that it exists is above it:
the choices of the calls around it, and of the earlier iterations of the loops that it is in.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.settings import bad

#: A component of an address with the number of an iteration.
_ITERATION = re.compile(r"(.*)\[(\d+)\](.*)")


#: What is held, in every search, drag and command: values by address; or addresses and patterns of a run that is there,
#: one or several, which keep the values that they have in it.
Hold: TypeAlias = Mapping[str, Any] | str | Iterable[str]


def held(hold: Hold, choices: Mapping[str, Any] | None, scene: Iterable[str], name: str) -> Mapping[str, Any]:
    """The values of what is held, by address.

    Parameters
    ----------
    hold
        What is held.
    choices
        The choices of the run that is there; None without one.
    scene
        The addresses of its scene's primitives.
    name
        The model, for messages.

    Raises
    ------
    InputError
        `no-address`: a pattern matches nothing; `hold-without-run`: there is no run for it; `bad-setting`: it is none.
    """
    if isinstance(hold, Mapping) and all(isinstance(address, str) for address in hold):
        return hold
    patterns = (hold,) if isinstance(hold, str) else tuple(hold) if isinstance(hold, Iterable) else (None,)
    if isinstance(hold, Mapping) or not all(isinstance(pattern, str) for pattern in patterns):
        raise bad(
            "hold",
            hold,
            "values by address, or patterns of a run",
            '`{"width": 2.0}`, or `result.held("wing[1]")`',
        )
    if choices is None:
        raise InputError(
            "hold-without-run", flag="hold", other="`choices`", cure='`hold=result.held("wing[1]")`'
        )
    taken = chosen(patterns, choices, scene, name) if patterns else set()
    return {address: value for address, value in choices.items() if address in taken}


def chosen(patterns: Sequence[str], choices: Iterable[str], scene: Iterable[str], name: str) -> set[str]:
    """The addresses among `choices` that the patterns hold; `scene` are the addresses of the scene's primitives.

    Raises
    ------
    InputError
        A pattern matches neither a choice nor a part; with those that are nearest.
    """
    choices = list(choices)
    emitted = {place: _above(place) for place in scene}
    calls = {call for address in [*choices, *emitted] for call in _calls(address)}
    found: set[str] = set()
    for pattern in patterns:
        own = {address for address in choices if _engine.matches(pattern, address)}
        parts = {call for call in calls if _engine.matches(pattern, call)}
        parts |= {call for place, call in emitted.items() if _engine.matches(pattern, place)}
        if not own and not parts:
            near = _engine.nearest(pattern, [*choices, *sorted(calls)])
            nearest = ", ".join(f"`{one}`" for one in near) or "none: the run has no choice"
            raise InputError("no-address", pattern=pattern, name=name, nearest=nearest)
        above = {call for part in parts for call in deciding(part)}
        found |= own
        found |= {address for address in choices if _above(address) in above}
        found |= {address for address in choices if any(_is_below(address, part) for part in parts)}
    return found


def matching(pattern: str, choices: Iterable[str], scene: Iterable[str], name: str) -> list[str]:
    """The calls and iterations that a pattern matches, without those inside of another one, in the order of the run.

    A primitive of the scene stands for the call that emits it, as for `chosen`.

    Raises
    ------
    InputError
        It matches none; with those that are nearest.
    """
    emitted = {place: _above(place) for place in scene}
    calls = list(dict.fromkeys(call for address in [*choices, *emitted] for call in _calls(address)))
    found = {call for call in calls if _engine.matches(pattern, call)}
    found |= {call for place, call in emitted.items() if _engine.matches(pattern, place) and call}
    if not found:
        near = ", ".join(f"`{one}`" for one in _engine.nearest(pattern, sorted(calls)))
        raise InputError(
            "no-address", pattern=pattern, name=name, nearest=near or "none: the run has no part"
        )
    return [one for one in calls if one in found and not found & set(_calls(one))]


def _above(address: str) -> str:
    """The call in which something with this address is; empty for the model itself."""
    return address.rpartition("/")[0]


def _calls(address: str) -> Iterator[str]:
    """The calls and iterations that an address is in, the model itself left out."""
    while address := _above(address):
        yield address


def _is_below(address: str, part: str) -> bool:
    return not part or address.startswith(part + "/")


def deciding(part: str) -> Iterator[str]:
    """The calls and iterations whose own choices decide that a part exists."""
    for call in [part, *_calls(part)] if part else []:
        above, _, component = call.rpartition("/")
        yield above
        if iteration := _ITERATION.fullmatch(component):
            name, number, rest = iteration.groups()
            prefix = above + "/" if above else ""
            yield from (f"{prefix}{name}[{earlier}]{rest}" for earlier in range(int(number)))
