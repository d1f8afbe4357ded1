"""Lowering of `infer(model, method, ...)` to a call of a host function with the model, the arguments and a seed.

    (host K MODEL ARGUMENT ... SEED)        K: the constant ("infer", keep, text of the method)

The seed is a choice of the outer run, `(sample (dist discrete_uniform 0 LARGEST))`; enumeration needs no seed. The
engine's `nested` reads the constant.
"""

from __future__ import annotations

import ast
from typing import Any

from niwaki import _engine
from niwaki.errors import InputError, ModelFault
from niwaki.lang.body import Body
from niwaki.lang.core import Expr, Form
from niwaki.lang.expressions import later, static
from niwaki.lang.names import MISSING
from niwaki.methods import EnumerateAll, Method
from niwaki.words.distributions import DiscreteUniform

KEEP = ("sample", "best")

#: The largest seed of an inner search.
LARGEST = 2**53 - 1

#: The distribution of an inner search's seed.
SEEDS = DiscreteUniform(0, LARGEST)


def constant(method: Method, keep: str) -> tuple[str, str, str]:
    """Return the constant for the engine: "infer", `keep`, the text of the method.

    Parameters
    ----------
    method
        The method that searches the inner model.
    keep
        "sample" or "best".
    """
    return ("infer", keep, method.text()[0])


def wrong_inside(method: Method) -> str:
    """Return the reason why an `infer` cannot use a method; an empty text if it can."""
    text, functions = method.text()
    if functions:
        return "inside a model a kernel cannot call a Python function, so it cannot use `proposal`"
    try:
        _engine.check_inside(text)
    except _engine.EngineFault as fault:
        return str(fault.message)
    return ""


def check(method: Any, keep: Any) -> None:
    """Refuse, in a plain run, the methods and settings that the compiler refuses."""
    if not isinstance(method, Method):
        raise ModelFault("type-mismatch", f"`infer` takes a method such as `smc(100)`, found {method!r}")
    if wrong := wrong_inside(method):
        raise ModelFault("bad-argument", f"{wrong}, found {method!r}")
    if keep not in KEEP:
        raise ModelFault("bad-argument", f'`keep` is "sample" or "best", found {keep!r}')


def infer(body: Body, node: ast.Call) -> Expr:
    """Lower a call of `infer`."""
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
    number = body.program.number(constant(method, keep))
    makers = [later(body, arg) for arg in (node.args[0], *node.args[2:])]
    if isinstance(method, EnumerateAll):
        return Form("host", [str(number), *body.in_order(makers), "0"], body.span(node))
    return Form("host", [str(number), *body.in_order([*makers, lambda: _seed(body, node)])], body.span(node))


def _seed(body: Body, node: ast.Call) -> Expr:
    return body.form("sample", [Form("dist", [SEEDS.family, "0", str(LARGEST)])], node)


def _method(body: Body, node: ast.expr) -> Method:
    """Return the method that an argument means when the model is compiled."""
    method = _constant(body, node)
    if not isinstance(method, Method):
        body.refuse("infer-method", node, found=body.span(node).text)
    if wrong := wrong_inside(method):
        body.refuse("infer-method", node, found=f"{body.span(node).text}: {wrong}")
    return method


def _constant(body: Body, node: ast.expr) -> Any:
    """Return a method, a kernel or a setting: a call of its function, a literal, or a constant of the module."""
    if isinstance(node, ast.Call):
        maker = static(body, node.func)
        if str(getattr(maker, "__module__", "")).startswith("niwaki.methods"):
            args = [_constant(body, arg) for arg in node.args]
            keywords = {
                keyword.arg: _constant(body, keyword.value) for keyword in node.keywords if keyword.arg
            }
            try:
                return maker(*args, **keywords)
            except (TypeError, InputError) as error:
                text = f"{body.span(node).text}: {str(error).splitlines()[0]}"
                body.refuse("infer-method", node, found=text)
    value = static(body, node)
    if value is not MISSING:
        return value
    try:
        return ast.literal_eval(node)
    except (ValueError, SyntaxError, TypeError):
        body.refuse("infer-method", node, found=body.span(node).text)
