"""Scopes of names in a top-level function and in all functions nested in it.

Python's closures capture variables, the engine's closures capture values. To hide the difference, this module computes:

- the *captures* of a nested function, the variables that it needs from outside;
- the order of assignments and definitions;
- the nested functions that a single `def` binds, which can be called directly, by name.

Captures are a fixed point: a function that calls a sibling needs all that the sibling needs.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass, field

FunctionNode = ast.FunctionDef | ast.Lambda
COMPREHENSIONS = (ast.ListComp, ast.GeneratorExp, ast.SetComp, ast.DictComp)


@dataclass(frozen=True)
class Moment:
    """A moment of a run: a number that grows in the order of evaluation, and the loops around the moment."""

    order: int
    loops: frozenset[int]

    def may_precede(self, other: Moment) -> bool:
        """Return whether this moment may be before `other`."""
        return self.order < other.order or bool(self.loops & other.loops)


@dataclass(eq=False)
class Variable:
    """A local variable: a parameter, an assigned name, a loop variable, or a default kept for later calls."""

    name: str
    scope: Scope
    core: str
    assigned: list[tuple[Moment, ast.AST]] = field(default_factory=list)

    @property
    def owner(self) -> Scope:
        """The scope of the variable's function."""
        return self.scope.function


@dataclass(eq=False)
class Scope:
    """A function, or a comprehension within a function."""

    node: ast.AST
    parent: Scope | None
    name: str
    variables: dict[str, Variable] = field(default_factory=dict)
    nested: dict[str, Scope] = field(default_factory=dict)
    needed: list[Variable] = field(default_factory=list)
    uses: list[Scope] = field(default_factory=list)
    defaults: dict[str, Variable | ast.expr] = field(default_factory=dict)
    defined: Moment = field(default_factory=lambda: Moment(0, frozenset()))
    is_function: bool = True

    @property
    def function(self) -> Scope:
        """The scope of the function: this scope, or the scope around a comprehension."""
        return self if self.is_function or self.parent is None else self.parent.function

    @property
    def parameters(self) -> list[str]:
        """The names of the parameters in order, keyword-only parameters last."""
        assert isinstance(self.node, (ast.FunctionDef, ast.Lambda))
        a = self.node.args
        return [arg.arg for arg in (*a.posonlyargs, *a.args, *a.kwonlyargs)]

    def inside(self, other: Scope) -> bool:
        """Return whether this scope is `other` or inside it."""
        scope: Scope | None = self
        while scope is not None:
            if scope is other:
                return True
            scope = scope.parent
        return False


@dataclass(eq=False)
class Scopes:
    """The scopes of a top-level function."""

    root: Scope
    of: dict[ast.AST, Scope]
    moments: dict[ast.AST, Moment]
    count: int = 0

    def number(self) -> int:
        """Return a fresh number for a variable of the compiler."""
        self.count += 1
        return self.count

    def find(self, name: str, scope: Scope) -> Variable | Scope | None:
        """Return the meaning of a name in a scope: a variable, a nested function, or None if the name is not local."""
        at: Scope | None = scope
        while at is not None:
            if name in at.nested:
                return at.nested[name]
            if name in at.variables:
                return at.variables[name]
            at = at.parent
        return None


def default_expressions(node: FunctionNode) -> dict[str, ast.expr]:
    """Return the expressions of default values by parameter, in order."""
    a = node.args
    positional = [arg.arg for arg in (*a.posonlyargs, *a.args)]
    expressions = dict(zip(positional[len(positional) - len(a.defaults) :], a.defaults, strict=True))
    expressions |= {
        arg.arg: value for arg, value in zip(a.kwonlyargs, a.kw_defaults, strict=True) if value is not None
    }
    return expressions


def analyse(node: FunctionNode) -> Scopes:
    """Compute the scopes of a top-level function."""
    root = Scope(node, None, node.name if isinstance(node, ast.FunctionDef) else "lambda")
    scopes = Scopes(root, {node: root}, {})
    walker = _Walker(scopes)
    walker.function(root)
    _close(scopes)
    return scopes


