"""Replay of a stored run with a model whose source has changed: choices that still fit are kept, new ones are drawn.

`niwaki replay --anyway` runs the model's file as it is now. Choices are matched by address, whatever their line. A
stored choice is left out if the model no longer makes it, or if its value is not possible; a choice that the run did
not have is drawn.
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

#: The number of addresses of each kind that are listed.
SHOWN = 6


@dataclass(frozen=True)
class Changed:
    """A run of a changed model.

    Attributes
    ----------
    sample
        The run.
    reference
        The model as it is now.
    reused, removed, unfit, drawn : list of str
        Addresses of choices: with the value of the run; that the model no longer makes; whose value is not possible;
        with a new value, because the run has no value that is possible.
    """

    sample: nw.Sample
    reference: shell.references.ModelReference
    reused: list[str]
    removed: list[str]
    unfit: list[str]
    drawn: list[str]

    def __str__(self) -> str:
        lines = [
            f"{len(self.reused)} of {len(self.reused) + len(self.removed) + len(self.unfit)} choices fit"
        ]
        for label, addresses in (
            ("no longer made", self.removed),
            ("not possible", self.unfit),
            ("drawn", self.drawn),
        ):
            if addresses:
                more = f" and {len(addresses) - SHOWN} more" if len(addresses) > SHOWN else ""
                listed = ", ".join(map(self.reference.model.labels.label, addresses[:SHOWN]))
                lines.append(f"  {label}: {listed}{more}")
        return "\n".join(lines)


def replay_changed(data: dict[str, Any], place: int, model: Path | None, path: Path) -> Changed:
    """Replay a run of a search with the model of its file as it is now.

    Parameters
    ----------
    data
        The data of a run.json.
    place
        The index of the run.
    model
        The model's file, if it is another than the file in run.json; it is run.
    path
        The run.json, for messages.
    """
    name = str(data["model"])
    if model is not None:
        name = f"{model}:{name.rpartition(':')[2]}"
    reference = shell.references.find(name)
    modules = tuple(sorted({module for module, _, _ in shell.trust.hosts(data["search"])}))
    before = shell.run_files.searched(data, modules, path)
    search = replace(before, model=reference.model, hold=None, choices=None)
    stored = shell.run_files.choices(data["runs"][place], place, path)
    trace, unfit = _fitting(search, stored, search.seed)
    values = {choice.path: choice.value for choice in trace.choices}
    reused = {address for address in values if address in stored and address not in unfit}
    if stored and not reused:
        raise InputError("nothing-fits", count=len(stored), model=reference.name)
    return Changed(
        nw.Sample.of_trace(trace, search, search.seed),
        reference,
        [address for address in stored if address in reused],
        [address for address in stored if address not in reused and address not in unfit],
        [address for address in stored if address in unfit],
        [address for address in values if address not in reused],
    )


def _fitting(search: nw.Search, stored: Mapping[str, Any], seed: int) -> tuple[_engine.Trace, set[str]]:
    """Return a run with the stored choices that are possible, and the addresses of the others."""
    unfit: set[str] = set()
    while True:
        values = {address: value for address, value in stored.items() if address not in unfit}
        try:
            trace = _run(search, values, seed)
        except (ModelFault, InputError):
            unfit.add(_first_failing(search, values, seed))
            continue
        outside = {
            choice.path
            for choice in trace.choices
            if choice.log_density == -math.inf and choice.path in values
        }
        if not outside:
            return trace, unfit
        # Only the first is left out: the choices after it may depend on it.
        unfit.add(next(choice.path for choice in trace.choices if choice.path in outside))


def _first_failing(search: nw.Search, stored: dict[str, Any], seed: int) -> str:
    """Return the first choice with which a run fails; raise the error of a run that fails without choices."""
    addresses = list(stored)
    _run(search, {}, seed)
    low, high = 0, len(addresses)
    # A run with the first `low` choices works, one with the first `high` fails.
    while high - low > 1:
        middle = (low + high) // 2
        try:
            _run(search, {address: stored[address] for address in addresses[:middle]}, seed)
            low = middle
        except NiwakiError:
            high = middle
    return addresses[low]


def _run(search: nw.Search, values: dict[str, Any], seed: int) -> _engine.Trace:
    with translated(search.model.name, f"seed={seed}", values):
        return search.task.replay(values, seed)
