"""Log densities of runs over continuous choices, with gradients, for samplers and optimisers of your own.

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
    """Log density over unconstrained coordinates.

    If a comparison of the model has another result than in the run, the model is run again at this point. `recordings`
    counts these runs. Scores of a scene are no part of the density.

    Attributes
    ----------
    start : array of shape (dim,)
        The coordinates of the sample.
    choices : list of Coordinates
        The continuous choices in the order of the run: `name` (the address), `family`, `transform`, and the place of
        the coordinates, `x[first : first + count]`.
    """

    def __init__(self, density: _engine.Density) -> None:
        self._density = density
        self.start: NDArray[np.float64] = density.start
        self.choices: list[_engine.Coordinates] = density.choices

    @property
    def dim(self) -> int:
        """The number of coordinates."""
        return self._density.dim

    @property
    def operations(self) -> int:
        """The number of operations for a value with its gradient."""
        return self._density.operations[0]

    @property
    def guards(self) -> int:
        """The number of comparisons on the path that was used last."""
        return self._density.operations[2]

    @property
    def recordings(self) -> int:
        """The number of runs of the model to record a path."""
        return self._density.recordings

    def value_and_gradient(self, x: ArrayLike) -> tuple[float, NDArray[np.float64]]:
        """Compute the log density and its gradient.

        Parameters
        ----------
        x : array of shape (dim,)
            Coordinates.

        Returns
        -------
        float
            The log density, nats; minus infinity if the model makes other choices than in the run.
        array of shape (dim,)
            The derivatives; NaN if the log density is minus infinity.

        Raises
        ------
        ModelFault
            The model fails at this point.
        InputError
            `x` has another shape.
        """
        point = np.ascontiguousarray(x, dtype=np.float64)
        with translated("model"):
            pair = self._density.value_and_gradient(point)
        return pair if pair is not None else (-np.inf, np.full(self.dim, np.nan))

    def __call__(self, x: ArrayLike) -> float:
        """The log density, nats."""
        return self.value_and_gradient(x)[0]

    def values(self, x: ArrayLike) -> dict[str, Any]:
        """The values of the continuous choices at these coordinates, by address."""
        with translated("model"):
            return self._density.values(np.ascontiguousarray(x, dtype=np.float64))

    def compile(self) -> bool:
        """Compile machine code now; by default it is compiled in the background after some hundred gradients.

        Returns
        -------
        bool
            Whether this processor has machine code; without it the density is interpreted.
        """
        return self._density.compile()

    def jax(self) -> str:
        """The text of a module with a JAX function `log_density(x)`, NaN if the model takes another path."""
        return self._density.jax()
