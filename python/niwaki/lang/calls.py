"""Lowering of calls; the kind of callee selects the form.

A call of a nested function or a model function is direct; a built-in or a word becomes an operation; a record class
makes a record; a value of unknown origin is applied. `builtin_calls` has the built-ins that take functions or
generators.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from types import FunctionType, ModuleType
from typing import Any

from niwaki import words
from niwaki.lang import builtin_calls, vocabulary
from niwaki.lang.arguments import bind, no_keywords, no_stars
from niwaki.lang.body import Body
from niwaki.lang.callees import applied, nested, operate, user_function
from niwaki.lang.core import Expr, Form, literal
from niwaki.lang.emits import emit
from niwaki.lang.expressions import expressions, forbidden, keep_defaults, later, lowers, static
from niwaki.lang.inference import infer
from niwaki.lang.marks import Host, underlying
from niwaki.lang.names import MISSING, is_library, is_random, is_record_class, nearest
from niwaki.lang.scope import Scope, Variable
from niwaki.lang.statements import first_assignment, is_text
from niwaki.words.memo import Memoised


@lowers(ast.Call)
def call(body: Body, node: ast.Call) -> Expr:
    """Lower a call."""
    no_stars(body, node)
    callee = node.func
    if isinstance(callee, ast.Name):
        meaning = body.scopes.find(callee.id, body.scope)
        if isinstance(meaning, Scope):
            return nested(body, node, meaning, "call", node.args, node.keywords)
        if isinstance(meaning, Variable):
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


def known(body: Body, node: ast.Call, value: Any) -> Expr:
    """Lower a call of a Python object."""
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
    if value is words.mem:
        return mem(body, node)
    if isinstance(value, Memoised):
        return remembered(body, node, value)
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


def distribution(body: Body, node: ast.Call, family: type[words.Distribution]) -> Expr:
    """Lower a distribution as a value, with all its parameters."""
    parameters = vocabulary.parameters_of(family)
    name = body.span(node.func).text
    values = bind(body, node, node.args, node.keywords, parameters, name)
    filled = [
        literal(p.default) if value is None else value for p, value in zip(parameters, values, strict=True)
    ]
    return Form("dist", [family.family, *filled], body.span(node))


def effect(body: Body, node: ast.Call, word: Any) -> Expr:
    """Lower a call of `sample`, `observe`, `factor`, `condition`, `query`, `emit` or `force`."""
    head = vocabulary.EFFECTS[word]
    if head == "emit":
        return emit(body, node)
    values = bind(body, node, node.args, node.keywords, vocabulary.parameters_of(word), head)
    return body.form(head, [value for value in values if value is not None], node)


def record(body: Body, node: ast.Call, kind: type) -> Expr:
    """Lower the creation of a record, of a frozen dataclass or a NamedTuple."""
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


def mem(body: Body, node: ast.Call) -> Expr:
    """Lower `mem(f)`, which makes a new memoised function each time it runs."""
    values = bind(body, node, node.args, node.keywords, vocabulary.parameters_of(words.mem), "mem")
    return body.form("mem", [value for value in values if value is not None], node)


def remembered(body: Body, node: ast.Call, value: Memoised[..., Any]) -> Expr:
    """Lower a call of a memoised function of a module."""
    function = underlying(value.function)
    called = user_function(body, node, function, "call", node.args, node.keywords)
    assert isinstance(called, Form)
    memo = body.program.constant(value, body.span(node.func), value.name)
    return body.form("apply", [memo, *called.args[1:]], node)


def host(body: Body, node: ast.Call, value: Host[Any, Any]) -> Expr:
    """Lower a call of a pure host function; keywords become positions if the signature is known."""
    try:
        parameters = vocabulary.parameters_of(value.function)
    except (TypeError, ValueError):
        no_keywords(body, node, value.name)
        return body.form("host", [body.program.host(value), *expressions(body, node.args)], node)
    values = bind(body, node, node.args, node.keywords, parameters, value.name)
    filled = [
        body.program.constant(p.default, body.span(node), p.name) if argument is None else argument
        for p, argument in zip(parameters, values, strict=True)
    ]
    return body.form("host", [body.program.host(value), *filled], node)


def method(body: Body, node: ast.Call, callee: ast.Attribute) -> Expr:
    """Lower a call of a method of a built-in value, or of a function in a record's field."""
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
    makers: list[Callable[[], Expr]] = [later(body, callee.value)]
    makers += [builtin_calls.items_later(body, arg) for arg in node.args]
    value, *args = body.in_order(makers)
    return body.form("method", [value, literal(name), *args], node)


def changes(body: Body, node: ast.Call, callee: ast.Attribute, name: str, target: str) -> None:
    """Refuse a method that changes its value in place, and suggest a replacement."""
    second = None
    if isinstance(callee.value, ast.Name):
        meaning = body.scopes.find(callee.value.id, body.scope)
        if isinstance(meaning, Variable) and meaning.assigned:
            second = first_assignment(body, meaning)
    argument = body.span(node.args[0]).text if node.args else "..."
    of_dict = name == "pop" and node.args and is_text(node.args[0])
    cure = vocabulary.CHANGERS["popitem" if of_dict else name].format(target=target, argument=argument)
    body.refuse("changes-a-value", node, second, name=target, cure=cure if "`" in cure else f"`{cure}`")
