"""The search that the flags of `niwaki grow` ask for; a batch asks for many of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from niwaki import Search, gallery, search
from niwaki.errors import InputError
from niwaki.errors.settings import MAX_MEMORY, MAX_STEPS
from niwaki.shell import controls, settings
from niwaki.shell.references import ModelReference


@dataclass(frozen=True)
class Asked:
    """The flags that decide a search, as they were given; None for those that were not.

    Attributes
    ----------
    chosen
        What the scene should be like.
    method, guide, polish, polish_kernel
        How to search.
    given
        Settings of the method.
    """

    chosen: controls.Controls
    voxel: float | None = None
    sigma: float | None = None
    rule: str = "solid"
    method: str | None = None
    guide: str | None = None
    polish: int | None = None
    polish_kernel: str | None = None
    runs: int = 1
    seed: int | None = None
    max_steps: int = MAX_STEPS
    max_memory: int = MAX_MEMORY >> 20
    given: Mapping[str, Any] = field(default_factory=dict)

    def search(
        self, found: ModelReference, arguments: Mapping[str, Any], lock: Mapping[str, Any] | None = None
    ) -> Search:
        """The search of a model with these arguments; `lock` holds choices."""
        onward = settings.polish(self.polish, self.polish_kernel)
        aim = self.chosen.aim(found)
        score = self.chosen.score(found, self.voxel, self.sigma)
        drawing = self.chosen.drawing(found)
        start: dict[str, Any] = {}
        if drawing is not None and controls.follows(found.model):
            start = dict(zip(("x", "y", "ahead"), drawing.place(self.chosen.page(found)), strict=True))
        voxel, entry = self.voxel, found.entry
        if voxel is None and self.chosen.target is None and aim is not None and entry is not None:
            voxel = entry.voxel
        suits: dict[str, Any] = {"particles": gallery.PARTICLES} if entry is None else entry.usual
        if score.window is not None:
            suits = {**suits, "power": 1.0}
        sketches = [*(spec.name for spec in score.specs), *(["match_volume"] if aim else [])]
        method, given = self.method, dict(self.given)
        own = settings.guide(self.guide, found, sketches, method, given)
        if own is not None:
            suits, method = {**suits, **search.GUIDED}, method or "smc"
        if "(emit " not in found.model.core().text:
            raise InputError("no-emit", name=found.model.name)
        return search.asked(
            found.model,
            aim,
            **{**start, **arguments},
            score=score,
            method=settings.guided(settings.method(method, given, suits), own, given),
            polish=onward,
            seed=self.seed,
            lock=lock,
            voxel=voxel,
            sigma=0.02 if self.sigma is None else self.sigma,
            rule=self.rule,
            runs=self.runs,
            max_steps=self.max_steps,
            max_memory=self.max_memory << 20,
        )
