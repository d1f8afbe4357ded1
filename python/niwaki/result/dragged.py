"""Results of drags: the answers, or the reason why there is none; and a part under a moving pointer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from niwaki.draw.scene import Scene
from niwaki.result.progress import Watch
from niwaki.result.result import Result
from niwaki.result.sample import Sample


@dataclass(frozen=True)
class Dragged:
    """Answer of a drag.

    Attributes
    ----------
    sample : Sample
        The run with the changed choices.
    changed : dict
        The value before and the value after, by address; None for a choice that the run before or after does not have.
    distance, share : float
        The distance to the goal: in scene units, and as a share of the scene's size.
    kind : str
        The choices that could change: "least" all, "fewest" the three that move the part most, "own" those of the
        part's own call, "outermost" those of the model itself, "other" all, from other values,
        "structure" discrete choices, too.
    part : str
        The address of the part at the goal.
    holds : dict
        The choices that place the part, with their values: a `hold` with which the rest is grown again.
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
        """Grow the rest again around the part, by the method of the sample's search, with the choices of the part held.

        Parameters
        ----------
        seed
            The seed of all random choices; the seed of the search when left out.
        threads, progress
            As for `niwaki.run`.

        Raises
        ------
        InputError
            Every particle with the part at the goal is impossible.
        """
        search = self.sample.search
        hold = {**search.held, **self.holds}
        around = replace(search, hold=hold, choices=None, seed=search.seed if seed is None else seed)
        return around.run(threads=threads, progress=progress)


@dataclass(frozen=True)
class Moved:
    """State of a part under a moving pointer, without a score.

    Attributes
    ----------
    scene : Scene
        The scene of the run.
    point : tuple
        The held point, scene units.
    share : float
        Its distance to the goal, as a share of the scene's size.
    reason : str
        The reason why it is not at the goal; empty if it is.
    """

    scene: Scene
    point: tuple[float, float, float]
    share: float
    reason: str


@dataclass(frozen=True)
class Drag:
    """Answers of a drag, the least change first; or the reason why there is none.

    Attributes
    ----------
    answers : list of Dragged
        The possible runs with the part at the goal.
    nearest : Dragged or None
        The nearest state, if there is no answer.
    reason : str
        The reason why there is no answer; empty with an answer.
    """

    answers: list[Dragged]
    nearest: Dragged | None = None
    reason: str = ""

    @property
    def best(self) -> Dragged | None:
        """The first answer; without an answer, the nearest state."""
        return self.answers[0] if self.answers else self.nearest
