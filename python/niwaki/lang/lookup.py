"""Addresses by what people call them: by a label, or by the last steps of a label or an address.

Wing 1 › section 2 › width     the whole label, in any case; `>` and `/` may stand for `›`
section 2 > width              its last steps
width                          the label of several choices without their numbers
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.lang.labels import SEPARATOR, Labels

#: The most addresses of a program that are compared with a label.
LIMIT = 1000
#: The most addresses that a message names.
MOST = 6

_SEPARATOR = re.compile(r"\s*[›>/]\s*")
_NUMBERED = re.compile(r"(.+) \d+")


def matching(labels: Labels, text: str, addresses: Iterable[str]) -> list[str]:
    """List the addresses that a text names.

    These are the addresses with this label. If there are none, they are those whose label or address ends with the
    text, and then those whose label does so without its numbers.
    """
    return _matching(text, [(address, labels.steps(address)) for address in dict.fromkeys(addresses)])


def _matching(text: str, rows: Iterable[tuple[str, Sequence[str]]]) -> list[str]:
    steps_of_text = _steps(text)
    whole, ends, unnumbered = list[str](), list[str](), list[str]()
    for address, label in rows:
        steps = [_plain(step) for step in label]
        if steps == steps_of_text:
            whole.append(address)
        elif steps_of_text in (
            steps[-len(steps_of_text) :],
            address.casefold().split("/")[-len(steps_of_text) :],
        ):
            ends.append(address)
        elif len(steps) >= len(steps_of_text) and all(
            step == name or ((numbered := _NUMBERED.fullmatch(step)) is not None and numbered[1] == name)
            for step, name in zip(steps[-len(steps_of_text) :], steps_of_text, strict=True)
        ):
            unnumbered.append(address)
    return whole or ends or unnumbered


def choices_named(labels: Labels, text: str) -> tuple[list[str], bool]:
    """List the addresses of a program's choices that a text names, and tell whether they are all."""
    steps_of_text = _steps(text)
    numbers = {int(number) for number in re.findall(r"\d{1,9}", text)}
    numbers |= {number - 1 for number in numbers if number > 0}

    def leads_there(steps: Sequence[str], _: int) -> bool:
        return (
            len(steps) <= len(steps_of_text)
            and [_plain(step) for step in steps[:-1]] == steps_of_text[: len(steps) - 1]
        )

    rows, _ = labels.walk(numbers, leads_there, LIMIT)
    whole = [address for address, steps in rows if [_plain(step) for step in steps] == steps_of_text]
    if whole:
        return whole, True
    rows, is_all = labels.walk({0, 1} | numbers, _is_shallow, LIMIT)
    return _matching(text, rows), is_all


def choices(labels: Labels) -> list[str]:
    """List addresses of a program's choices, with the first two iterations of loops, for messages."""
    return [address for address, _ in labels.walk((0, 1), _is_shallow, LIMIT)[0]]


def _is_shallow(_: Sequence[str], times: int) -> bool:
    """Enter each function at most twice on a path."""
    return times < 2


def nearest(labels: Labels, text: str, addresses: Iterable[str], kind: str) -> str:
    """Return the end of a message about a text that names nothing: the nearest addresses with their labels.

    `kind` is the word for what was looked for, if there is none of it.
    """
    names: dict[str, str] = {}
    for address in addresses:
        for name in (address, labels.label(address), labels.short(address)):
            names.setdefault(name.casefold(), address)
    near: list[str] = []
    while len(near) < 3 and names:
        for name in _engine.nearest(text.casefold(), list(names)):
            if names[name] not in near and len(near) < 3:
                near.append(names[name])
        names = {name: address for name, address in names.items() if address not in near}
    if not near:
        return f"there is no {kind}"
    return f"the nearest {'are' if len(near) > 1 else 'is'} {described(labels, near)}"


def described(labels: Labels, addresses: Sequence[str]) -> str:
    """Return addresses with their labels, where these say more: `` `roof#1/high` (Roof 2 › high)``."""
    texts = []
    for address in addresses[:MOST]:
        label = labels.label(address)
        texts.append(
            f"`{address}`"
            if label.replace(SEPARATOR, "/").casefold() == address.casefold()
            else f"`{address}` ({label})"
        )
    more = len(addresses) - MOST
    return ", ".join(texts) + (f" and {more} more" if more > 0 else "")


def resolved(values: Mapping[str, Any], labels: Labels, name: str) -> dict[str, Any]:
    """Return values of choices by address, for values by address or label.

    A text that names nothing stays as it is: the engine knows whether it is an address.

    Raises
    ------
    InputError
        `ambiguous-label`: several choices have the label; `held-twice`: two texts name the same choice.
    """
    by_address: dict[str, Any] = {}
    texts: dict[str, str] = {}
    for text, value in values.items():
        address = text
        if labels.tables and not labels.is_possible(text):
            named, is_all = choices_named(labels, text)
            if len(named) > 1 or (named and not is_all):
                raise ambiguous(labels, text, named, name)
            address = named[0] if named else text
        if address in by_address and by_address[address] != value:
            raise held_twice(address, (texts[address], by_address[address]), (text, value))
        by_address[address], texts[address] = value, text
    return by_address


def ambiguous(labels: Labels, text: str, addresses: Sequence[str], name: str) -> InputError:
    """Return the error of a label that several choices have."""
    return InputError("ambiguous-label", label=text, name=name, addresses=described(labels, addresses))


def held_twice(address: str, first: tuple[str, Any], second: tuple[str, Any]) -> InputError:
    """Return the error of a choice with two values, each with the text that names the choice."""
    return InputError(
        "held-twice",
        address=address,
        first=f"{first[0]}={first[1]}",
        second=f"{second[0]}={second[1]}",
    )


def _steps(text: str) -> list[str]:
    return [_plain(step) for step in _SEPARATOR.split(text.strip())]


def _plain(step: str) -> str:
    return " ".join(step.casefold().split()).removesuffix("?")
