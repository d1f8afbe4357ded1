"""Instrumented model functions: the user's code, compiled again with hooks that report each site to the plain run.

`f(x)` becomes `__nw__.call("f", f, x)`, `for i in xs` becomes `for i in __nw__.loop("i[]", xs)`, and a side of a
comparison becomes `__nw__.compared(x)`. Nested functions are marked with their place in the program. Nothing else
changes: every node keeps its line and columns, so that a debugger and a traceback show the user's file. `__nw__` is a
cell of the function's closure, so the user's module stays as it is.
"""

from __future__ import annotations

import ast
from types import CellType, CodeType, FunctionType
from typing import Any
from weakref import WeakKeyDictionary

from niwaki.errors import ModelError
from niwaki.errors.source import head_span
from niwaki.lang.deep import copied, deep
from niwaki.lang.program import Program
from niwaki.lang.scope import functions

HOOK = "__nw__"
#: The cell with the function itself, for functions nested in it.
FUNCTION = "__nw_own__"
INNER = "__nw_def__"
_codes: WeakKeyDictionary[FunctionType, CodeType] = WeakKeyDictionary()


def instrumented(function: FunctionType, hook: Any) -> FunctionType:
    """Return the instrumented function; `hook` has the methods `call`, `loop`, `compared`, ..."""
    if function not in _codes:
        _codes[function] = _compile(function)
    code = _codes[function]
    cells = dict(zip(function.__code__.co_freevars, function.__closure__ or (), strict=True))
    cells |= {HOOK: CellType(hook), FUNCTION: CellType(function)}
    closure = tuple(cells[name] for name in code.co_freevars)
    built = FunctionType(code, function.__globals__, function.__name__, function.__defaults__, closure)
    built.__kwdefaults__ = function.__kwdefaults__
    built.__qualname__ = function.__qualname__
    return built


@deep
def _compile(function: FunctionType) -> CodeType:
    unit = Program().unit(function)
    clone, memo = copied(unit.node)
    components: dict[Any, Any] = {}
    for key, component in unit.components.items():
        if isinstance(key, tuple):
            pair = components.setdefault(memo[key[0]], ["", ""])
            pair[0 if key[1] == "loop" else 1] = component
        else:
            components[memo[key]] = component
    shown = {memo[scope.node]: n for n, scope in enumerate(functions(unit.scopes))}
    assert isinstance(clone, (ast.FunctionDef, ast.Lambda))
    arguments = clone.args
    arguments.defaults = [ast.copy_location(ast.Constant(None), default) for default in arguments.defaults]
    arguments.kw_defaults = [d and ast.copy_location(ast.Constant(None), d) for d in arguments.kw_defaults]
    node = _Namer(components, shown, clone).visit(clone)
    if isinstance(node, ast.FunctionDef):
        node.name, node.decorator_list = INNER, []
        inner: list[ast.stmt] = [node]
    else:
        inner = [ast.Expr(node)]
    names = [HOOK, FUNCTION, *function.__code__.co_freevars]
    parameters = ast.arguments(
        posonlyargs=[], args=[ast.arg(name) for name in names], kwonlyargs=[], kw_defaults=[], defaults=[]
    )
    factory = ast.FunctionDef("__factory__", parameters, inner, [], lineno=1, col_offset=0)
    module = ast.fix_missing_locations(ast.Module([factory], []))
    try:
        compiled = compile(module, unit.file.path, "exec", dont_inherit=True)
    except (RecursionError, MemoryError):
        raise ModelError("nested-too-deeply", head_span(unit.node, unit.file)) from None
    outer = _inner(compiled, "__factory__")
    return _renamed(_inner(outer, node.name if isinstance(node, ast.FunctionDef) else "<lambda>"), function)


