"""Words with effects: they score a run, record an answer, add to the scene, or postpone a call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from niwaki import _engine
from niwaki._engine import Shape
from niwaki.words.distributions import Distribution
from niwaki.words.running import runner

__all__ = ["condition", "emit", "factor", "force", "future", "infer", "observe", "query"]

T = TypeVar("T")


def observe(dist: Distribution, value: T) -> T:
    """Add the log density of an observed value to the score, as if the model had drawn it from `dist`.

    Parameters
    ----------
    dist
        A distribution value such as `Gaussian(0, 1)`.
    value
        The observed value.

    Returns
    -------
    The observed value.
    """
    observed: T = runner("observe").observe(dist, value)
    return observed


def factor(log_score: float) -> None:
    """Add `log_score` (in nats) to the log score of the run.

    Parameters
    ----------
    log_score
        Positive to favour the run, negative to disfavour it, `-inf` to forbid it.
    """
    runner("factor").factor(log_score)


def condition(holds: bool) -> None:
    """Forbid the run if `holds` is false.

    Parameters
    ----------
    holds
        A truth value.
    """
    runner("condition").condition(holds)


def query(key: str, value: Any) -> None:
    """Record an answer of the run under a key, as a part of the result.

    Parameters
    ----------
    key
        The answer's name, used once in a run.
    value
        The answer.
    """
    runner("query").query(key, value)


def emit(
    *shapes: Any,
    name: str | None = None,
    label: str | None = None,
    color: Sequence[float] | str | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
    material: str | None = None,
) -> None:
    """Add shapes to the scene. The shapes of an `emit` form one part, and may overlap each other.

    Parameters
    ----------
    shapes
        Shapes, or lists and tuples of shapes.
    name
        The part's name in addresses and files, instead of `emit`: a constant of letters, digits, `_` and `-`.
    label
        The part's name for people, a constant text; by default its `name`, or its first shape.
    color
        `(r, g, b)` in [0, 1], or a name such as "tomato" or "#c83c1e", for shapes that have no colour yet.
    metalness
        From 0 (paint, wood, stone) to 1 (metal), for solids that have no metalness yet.
    roughness
        From 0 (a mirror) to 1 (chalk), for solids that have no roughness yet.
    material
        The name of a material, which files keep, for solids that have none yet.
    """
    look = (color, metalness, roughness, material)
    is_plain = all(part is None for part in look)
    runner("emit").emit(shapes if is_plain else _engine.operation("worn", *look, tuple(flatten(shapes))))


def future(function: Callable[..., T], *args: Any, label: str | None = None) -> T:
    """Postpone a call, and return a future of its value. Futures may run in any order.

    Parameters
    ----------
    function
        A model function.
    args
        The function's arguments, by position.
    label
        The call's name for people, a constant text; by default the function's name.

    Returns
    -------
    A future of the function's value. You can pass it on, but only `force` reads it.
    """
    promise: T = runner("future").future(function, args)
    return promise


def force(promise: T) -> T:
    """Return the value of a future, after its call has run.

    Parameters
    ----------
    promise
        A future; any other value is returned as it is.
    """
    value: T = runner("force").force(promise)
    return value


def infer(
    model: Callable[..., Any], method: Any, *args: Any, keep: str = "sample", label: str | None = None
) -> Any:
    """Search another model inside this model, and return its value (dissertation 2.3.1).

    The outer run gets only the value, not the choices, factors and shapes of the inner model. The value depends on the
    model, its arguments and a seed. The seed is a choice of the outer run, with an address like any other choice.

    Parameters
    ----------
    model
        The inner model: a model, a function or a lambda.
    method
        `smc(...)`, `ais(...)`, `mh(...)`, `importance(...)`, `rejection(...)`, `forward(...)` or `enumerate_all(...)`,
        with constant settings or as a constant of the module.
    args
        The inner model's arguments, by position.
    keep
        "sample": the value of a sample, drawn by weight; "best": the value of the sample with the best log score.
    label
        The name of the seed's choice for people, a constant text.

    Returns
    -------
    The inner model's value; with `enumerate_all` the list of its values with their probabilities, most probable first.
    """
    return runner("infer").infer(model, method, args, keep)


def flatten(shapes: Sequence[Any]) -> list[Any]:
    """Return the shapes of an `emit` in order, with lists and tuples opened; other values raise `TypeError`."""
    flat: list[Any] = []
    waiting = [*reversed(shapes)]
    while waiting:
        shape = waiting.pop()
        if type(shape) in (list, tuple):
            waiting.extend(reversed(shape))
        elif isinstance(shape, Shape):
            flat.append(shape)
        else:
            raise TypeError(f"`emit` takes shapes, found {shape!r}")
    return flat
