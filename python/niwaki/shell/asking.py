"""The search that the flags of `niwaki grow` ask for; a batch asks for many of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import typer

from niwaki import Search, gallery, search, targets
from niwaki.errors import InputError
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS
from niwaki.shell import settings
from niwaki.shell.app import Megabytes, Runs, Seed
from niwaki.shell.references import ModelReference
from niwaki.targets.sketches import Ask


@dataclass(frozen=True)
class How:
    """How to search, beside the settings of the method; None for what was not given."""

    method: settings.MethodName = None
    guide: settings.GuideFile = None
    polish: settings.Polish = None
    polish_kernel: settings.PolishKernel = None
    runs: Runs = 1
    seed: Seed = None
    max_steps: Annotated[
        int, typer.Option("--max-steps", metavar="N", help="Most calls and loop steps of one run.")
    ] = MAX_STEPS
    max_memory: Megabytes = MAX_MEMORY >> 20


def searched(
    found: ModelReference,
    asks: Sequence[Ask],
    how: How,
    given: Mapping[str, Any],
    arguments: Mapping[str, Any],
    hold: Mapping[str, Any] | None = None,
) -> Search:
    """The search of a model.

    Parameters
    ----------
    found
        The model.
    asks
        What is asked of its scene.
    how, given
        How to search, and the settings of the method; None for those that were not given.
    arguments
        Of the model.
    hold
        Choices that are held.
    """
    onward = settings.polish(how.polish, how.polish_kernel)
    score = targets.asks.score(asks)
    suits: dict[str, Any] = (
        {"particles": gallery.PARTICLES} if found.entry is None else dict(found.entry.usual)
    )
    if score.window is not None:
        suits["power"] = 1.0
    sketches, name = [spec.name for spec in score.specs], how.method
    own = settings.guide(how.guide, found, sketches, name, dict(given))
    if own is not None:
        suits, name = {**suits, **search.GUIDED}, name or "smc"
    if "(emit " not in found.model.core().text:
        raise InputError("no-emit", name=found.model.name)
    return search.grow_search(
        found.model,
        **{**found.start(asks), **arguments},
        score=score,
        method=settings.guided(settings.method(name, dict(given), suits), own, given),
        polish=onward,
        seed=how.seed,
        hold=hold,
        runs=how.runs,
        max_steps=how.max_steps,
        max_memory=how.max_memory << 20,
    )
