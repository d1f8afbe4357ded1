"""Binding of arguments to parameters, as Python does it; a mismatch is refused with the definition's place."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from typing import NoReturn

from niwaki.errors.source import Span
from niwaki.lang.body import Body
from niwaki.lang.core import Expr
from niwaki.lang.expressions import later
from niwaki.lang.names import nearest
from niwaki.lang.vocabulary import REQUIRED, Parameter


def no_stars(body: Body, node: ast.Call) -> None:
    """Refuse `f(*xs)` and `f(**d)`."""
    for arg in node.args:
        if isinstance(arg, ast.Starred):
            body.refuse("star-arguments", arg)
    for keyword in node.keywords:
        if keyword.arg is None:
            body.refuse("star-arguments", keyword.value)


def no_keywords(body: Body, node: ast.Call, name: str) -> None:
    """Refuse keywords of a function that takes arguments by position only."""
    if node.keywords:
        keyword = node.keywords[0]
        body.refuse(
            "unknown-keyword",
            keyword,
            name=name,
            keyword=keyword.arg,
            suggestion="pass the value by position",
        )


def bind(
    body: Body,
    node: ast.AST,
    args: Sequence[ast.expr],
    keywords: Sequence[ast.keyword],
    parameters: Sequence[Parameter],
    name: str,
    place: Span | None = None,
    keyword_only: int = 0,
    variadic: bool = False,
) -> list[Expr | None]:
    """Lower the argument of each parameter, None for a default; if `variadic`, extra arguments follow."""
    names = [parameter.name for parameter in parameters]
    positional = len(names) - keyword_only
    if len(args) > positional and not variadic:
        wrong(body, node, parameters, name, place, len(args) + len(keywords))
    slots: list[int] = list(range(len(args)))
    for keyword in keywords:
        if keyword.arg not in names:
            unknown(body, keyword, name, names, place)
        slot = names.index(keyword.arg)
        if slot in slots:
            body.refuse("argument-twice", keyword, place, name=name, keyword=keyword.arg)
        slots.append(slot)
    for slot, parameter in enumerate(parameters):
        if parameter.default is REQUIRED and slot not in slots:
            wrong(body, node, parameters, name, place, len(args) + len(keywords))
    nodes = [*args, *(keyword.value for keyword in keywords)]
    makers: list[Callable[[], Expr]] = [later(body, value) for value in nodes]
    values = body.in_order(makers, keep=slots != sorted(slots))
    bound: list[Expr | None] = [None] * max(len(names), len(args))
    for slot, value in zip(slots, values, strict=True):
        bound[slot] = value
    return bound


#: Keywords of calls that make a choice or a part, which shapes and helpers do not have.
OF_SITES = {
    "label": "`label=` is for choices, parts and calls of your functions: give it to `emit`, the choice or the call",
    "name": "`name=` names a part: write `emit(..., name=...)`",
}


def unknown(
    body: Body, keyword: ast.keyword, name: str, names: Sequence[str], place: Span | None = None
) -> NoReturn:
    """Refuse a keyword that is not a parameter, and suggest the nearest parameter."""
    close = nearest(keyword.arg or "", names)
    hint = f"did you mean `{close[0]}`?" if close else f"its parameters are {', '.join(names) or 'none'}"
    hint = OF_SITES.get(keyword.arg or "", hint)
    body.refuse("unknown-keyword", keyword, place, name=name, keyword=keyword.arg, suggestion=hint)


def wrong(
    body: Body, node: ast.AST, parameters: Sequence[Parameter], name: str, place: Span | None, count: int
) -> None:
    """Refuse a call with too few or too many arguments."""
    most, least = len(parameters), sum(parameter.default is REQUIRED for parameter in parameters)
    limits = str(most) if least == most else f"{least} to {most}"
    expected = f"{limits} argument{'s' if limits != '1' else ''}"
    listed = ", ".join(p.name if p.default is REQUIRED else f"[{p.name}]" for p in parameters)
    body.refuse(
        "wrong-number-of-arguments",
        node,
        place,
        name=name,
        expected=expected,
        found=str(count),
        parameters=listed,
    )