class _Walker:
    """Visitor of a function in the order of evaluation, which opens scopes and records assignments and uses."""

    def __init__(self, scopes: Scopes) -> None:
        self.scopes = scopes
        self.scope = scopes.root
        self.order = 0
        self.loops: list[int] = []
        self.cores: set[str] = set()

    def now(self) -> Moment:
        self.order += 1
        return Moment(self.order, frozenset(self.loops))

    def function(self, scope: Scope) -> None:
        node = scope.node
        assert isinstance(node, (ast.FunctionDef, ast.Lambda))
        outer, self.scope = self.scope, scope
        for name in scope.parameters:
            self.assign(name, node, scope)
        body = node.body if isinstance(node.body, list) else [node.body]
        bound = _bound_names(body)
        for name, binders in bound.items():
            if name in scope.variables:
                continue
            if len(binders) == 1 and isinstance(binders[0], ast.FunctionDef):
                scope.nested[name] = Scope(binders[0], scope, name)
            else:
                self.declare(name, scope)
        for part in body:
            self.visit(part)
        self.scope = outer

    def declare(self, name: str, scope: Scope) -> Variable:
        if name not in scope.variables:
            core = f"${name}"
            if core in self.cores:
                core = f"${name}%{self.scopes.number()}"
            self.cores.add(core)
            scope.variables[name] = Variable(name, scope, core)
        return scope.variables[name]

    def assign(self, name: str, node: ast.AST, scope: Scope | None = None) -> None:
        where = scope if scope is not None else self.scope
        if name in where.nested:
            return
        self.declare(name, where).assigned.append((self.now(), node))

    def targets(self, node: ast.AST) -> None:
        for part in ast.walk(node):
            if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
                self.assign(part.id, part)
        if any(isinstance(part, (ast.Attribute, ast.Subscript)) for part in ast.walk(node)):
            self.children(node)

    def children(self, node: ast.AST) -> None:
        for child in ast.iter_child_nodes(node):
            self.visit(child)

    def visit(self, node: ast.AST) -> None:
        match node:
            case ast.Name(ctx=ast.Load()):
                self.scopes.moments[node] = self.now()
                self.reference(node.id)
            case ast.Assign():
                self.visit(node.value)
                for target in node.targets:
                    self.targets(target)
            case ast.AnnAssign():
                if node.value is not None:
                    self.visit(node.value)
                    self.targets(node.target)
            case ast.AugAssign():
                if isinstance(node.target, ast.Name):
                    self.scopes.moments[node.target] = self.now()
                    self.reference(node.target.id)
                self.visit(node.value)
                self.targets(node.target)
            case ast.For():
                self.visit(node.iter)
                self.loops.append(id(node))
                self.targets(node.target)
                for part in node.body:
                    self.visit(part)
                self.loops.pop()
            case ast.While():
                self.loops.append(id(node))
                self.visit(node.test)
                for part in node.body:
                    self.visit(part)
                self.loops.pop()
            case ast.FunctionDef():
                self.definition(node, self.scope.nested.get(node.name))
            case ast.Lambda():
                self.definition(node, None)
            case ast.ListComp() | ast.GeneratorExp() | ast.SetComp() | ast.DictComp():
                self.comprehension(node)
            case ast.arguments() | ast.arg():
                pass
            case _:
                self.children(node)

    def reference(self, name: str) -> None:
        meaning = self.scopes.find(name, self.scope)
        here = self.scope.function
        if isinstance(meaning, Scope):
            here.uses.append(meaning)
        elif meaning is not None and meaning.owner is not here and meaning not in here.needed:
            here.needed.append(meaning)

    def definition(self, node: FunctionNode, known: Scope | None) -> None:
        for default in default_expressions(node).values():
            self.visit(default)
        for extra in getattr(node, "decorator_list", []):
            self.visit(extra)
        scope = known
        if scope is None or scope.node is not node:
            scope = Scope(node, self.scope, node.name if isinstance(node, ast.FunctionDef) else "lambda")
        scope.parent = self.scope
        self.scopes.of[node] = scope
        for name, default in default_expressions(node).items():
            if isinstance(default, ast.Constant):
                scope.defaults[name] = default
            else:
                kept = Variable(name, self.scope, f"${name}%{self.scopes.number()}")
                kept.assigned.append((self.now(), default))
                scope.defaults[name] = kept
                scope.needed.append(kept)
        scope.defined = self.now()
        self.scopes.moments[node] = scope.defined
        loops, self.loops = self.loops, []
        self.function(scope)
        self.loops = loops
        if scope is not known and isinstance(node, ast.FunctionDef):
            self.assign(node.name, node)
        if scope is not known:
            self.scope.function.uses.append(scope)

    def comprehension(self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp | ast.DictComp) -> None:
        self.visit(node.generators[0].iter)
        outer = self.scope
        self.scope = Scope(node, outer, "comprehension", is_function=False)
        self.scopes.of[node] = self.scope
        depth = len(self.loops)
        for number, generator in enumerate(node.generators):
            if number:
                self.visit(generator.iter)
            self.loops.append(id(generator))
            self.targets(generator.target)
            for test in generator.ifs:
                self.visit(test)
        for part in (node.key, node.value) if isinstance(node, ast.DictComp) else (node.elt,):
            self.visit(part)
        del self.loops[depth:]
        self.scope = outer


def _bound_names(body: list[ast.AST] | list[ast.stmt] | list[ast.expr]) -> dict[str, list[ast.AST]]:
    """Return the names that a function's statements bind, each with the nodes that bind it."""
    bound: dict[str, list[ast.AST]] = {}

    def look(node: ast.AST) -> None:
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
                bound.setdefault(node.name, []).append(node)
            case ast.Lambda() | ast.ListComp() | ast.GeneratorExp() | ast.SetComp() | ast.DictComp():
                pass
            case ast.Name(ctx=ast.Store()):
                bound.setdefault(node.id, []).append(node)
            case _:
                for child in ast.iter_child_nodes(node):
                    look(child)

    for part in body:
        look(part)
    return bound


def _close(scopes: Scopes) -> None:
    """Complete the captures: add what a function's callees need, except variables of the function itself."""
    functions = [scope for scope in scopes.of.values() if scope.is_function]
    changed = True
    while changed:
        changed = False
        for scope in functions:
            for used in scope.uses:
                for variable in used.needed:
                    if not variable.owner.inside(scope) and variable not in scope.needed:
                        scope.needed.append(variable)
                        changed = True


def functions(scopes: Scopes) -> Iterator[Scope]:
    """Yield the scopes of all functions, the root first."""
    for scope in scopes.of.values():
        if scope.is_function:
            yield scope
