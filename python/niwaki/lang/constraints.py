"""How far each soft constraint of a run is from holding, so that requests which contradict one another are seen.

The run is repeated in plain Python with the same choices; every `softeq`, `soft_at_least` and `soft_at_most` that it
meets is noted with its line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from niwaki.errors.source import Span
    from niwaki.words.models import Model


@dataclass(frozen=True)
class Constraint:
    """One soft constraint of a run.

    Attributes
    ----------
    kind : str
        "softeq", "soft_at_least" or "soft_at_most".
    address : str
        The calls and loops that led to it, then its kind.
    span : Span or None
        Where it stands in the source.
    value, goal : float
        What is compared with what.
    width : float
        Within which it should hold.
    """

    kind: str
    address: str
    span: Span | None
    value: float
    goal: float
    width: float

    @property
    def residual(self) -> float:
        """How far it is from holding, in its own units: signed for an equality, 0 or more for the others."""
        miss = self.value - self.goal
        if self.kind == "softeq":
            return miss
        return max(0.0, miss if self.kind == "soft_at_most" else -miss)

    @property
    def widths(self) -> float:
        """How far it is from holding, in widths; 0 or more."""
        return abs(self.residual) / self.width

    @property
    def line(self) -> str:
        """File and line, `tree.py:14`."""
        return f"{self.span.file.path}:{self.span.line}" if self.span is not None else ""


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
    from niwaki.lang.plain import run_python

    return Residuals(run_python(model, *args, seed=seed, choices=choices, **kwargs).constraints)
