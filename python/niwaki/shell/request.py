"""The search that the flags of `niwaki grow` describe; a batch has many of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

import typer

from niwaki import Search, gallery, search, targets
from niwaki.errors import InputError
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS
from niwaki.methods import Improve
from niwaki.shell import settings
from niwaki.shell.app import Megabytes, Runs, Seed
from niwaki.shell.references import ModelReference
from niwaki.targets.sketches import Ask


@dataclass(frozen=True)
class SearchFlags:
    """Flags of a search beside the settings of its method; None for a flag that was left out."""

    method: settings.MethodName = None
    guide: settings.GuideFile = None
    polish: settings.Polish = None
    polish_kernel: settings.PolishKernel = None
    runs: Runs = 1
    seed: Seed = None
    max_steps: Annotated[
        int, typer.Option("--max-steps", metavar="N", help="Limit of calls and loop steps of one run.")
    ] = MAX_STEPS
    max_memory: Megabytes = MAX_MEMORY >> 20


def search_of(
    reference: ModelReference,
    asks: Sequence[Ask],
    flags: SearchFlags,
    method_settings: Mapping[str, Any],
    arguments: Mapping[str, Any],
    hold: Mapping[str, Any] | None = None,
) -> Search:
    """Return the search of a model.

    Parameters
    ----------
    reference
        The model.
    asks
        Terms of the score: targets and constraints.
    flags
        Flags of the search.
    method_settings
        Settings of the method; None for a flag that was left out.
    arguments
        Arguments of the model.
    hold
        Held choices by address.
    """
    chain = settings.polish(flags.polish, flags.polish_kernel)
    score = targets.asks.score(asks, targets.sketches.volume_score)
    defaults: dict[str, Any] = (
        {"particles": gallery.PARTICLES} if reference.entry is None else dict(reference.entry.usual)
    )
    if score.window is not None:
        defaults["power"] = 1.0
    sketches, name = [spec.name for spec in score.specs], flags.method
    guide = settings.guide(flags.guide, reference, sketches, name, dict(method_settings))
    if guide is not None:
        name = name or settings.guided_method(dict(method_settings))
        # The settings of a model without a guide are for one population.
        usual = {"particles": gallery.PARTICLES}
        defaults = usual if name == Improve.NAME else {**defaults, **search.GUIDED}
    if "(emit " not in reference.model.core().text:
        raise InputError("no-emit", name=reference.model.name)
    built = search.grow_search(
        reference.model,
        **{**reference.start(asks), **arguments},
        score=score,
        # The rule of intersections is among the asks.
        rule=targets.sketches.FREE,
        method=settings.guided(
            settings.method(name, dict(method_settings), defaults), guide, method_settings
        ),
        polish=chain,
        seed=flags.seed,
        hold=hold,
        runs=flags.runs,
        max_steps=flags.max_steps,
        max_memory=flags.max_memory << 20,
    )
    is_free = name is None and "resampling" not in defaults
    return search.by_program(built, settings.typed(dict(method_settings))) if is_free else built
