"""The decorator `@model`, which marks a Python function as a model."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

from niwaki.lang.compiled import Compiled
from niwaki.lang.marks import P, T
from niwaki.lang.plain import run


class Model(Compiled[P, T]):
    """A model: a Python function that can be run, searched and drawn.

    Attributes
    ----------
    name : str
        The function's name.
    function : FunctionType
        The original Python function.
    """

    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> T:
        """Run the model once as plain Python with a fresh seed, and return only its value."""
        return cast(T, run(self.function, args, kwargs).value)

    def __repr__(self) -> str:
        return f"<model {self.name}>"


def model(function: Callable[P, T]) -> Model[P, T]:
    """Mark a function as a model.

    Parameters
    ----------
    function
        A function written in the modelling language.

    Examples
    --------
    >>> from niwaki import model
    >>> @model
    ... def half(x):
    ...     return x / 2
    >>> half
    <model half>
    """
    return Model(function)


def as_model(model: Model[..., Any] | Callable[..., Any]) -> Model[..., Any]:
    """Return a model as it is, and a function of the modelling language as a model."""
    return model if isinstance(model, Model) else Model(model)
