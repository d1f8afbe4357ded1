"""Settings of a guide's network and of its training."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from niwaki.errors.settings import bad, count, is_whole, real
from niwaki.methods import at_least_one
from niwaki.methods.checks import one_of


@dataclass(frozen=True)
class Training:
    """Settings of a guide's network and of its training.

    Attributes
    ----------
    architecture : "shared" or "dissertation"
        One network for all choices, which sees windows in the direction of growth; or that of the dissertation (see
        `Training.dissertation`).
    objective : "examples", "bound" or "particles"
        What is raised: the density of traces that searches found; or the evidence bound, of one run or of several (see
        `Training.bound`).
    runs : int
        Runs of each target in a step, for the two bounds.
    hidden : (int, int)
        Units of the two hidden layers of the shared network.
    components : int
        Gaussians of each mixture.
    share : float
        Share of the prior in each proposal; the weight of a choice is at most 1 / share.
    looks : bool, "target" or "scene"
        Whether it sees the surroundings in the sketches; with the dissertation's network also one of the two images.
    reads : bool or tuple of str
        Whether it sees what is in scope, or the names of the variables that it sees.
    steps : int
        Steps of Adam; None for so many that each choice is seen about `passes` times, and 1,000 for the two bounds.
    passes : float
        As many passes over the choices.
    rate : float
        Step size of Adam.
    decays : (float, float)
        Shares of Adam's means that stay at each step: of slopes, and of their squares.
    batch : int
        Choices for each step; whole traces with the dissertation's network, targets for the two bounds.
    averaging : float
        Share of the mean of the weights that stays at each step; 0 for the last weights.
    """

    architecture: str = "shared"
    objective: str = "examples"
    runs: int = 16
    hidden: tuple[int, int] = (38, 32)
    components: int = 4
    share: float = 0.02
    looks: bool | str = True
    reads: bool | tuple[str, ...] = True
    steps: int | None = None
    passes: float = 6.0
    rate: float = 2e-3
    decays: tuple[float, float] = (0.9, 0.999)
    batch: int = 256
    averaging: float = 0.998

    def __post_init__(self) -> None:
        """Check the settings."""
        one_of("architecture", self.architecture, ("shared", "dissertation"))
        one_of("objective", self.objective, ("examples", "bound", "particles"))
        if self.architecture == "dissertation" and self.objective != "examples":
            raise bad("objective", self.objective, "'examples' with the dissertation's network", "'examples'")
        # The others are the baseline of each run.
        count("runs", self.runs, 2, usual="16")
        images = ("target", "scene") if self.architecture == "dissertation" else ()
        if not isinstance(self.looks, bool) and self.looks not in images:
            expected = "True or False, or one image with the dissertation's network"
            raise bad("looks", self.looks, expected, "True")
        if len(self.hidden) != 2 or not all(is_whole(one) and one >= 1 for one in self.hidden):
            raise bad("hidden", self.hidden, "two whole numbers above 0", "(38, 32)")
        for name in ("components", "batch", "steps"):
            if getattr(self, name) is not None:
                at_least_one(name, getattr(self, name))
        real("share", self.share, 0, 1, usual="0.02")
        real("rate", self.rate, 0, usual="0.002")
        real("passes", self.passes, 0, usual="6.0")
        real("averaging", self.averaging, 0, 1, "[)", "0.998")

    @classmethod
    def dissertation(cls, **changes: Any) -> Training:
        """The dissertation's network and its recipe (6.4).

        Each choice has a net of its own, with one hidden layer. It sees 3 by 3 windows of target and scene in four
        resolutions, through filters that are learned too, its position and direction, and what `reads` names. Adam
        makes 20,000 steps of one whole trace each. The share of the prior is nearly nothing; the dissertation has none.

        Parameters
        ----------
        changes
            Attributes with other values: `looks` and `reads` make the dissertation's ablations.
        """
        recipe: dict[str, Any] = {
            "share": 1e-6,
            "rate": 0.01,
            "decays": (0.75, 0.75),
            "batch": 1,
            "averaging": 0.0,
        }
        return cls(architecture="dissertation", **(recipe | changes))

    @classmethod
    def bound(cls, **changes: Any) -> Training:
        """By the evidence bound, in place of examples.

        The guide is a family of distributions over runs, q. Each step draws `runs` runs of each of `batch` targets from
        the present guide, and raises the mean of log p - log q, which is below the log evidence by the divergence of q
        from the posterior. It needs no searches and no gradient of the model. A guide that cannot express the posterior
        learns one part of it and leaves out the others; one that learns from examples covers all of it.

        Parameters
        ----------
        changes
            Attributes with other values; `objective="particles"` raises the bound of all runs of a target together, the
            mean log of their mean weight, which is kinder to runs of small weight.
        """
        recipe: dict[str, Any] = {"objective": "bound", "batch": 8, "averaging": 0.99}
        return cls(**(recipe | changes))
