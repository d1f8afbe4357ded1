"""A run of a model whose source has changed since: what still fits is kept, what is new is drawn.

`niwaki replay --anyway` runs the model's file as it is. Choices are matched by address, whatever their line. One that
the model does not make any more, or whose value is not possible there, is left out; one that the run did not have is
drawn.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import niwaki as nw
from niwaki import _engine, shell
from niwaki.errors import InputError, ModelFault, NiwakiError
from niwaki.lang.compiled import translated

#: So many addresses of each kind are named.
SHOWN = 6


@dataclass(frozen=True)
class Changed:
    """A run of a changed model.

    Attributes
    ----------
    sample
        The run.
    found
        The model as it is.
    kept, gone, unfit, drawn : list of str
        Addresses: with the value of the run; that the model does not make any more; whose value is not possible; of
        choices that were drawn, because the run did not have them, or not with such a value.
    """

    sample: nw.Sample
    found: shell.references.ModelReference
    kept: list[str]
    gone: list[str]
    unfit: list[str]
    drawn: list[str]

    def __str__(self) -> str:
        lines = [f"{len(self.kept)} of {len(self.kept) + len(self.gone) + len(self.unfit)} choices fit"]
        for what, addresses in (
            ("not made any more", self.gone),
            ("not possible there", self.unfit),
            ("drawn", self.drawn),
        ):
            if addresses:
                more = f" and {len(addresses) - SHOWN} more" if len(addresses) > SHOWN else ""
                named = ", ".join(f"`{one}`" for one in addresses[:SHOWN])
                lines.append(f"  {what}: {named}{more}")
        return "\n".join(lines)


def replayed(data: dict[str, Any], place: int, model: Path | None, path: Path) -> Changed:
    """A run of a search once more, with the model as its file has it.

    Parameters
    ----------
    data
        A run.json.
    place
        Which of its runs.
    model
        The model's file, where it is not the one that run.json names; it is run.
    path
        The run.json, for messages.
    """
    reference = str(data["model"])
    if model is not None:
        reference = f"{model}:{reference.rpartition(':')[2]}"
    found = shell.references.find(reference)
    known = tuple(sorted({module for module, _, _ in shell.trust.hosts(data["search"])}))
    before = shell.run_files.searched(data, known, path)
    search = replace(before, model=found.model, hold=None, choices=None)
    given = shell.run_files.choices(data["runs"][place], place, path)
    trace, unfit = _fitting(search, given, search.seed)
    values = {one.path: one.value for one in trace.choices}
    made = {address for address in values if address in given and address not in unfit}
    if given and not made:
        raise InputError("nothing-fits", count=len(given), model=found.reference)
    return Changed(
        nw.Sample.of_trace(trace, search, search.seed),
        found,
        [address for address in given if address in made],
        [address for address in given if address not in made and address not in unfit],
        [address for address in given if address in unfit],
        [address for address in values if address not in made],
    )


def _fitting(search: nw.Search, given: Mapping[str, Any], seed: int) -> tuple[_engine.Trace, set[str]]:
    """A run with the choices that are possible, and the addresses of those that are not."""
    unfit: set[str] = set()
    while True:
        asked = {address: value for address, value in given.items() if address not in unfit}
        try:
            trace = _run(search, asked, seed)
        except (ModelFault, InputError):
            unfit.add(_first_that_fails(search, asked, seed))
            continue
        outside = {one.path for one in trace.choices if one.log_density == -math.inf and one.path in asked}
        if not outside:
            return trace, unfit
        # The first alone: what comes after it may have depended on it.
        unfit.add(next(one.path for one in trace.choices if one.path in outside))


def _first_that_fails(search: nw.Search, given: dict[str, Any], seed: int) -> str:
    """The first choice with which a run fails; the error itself where it fails without any."""
    addresses = list(given)
    _run(search, {}, seed)
    low, high = 0, len(addresses)
    # A run with the first `low` choices works, one with the first `high` fails.
    while high - low > 1:
        middle = (low + high) // 2
        try:
            _run(search, {address: given[address] for address in addresses[:middle]}, seed)
            low = middle
        except NiwakiError:
            high = middle
    return addresses[low]


def _run(search: nw.Search, given: dict[str, Any], seed: int) -> _engine.Trace:
    with translated(search.model.name, f"seed={seed}", given):
        return search.task.replay(given, seed)
