"""Lowering of expressions, with a function for each kind of syntax node.

The arms of `and`, `or` and `if ... else`, which may not be evaluated, are lowered separately. If an arm needs
statements, the whole expression becomes an `if` statement that sets a temporary.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from functools import partial
from types import ModuleType
from typing import Any, TypeVar

import numpy as np

from niwaki import words
from niwaki.lang import vocabulary
from niwaki.lang.body import Block, Body, stable
from niwaki.lang.core import Expr, Form, literal
from niwaki.lang.names import MISSING, hashable, is_record_class, nearest
from niwaki.lang.refuse import refuse
from niwaki.lang.scope import Scope, Variable

Node = TypeVar("Node", bound=ast.AST)
#: The arrays of a mesh, of this package or of another.
ARRAYS = ("vertices", "faces")
TABLE: dict[type[ast.AST], Callable[[Body, Any], Expr]] = {}


def lowers(*kinds: type[ast.AST]) -> Callable[[Callable[[Body, Node], Expr]], Callable[[Body, Node], Expr]]:
    """Register a function that lowers kinds of nodes."""

    def register(function: Callable[[Body, Node], Expr]) -> Callable[[Body, Node], Expr]:
        TABLE.update(dict.fromkeys(kinds, function))
        return function

    return register


def expression(body: Body, node: ast.expr) -> Expr:
    """Lower an expression."""
    lower = TABLE.get(type(node))
    if lower is None:
        refuse(body, node)
    return lower(body, node)


def later(body: Body, node: ast.expr) -> Callable[[], Expr]:
    """Return a function that lowers an expression."""
    return lambda: expression(body, node)


def expressions(body: Body, nodes: Sequence[ast.expr]) -> list[Expr]:
    """Lower several expressions, evaluated from left to right."""
    return body.in_order([later(body, node) for node in nodes])


@lowers(ast.Constant)
def constant(body: Body, node: ast.Constant) -> Expr:
    """Lower a number, a truth value, a string or None."""
    value = node.value
    if isinstance(value, (bytes, complex)) or value is ...:
        body.refuse("unknown-constant", node, name=body.span(node).text, found=_kind(value))
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        body.refuse("integer-too-large", node, found=str(value))
    if isinstance(value, float):
        return body.program.real(value, body.span(node))
    return literal(value)


def _kind(value: Any) -> str:
    return {"bytes": "a bytes string", "complex": "a complex number"}.get(type(value).__name__, "an ellipsis")


@lowers(ast.Name)
def name(body: Body, node: ast.Name) -> Expr:
    """Lower a name: a variable, a nested function, or an object from outside of the model."""
    meaning = body.scopes.find(node.id, body.scope)
    if isinstance(meaning, Variable):
        return variable(body, node, meaning)
    if isinstance(meaning, Scope):
        return closure(body, meaning, node)
    return outside(body, node, resolve(body, node))


def variable(body: Body, node: ast.Name, local: Variable) -> Expr:
    """Lower a local or captured variable; refuse a variable that certainly has no value yet."""
    moment = body.scopes.moments.get(node)
    if local.owner is body.scope.function and moment is not None and local.assigned:
        if not any(when.may_precede(moment) for when, _ in local.assigned):
            first = local.assigned[0][1]
            body.refuse("used-before-assigned", node, body.span(first), name=node.id)
    return local.core


def resolve(body: Body, node: ast.Name) -> Any:
    """Return the object of a global name."""
    value = body.namespace.find(node.id)
    if value is MISSING:
        local = [*(name for scope in body.scopes.of.values() for name in (*scope.variables, *scope.nested))]
        close = nearest(node.id, [*body.namespace.names(), *local])
        hint = _import_of(node.id) or (
            f"did you mean `{close[0]}`?"
            if close
            else f"give `{node.id}` a value before the model is defined, or as an argument"
        )
        body.refuse("unknown-name", node, name=node.id, suggestion=hint)
    return value


def outside(body: Body, node: ast.expr, value: Any) -> Expr:
    """Lower a Python object that is used as a value."""
    text = body.span(node).text
    function = vocabulary.ALL_WORDS | set(vocabulary.OPERATIONS) | {map, filter, sorted, dict}
    if hashable(value) and (value in vocabulary.NOT_IN_A_MODEL or value in vocabulary.FORBIDDEN_BUILTINS):
        forbidden(body, node, value)
    if (hashable(value) and value in function) or is_record_class(value):
        body.refuse("word-as-value", node, name=text, cure=f"lambda x: {text}(x)")
    if isinstance(value, ModuleType):
        body.refuse("module-as-value", node, name=text)
    return with_place(body.program.constant(value, body.span(node), text), body, node)


def with_place(form: Expr, body: Body, node: ast.AST) -> Expr:
    """Give a form the span of the place that uses it."""
    if isinstance(form, Form) and form.head in ("dist", "record"):
        form.span = body.span(node)
    return form


def forbidden(body: Body, node: ast.AST, value: Any) -> None:
    """Refuse a built-in that a model cannot use."""
    if value in vocabulary.NOT_IN_A_MODEL:
        code, cure = vocabulary.NOT_IN_A_MODEL[value]
        body.refuse(code, node, name=value.__name__, cure=cure)
    body.refuse("forbidden-function", node, name=value.__name__)


def closure(body: Body, scope: Scope, node: ast.AST, immediate: bool = False) -> Expr:
    """Lower a nested function as a value, with its captures; refuse a capture that changes afterwards."""
    if not immediate:
        check_captures(body, scope, node)
    return Form("closure", [literal(body.unit.names[scope]), *(needed.core for needed in scope.needed)])


def check_captures(body: Body, scope: Scope, node: ast.AST) -> None:
    """Refuse variables that a function value reads and that are assigned again after the function's definition.

    In plain Python the function would read the new value; in the engine it keeps the old value.
    """
    defaults = [default for default in scope.defaults.values() if isinstance(default, Variable)]
    for needed in scope.needed:
        if needed in defaults:
            continue
        for when, assignment in needed.assigned:
            if scope.defined.may_precede(when) and assignment is not needed.owner.node:
                body.refuse(
                    "captured-then-changed",
                    node,
                    body.span(assignment),
                    name=needed.name,
                    function=scope.name,
                )


@lowers(ast.Lambda)
def lambda_(body: Body, node: ast.Lambda) -> Expr:
    """Lower a lambda as a value."""
    scope = body.scopes.of[node]
    keep_defaults(body, scope)
    return closure(body, scope, node)


def keep_defaults(body: Body, scope: Scope) -> None:
    """Compute a function's default values where it is defined, and keep them in variables for its calls."""
    for default in scope.defaults.values():
        if isinstance(default, Variable):
            node = default.assigned[0][1]
            assert isinstance(node, ast.expr)
            body.put(body.form("set", [default.core, expression(body, node)], node))


