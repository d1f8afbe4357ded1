"""Syntax that the language always refuses, with the message for each kind.

The lowering refuses other code: a mutating method in `calls`, an unknown name in `expressions`.
"""

from __future__ import annotations

import ast
from typing import NoReturn

from niwaki.lang.body import Body

STATEMENTS: dict[type[ast.AST], str] = {
    ast.AsyncFunctionDef: "asynchronous",
    ast.AsyncFor: "asynchronous",
    ast.AsyncWith: "asynchronous",
    ast.ClassDef: "class-in-a-model",
    ast.Delete: "deletes",
    ast.Global: "global-name",
    ast.Nonlocal: "global-name",
    ast.Import: "import-in-a-model",
    ast.ImportFrom: "import-in-a-model",
    ast.Match: "match-statement",
    ast.Raise: "exceptions",
    ast.Try: "exceptions",
    ast.TryStar: "exceptions",
    ast.With: "with-statement",
}

EXPRESSIONS: dict[type[ast.AST], str] = {
    ast.Await: "asynchronous",
    ast.DictComp: "dict-comprehension",
    ast.GeneratorExp: "generator-value",
    ast.NamedExpr: "walrus",
    ast.Set: "set-value",
    ast.SetComp: "set-value",
    ast.Starred: "star-arguments",
    ast.Yield: "yields",
    ast.YieldFrom: "yields",
}

WORDS: dict[type[ast.AST], str] = {
    ast.Delete: "del",
    ast.Global: "global",
    ast.Nonlocal: "nonlocal",
    ast.Raise: "raise",
    ast.Try: "try",
    ast.TryStar: "try",
}


def refuse(body: Body, node: ast.AST) -> NoReturn:
    """Raise the error about a kind of syntax that the language does not have."""
    code = STATEMENTS.get(type(node)) or EXPRESSIONS.get(type(node)) or "unsupported-syntax"
    names = getattr(node, "names", []) if code == "global-name" else []
    body.refuse(code, _headline(node), word=WORDS.get(type(node), ""), name=", ".join(names))


def _headline(node: ast.AST) -> ast.AST:
    """Return a node that covers only the keyword of a statement with a body, so that the carets stay short."""
    if isinstance(node, ast.stmt) and isinstance(getattr(node, "body", None), list):
        short = ast.Pass()
        short.lineno, short.col_offset = node.lineno, node.col_offset
        short.end_lineno, short.end_col_offset = (
            node.lineno,
            node.col_offset + len(_KEYWORD.get(type(node), "with")),
        )
        return short
    return node


_KEYWORD: dict[type[ast.AST], str] = {
    ast.AsyncFunctionDef: "async",
    ast.AsyncFor: "async",
    ast.AsyncWith: "async",
    ast.ClassDef: "class",
    ast.Try: "try",
    ast.TryStar: "try",
    ast.With: "with",
}