def _renamed(code: CodeType, function: FunctionType) -> CodeType:
    """Give the code, and all code nested in it, the user's names again.

    The function is compiled under another name, because a call of itself would find the factory's variable.
    """
    name, qualified = function.__name__, function.__qualname__

    def rename(part: CodeType) -> CodeType:
        shown = "<lambda>" if name == "<lambda>" else INNER
        path = part.co_qualname.removeprefix(f"__factory__.<locals>.{shown}")
        parts = tuple(rename(inner) if isinstance(inner, CodeType) else inner for inner in part.co_consts)
        short = name if part.co_name == INNER else part.co_name
        return part.replace(co_name=short, co_qualname=qualified + path, co_consts=parts)

    return rename(code)


def _inner(code: CodeType, name: str) -> CodeType:
    return next(part for part in code.co_consts if isinstance(part, CodeType) and part.co_name == name)


class _Namer(ast.NodeTransformer):
    """Rewriter of calls, comparisons, loops, `break` and nested functions."""

    def __init__(self, components: dict[Any, Any], names: dict[Any, int], root: ast.AST) -> None:
        self.components = components
        self.names = names
        self.root = root

    def _hook(self, name: str, args: list[ast.expr], keywords: list[ast.keyword], at: ast.AST) -> ast.Call:
        hook = ast.copy_location(ast.Attribute(ast.Name(HOOK, ast.Load()), name, ast.Load()), at)
        # CPython takes the line on which an attribute ends as the line of its call.
        hook.end_lineno, hook.end_col_offset = hook.lineno, hook.col_offset
        built = ast.copy_location(ast.Call(hook, args, keywords), at)
        return ast.fix_missing_locations(built)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        component = self.components.get(node, "")
        self.generic_visit(node)
        shown: Any = tuple(component) if isinstance(component, list) else component
        return self._hook("call", [ast.Constant(shown), node.func, *node.args], node.keywords, node)

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        sides = [node.left, *node.comparators]
        for at, op in enumerate(node.ops):
            if not isinstance(op, (ast.Is, ast.IsNot)):
                word = "searched" if isinstance(op, (ast.In, ast.NotIn)) else "compared"
                sides[at + 1] = self._hook(word, [sides[at + 1]], [], node)
                if at == 0:
                    sides[0] = self._hook("compared", [sides[0]], [], node)
        node.left, *node.comparators = sides
        return node

    def visit_For(self, node: ast.For) -> ast.AST:
        component = self.components.get(node, "")
        self.generic_visit(node)
        node.iter = self._hook("loop", [ast.Constant(component), node.iter], [], node.iter)
        return node

    def visit_While(self, node: ast.While) -> ast.AST:
        component = self.components.get(node, "")
        self.generic_visit(node)
        if node.orelse:
            return node
        leave = ast.Expr(self._hook("leave", [], [], node.test))
        test = ast.If(ast.UnaryOp(ast.Not(), node.test), [leave, ast.Break()], [])
        items = self._hook("forever", [ast.Constant(component)], [], node.test)
        loop = ast.For(
            ast.Name("__nw_step__", ast.Store()), items, [ast.copy_location(test, node.test), *node.body], []
        )
        return ast.fix_missing_locations(ast.copy_location(loop, node))

    def visit_comprehension(self, node: ast.comprehension) -> ast.AST:
        component = self.components.get(node, "")
        self.generic_visit(node)
        node.iter = self._hook("loop", [ast.Constant(component), node.iter], [], node.iter)
        return node

    def visit_Break(self, node: ast.Break) -> Any:
        leave = ast.copy_location(ast.Expr(self._hook("leave", [], [], node)), node)
        return [leave, node]

    def visit_arg(self, node: ast.arg) -> ast.AST:
        node.annotation = None
        return node

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.returns = None
        self.generic_visit(node)
        node.decorator_list = [] if node is self.root else [self._hook("named", self._name(node), [], node)]
        return node

    def visit_Lambda(self, node: ast.Lambda) -> ast.AST:
        self.generic_visit(node)
        if node is self.root:
            return node
        named = self._hook("named", self._name(node), [], node)
        return ast.fix_missing_locations(ast.copy_location(ast.Call(named, [node], []), node))

    def _name(self, node: ast.AST) -> list[ast.expr]:
        return [ast.Name(FUNCTION, ast.Load()), ast.Constant(self.names[node])]
