"""The log density of a run over its continuous choices, with its gradient: for samplers and optimisers of your own.

`log_density(sample)` takes any sample of a result. Discrete choices keep the sample's values; continuous ones become
unconstrained coordinates, with the Jacobian of the transform in the density:

========  ==========================  =====================================================
name      support                     value of the coordinates `v`
========  ==========================  =====================================================
line      all reals                   `v`
above     above `lo`                  `lo + exp(v)`
between   `lo` to `hi`                `lo + (hi - lo) / (1 + exp(-v))`
circle    angles                      `v`, less whole turns
simplex   n shares that sum to one    n - 1 sticks broken off what is left; zeros are equal shares
vector    vectors                     `v`
========  ==========================  =====================================================
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from niwaki import _engine
from niwaki.lang.compiled import translated


class LogDensity:
    """A log density over unconstrained coordinates.

    Where a comparison of the model turns out otherwise than in the run, the model is run again there; this is seen in
    `recordings` and costs about a run. Scores of a scene are no part of the density.

    Attributes
    ----------
    start : array of shape (dim,)
        The coordinates of the sample.
    choices : list of Coordinates
        The continuous choices in the order of the run: `name` (the address), `family`, `transform`, and where the
        coordinates are, `x[first : first + count]`.
    """

    def __init__(self, density: _engine.Density) -> None:
        self._density = density
        self.start: NDArray[np.float64] = density.start
        self.choices: list[_engine.Coordinates] = density.choices

    @property
    def dim(self) -> int:
        """How many coordinates there are."""
        return self._density.dim

    @property
    def operations(self) -> int:
        """How many operations a value with its gradient takes."""
        return self._density.operations[0]

    @property
    def guards(self) -> int:
        """How many comparisons hold on the path that was used last."""
        return self._density.operations[2]

    @property
    def recordings(self) -> int:
        """How often the model was run to record a path."""
        return self._density.recordings

    def value_and_gradient(self, x: ArrayLike) -> tuple[float, NDArray[np.float64]]:
        """The log density and its gradient.

        Parameters
        ----------
        x : array of shape (dim,)
            Coordinates.

        Returns
        -------
        float
            Nats. Minus infinity where the model would make other choices than in the run.
        array of shape (dim,)
            Derivatives; NaN where the value is minus infinity.

        Raises
        ------
        ModelFault
            The model fails at this point.
        InputError
            `x` has another shape.
        """
        point = np.ascontiguousarray(x, dtype=np.float64)
        with translated("model"):
            found = self._density.value_and_gradient(point)
        return found if found is not None else (-np.inf, np.full(self.dim, np.nan))

    def __call__(self, x: ArrayLike) -> float:
        """The log density, nats."""
        return self.value_and_gradient(x)[0]

    def values(self, x: ArrayLike) -> dict[str, Any]:
        """The values of the continuous choices at these coordinates, by address."""
        with translated("model"):
            return self._density.values(np.ascontiguousarray(x, dtype=np.float64))

    def compile(self) -> bool:
        """Make machine code now; it is made in the background after some hundred gradients otherwise.

        Returns
        -------
        bool
            Whether this processor has any; without it the density is interpreted.
        """
        return self._density.compile()

    def jax(self) -> str:
        """The text of a module with a JAX function `log_density(x)`, NaN where the model would take another path."""
        return self._density.jax()
