"""What a drag gives: the answers, or why there is none; and a part that is still being dragged."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from niwaki.draw.scene import Scene
from niwaki.result.progress import Watch
from niwaki.result.result import Result
from niwaki.result.sample import Sample


@dataclass(frozen=True)
class Dragged:
    """One answer to a drag.

    Attributes
    ----------
    sample : Sample
        The run with the changed choices.
    changed : dict
        By address: the value before and the value after; None where the run before had no such choice, or the run after
        has none.
    distance, share : float
        What is left to the point: scene units, and as a share of the scene's size.
    kind : str
        What was allowed to change: "least" all choices, "fewest" the three that move it most, "own" those of the part's
        own call, "outermost" those of the model itself, "other" all, from other values, "structure"
        discrete choices, too.
    part : str
        The address of the part that is there.
    holds : dict
        The choices that place the part there, with their values: a `hold` with which the rest is grown again.
    """

    sample: Sample
    changed: dict[str, tuple[Any, Any]]
    distance: float
    share: float
    kind: str
    part: str
    holds: dict[str, Any]

    def follow(
        self, *, seed: int | None = None, threads: int | None = None, progress: Watch | None = None
    ) -> Result:
        """Grow the rest again around the part, by the method of the sample's search, which holds what places the part.

        Parameters
        ----------
        seed
            Decides every random choice; that of the search when left out.
        threads, progress
            As for `niwaki.run`.

        Raises
        ------
        InputError
            With the part there every particle is impossible.
        """
        search = self.sample.search
        hold = {**search.held, **self.holds}
        own = replace(search, hold=hold, choices=None, seed=search.seed if seed is None else seed)
        return own.run(threads=threads, progress=progress)


@dataclass(frozen=True)
class Moved:
    """A part that is being dragged: the run as it is, without its score.

    Attributes
    ----------
    scene : Scene
        The scene of the run.
    point : tuple
        Where the held point is, scene units.
    share : float
        What is left to where it should be, as a share of the scene's size.
    reason : str
        Why it is not there; empty where it is.
    """

    scene: Scene
    point: tuple[float, float, float]
    share: float
    reason: str


@dataclass(frozen=True)
class Drag:
    """The answers to a drag, the least change first; or why there is none.

    Attributes
    ----------
    answers : list of Dragged
        Those with the part at the point, none of them impossible.
    nearest : Dragged or None
        The nearest that was found, where there is no answer.
    reason : str
        Why there is no answer; empty where there is one.
    """

    answers: list[Dragged]
    nearest: Dragged | None = None
    reason: str = ""

    @property
    def best(self) -> Dragged | None:
        """The first answer; without one, the nearest."""
        return self.answers[0] if self.answers else self.nearest
