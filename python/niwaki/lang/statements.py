"""Lowering of statements, with a function for each kind of syntax node."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from niwaki import words
from niwaki.lang import vocabulary
from niwaki.lang.body import Block, Body
from niwaki.lang.core import LOOK, Expr, Form, literal
from niwaki.lang.emits import makes_a_shape
from niwaki.lang.expressions import closure, expression, keep_defaults, static, variable
from niwaki.lang.refuse import refuse
from niwaki.lang.scope import Scope, Variable

Node = TypeVar("Node", bound=ast.AST)
TABLE: dict[type[ast.AST], Callable[[Body, Any], None]] = {}


def lowers(*kinds: type[ast.AST]) -> Callable[[Callable[[Body, Node], None]], Callable[[Body, Node], None]]:
    """Register a function that lowers kinds of nodes."""

    def register(function: Callable[[Body, Node], None]) -> Callable[[Body, Node], None]:
        TABLE.update(dict.fromkeys(kinds, function))
        return function

    return register


def statement(body: Body, node: ast.stmt) -> None:
    """Lower a statement."""
    lower = TABLE.get(type(node))
    if lower is None:
        refuse(body, node)
    lower(body, node)


def block(body: Body, nodes: Sequence[ast.stmt]) -> Block:
    """Lower several statements into a block that is separate from the current block."""

    def make() -> Expr:
        for node in nodes:
            statement(body, node)
        return "none"

    return body.within(make)[0]


@lowers(ast.Pass)
def pass_(body: Body, node: ast.Pass) -> None:
    """Lower `pass` to nothing."""


@lowers(ast.Expr)
def effect(body: Body, node: ast.Expr) -> None:
    """Lower an expression statement; a docstring becomes nothing, and `look` assigns the variable of the frame."""
    if isinstance(node.value, ast.Constant):
        return
    if makes_a_shape(node.value, body):
        body.refuse("not-emitted", node.value)
    value = expression(body, node.value)
    if isinstance(node.value, ast.Call) and static(body, node.value.func) is words.look:
        body.put(body.form("set", [LOOK, value], node))
    elif isinstance(value, Form):
        body.put(body.form("do", [value], node))


@lowers(ast.Return)
def return_(body: Body, node: ast.Return) -> None:
    """Lower `return`; without a value it returns None."""
    value = expression(body, node.value) if node.value is not None else "none"
    body.put(body.form("return", [value], node))


@lowers(ast.Assign)
def assign(body: Body, node: ast.Assign) -> None:
    """Lower `a = b = value`: the value once, then the targets from left to right."""
    body.target = next((target.id for target in node.targets if isinstance(target, ast.Name)), "")
    value = expression(body, node.value)
    if len(node.targets) > 1:
        value = body.kept(value)
    for target in node.targets:
        store(body, target, value, node)
    body.target = ""


@lowers(ast.AnnAssign)
def annotated(body: Body, node: ast.AnnAssign) -> None:
    """Lower `x: float = value`; without a value it becomes nothing."""
    if node.value is not None:
        body.target = node.target.id if isinstance(node.target, ast.Name) else ""
        store(body, node.target, expression(body, node.value), node)
        body.target = ""


@lowers(ast.AugAssign)
def augmented(body: Body, node: ast.AugAssign) -> None:
    """Lower `x += value`, which assigns a new value; nothing changes in place."""
    if not isinstance(node.target, ast.Name):
        changes(body, node.target, node)
    target = node.target
    assert isinstance(target, ast.Name)
    head = vocabulary.BINARY.get(type(node.op).__name__)
    if head is None:
        body.refuse("unsupported-syntax", node)
    local = body.scopes.find(target.id, body.scope)
    if not isinstance(local, Variable):
        body.refuse(
            "unknown-name",
            target,
            name=target.id,
            suggestion=f"assign `{target.id}` a value before this line",
        )
    body.target = target.id
    old = variable(body, target, local)
    value = expression(body, node.value)
    body.put(body.form("set", [local.core, body.form(head, [old, value], node)], node))
    body.target = ""


def store(body: Body, target: ast.expr, value: Expr, node: ast.AST) -> None:
    """Assign a value to a target: a name, or a pattern of names."""
    if isinstance(target, ast.Name):
        local = body.scopes.find(target.id, body.scope)
        assert isinstance(local, Variable)
        body.put(body.form("set", [local.core, value], node))
    elif isinstance(target, (ast.Tuple, ast.List)):
        unpack(body, target, value, node)
    else:
        changes(body, target, node)


def unpack(body: Body, target: ast.Tuple | ast.List, value: Expr, node: ast.AST) -> None:
    """Lower `a, (b, c), *rest = value`; inner patterns go through temporaries."""
    later: list[tuple[ast.expr, str]] = []

    def name(part: ast.expr) -> str:
        if isinstance(part, ast.Name):
            local = body.scopes.find(part.id, body.scope)
            assert isinstance(local, Variable)
            return local.core
        temporary = body.temporary("")
        later.append((part, temporary))
        return temporary

    star = next((n for n, part in enumerate(target.elts) if isinstance(part, ast.Starred)), None)
    if star is None:
        body.put(body.form("unpack", [Form("", [name(part) for part in target.elts]), value], target))
    else:
        rest = target.elts[star]
        assert isinstance(rest, ast.Starred)
        first = Form("", [name(part) for part in target.elts[:star]])
        middle = name(rest.value)
        last = Form("", [name(part) for part in target.elts[star + 1 :]])
        body.put(body.form("unpack_star", [first, middle, last, value], target))
    for part, temporary in later:
        store(body, part, temporary, node)


def changes(body: Body, target: ast.expr, node: ast.AST) -> None:
    """Refuse an assignment to an item or to a field."""
    owner = target.value if isinstance(target, (ast.Subscript, ast.Attribute)) else target
    second = None
    if isinstance(owner, ast.Name):
        local = body.scopes.find(owner.id, body.scope)
        if isinstance(local, Variable) and local.assigned:
            second = first_assignment(body, local)
    text = body.span(owner).text
    if isinstance(target, ast.Subscript):
        index = body.span(target.slice).text
        in_dict = f"write a dict with all of its keys: `{text} = {{{index}: value, ...}}`"
        slices = f"{text} = {text}[:{index}] + [value] + {text}[{index} + 1:]"
        in_list = f"for a list write `{slices}`, or build the list by a comprehension"
        cure = in_dict if is_text(target.slice) else f"{in_list}; for a dict {in_dict}"
        body.refuse("changes-an-item", target, second, name=text, cure=cure)
    body.refuse("changes-a-field", target, second, name=text, field=getattr(target, "attr", ""))


def is_text(key: ast.AST) -> bool:
    """Return whether a key is written as a text, so that its owner is a dict."""
    return isinstance(key, ast.JoinedStr) or (isinstance(key, ast.Constant) and isinstance(key.value, str))


def first_assignment(body: Body, variable: Variable) -> Any:
    """Return the place of a variable's first assignment, for a second label."""
    first = variable.assigned[0][1]
    if isinstance(first, (ast.FunctionDef, ast.Lambda)):
        for arg in (*first.args.posonlyargs, *first.args.args, *first.args.kwonlyargs):
            if arg.arg == variable.name:
                return body.span(arg)
    return body.span(first)


