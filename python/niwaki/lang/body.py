"""State while a function is lowered to core form: the statements so far, the scope, and fresh variables.

Expressions of Python may need statements in core form (a comprehension is a loop). Such statements are appended to the
current block *before* the expression that needs them. `in_order` keeps Python's order of evaluation: it first moves
earlier values that the statements could change into temporaries.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from niwaki.errors import ModelError
from niwaki.errors.source import SourceFile, Span, span_of
from niwaki.lang.core import Expr, Form
from niwaki.lang.names import Namespace
from niwaki.lang.program import Program, Unit
from niwaki.lang.scope import Scope, Scopes

Block = list[Expr]


class Body:
    """State while a function is lowered."""

    def __init__(self, program: Program, unit: Unit, scope: Scope) -> None:
        self.program = program
        self.unit = unit
        self.scope = scope
        self.block: Block = []
        self.target = ""

    @property
    def file(self) -> SourceFile:
        """The function's file."""
        return self.unit.file

    @property
    def scopes(self) -> Scopes:
        """The scopes of the top-level function around this function."""
        return self.unit.scopes

    @property
    def namespace(self) -> Namespace:
        """The namespace outside of the function."""
        return self.unit.namespace

    def span(self, node: ast.AST) -> Span:
        """Return a node's place in the file."""
        return span_of(node, self.file)

    def refuse(self, code: str, node: ast.AST, second: Span | None = None, **values: Any) -> NoReturn:
        """Raise `ModelError` about a place."""
        raise ModelError(code, self.span(node), second, **values)

    def form(self, head: str, args: Sequence[Expr], node: ast.AST | None = None) -> Form:
        """Return a form with its place, and with its component of addresses if it is a site."""
        component = self.unit.components.get(node, "") if node is not None else ""
        return Form(head, list(args), self.span(node) if node is not None else None, component)

    def temporary(self, name: str | None = None) -> str:
        """Return a fresh variable, named after the variable that the statement assigns, if any."""
        return f"${self.target if name is None else name}%{self.scopes.number()}"

    def put(self, statement: Expr) -> None:
        """Append a statement."""
        self.block.append(statement)

    def kept(self, value: Expr, node: ast.AST | None = None) -> Expr:
        """Return a value that can be used twice: an atom, or a temporary set to the value."""
        if isinstance(value, str):
            return value
        variable = self.temporary()
        self.put(self.form("set", [variable, value], None))
        return variable

    def within(self, make: Callable[[], Expr]) -> tuple[Block, Expr]:
        """Return the statements that `make` appends, kept out of the current block, and its result."""
        outer, self.block = self.block, []
        try:
            value = make()
            return self.block, value
        finally:
            self.block = outer

    def in_order(self, makers: Sequence[Callable[[], Expr]], keep: bool = False) -> list[Expr]:
        """Make values in Python's order of evaluation; set `keep` if they are used in another order."""
        values: list[Expr] = []
        for make in makers:
            start = len(self.block)
            value = make()
            if len(self.block) > start:
                spills: Block = []
                for number, earlier in enumerate(values):
                    if not stable(earlier):
                        variable = self.temporary()
                        spills.append(Form("set", [variable, earlier]))
                        values[number] = variable
                self.block[start:start] = spills
            values.append(value)
        if keep and sum(not stable(value) for value in values) > 1:
            values = [value if stable(value) else self.kept(value) for value in values]
        return values


def stable(value: Expr) -> bool:
    """Return whether a value can be computed later: it stays the same, cannot fail and has no effects."""
    if isinstance(value, str):
        return True
    return value.head in ("data", "closure") and all(stable(arg) for arg in value.args)
