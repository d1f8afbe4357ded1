"""The values that a held choice may have, for messages about a value that it may not.

The engine tells that a value is outside of the support of its choice. The support depends on the run, so it is read
from runs in plain Python.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError
from niwaki.lang import densities
from niwaki.lang.compiled import translated
from niwaki.lang.plain import PlainRun
from niwaki.result.search_like import SearchLike
from niwaki.words.distributions import Distribution
from niwaki.words.running import current

#: Runs in which the choice is looked for.
RUNS = 8
#: Choices after which such a run ends.
CHOICES = 10_000

_OUTSIDE = re.compile(r"(the held choice `(.+?)` at line \d+): its value is outside of its support")


@contextmanager
def translated_run(search: SearchLike, seed: int) -> Iterator[None]:
    """Raise a fault of the engine as an error of the package, which says what values a held choice may have."""
    try:
        with translated(search.model.name, f"seed={seed}", model=search.model):
            yield
    except InputError as error:
        _explain(error, search)
        raise


def _explain(error: InputError, search: SearchLike) -> None:
    """Name the value and the range in an error about a held choice."""
    constraint = error.values.get("constraint", "")
    cause = _OUTSIDE.search(constraint)
    if cause is None or cause[2] not in search.held:
        return
    value = search.held[cause[2]]
    ranges = _ranges(search, cause[2])
    if not ranges:
        return
    range_text = ranges[0] if len(ranges) == 1 else f"{ranges[0]} or, in another run, {ranges[1]}"
    error.values["constraint"] = constraint.replace(
        cause[0], f"{cause[1]}: its value {value!r} is not {range_text}"
    )
    error.values["cure"] = f"hold `{cause[2]}` at {range_text}"


def _ranges(search: SearchLike, address: str) -> list[str]:
    """Describe the values that a choice may have in some runs, each range once."""
    held = {path: value for path, value in search.held.items() if path != address}
    ranges: dict[str, None] = {}
    for seed in range(RUNS):
        state = _Listener(seed, held, address)
        token = current.set(state)
        # A run may end in any fault: its choice was met before, or it says nothing.
        with suppress(Exception, _Met):
            state.enter(search.model.function, search.args, {})
        current.reset(token)
        if state.distribution is not None:
            ranges[_described(state.distribution)] = None
    return list(ranges)


def _described(distribution: Distribution) -> str:
    """Return the values of a distribution as text."""
    space, low, high = _engine.support(distribution.family, densities.parameters(distribution))
    if space == "bool":
        return "True or False"
    if space not in ("int", "real"):
        return f"a value of `{distribution!r}`"
    kind = "a whole number" if space == "int" else "a number"
    is_low, is_high = (
        low is not None and abs(low) != float("inf"),
        high is not None and abs(high) != float("inf"),
    )
    if is_low and is_high:
        return f"{kind} from {low:g} to {high:g}"
    return f"{kind} of at least {low:g}" if is_low else f"{kind} of at most {high:g}" if is_high else kind


class _Met(BaseException):
    """The end of a run that has met the choice."""


class _Listener(PlainRun):
    """A plain run up to one choice, of which it keeps the distribution."""

    def __init__(self, seed: int, choices: Mapping[str, Any], goal: str) -> None:
        super().__init__(seed, choices)
        self.goal = goal
        self.distribution: Distribution | None = None

    def sample(self, dist: Any, words: Any = None) -> Any:
        """Stop at the choice, or make another one."""
        if len(self.choices_made) > CHOICES:
            raise _Met
        if "/".join([*self.path, self.pending or "sample"]) != self.goal:
            return super().sample(dist, words)
        self.distribution = dist if isinstance(dist, Distribution) else None
        raise _Met
