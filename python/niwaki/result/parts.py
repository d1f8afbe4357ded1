"""The choices of a part of a run, to hold them in another search.

A part is a call or an iteration of a loop: what is at and below its address. What decides that it exists is above it:
the choices of the calls around it, and of the earlier iterations of the loops that it is in.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from niwaki import _engine
from niwaki.errors import InputError

#: A component of an address with the number of an iteration.
_ITERATION = re.compile(r"(.*)\[(\d+)\](.*)")


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
