"""How far each soft constraint of a run is from holding, which shows constraints that contradict one another.

The run is repeated in plain Python with the same choices; every `softeq`, `soft_at_least` and `soft_at_most` that it
meets is noted with its line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from niwaki.lang.constraints import Constraint
from niwaki.lang.models import Model
from niwaki.lang.plain import run_python


class Residuals(Sequence[Constraint]):
    """The soft constraints of a run, worst first; printed, they are a table."""

    def __init__(self, constraints: Sequence[Constraint]) -> None:
        self._worst_first = sorted(constraints, key=lambda one: -one.widths)

    def __len__(self) -> int:
        return len(self._worst_first)

    def __iter__(self) -> Iterator[Constraint]:
        return iter(self._worst_first)

    def __getitem__(self, index: Any) -> Any:
        return self._worst_first[index]

    def beyond(self, widths: float = 3.0) -> list[Constraint]:
        """Those that are further from holding than this many widths."""
        return [one for one in self if one.widths > widths]

    def __repr__(self) -> str:
        rows = [("widths", "residual", "width", "constraint", "line")]
        for one in self:
            rows.append(
                (f"{one.widths:.2f}", f"{one.residual:.4g}", f"{one.width:.4g}", one.address, one.line)
            )
        sizes = [max(len(row[k]) for row in rows) for k in range(4)]
        lines = []
        for row in rows:
            numbers = [cell.rjust(size) for cell, size in zip(row[:3], sizes[:3], strict=True)]
            lines.append("  ".join([*numbers, row[3].ljust(sizes[3]), row[4]]).rstrip())
        return "\n".join(lines)


def residuals(
    model: Model[..., Any] | Callable[..., Any],
    *args: Any,
    choices: Mapping[str, Any] | None = None,
    seed: int | None = None,
    **kwargs: Any,
) -> Residuals:
    """How far each soft constraint of a run is from holding.

    Parameters
    ----------
    model
        A model, or a function of the modelling language.
    args, kwargs
        Its arguments.
    choices
        The run's choices by address: `sample.choices`.
    seed
        Decides the choices that are not given.

    Returns
    -------
    Residuals
        The constraints that the run met, worst first.

    Examples
    --------
    >>> from niwaki import factor, residuals, softeq, uniform
    >>> def both():
    ...     x = uniform(0, 1)
    ...     factor(softeq(x, 0.25, 0.01) + softeq(x, 0.75, 0.1))
    >>> worst = residuals(both, choices={"x": 0.35})[0]
    >>> worst.goal, round(worst.widths, 6)
    (0.25, 10.0)
    """
    return Residuals(run_python(model, *args, seed=seed, choices=choices, **kwargs).constraints)