@lowers(ast.If)
def if_(body: Body, node: ast.If) -> None:
    """Lower `if`, `elif`, `else`."""
    test = expression(body, node.test)
    arms = [Form("then", block(body, node.body)), Form("else", block(body, node.orelse))]
    body.put(body.form("if", [test, *arms], node.test))


def loop_variable(body: Body, target: ast.expr) -> tuple[str, Callable[[], None]]:
    """Return the variable of a `for`, and a function that unpacks it at the head of each iteration."""
    if isinstance(target, ast.Name):
        local = body.scopes.find(target.id, body.scope)
        assert isinstance(local, Variable)
        return local.core, lambda: None
    if not isinstance(target, (ast.Tuple, ast.List)):
        changes(body, target, target)
    first = next((part.id for part in ast.walk(target) if isinstance(part, ast.Name)), "")
    temporary = body.temporary(first)
    return temporary, lambda: store(body, target, temporary, target)


@lowers(ast.For)
def for_(body: Body, node: ast.For) -> None:
    """Lower `for x in xs`."""
    if node.orelse:
        body.refuse("loop-else", node.orelse[0])
    items = expression(body, node.iter)
    variable_, unpack_ = loop_variable(body, node.target)

    def iteration() -> Expr:
        unpack_()
        for part in node.body:
            statement(body, part)
        return "none"

    inside, _ = body.within(iteration)
    loop = body.form("for", [variable_, items, Form("body", inside)], node)
    loop.span = body.span(node.iter)
    body.put(loop)


@lowers(ast.While)
def while_(body: Body, node: ast.While) -> None:
    """Lower `while`; a test that needs statements moves to the head of the body."""
    if node.orelse:
        body.refuse("loop-else", node.orelse[0])
    before, test = body.within(lambda: expression(body, node.test))
    inside = block(body, node.body)
    if before:
        stop = Form("if", [test, Form("then", []), Form("else", [Form("break", [])])])
        inside, test = [*before, stop, *inside], "true"
    loop = body.form("while", [test, Form("body", inside)], node)
    loop.span = body.span(node.test)
    body.put(loop)


@lowers(ast.Break)
def break_(body: Body, node: ast.Break) -> None:
    """Lower `break`."""
    body.put(Form("break", []))


@lowers(ast.Continue)
def continue_(body: Body, node: ast.Continue) -> None:
    """Lower `continue`."""
    body.put(Form("continue", []))


@lowers(ast.Assert)
def assert_(body: Body, node: ast.Assert) -> None:
    """Lower `assert test, message`; the message is computed only if the test fails."""
    test = expression(body, node.test)
    before, message = body.within(lambda: expression(body, node.msg) if node.msg is not None else literal(""))
    if before:
        failing: Block = [*before, body.form("assert", ["false", message], node)]
        body.put(body.form("if", [test, Form("then", []), Form("else", failing)], node.test))
    else:
        body.put(body.form("assert", [test, message], node))


@lowers(ast.FunctionDef)
def definition(body: Body, node: ast.FunctionDef) -> None:
    """Lower a nested function; if a single `def` binds its name, only its defaults need code."""
    scope = body.scopes.of[node]
    if node.decorator_list:
        body.refuse("decorated", node.decorator_list[0], name=node.name)
    keep_defaults(body, scope)
    known = body.scopes.find(node.name, body.scope)
    if isinstance(known, Scope):
        return
    assert isinstance(known, Variable)
    if known in scope.needed:
        other = next((part for _, part in known.assigned if part is not node), node)
        body.refuse("rebound-recursion", node, body.span(other), name=node.name)
    body.put(body.form("set", [known.core, closure(body, scope, node)], None))
