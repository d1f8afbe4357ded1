"""Calls to core form: who is called decides what it becomes.

A name that is a nested function or a live model function is called directly; a built-in or a word becomes an
operation; a record class makes a record; a value of unknown origin is applied. `builtin_calls` holds the built-ins
that take functions or generators.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from functools import partial
from types import FunctionType, ModuleType
from typing import Any

from niwaki import words
from niwaki.errors.source import Span, head_span, span_of
from niwaki.lang import builtin_calls, vocabulary
from niwaki.lang.arguments import bind, no_keywords, no_stars
from niwaki.lang.body import Body
from niwaki.lang.core import Expr, Form, literal
from niwaki.lang.expressions import closure, expression, expressions, forbidden, keep_defaults, lowers, static
from niwaki.lang.inference import infer
from niwaki.lang.names import MISSING, is_library, is_random, is_record_class, nearest
from niwaki.lang.program import Program, Unit
from niwaki.lang.scope import Scope, Variable, default_expressions
from niwaki.lang.vocabulary import OMITTED, REQUIRED, Parameter
from niwaki.words.models import Host, underlying


@lowers(ast.Call)
def call(body: Body, node: ast.Call) -> Expr:
    """Any call."""
    no_stars(body, node)
    callee = node.func
    if isinstance(callee, ast.Name):
        found = body.scopes.find(callee.id, body.scope)
        if isinstance(found, Scope):
            return nested(body, node, found, "call", node.args, node.keywords)
        if isinstance(found, Variable):
            return applied(body, node, "apply", callee, node.args)
    if isinstance(callee, ast.Lambda):
        keep_defaults(body, body.scopes.of[callee])
        return nested(body, node, body.scopes.of[callee], "call", node.args, node.keywords)
    value = underlying(static(body, callee))
    if value is not MISSING:
        return known(body, node, value)
    if isinstance(callee, ast.Attribute):
        return method(body, node, callee)
    if isinstance(callee, (ast.Constant, ast.List, ast.Tuple, ast.Dict, ast.JoinedStr)):
        body.refuse("not-a-function", callee, name=body.span(callee).text)
    return applied(body, node, "apply", callee, node.args)


def applied(body: Body, node: ast.Call, head: str, callee: ast.expr, args: Sequence[ast.expr]) -> Expr:
    """A call of a value: only the run knows which function it is."""
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
    """A direct call of a nested function: its arguments, then what it captures."""
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


def known(body: Body, node: ast.Call, value: Any) -> Expr:
    """A call of a live object."""
    try:
        special = builtin_calls.TABLE.get(value)
        operation = vocabulary.OPERATIONS.get(value)
    except TypeError:
        special = operation = None
    if special is not None:
        return special(body, node)
    if operation is not None:
        return operate(body, node, operation)
    if isinstance(value, Host):
        return host(body, node, value)
    if value is words.infer:
        return infer(body, node)
    if isinstance(value, type) and issubclass(value, words.Distribution):
        return distribution(body, node, value)
    if is_record_class(value):
        return record(body, node, value)
    if _in(value, vocabulary.DRAWS):
        dist = distribution(body, node, vocabulary.DRAWS[value])
        return body.form("sample", [dist], node)
    if _in(value, vocabulary.EFFECTS):
        return effect(body, node, value)
    if _in(value, vocabulary.NOT_IN_A_MODEL) or _in(value, vocabulary.FORBIDDEN_BUILTINS):
        forbidden(body, node, value)
    if is_random(value):
        body.refuse("outside-randomness", node, name=body.span(node.func).text)
    if isinstance(value, FunctionType) and not is_library(value):
        return user_function(body, node, value, "call", node.args, node.keywords)
    text = body.span(node.func).text
    if isinstance(value, type) or callable(value):
        code = "class-call" if isinstance(value, type) else "library-function"
        body.refuse(code, node, name=text)
    if isinstance(value, ModuleType):
        body.refuse("module-as-value", node.func, name=text)
    body.refuse("not-a-function", node.func, name=text)


def _in(value: Any, table: Any) -> bool:
    try:
        return value in table
    except TypeError:
        return False


def user_function(
    body: Body,
    node: ast.Call,
    function: FunctionType,
    head: str,
    args: Sequence[ast.expr],
    keywords: Sequence[ast.keyword],
) -> Expr:
    """A direct call of a function that the user wrote at the top level of a module."""
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
    """The default values of a top-level function, by the parameter's position."""
    root = unit.scopes.root
    assert isinstance(root.node, (ast.FunctionDef, ast.Lambda))
    given = list(unit.function.__defaults__ or ())
    a = root.node.args
    positional = [arg.arg for arg in (*a.posonlyargs, *a.args)]
    values = dict(zip(positional[len(positional) - len(given) :], given, strict=True))
    values |= unit.function.__kwdefaults__ or {}
    places = default_expressions(root.node)

    def where(name: str) -> Span:
        return span_of(places[name], unit.file) if name in places else head_span(root.node, unit.file)  # type: ignore[arg-type]

    return {n: program.constant(values[p], where(p), p) for n, p in enumerate(root.parameters) if p in values}


