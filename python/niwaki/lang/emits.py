"""Lowering of `emit`: shapes, the name of the part, and a look (colour, metalness, roughness, material).

The name is a component of addresses, so it is a constant (`sites`). The operation `worn` gives the look to the shapes
that have no such look yet.
"""

from __future__ import annotations

import ast
from typing import TypeGuard

from niwaki.lang.arguments import unknown
from niwaki.lang.body import Body
from niwaki.lang.core import Expr, Form
from niwaki.lang.expressions import expressions, later, static
from niwaki.lang.marks import underlying
from niwaki.lang.sites import part_name
from niwaki.words.measures import LOOKS
from niwaki.words.shapes import SHAPES

KEYWORDS = ("name", *LOOKS)


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
    looks = {key: value for key, value in keywords.items() if key in LOOKS and not _is_none(value)}
    if not looks:
        return body.form("emit", expressions(body, node.args), node)
    values = body.in_order([later(body, value) for value in (*node.args, *looks.values())])
    count = len(node.args)
    look = dict(zip(looks, values[count:], strict=True))
    worn = Form(
        "worn", [*(look.get(key, "none") for key in LOOKS), Form("tuple", values[:count])], body.span(node)
    )
    return body.form("emit", [worn], node)


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


def makes_a_shape(node: ast.expr, body: Body) -> TypeGuard[ast.Call]:
    """Return whether an expression is a call of `box` or another word for a shape."""
    return isinstance(node, ast.Call) and any(_word(body, node) is word for word in SHAPES)


def _word(body: Body, node: ast.Call) -> object:
    """Return the callee of a call, or None if only the run knows it."""
    callee = node.func
    if isinstance(callee, ast.Name) and body.scopes.find(callee.id, body.scope) is not None:
        return None
    if not isinstance(callee, (ast.Name, ast.Attribute)):
        return None
    return underlying(static(body, callee))