@lowers(ast.BinOp)
def binary(body: Body, node: ast.BinOp) -> Expr:
    """Lower arithmetic; the span is the whole operation, because either side may be at fault."""
    head = vocabulary.BINARY.get(type(node.op).__name__)
    if head is None:
        body.refuse("unsupported-syntax", node)
    return body.form(head, expressions(body, [node.left, node.right]), node)


@lowers(ast.UnaryOp)
def unary(body: Body, node: ast.UnaryOp) -> Expr:
    """Lower `-x`, `+x`, `not x`, `~x`; the sign of a number is part of the number."""
    if isinstance(node.op, ast.USub) and isinstance(node.operand, ast.Constant):
        number = node.operand.value
        if isinstance(number, (int, float)) and not isinstance(number, bool):
            return constant(body, ast.copy_location(ast.Constant(-number), node))
    return body.form(vocabulary.UNARY[type(node.op).__name__], [expression(body, node.operand)], node)


@lowers(ast.BoolOp)
def boolean(body: Body, node: ast.BoolOp) -> Expr:
    """Lower `a and b and c` and `a or b`: the value is the first operand that decides."""
    head = "and" if isinstance(node.op, ast.And) else "or"
    return short_circuit(body, head, [later(body, value) for value in node.values], node)


def short_circuit(body: Body, head: str, makers: Sequence[Callable[[], Expr]], node: ast.AST) -> Expr:
    """Lower operands of `and` or `or`; statements of an operand go into an `if` on the operands before it."""
    parts: list[tuple[Block, list[Expr]]] = [([], [makers[0]()])]
    for make in makers[1:]:
        block, value = body.within(make)
        if block:
            parts.append((block, [value]))
        else:
            parts[-1][1].append(value)
    values = [body.form(head, part, node) if len(part) > 1 else part[0] for _, part in parts]
    if len(values) == 1:
        return values[0]
    result = body.temporary()
    body.put(Form("set", [result, values[0]]))
    for (block, _), value in zip(parts[1:], values[1:], strict=True):
        more: Block = [*block, Form("set", [result, value])]
        then, other = (more, []) if head == "and" else ([], more)
        body.put(body.form("if", [result, Form("then", then), Form("else", other)], None))
    return result


