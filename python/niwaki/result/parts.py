"""Choices of a part of a run, to hold them in another search.

A part is a call or an iteration of a loop: the choices at and below its address. Choices above it decide whether it
exists: those of the calls around it, and of the earlier iterations of its loops.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.errors.settings import bad
from niwaki.lang import lookup
from niwaki.lang.models import Model

#: A component of an address with the number of an iteration.
_ITERATION = re.compile(r"(.*)\[(\d+)\](.*)")


#: Held choices, in every search, drag and command: values by address; or one or several addresses and patterns, which
#: take the values of an existing run.
Hold: TypeAlias = Mapping[str, Any] | str | Iterable[str]


def held(
    hold: Hold, choices: Mapping[str, Any] | None, scene: Iterable[str], model: Model[..., Any]
) -> Mapping[str, Any]:
    """Resolve held choices to values by address.

    Parameters
    ----------
    hold
        Values by address or label, or addresses, labels and patterns.
    choices
        The choices of an existing run; None without a run.
    scene
        The addresses of the primitives in the scene of that run.
    model
        The model, with its labels.

    Raises
    ------
    InputError
        `no-address`: a pattern matches nothing; `ambiguous-label`: several choices have a label; `held-twice`: two
        names of one choice; `hold-without-run`: patterns without a run; `bad-setting`: another type.
    """
    if isinstance(hold, Mapping) and all(isinstance(address, str) for address in hold):
        return lookup.resolved(hold, model.labels, model.name) if hold else hold
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
    addresses = held_addresses(patterns, choices, scene, model) if patterns else set()
    return {address: value for address, value in choices.items() if address in addresses}


def held_addresses(
    patterns: Sequence[str], choices: Iterable[str], scene: Iterable[str], model: Model[..., Any]
) -> set[str]:
    """Find the addresses among `choices` that patterns hold; `scene` has the addresses of the scene's primitives.

    A text that matches no address may be a label.

    Raises
    ------
    InputError
        A pattern matches neither a choice nor a part; the message names the nearest addresses.
    """
    choices = list(choices)
    emitted = {place: _above(place) for place in scene}
    calls = {call for address in [*choices, *emitted] for call in _calls(address)}
    held: set[str] = set()
    for pattern in patterns:
        names = _matches(pattern, [*choices, *sorted(calls), *emitted], model, "choice")
        matches = names & set(choices)
        parts = names & calls | {call for place, call in emitted.items() if place in names}
        above = {call for part in parts for call in deciding(part)}
        held |= matches
        held |= {address for address in choices if _above(address) in above}
        held |= {address for address in choices if any(_is_below(address, part) for part in parts)}
    return held


def matching_parts(
    pattern: str, choices: Iterable[str], scene: Iterable[str], model: Model[..., Any]
) -> list[str]:
    """List the outermost calls and iterations that a pattern or a label matches, in the order of the run.

    A primitive of the scene stands for the call that emits it, as for `held_addresses`.

    Raises
    ------
    InputError
        The pattern matches no part; the message names the nearest parts.
    """
    emitted = {place: _above(place) for place in scene}
    calls = list(dict.fromkeys(call for address in [*choices, *emitted] for call in _calls(address)))
    # The model itself is no part.
    places = {place: call for place, call in emitted.items() if call}
    names = _matches(pattern, [*calls, *places], model, "part")
    matches = names & set(calls) | {call for place, call in places.items() if place in names}
    return [call for call in calls if call in matches and not matches & set(_calls(call))]


def _matches(pattern: str, addresses: Iterable[str], model: Model[..., Any], kind: str) -> set[str]:
    """The addresses that a pattern matches, else those with this label.

    Raises
    ------
    InputError
        There is none; the message names the nearest.
    """
    addresses = [*dict.fromkeys(addresses)]
    matches = {address for address in addresses if _engine.matches(pattern, address)}
    matches = matches or set(lookup.matching(model.labels, pattern, addresses))
    if not matches:
        nearest = lookup.nearest(model.labels, pattern, addresses, kind)
        raise InputError("no-address", pattern=pattern, name=model.name, nearest=nearest)
    return matches


def labelled_part(text: str, choices: Iterable[str], model: Model[..., Any]) -> str:
    """Return the address of a call or iteration with this label; the text itself if it is no label of a single one."""
    calls = list(dict.fromkeys(call for address in choices for call in _calls(address)))
    if any(_engine.matches(text, call) for call in calls):
        return text
    named = lookup.matching(model.labels, text, calls)
    return named[0] if len(named) == 1 else text


def _above(address: str) -> str:
    """The call around an address; empty for the model itself."""
    return address.rpartition("/")[0]


def _calls(address: str) -> Iterator[str]:
    """The calls and iterations around an address, without the model itself."""
    while address := _above(address):
        yield address


def _is_below(address: str, part: str) -> bool:
    return not part or address.startswith(part + "/")


def deciding(part: str) -> Iterator[str]:
    """List the calls and iterations whose own choices decide whether a part exists."""
    for call in [part, *_calls(part)] if part else []:
        above, _, component = call.rpartition("/")
        yield above
        if iteration := _ITERATION.fullmatch(component):
            name, number, rest = iteration.groups()
            prefix = above + "/" if above else ""
            yield from (f"{prefix}{name}[{earlier}]{rest}" for earlier in range(int(number)))
