"""The depth to which a model's text may be nested, and the recursion limit for reading it.

The passes call themselves for each level of the syntax tree. A sum of 250 terms has 250 levels, and 300 `elif` have
300 levels: more than Python's usual limit of 1,000 calls allows. So the passes run under a higher limit, and code
deeper than `MOST` levels is refused, with its place, before a pass reads it.

Calls of Python functions need no stack of the processor, so the higher limit is free. Calls through C code (`partial`,
`map`, a generator inside `join`) need it, so a pass must not use them between its calls.
"""

from __future__ import annotations

import ast
import sys
import threading
from collections.abc import Callable
from functools import wraps
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")

#: The most levels of a syntax tree. The engine reads 2,000 levels of core form; an `elif` needs two.
MOST = 960

#: The most nested calls that a pass needs for so many levels.
CALLS = 20 * MOST

_lock = threading.Lock()
_inside = 0
_outside = 0


def deep(function: Callable[P, T]) -> Callable[P, T]:
    """Run a pass under a recursion limit that is enough for `MOST` levels."""

    @wraps(function)
    def run(*args: P.args, **kwargs: P.kwargs) -> T:
        global _inside, _outside
        with _lock:
            if _inside == 0:
                _outside = sys.getrecursionlimit()
                sys.setrecursionlimit(_outside + CALLS)
            _inside += 1
        try:
            return function(*args, **kwargs)
        finally:
            with _lock:
                _inside -= 1
                if _inside == 0:
                    _back()

    return run


def _back() -> None:
    """Restore the old limit; in a thread that is deeper than that, the higher limit stays."""
    try:
        sys.setrecursionlimit(_outside)
    except RecursionError:
        pass


def too_deep(root: ast.AST) -> ast.AST | None:
    """Return a node more than `MOST` levels below the root, or None."""
    level: list[ast.AST] = [root]
    for _ in range(MOST):
        level = [child for node in level for child in ast.iter_child_nodes(node)]
        if not level:
            return None
    return next((node for node in level if hasattr(node, "lineno")), root)


def copied(root: ast.AST) -> tuple[ast.AST, dict[ast.AST, ast.AST]]:
    """Return a copy of a tree, and the copy of each node."""
    of = {node: type(node)() for node in ast.walk(root)}
    for node, copy in of.items():
        for name, value in vars(node).items():
            if isinstance(value, list):
                value = [of.get(part, part) if isinstance(part, ast.AST) else part for part in value]
            setattr(copy, name, of.get(value, value) if isinstance(value, ast.AST) else value)
    return of[root], of