@lowers(ast.IfExp)
def conditional(body: Body, node: ast.IfExp) -> Expr:
    """Lower `a if test else b`."""
    test = expression(body, node.test)
    then_block, then = body.within(lambda: expression(body, node.body))
    else_block, other = body.within(lambda: expression(body, node.orelse))
    if not then_block and not else_block:
        return body.form("cond", [test, then, other], node)
    result = body.temporary()
    arms = [
        Form("then", [*then_block, Form("set", [result, then])]),
        Form("else", [*else_block, Form("set", [result, other])]),
    ]
    body.put(body.form("if", [test, *arms], node.test))
    return result


@lowers(ast.Compare)
def compare(body: Body, node: ast.Compare) -> Expr:
    """Lower comparisons; `a < b < c` computes `b` once and stops at the first comparison that fails."""
    left, *rest = [node.left, *node.comparators]
    if len(rest) == 1:
        return _comparison(body, node, node.ops[0], later(body, left), rest[0], keep=False)[0]
    middle: list[Expr] = []

    def step(number: int) -> Expr:
        first = later(body, left) if number == 0 else (lambda: middle[-1])
        last = number == len(rest) - 1
        form, right = _comparison(body, node, node.ops[number], first, rest[number], keep=not last)
        middle.append(right)
        return form

    return short_circuit(body, "and", [partial(step, number) for number in range(len(rest))], node)


def _comparison(
    body: Body, node: ast.Compare, op: ast.cmpop, left: Callable[[], Expr], right: ast.expr, keep: bool
) -> tuple[Expr, Expr]:
    """Return a comparison and its right side, which the next comparison may need again."""
    none = isinstance(right, ast.Constant) and right.value is None
    if isinstance(op, (ast.Is, ast.IsNot)):
        if not none:
            body.refuse("compares-identity", node, word="is" if isinstance(op, ast.Is) else "is not")
        test = body.form("is_none", [left()], node)
        return (test if isinstance(op, ast.Is) else body.form("not", [test], node)), "none"

    def second() -> Expr:
        value = expression(body, right)
        return body.kept(value) if keep else value

    a, b = body.in_order([left, second])
    if isinstance(op, ast.NotIn):
        return body.form("not", [body.form("in", [a, b], node)], node), b
    return body.form(vocabulary.COMPARE[type(op).__name__], [a, b], node), b


@lowers(ast.List, ast.Tuple)
def sequence(body: Body, node: ast.List | ast.Tuple) -> Expr:
    """Lower a list or a tuple; refuse `[*a, *b]`."""
    for part in node.elts:
        if isinstance(part, ast.Starred):
            body.refuse("star-in-a-list", part)
    return body.form("list" if isinstance(node, ast.List) else "tuple", expressions(body, node.elts), None)


@lowers(ast.Dict)
def dictionary(body: Body, node: ast.Dict) -> Expr:
    """Lower a dict with constant keys."""
    keys = []
    for key, value in zip(node.keys, node.values, strict=True):
        atom = expression(body, key) if isinstance(key, (ast.Constant, ast.UnaryOp)) else None
        if not isinstance(atom, str):
            body.refuse("dict-key", key if key is not None else value)
        keys.append(atom)
    return body.form("dict", [Form("", list(keys)), *expressions(body, node.values)], None)


