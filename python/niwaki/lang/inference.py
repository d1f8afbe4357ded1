"""`infer(model, method, ...)` to core form: a host function of the model, a seed and the arguments.

    (host K MODEL ARGUMENT ... SEED)        K: the constant ("infer", keep, method, settings ...)

The seed is a choice of the run around it, `(sample (dist discrete_uniform 0 LARGEST))`; enumeration needs none. The
engine's `nested` reads the constant.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from functools import partial
from types import FunctionType
from typing import Any

from niwaki.errors import Call, InputError, ModelFault
from niwaki.lang.body import Body
from niwaki.lang.core import Expr, Form
from niwaki.lang.expressions import expression, static
from niwaki.lang.names import MISSING
from niwaki.methods import EnumerateAll, Forward, Importance, Method, Mh, Rejection, Smc
from niwaki.words.distributions import DiscreteUniform
from niwaki.words.models import Model

KEEP = ("sample", "best")

#: The largest seed of an inner search.
LARGEST = 2**53 - 1

#: What an inner search draws its seed from.
SEEDS = DiscreteUniform(0, LARGEST)


def settings(method: Method, keep: str) -> tuple[Any, ...]:
    """The constant that the engine reads.

    Parameters
    ----------
    method
        How the inner model is searched.
    keep
        "sample" or "best".
    """
    match method:
        case Smc():
            own: tuple[Any, ...] = (
                "smc",
                method.particles,
                method.order,
                method.weights,
                float(method.temper),
                method.resampling,
                method.ess,
            )
        case Mh():
            own = ("mh", method.steps, method.strategy, method.chains, method.tries)
        case EnumerateAll():
            own = ("enumerate", method.max_runs)
        case Rejection():
            own = ("rejection", method.n, float(method.bound), method.max_tries)
        case Importance():
            own = ("importance", method.n)
        case Forward():
            own = ("forward", method.n)
        case _:
            raise TypeError(f"{method!r} is no method that `infer` knows")
    return ("infer", keep, *own)


def is_method(value: Any) -> bool:
    """Whether a live object is a method that `infer` knows."""
    return isinstance(value, (Smc, Mh, EnumerateAll, Rejection, Importance, Forward))


#: What an inner search of particles, or of chains, may be.
ONE_POPULATION = "particles are one population at a constant temperature"
PRIOR_MOVES = "chains draw from the prior, without `kernel`"


def limit(method: Any) -> str:
    """What an inner search of that kind may be, where this one is not; else nothing."""
    if isinstance(method, Smc) and not is_plain(method):
        return ONE_POPULATION
    if isinstance(method, Mh) and method.kernel is not None:
        return PRIOR_MOVES
    return ""


def is_plain(method: Smc) -> bool:
    """Whether a search of particles is one population, without a way of the temperature and without a clock."""
    extras = (method.anneal, method.diverse, method.seconds)
    return isinstance(method.particles, int) and method.populations == 1 and extras == (None, None, None)


def check(method: Any, keep: Any) -> None:
    """Refuse what the compiler refuses too, in a plain run."""
    if not is_method(method):
        raise ModelFault("type-mismatch", f"`infer` takes a method such as `smc(100)`, found {method!r}")
    if found := limit(method):
        raise ModelFault("bad-argument", f"inside a model {found}, found {method!r}")
    if keep not in KEEP:
        raise ModelFault("bad-argument", f'`keep` is "sample" or "best", found {keep!r}')


def search(
    function: FunctionType,
    method: Method,
    keep: str,
    args: Sequence[Any],
    seed: int,
    stack: Callable[[], list[Call]],
) -> Any:
    """What the engine gives for an `infer` of a plain run.

    Parameters
    ----------
    function
        The inner model.
    method, keep, args, seed
        As the words say.
    stack
        Asked for the calls of the plain run when the search fails.
    """
    from niwaki import _engine
    from niwaki.compiled import task

    made = task(Model(function), args)
    try:
        return made.infer(settings(method, keep), seed)
    except _engine.EngineFault as fault:
        raise ModelFault(fault.code, fault.message, fault.help, stack=stack()) from None


def infer(body: Body, node: ast.Call) -> Expr:
    """A call of `infer`."""
    keep = "sample"
    for keyword in node.keywords:
        value = keyword.value.value if isinstance(keyword.value, ast.Constant) else None
        if keyword.arg != "keep" or value not in KEEP:
            body.refuse("infer-keep", keyword.value, found=body.span(keyword.value).text)
        keep = str(value)
    if len(node.args) < 2:
        expected = "a model and a method"
        body.refuse(
            "wrong-number-of-arguments", node, name="infer", expected=expected, found=str(len(node.args))
        )
    method = _method(body, node.args[1])
    number = body.program.number(settings(method, keep))
    makers = [partial(expression, body, arg) for arg in (node.args[0], *node.args[2:])]
    if isinstance(method, EnumerateAll):
        return Form("host", [str(number), *body.in_order(makers), "0"], body.span(node))
    return Form("host", [str(number), *body.in_order([*makers, partial(_seed, body, node)])], body.span(node))


def _seed(body: Body, node: ast.Call) -> Expr:
    return body.form("sample", [Form("dist", [SEEDS.family, "0", str(LARGEST)])], node)


def _method(body: Body, node: ast.expr) -> Method:
    """The method that an argument means when the model is compiled."""
    found = static(body, node)
    if isinstance(node, ast.Call):
        maker = static(body, node.func)
        if str(getattr(maker, "__module__", "")).startswith("niwaki.methods"):
            args = [_constant(body, arg) for arg in node.args]
            keywords = {
                keyword.arg: _constant(body, keyword.value) for keyword in node.keywords if keyword.arg
            }
            try:
                found = maker(*args, **keywords)
            except (TypeError, InputError) as error:
                body.refuse(
                    "infer-method", node, found=f"{body.span(node).text}: {str(error).splitlines()[0]}"
                )
    if not is_method(found):
        body.refuse("infer-method", node, found=body.span(node).text)
    if wrong := limit(found):
        body.refuse("infer-method", node, found=f"{body.span(node).text}, but inside a model {wrong}")
    method: Method = found
    return method


def _constant(body: Body, node: ast.expr) -> Any:
    """A setting: a literal, or a constant of the module."""
    found = static(body, node)
    if found is not MISSING:
        return found
    try:
        return ast.literal_eval(node)
    except (ValueError, SyntaxError, TypeError):
        body.refuse("infer-method", node, found=body.span(node).text)
