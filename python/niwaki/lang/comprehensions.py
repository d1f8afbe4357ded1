"""Lowering of comprehensions, generator arguments, `map`, `filter` and `sorted(key=)` to loops that build a list."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence

from niwaki.lang.body import Body
from niwaki.lang.core import Expr, Form
from niwaki.lang.expressions import expression, lowers
from niwaki.lang.statements import loop_variable

Comprehension = ast.ListComp | ast.GeneratorExp


@lowers(ast.ListComp)
def collect(body: Body, node: Comprehension) -> Expr:
    """Lower a comprehension or a generator argument to the list of its values."""
    result = body.temporary()
    body.put(Form("set", [result, Form("list", [])]))

    def append(value: Expr) -> None:
        body.put(Form("set", [result, Form("append", [result, value])]))

    loops(body, node, append)
    return result


def decide(body: Body, node: Comprehension, decisive: bool) -> Expr:
    """Lower `any(...)` or `all(...)`, which stop at the first value that is `decisive` (True for `any`)."""
    result = body.temporary()
    body.put(Form("set", [result, "false" if decisive else "true"]))

    def test(value: Expr) -> None:
        stop: list[Expr] = [Form("set", [result, "true" if decisive else "false"]), Form("break", [])]
        arms = [Form("then", stop), Form("else", [])] if decisive else [Form("then", []), Form("else", stop)]
        body.put(Form("if", [value, *arms]))

    leave: list[Expr] = [Form("break", [])]
    after = Form(
        "if", [result, Form("then", leave if decisive else []), Form("else", [] if decisive else leave)]
    )
    loops(body, node, test, after)
    return result


def loops(body: Body, node: Comprehension, use: Callable[[Expr], None], after: Form | None = None) -> None:
    """Lower the generators to nested loops; `after` follows each inner loop, to leave the outer loops too."""
    outer, inner_scope = body.scope, body.scopes.of[node]

    def generator(number: int) -> None:
        if number == len(node.generators):
            use(expression(body, node.elt))
            return
        part = node.generators[number]
        if part.is_async:
            body.refuse("asynchronous", part.target)
        items = expression(body, part.iter)
        body.scope = inner_scope

        def iteration() -> Expr:
            unpack()
            tests(part.ifs)
            return "none"

        def tests(conditions: Sequence[ast.expr]) -> None:
            if not conditions:
                generator(number + 1)
                return
            test = expression(body, conditions[0])

            def rest() -> Expr:
                tests(conditions[1:])
                return "none"

            block, _ = body.within(rest)
            body.put(body.form("if", [test, Form("then", block), Form("else", [])], None))

        variable, unpack = loop_variable(body, part.target)
        block, _ = body.within(iteration)
        loop = body.form("for", [variable, items, Form("body", block)], part)
        loop.span = body.span(part.iter)
        body.put(loop)
        if after is not None and number:
            body.put(after)

    generator(0)
    body.scope = outer


def mapped(body: Body, items: Expr, word: str, node: ast.AST, use: Callable[[str], Sequence[Expr]]) -> Expr:
    """Lower a list that a loop over `items` builds; `use` returns the values that an iteration appends."""
    result = body.temporary()
    body.put(Form("set", [result, Form("list", [])]))
    variable = body.temporary(word)

    def iteration() -> Expr:
        for value in use(variable):
            body.put(Form("set", [result, Form("append", [result, value])]))
        return "none"

    block, _ = body.within(iteration)
    loop = body.form("for", [variable, items, Form("body", block)], node)
    loop.component = body.unit.components.get((node, "loop"), "")
    body.put(loop)
    return result
