"""Places in the source of choices and parts, and the ranges of sliders.

The model runs once more as plain Python with the choices of a result; each word notes the line that called it.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from typing import Any

from niwaki import _engine
from niwaki.errors.source import Span
from niwaki.lang.models import Model
from niwaki.lang.plain import PlainRun
from niwaki.words.distributions import FAMILIES, Distribution
from niwaki.words.running import current

#: Where the draws of each family lie, by the family's name.
SPACES = {family.family: _engine.FAMILIES[family.family][3] for family in FAMILIES}
#: The spaces whose draws are whole numbers, and the spaces whose draws are real numbers.
WHOLE = ("Integers", "Categories")
REAL = ("Bounded", "Line", "Positive", "Unit", "Circle")


class PlaceRecorder(PlainRun):
    """A plain run that notes places and distributions by address."""

    def __init__(self, choices: Mapping[str, Any]) -> None:
        super().__init__(0, choices)
        self.places: dict[str, Span | None] = {}
        self.distributions: dict[str, Distribution] = {}

    def _span(self) -> Span | None:
        calls = self.stack()
        return calls[-1].span if calls else None

    def sample(self, dist: Any, words: Sequence[str] | None = None) -> Any:
        """Make a choice, and note its place."""
        before = len(self.choices_made)
        value = super().sample(dist, words)
        if len(self.choices_made) > before:
            address = next(reversed(self.choices_made))
            self.places[address], self.distributions[address] = self._span(), dist
        return value

    def emit(self, shapes: Sequence[Any]) -> None:
        """Add a primitive to the scene, and note its place."""
        super().emit(shapes)
        self.places[self.scene[-1][0]] = self._span()


def record(model: Model[..., Any], args: Sequence[Any], choices: Mapping[str, Any]) -> PlaceRecorder:
    """Run the model with these choices and record places; a run that fails has the places before the failure."""
    state = PlaceRecorder(choices)
    token = current.set(state)
    try:
        state.enter(model.function, args, {})
    except Exception:  # noqa: S110 - a changed model may fail with old choices: then fewer places are known
        pass
    finally:
        current.reset(token)
    return state


def slider(dist: Distribution | None, value: Any) -> tuple[float, float, bool] | None:
    """Return the low and the high end of a slider, and whether its values are whole; None without a slider."""
    if dist is None or isinstance(value, tuple | list | str):
        return None
    if isinstance(value, bool) or dist.family == "bernoulli":
        return 0.0, 1.0, True
    numbers = [number for number in dist.parameters if isinstance(number, int | float)]
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
    space = SPACES[dist.family]
    # A mixture draws whole or real numbers, as its components do.
    is_whole = space in WHOLE or (space not in REAL and isinstance(value, int))
    return float(min(low, value)), float(max(high, value)), is_whole


def as_drawn(family: str, value: Any, present: Any) -> Any:
    """Return a value of a choice in the type of its family's draws: JSON writes the real number 2.0 as 2.

    Parameters
    ----------
    family
        The family of the choice.
    value
        The value, as it came.
    present
        The present value of the choice, for families whose draws have the type of a component's draws.
    """
    # A whole number beyond all floats stays as it is.
    if isinstance(value, bool) or not isinstance(value, int | float) or abs(value) > sys.float_info.max:
        return value
    space = SPACES.get(family)
    if space in REAL or (space not in WHOLE and isinstance(present, float)):
        return float(value)
    if space == "Booleans" or isinstance(present, bool):
        return bool(value)
    return int(value) if float(value).is_integer() else value
