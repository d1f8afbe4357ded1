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
        One network for all choices, which sees windows in the direction of growth; or the dissertation's networks (see
        `Training.dissertation`).
    objective : "examples", "bound" or "particles"
        The quantity that training raises: the density of traces of searches; or the evidence bound, of one run or of
        several (see `Training.bound`).
    runs : int
        Runs of each target in a step, for the two bounds.
    hidden : (int, int)
        Units of the two hidden layers of the shared network.
    components : int
        Gaussians of each mixture.
    share : float
        Share of the prior in each proposal; the weight of a choice is at most 1 / share.
    looks : bool, "target" or "scene"
        Whether the network sees the surroundings in the sketches; the dissertation's network can also see one image.
    reads : bool or tuple of str
        Whether the network sees the variables in scope, or the names of the variables that it sees.
    steps : int
        Number of steps of Adam. With None each choice is seen about `passes` times; the two bounds have 1,000 steps.
    passes : float
        Number of passes over the choices, without `steps`.
    rate : float
        Step size of Adam.
    decays : (float, float)
        Shares of Adam's means that stay at each step: of gradients, and of their squares.
    batch : int
        Number of choices for each step; of whole traces for the dissertation's network, of targets for the two bounds.
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
        # The other runs of a target are the baseline of each run, so there are at least two.
        count("runs", self.runs, 2, usual="16")
        images = ("target", "scene") if self.architecture == "dissertation" else ()
        if not isinstance(self.looks, bool) and self.looks not in images:
            expected = "True or False, or one image with the dissertation's network"
            raise bad("looks", self.looks, expected, "True")
        if len(self.hidden) != 2 or not all(is_whole(units) and units >= 1 for units in self.hidden):
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
        """Return settings for the dissertation's network and its recipe (6.4).

        Each choice has its own network, with one hidden layer. Its inputs are 3 by 3 windows of target and scene in
        four resolutions, through filters that are trained too; its position and direction; and the variables that
        `reads` names. Adam makes 20,000 steps, each with one whole trace. The share of the prior is nearly zero; in the
        dissertation it is zero.

        Parameters
        ----------
        changes
            Attributes with other values. `looks` and `reads` give the dissertation's ablations.
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
        """Return settings for training by the evidence bound, in place of examples.

        The guide is a family q of distributions over runs. Each step draws `runs` runs of each of `batch` targets from
        the current guide, and raises the mean of log p - log q. This mean is below the log evidence by the divergence
        of q from the posterior. The training needs no searches and no gradient of the model. A guide that cannot
        express the posterior learns one part of it and leaves out the rest; training on examples covers all of it.

        Parameters
        ----------
        changes
            Attributes with other values. `objective="particles"` raises the bound of all runs of a target together, the
            mean log of their mean weight, which tolerates runs of small weight.
        """
        recipe: dict[str, Any] = {"objective": "bound", "batch": 8, "averaging": 0.99}
        return cls(**(recipe | changes))
