"""Lowering of `emit`: shapes, the name of the part, and a look (colour, metalness, roughness).

The name is a component of addresses, so it is a constant (`sites`). The look becomes arguments of the shapes, because
the engine cannot paint an existing shape. So the shapes must be made inside the `emit`, directly, in lists or in
comprehensions. The look is computed once, before the shapes, and must not contain a random draw.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TypeGuard

from niwaki.lang import vocabulary
from niwaki.lang.arguments import unknown
from niwaki.lang.body import Body
from niwaki.lang.core import Expr
from niwaki.lang.expressions import expression, expressions, lowers, static
from niwaki.lang.marks import underlying
from niwaki.lang.sites import part_name
from niwaki.words.measures import LOOKS
from niwaki.words.shapes import SHAPES

KEYWORDS = ("name", *LOOKS)


class _Computed(ast.expr):
    """A value that is already lowered."""

    core: Expr


@lowers(_Computed)
def computed(body: Body, node: _Computed) -> Expr:
    """Return the form."""
    return node.core


def emit(body: Body, node: ast.Call) -> Expr:
    """Lower a call of `emit`."""
    for keyword in node.keywords:
        if keyword.arg not in KEYWORDS:
            unknown(body, keyword, "emit", KEYWORDS)
    if not node.args:
        body.refuse(
            "wrong-number-of-arguments",
            node,
            name="emit",
            expected="at least 1 shape",
            found="0",
            parameters="shapes, " + ", ".join(f"[{keyword}]" for keyword in KEYWORDS),
        )
    keywords = {keyword.arg: keyword.value for keyword in node.keywords}
    name = keywords.get("name")
    if name is not None and not _is_none(name) and part_name(node) is None:
        body.refuse("emit-name", name)
    looks = {key: keywords[key] for key in LOOKS if key in keywords and not _is_none(keywords[key])}
    if not looks:
        return body.form("emit", expressions(body, node.args), node)
    for value in looks.values():
        if any(part in body.unit.components for part in ast.walk(value)):
            body.refuse("emit-color", value)
    makers = [maker for arg in node.args for maker in _makers(body, arg)]
    added: list[ast.Call] = []
    for key, value in looks.items():
        coat = ast.copy_location(_Computed(), value)
        coat.core = body.kept(expression(body, value))
        for maker in makers:
            if _takes(body, maker, key):
                maker.keywords.append(ast.copy_location(ast.keyword(key, coat), value))
                added.append(maker)
    try:
        return body.form("emit", expressions(body, node.args), node)
    finally:
        for maker in added:
            maker.keywords.pop()


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


def _makers(body: Body, node: ast.expr) -> Iterator[ast.Call]:
    """Yield the calls that make the shapes of an argument."""
    if isinstance(node, (ast.List, ast.Tuple)):
        for part in node.elts:
            yield from _makers(body, part)
    elif isinstance(node, ast.IfExp):
        yield from _makers(body, node.body)
        yield from _makers(body, node.orelse)
    elif isinstance(node, (ast.ListComp, ast.GeneratorExp)):
        yield from _makers(body, node.elt)
    elif makes_a_shape(node, body):
        yield node
    else:
        body.refuse("emit-color", node)


def makes_a_shape(node: ast.expr, body: Body) -> TypeGuard[ast.Call]:
    """Return whether an expression is a call of `box` or another word for a shape."""
    return isinstance(node, ast.Call) and any(_word(body, node) is word for word in SHAPES)


def _takes(body: Body, node: ast.Call, key: str) -> bool:
    """Return whether a call of a shape's word can take this keyword, and does not have it yet."""
    names = [parameter.name for parameter in vocabulary.OPERATIONS[_word(body, node)].parameters]
    if key not in names:
        return False
    return len(node.args) <= names.index(key) and all(keyword.arg != key for keyword in node.keywords)


def _word(body: Body, node: ast.Call) -> object:
    """Return the callee of a call, or None if only the run knows it."""
    callee = node.func
    if isinstance(callee, ast.Name) and body.scopes.find(callee.id, body.scope) is not None:
        return None
    if not isinstance(callee, (ast.Name, ast.Attribute)):
        return None
    return underlying(static(body, callee))
