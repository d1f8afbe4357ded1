"""The effects of a model: score a run, record an answer, add to the scene, postpone a call."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from niwaki._engine import Shape
from niwaki.words.distributions import Distribution
from niwaki.words.measures import worn
from niwaki.words.running import runner

__all__ = ["condition", "emit", "factor", "force", "future", "infer", "observe", "query"]

T = TypeVar("T")


def observe(dist: Distribution, value: T) -> T:
    """Say that `value` was seen where the model would draw from `dist`; adds its log density to the score.

    Parameters
    ----------
    dist
        A distribution value such as `Gaussian(0, 1)`.
    value
        What was seen.

    Returns
    -------
    The observed value.
    """
    seen: T = runner("observe").observe(dist, value)
    return seen


def factor(log_score: float) -> None:
    """Add `log_score` (nats) to the log score of this run.

    Parameters
    ----------
    log_score
        Positive to favour the run, negative to disfavour it, `-inf` to forbid it.
    """
    runner("factor").factor(log_score)


def condition(holds: bool) -> None:
    """Forbid every run in which `holds` is false.

    Parameters
    ----------
    holds
        A truth value.
    """
    runner("condition").condition(holds)


def query(key: str, value: Any) -> None:
    """Record an answer under a key; written once in a run, and only read from outside.

    Parameters
    ----------
    key
        The answer's name.
    value
        The answer.
    """
    runner("query").query(key, value)


def emit(
    *shapes: Any,
    name: str | None = None,
    color: Sequence[float] | None = None,
    metalness: float | None = None,
    roughness: float | None = None,
) -> None:
    """Add shapes to the scene. All shapes of one `emit` are one primitive and are not tested against one another.

    Parameters
    ----------
    shapes
        Shapes, or lists and tuples of shapes.
    name
        What addresses and files call the part, in place of `emit`: a constant of letters, digits, `_` and `-`.
    color
        `(r, g, b)` in [0, 1], for the shapes without a colour of their own.
    metalness
        From 0 (paint, wood, stone) to 1 (metal), for the solids without one of their own.
    roughness
        From 0 (a mirror) to 1 (chalk), for the solids without one of their own.
    """
    look = {"color": color, "metalness": metalness, "roughness": roughness}
    given = {key: value for key, value in look.items() if value is not None}
    runner("emit").emit([worn(shape, given) for shape in flatten(shapes)] if given else shapes)


def future(function: Callable[..., T], *args: Any) -> T:
    """Leave a call for later; in which order calls left for later run has no meaning.

    Parameters
    ----------
    function
        A model function.
    args
        Its arguments, by position.

    Returns
    -------
    A future of the function's value. It may be passed on; only `force` looks at it.
    """
    promise: T = runner("future").future(function, args)
    return promise


def force(promise: T) -> T:
    """The value of a future, waiting for it if it has not returned.

    Parameters
    ----------
    promise
        What `future` gave; anything else is given back.
    """
    value: T = runner("force").force(promise)
    return value


def infer(model: Callable[..., Any], method: Any, *args: Any, keep: str = "sample") -> Any:
    """What a search of another model gives: inference as a part of the language (dissertation 2.3.1).

    The choices, factors and shapes of the inner model are its own; the run around it sees only the value. That depends
    on the model, its arguments and a seed, which is a choice of the run around it, named like any other choice.

    Parameters
    ----------
    model
        A model, a function, a lambda.
    method
        `smc(...)`, `ais(...)`, `mh(...)`, `importance(...)`, `rejection(...)`, `forward(...)` or `enumerate_all(...)`,
        with constant settings or as a constant of the module.
    args
        The inner model's arguments, by position.
    keep
        "sample": the value of one sample, drawn by weight; "best": that of the sample with the best log score.

    Returns
    -------
    The inner model's value; with `enumerate_all` the list of its values with their probabilities, most probable first.
    """
    return runner("infer").infer(model, method, args, keep)


def flatten(shapes: Sequence[Any]) -> list[Any]:
    """The shapes of one `emit` in order, with lists and tuples opened; anything else is a `TypeError`."""
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
