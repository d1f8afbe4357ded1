"""Where in the source each choice is made and each part is emitted, and how far a choice's slider goes.

The model runs once more as plain Python with the choices of a result; its words note the line that called them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from niwaki.errors.source import Span
from niwaki.lang.models import Model
from niwaki.lang.plain import PlainRun
from niwaki.words.distributions import Distribution
from niwaki.words.running import current


class Noting(PlainRun):
    """A plain run that notes places and distributions by address."""

    def __init__(self, choices: Mapping[str, Any]) -> None:
        super().__init__(0, choices)
        self.places: dict[str, Span | None] = {}
        self.distributions: dict[str, Distribution] = {}

    def _span(self) -> Span | None:
        calls = self.stack()
        return calls[-1].span if calls else None

    def sample(self, dist: Any) -> Any:
        """Make a choice."""
        before = len(self.choices_made)
        value = super().sample(dist)
        if len(self.choices_made) > before:
            address = next(reversed(self.choices_made))
            self.places[address], self.distributions[address] = self._span(), dist
        return value

    def emit(self, shapes: Sequence[Any]) -> None:
        """Add a primitive to the scene."""
        super().emit(shapes)
        self.places[self.scene[-1][0]] = self._span()


def noted(model: Model[..., Any], args: Sequence[Any], choices: Mapping[str, Any]) -> Noting:
    """A run of the model with those choices; what it did until it failed, where it fails."""
    state = Noting(choices)
    token = current.set(state)
    try:
        state.enter(model.function, args, {})
    except Exception:  # noqa: S110 - a model that has changed may fail with old choices: then fewer places are known
        pass
    finally:
        current.reset(token)
    return state


def slider(dist: Distribution | None, value: Any) -> tuple[float, float, bool] | None:
    """The low and the high end of a choice's slider, and whether its values are whole; None where it has none."""
    if dist is None or isinstance(value, tuple | list | str):
        return None
    if isinstance(value, bool) or dist.family == "bernoulli":
        return 0.0, 1.0, True
    numbers = [one for one in dist.parameters if isinstance(one, int | float)]
    match dist.family:
        case "uniform" | "discrete_uniform":
            low, high = numbers[0], numbers[1]
        case "categorical":
            low, high = 0, len(dist.parameters[0]) - 1
        case "beta":
            low, high = 0.0, 1.0
        case "gaussian":
            low, high = numbers[0] - 4 * numbers[1], numbers[0] + 4 * numbers[1]
        case "truncated_gaussian":
            low, high = numbers[2], numbers[3]
        case _:
            reach = max(1.0, 2.0 * abs(value))
            low, high = (0.0 if value >= 0 else -reach), reach
    whole = isinstance(value, int)
    return float(min(low, value)), float(max(high, value)), whole