@lowers(ast.Subscript)
def subscript(body: Body, node: ast.Subscript) -> Expr:
    """Lower `xs[i]`, `xs[a:b:c]`, and `array[i, j]` for data."""
    if isinstance(node.slice, ast.Slice):
        parts = [node.slice.lower, node.slice.upper, node.slice.step]
        makers = [later(body, part) if part is not None else (lambda: "none") for part in parts]
        return body.form("slice", body.in_order([later(body, node.value), *makers]), node)
    indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
    for index in indices:
        if isinstance(index, (ast.Slice, ast.Starred)):
            body.refuse("unsupported-syntax", index)
    value, *places = expressions(body, [node.value, *indices])
    for place in places:
        value = body.form("index", [value, place], node)
    return value


@lowers(ast.Attribute)
def attribute(body: Body, node: ast.Attribute) -> Expr:
    """Lower a name in a module, or a field of a value."""
    value = static(body, node)
    if value is not MISSING:
        return outside(body, node, value)
    return body.form("field", [expression(body, node.value), literal(node.attr)], node)


def static(body: Body, node: ast.expr) -> Any:
    """Return the object of `module.name` or an array of a mesh, or MISSING if only the run knows the value."""
    if isinstance(node, ast.Name):
        return resolve(body, node) if body.scopes.find(node.id, body.scope) is None else MISSING
    if not isinstance(node, ast.Attribute):
        return MISSING
    owner = static(body, node.value)
    if not isinstance(owner, ModuleType):
        return array_of_mesh(owner, node.attr)
    try:
        return getattr(owner, node.attr)
    except AttributeError:
        close = nearest(node.attr, dir(owner))
        other = f"did you mean `{close[0]}`?" if close else f"`{owner.__name__}` has no such name"
        hint = _import_of(node.attr) if owner.__name__ == "niwaki" else ""
        body.refuse("unknown-name", node, name=f"{owner.__name__}.{node.attr}", suggestion=hint or other)


def _import_of(name: str) -> str:
    """Return how to import a word of the language that a file lacks; empty for other names."""
    return f"write `from niwaki.words import {name}`" if name in words.__all__ else ""


def array_of_mesh(owner: Any, name: str) -> Any:
    """Return the vertices or the faces of a mesh of the module, which models cannot have whole; else MISSING."""
    if name not in ARRAYS or is_record_class(type(owner)):
        return MISSING
    arrays = {key: getattr(owner, key, None) for key in ARRAYS}
    is_mesh = all(isinstance(array, np.ndarray) and array.ndim == 2 for array in arrays.values())
    return np.asarray(arrays[name]) if is_mesh else MISSING


@lowers(ast.JoinedStr)
def formatted(body: Body, node: ast.JoinedStr) -> Expr:
    """Lower an f-string."""
    holes = [part for part in node.values if isinstance(part, ast.FormattedValue)]
    values = iter(expressions(body, [hole.value for hole in holes]))
    parts: list[Expr] = []
    for part in node.values:
        if isinstance(part, ast.Constant):
            parts.append(literal(part.value))
        elif isinstance(part, ast.FormattedValue):
            conversion = chr(part.conversion) if part.conversion > 0 else ""
            parts.append(
                body.form("format", [next(values), literal(_spec(body, part)), literal(conversion)], None)
            )
    return body.form("fstr", parts, node)


def _spec(body: Body, node: ast.FormattedValue) -> str:
    spec = node.format_spec
    if spec is None:
        return ""
    assert isinstance(spec, ast.JoinedStr)
    if not all(isinstance(part, ast.Constant) for part in spec.values):
        body.refuse("unsupported-syntax", node)
    return "".join(str(part.value) for part in spec.values if isinstance(part, ast.Constant))


__all__ = ["expression", "expressions", "later", "lowers", "stable"]
