"""Residuals of a run's soft constraints, which show constraints that contradict one another.

The run is repeated in plain Python with the same choices, and every `softeq`, `soft_at_least` and `soft_at_most` is
recorded with its line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from niwaki.lang.constraints import Constraint
from niwaki.lang.models import Model
from niwaki.lang.plain import run_python


class Residuals(Sequence[Constraint]):
    """The soft constraints of a run, worst first; they print as a table."""

    def __init__(self, constraints: Sequence[Constraint]) -> None:
        self._worst_first = sorted(constraints, key=lambda constraint: -constraint.widths)

    def __len__(self) -> int:
        return len(self._worst_first)

    def __iter__(self) -> Iterator[Constraint]:
        return iter(self._worst_first)

    def __getitem__(self, index: Any) -> Any:
        return self._worst_first[index]

    def beyond(self, widths: float = 3.0) -> list[Constraint]:
        """Return the constraints that are further from holding than this many widths."""
        return [constraint for constraint in self if constraint.widths > widths]

    def __repr__(self) -> str:
        rows = [("widths", "residual", "width", "constraint", "line")]
        for constraint in self:
            rows.append(
                (
                    f"{constraint.widths:.2f}",
                    f"{constraint.residual:.4g}",
                    f"{constraint.width:.4g}",
                    constraint.address,
                    constraint.line,
                )
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
    """Return the soft constraints of a run with their distances from holding.

    Parameters
    ----------
    model
        A model, or a function of the modelling language.
    args, kwargs
        The model's arguments.
    choices
        The run's choices by address: `sample.choices`.
    seed
        The seed of the choices that `choices` does not have.

    Returns
    -------
    Residuals
        The constraints, worst first.

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
