"""Calls by kinds of callees: a value, a nested function, a function of a module, a built-in that computes."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from types import FunctionType
from typing import Any

from niwaki.errors.source import Span, head_span, span_of
from niwaki.lang import vocabulary
from niwaki.lang.arguments import bind, no_keywords
from niwaki.lang.body import Body
from niwaki.lang.core import Expr, Form, literal
from niwaki.lang.expressions import expression, expressions
from niwaki.lang.program import Program, Unit
from niwaki.lang.scope import Scope, Variable, default_expressions
from niwaki.lang.vocabulary import OMITTED, REQUIRED, Parameter


def applied(body: Body, node: ast.Call, head: str, callee: ast.expr, args: Sequence[ast.expr]) -> Expr:
    """Lower a call of a value; only the run knows which function the value is."""
    if node.keywords:
        body.refuse("keyword-of-a-value", node.keywords[0].value, name=body.span(callee).text)
    return body.form(head, expressions(body, [callee, *args]), node)


def nested(
    body: Body,
    node: ast.Call,
    scope: Scope,
    head: str,
    args: Sequence[ast.expr],
    keywords: Sequence[ast.keyword],
) -> Expr:
    """Lower a direct call of a nested function: its arguments, then its captures."""
    assert isinstance(scope.node, (ast.FunctionDef, ast.Lambda))
    required = {name for name in scope.parameters if name not in scope.defaults}
    parameters = [Parameter(name, REQUIRED if name in required else OMITTED) for name in scope.parameters]
    only = len(scope.node.args.kwonlyargs)
    place = head_span(scope.node, body.file)
    positions = bind(body, node, args, keywords, parameters, scope.name, place, only)
    values: list[Expr] = []
    for parameter, value in zip(parameters, positions, strict=True):
        if value is None:
            default = scope.defaults[parameter.name]
            value = default.core if isinstance(default, Variable) else expression(body, default)
        values.append(value)
    captures = [needed.core for needed in scope.needed]
    return body.form(head, [literal(body.unit.names[scope]), *values, *captures], node)


def user_function(
    body: Body,
    node: ast.Call,
    function: FunctionType,
    head: str,
    args: Sequence[ast.expr],
    keywords: Sequence[ast.keyword],
) -> Expr:
    """Lower a direct call of a user's function at the top level of a module."""
    unit = body.program.unit(function, body.span(node))
    root = unit.scopes.root
    assert isinstance(root.node, (ast.FunctionDef, ast.Lambda))
    required = set(root.parameters) - set(default_expressions(root.node))
    parameters = [Parameter(name, REQUIRED if name in required else OMITTED) for name in root.parameters]
    place = head_span(root.node, unit.file)
    only = len(root.node.args.kwonlyargs)
    positions = bind(body, node, args, keywords, parameters, function.__name__, place, only)
    defaults = live_defaults(body.program, unit)
    values = [defaults[n] if value is None else value for n, value in enumerate(positions)]
    return body.form(head, [literal(unit.name), *values], node)


def live_defaults(program: Program, unit: Unit) -> dict[int, Expr]:
    """Return the default values of a top-level function, by the parameter's position."""
    root = unit.scopes.root
    assert isinstance(root.node, (ast.FunctionDef, ast.Lambda))
    defaults = list(unit.function.__defaults__ or ())
    a = root.node.args
    positional = [arg.arg for arg in (*a.posonlyargs, *a.args)]
    values = dict(zip(positional[len(positional) - len(defaults) :], defaults, strict=True))
    values |= unit.function.__kwdefaults__ or {}
    places = default_expressions(root.node)

    def where(name: str) -> Span:
        return span_of(places[name], unit.file) if name in places else head_span(root.node, unit.file)  # type: ignore[arg-type]

    return {n: program.constant(values[p], where(p), p) for n, p in enumerate(root.parameters) if p in values}


def operate(body: Body, node: ast.Call, operation: vocabulary.Op) -> Expr:
    """Lower a call of a built-in or a word that computes."""
    name = body.span(node.func).text
    if node.keywords and not operation.keywords:
        no_keywords(body, node, name)
    if operation.head == "range" and node.args and len(node.args) <= 3:
        return body.form("range", expressions(body, node.args), node)
    if operation.head in ("to_list", "to_tuple") and not node.args:
        return Form("list" if operation.head == "to_list" else "tuple", [])
    values = bind(
        body, node, node.args, node.keywords, operation.parameters, name, variadic=operation.variadic
    )
    filled: list[Expr] = []
    for number, value in enumerate(values):
        parameter = operation.parameters[number] if number < len(operation.parameters) else None
        if value is not None:
            filled.append(value)
        elif parameter is not None and parameter.default is not OMITTED:
            filled.append(_default(parameter.default))
        elif any(later is not None for later in values[number:]):
            filled.append("none")
    return body.form(operation.head, filled, node)


def _default(value: Any) -> Expr:
    if isinstance(value, tuple):
        return Form("tuple", [literal(part) for part in value])
    return literal(value)
