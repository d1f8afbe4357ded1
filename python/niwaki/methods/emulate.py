"""The search of dear models: an emulator learns what the scene does when a choice changes."""

from __future__ import annotations

from dataclasses import dataclass

from niwaki.errors.settings import count
from niwaki.methods.method import Method


@dataclass(frozen=True)
class Emulate(Method):
    """Search for one good run of a model whose choices come before its scene, in few runs.

    An emulator learns from each run which cells, pixels and numbers change when a choice does. The next run is the one
    whose scene it expects to be nearest to the goal, or about which it doubts most. It needs choices with the same
    ranges in all runs, and a score with a target to learn from; which choices a run makes may change from run to run.

    Parameters
    ----------
    evaluations
        The number of runs.
    diverse
        The number of results that differ, best score first. No two share more than half of their choices. Fewer
        results are possible, with a warning.
    """

    NAME = "emulate"
    evaluations: int = 300
    diverse: int | None = None

    def __post_init__(self) -> None:
        """Check the settings."""
        count("evaluations", self.evaluations)
        if self.diverse is not None:
            count("diverse", self.diverse)


emulate = Emulate