def operate(body: Body, node: ast.Call, operation: vocabulary.Op) -> Expr:
    """A built-in or a word that computes."""
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


def distribution(body: Body, node: ast.Call, family: type[words.Distribution]) -> Expr:
    """A distribution as a value, with all its parameters."""
    parameters = vocabulary.parameters_of(family)
    name = body.span(node.func).text
    values = bind(body, node, node.args, node.keywords, parameters, name)
    filled = [
        literal(p.default) if value is None else value for p, value in zip(parameters, values, strict=True)
    ]
    return Form("dist", [family.family, *filled], body.span(node))


def effect(body: Body, node: ast.Call, word: Any) -> Expr:
    """`sample`, `observe`, `factor`, `condition`, `query`, `emit`, `force`."""
    head = vocabulary.EFFECTS[word]
    if head == "emit":
        no_keywords(body, node, "emit")
        if not node.args:
            body.refuse(
                "wrong-number-of-arguments", node, name="emit", expected="at least 1 argument", found="0"
            )
        return body.form("emit", expressions(body, node.args), node)
    values = bind(body, node, node.args, node.keywords, vocabulary.parameters_of(word), head)
    return body.form(head, [value for value in values if value is not None], node)


def record(body: Body, node: ast.Call, kind: type) -> Expr:
    """A record of a frozen dataclass or a NamedTuple."""
    body.program.check_record(kind, body.span(node))
    parameters = vocabulary.parameters_of(kind)
    values = bind(body, node, node.args, node.keywords, parameters, kind.__name__)
    filled: list[Expr] = []
    for parameter, value in zip(parameters, values, strict=True):
        if value is None and repr(parameter.default) == "<factory>":
            body.refuse("record-runs-code", node, name=kind.__name__)
        filled.append(
            body.program.constant(parameter.default, body.span(node), parameter.name)
            if value is None
            else value
        )
    return body.form("record", [str(body.program.class_number(kind)), *filled], node)


def host(body: Body, node: ast.Call, value: Host[Any, Any]) -> Expr:
    """A pure host function; its keywords are written as positions when its signature tells them."""
    try:
        parameters = vocabulary.parameters_of(value.function)
    except (TypeError, ValueError):
        no_keywords(body, node, value.name)
        return body.form("host", [body.program.host(value), *expressions(body, node.args)], node)
    values = bind(body, node, node.args, node.keywords, parameters, value.name)
    filled = [
        body.program.constant(p.default, body.span(node), p.name) if given is None else given
        for p, given in zip(parameters, values, strict=True)
    ]
    return body.form("host", [body.program.host(value), *filled], node)


def method(body: Body, node: ast.Call, callee: ast.Attribute) -> Expr:
    """A method of a built-in value, or a function kept in a record's field."""
    name, target = callee.attr, body.span(callee.value).text
    if name in vocabulary.CHANGERS and not body.namespace.has_field(name):
        changes(body, node, callee, name, target)
    if name not in vocabulary.METHODS or body.namespace.has_field(name):
        if body.namespace.has_field(name):
            return applied(body, node, "apply", callee, node.args)
        close = nearest(name, vocabulary.METHODS)
        hint = (
            f"did you mean `{close[0]}`?"
            if close
            else "methods of a model's values are " + ", ".join(vocabulary.METHODS)
        )
        body.refuse("unknown-method", node, name=name, suggestion=hint)
    no_keywords(body, node, name)
    least, most = vocabulary.METHODS[name]
    if not least <= len(node.args) <= most:
        expected = (
            f"{least} argument{'s' * (least != 1)}" if least == most else f"{least} to {most} arguments"
        )
        body.refuse(
            "wrong-number-of-arguments", node, name=name, expected=expected, found=str(len(node.args))
        )
    makers: list[Callable[[], Expr]] = [partial(expression, body, callee.value)]
    makers += [partial(builtin_calls.iterable, body, arg) for arg in node.args]
    value, *args = body.in_order(makers)
    return body.form("method", [value, literal(name), *args], node)


def changes(body: Body, node: ast.Call, callee: ast.Attribute, name: str, target: str) -> None:
    """Refuse a method that changes its value in place, with what to write instead."""
    from niwaki.lang.statements import made_here

    second = None
    if isinstance(callee.value, ast.Name):
        found = body.scopes.find(callee.value.id, body.scope)
        if isinstance(found, Variable) and found.assigned:
            second = made_here(body, found)
    argument = body.span(node.args[0]).text if node.args else "..."
    cure = vocabulary.CHANGERS[name].format(target=target, argument=argument)
    body.refuse("changes-a-value", node, second, name=target, cure=cure if "`" in cure else f"`{cure}`")


__all__ = ["call", "closure"]
