"""Sites of a program with what they are for: what a choice is called or decides, what a call or a part makes.

`labelling` makes the labels from these.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from types import FunctionType
from typing import Any, Literal, TypeGuard

from niwaki import words
from niwaki.lang import given, vocabulary
from niwaki.lang.labels import PLAIN, is_anonymous
from niwaki.lang.marks import underlying
from niwaki.lang.names import MISSING, hashable, is_record_class, record_fields
from niwaki.lang.nouns import singular
from niwaki.lang.nouns import words as spoken
from niwaki.lang.program import Program, Unit
from niwaki.lang.scope import Scope, default_expressions
from niwaki.lang.scope import functions as functions_of
from niwaki.lang.sites import meaning, part_name
from niwaki.words.distributions import FAMILIES
from niwaki.words.memo import Memoised
from niwaki.words.shapes import SHAPES

#: The decisions of a run: an `if` and the side that is taken.
Arms = tuple[tuple[ast.AST, int], ...]
Comprehension = ast.ListComp | ast.GeneratorExp | ast.SetComp

#: Numbers of a vector and of a colour.
AXES = ("x", "y", "z", "w")
COLORS = ("red", "green", "blue")
CHOICES = (words.sample, words.choose, words.infer)
SCORES = (words.observe, words.factor, words.condition, words.query, words.force)
LEAVES = (ast.Return, ast.Break, ast.Continue)


@dataclass(frozen=True)
class Purpose:
    """The use of a value: the name of a variable or parameter, or what it decides."""

    name: str = ""
    form: Literal["", "if", "while", "count"] = ""
    nodes: Sequence[ast.AST] = ()
    alternative: Sequence[ast.AST] = ()
    loop: Entry | None = None
    is_negated: bool = False
    #: The function with the decision, and whether the decision is all that it does.
    scope: Scope | None = None
    is_whole: bool = False


UNUSED = Purpose()


#: The words that call a function, and its place among the arguments.
FUNCTION_PLACES = {words.future: 0, words.place: 1, words.mirrored: 1, words.arrayed: 1}


@dataclass(eq=False)
class Entry:
    """A site while labels are made."""

    kind: Literal["end", "part", "call", "loop"]
    component: str
    node: ast.AST
    arms: Arms
    text: str = ""
    purpose: Purpose = UNUSED
    reader: Reader | None = None
    inside: int | None = None
    joins: dict[str, str] = field(default_factory=dict)


class Activations:
    """The sites of a program, by activation: a function, or the body of a loop.

    Attributes
    ----------
    entries : list of list of Entry
        The sites of each activation; the model's is the first.
    scopes : dict
        The activations of functions.
    functions : dict
        The activations of functions by name, where it is the name of one function.
    calls : dict
        The sites of calls, parts and choices by their syntax node.
    """

    def __init__(self, program: Program, function: FunctionType) -> None:
        self.program = program
        self.entries: list[list[Entry]] = []
        self.scopes: dict[Scope, int] = {}
        self.calls: dict[ast.AST, Entry] = {}
        names: Counter[str] = Counter()
        for unit in (program.units[function], *program.units.values()):
            for scope in functions_of(unit.scopes):
                if scope not in self.scopes:
                    self.scopes[scope] = self.add()
                    names[scope.name] += 1
        self.functions = {s.name: n for s, n in self.scopes.items() if names[s.name] == 1}
        for unit in program.units.values():
            reader = Reader(self, unit)
            for scope in functions_of(unit.scopes):
                reader.function(scope)

    def add(self) -> int:
        """Add an activation, and return its number."""
        self.entries.append([])
        return len(self.entries) - 1


class Reader:
    """Reader of a unit's functions, which collects the sites of each activation."""

    def __init__(self, every: Activations, unit: Unit) -> None:
        self.all, self.unit = every, unit
        self.scope: Scope = unit.scopes.root
        self.arms: Arms = ()
        self.here = 0
        self.function_names: dict[ast.AST, str] = {}

    def function(self, scope: Scope) -> None:
        """Read a function's body."""
        assert isinstance(scope.node, (ast.FunctionDef, ast.Lambda))
        self.scope, self.here, self.arms = scope, self.all.scopes[scope], ()
        if isinstance(scope.node, ast.Lambda):
            self.visit(scope.node.body)
        else:
            self.block(scope.node.body)

    def block(self, statements: Sequence[ast.AST]) -> None:
        """Read statements; after an `if` that leaves, the others are its other side."""
        outer = self.arms
        for statement in statements:
            self.visit(statement)
            if isinstance(statement, ast.If):
                for side, body in enumerate((statement.body, statement.orelse)):
                    if body and isinstance(body[-1], LEAVES):
                        self.arms = (*self.arms, (statement, 1 - side))
        self.arms = outer

    def side(self, node: ast.AST, number: int, parts: Sequence[ast.AST], purpose: Purpose = UNUSED) -> None:
        """Read a side of an `if`."""
        outer, self.arms = self.arms, (*self.arms, (node, number))
        if isinstance(node, ast.If):
            self.block(parts)
        else:
            for part in parts:
                self.visit(part, purpose)
        self.arms = outer

    def loop(self, node: ast.AST, component: str, name: str = "") -> Entry:
        """Add a loop, and an activation for its iterations."""
        entry = Entry("loop", component, node, self.arms, purpose=Purpose(name), reader=self)
        entry.inside = self.all.add()
        self.all.entries[self.here].append(entry)
        return entry

    def inner(self, loop: Entry) -> tuple[int, Arms, Scope]:
        """Enter the iterations of a loop; return what to restore after them."""
        outer = self.here, self.arms, self.scope
        assert loop.inside is not None
        self.here, self.arms = loop.inside, ()
        return outer

    def visit(self, node: ast.AST, purpose: Purpose = UNUSED) -> None:
        """Read a statement or an expression with what its value is for."""
        components = self.unit.components
        match node:
            case ast.Assign() | ast.AnnAssign() | ast.AugAssign():
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                if node.value is not None:
                    self.assigned(targets[0], node.value)
            case ast.Return() if node.value is not None:
                self.visit(node.value, Purpose(spoken(self.scope.function.name)))
            case ast.For():
                loop = self.loop(node, components.get(node, "[]"), _loop_name(node.target))
                self.visit(node.iter, self.decision("count", node.body, loop=loop))
                outer = self.inner(loop)
                self.block(node.body)
                self.here, self.arms, self.scope = outer
            case ast.While():
                loop = self.loop(node, components.get(node, "while[]"))
                outer = self.inner(loop)
                self.visit(node.test, self.decision("while", node.body))
                self.block(node.body)
                self.here, self.arms, self.scope = outer
            case ast.If():
                whole = self.is_whole(node)
                self.visit(node.test, self.decision("if", node.body, node.orelse, is_whole=whole))
                self.side(node, 0, node.body)
                self.side(node, 1, node.orelse)
            case ast.IfExp():
                test = self.decision("if", [node.body], [node.orelse])
                self.visit(node.test, Purpose(f"{purpose.name}?") if purpose.name else test)
                self.side(node, 0, [node.body], purpose)
                self.side(node, 1, [node.orelse], purpose)
            case ast.BoolOp():
                for number, value in enumerate(node.values):
                    rest = self.decision("if", node.values[number + 1 :])
                    is_last = number + 1 == len(node.values)
                    self.visit(value, purpose if is_last or purpose != UNUSED else rest)
            case ast.UnaryOp(op=ast.Not()):
                self.visit(node.operand, replace(purpose, is_negated=not purpose.is_negated))
            case ast.Dict():
                for key, value in zip(node.keys, node.values, strict=True):
                    is_text = isinstance(key, ast.Constant) and isinstance(key.value, str)
                    self.visit(value, Purpose(spoken(key.value)) if is_text else purpose)  # type: ignore[union-attr]
            case ast.Subscript():
                name = node.value.id if isinstance(node.value, ast.Name) else ""
                self.visit(node.value, purpose)
                of = Purpose(singular(spoken(name.lower()))) if name else UNUSED
                self.visit(node.slice, of if purpose == UNUSED else purpose)
            case ast.ListComp() | ast.GeneratorExp() | ast.SetComp():
                self.generators(node, 0, self.scope, purpose)
            case ast.FunctionDef() | ast.Lambda():
                for parameter, default in default_expressions(node).items():
                    self.visit(default, Purpose(spoken(parameter)))
            case ast.Call():
                self.call(node, purpose)
            case _:
                for child in ast.iter_child_nodes(node):
                    self.visit(child, purpose if isinstance(node, ast.expr) else UNUSED)

    def decision(
        self,
        form: Literal["if", "while", "count"],
        nodes: Sequence[ast.AST],
        alternative: Sequence[ast.AST] = (),
        loop: Entry | None = None,
        is_whole: bool = False,
    ) -> Purpose:
        """Return the purpose of a condition, or of the items of a loop."""
        return Purpose("", form, nodes, alternative, loop, scope=self.scope, is_whole=is_whole)

    def is_whole(self, node: ast.If) -> bool:
        """Return whether an `if` without another side is all that its function does."""
        body = getattr(self.scope.function.node, "body", [])
        statements = [s for s in body if not isinstance(s, ast.Expr) or not isinstance(s.value, ast.Constant)]
        return statements == [node] and not node.orelse

    def assigned(self, target: ast.expr, value: ast.expr) -> None:
        """Read an assigned value; the numbers of a tuple have the names of their places."""
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            if len(target.elts) == len(value.elts) and not any(
                isinstance(part, ast.Starred) for part in (*target.elts, *value.elts)
            ):
                for part, element in zip(target.elts, value.elts, strict=True):
                    self.assigned(part, element)
                return
        names = [spoken(part.id) for part in ast.walk(target) if is_stored(part)]
        self.visit(value, Purpose(" and ".join(names[:2]) if len(names) < 3 else ", ".join(names)))

    def generators(self, node: Comprehension, number: int, scope: Scope, purpose: Purpose) -> None:
        """Read a comprehension from one of its generators on."""
        if number == len(node.generators):
            self.visit(node.elt, purpose)
            return
        part = node.generators[number]
        loop = self.loop(part, self.unit.components.get(part, "[]"), _loop_name(part.target))
        self.visit(part.iter, self.decision("count", [node.elt], loop=loop))
        outer = self.inner(loop)
        self.scope = self.unit.scopes.of.get(node, scope)
        for test in part.ifs:
            self.visit(test, self.decision("if", [node.elt]))
        self.generators(node, number + 1, self.scope, purpose)
        self.here, self.arms, self.scope = outer

    def call(self, node: ast.Call, purpose: Purpose) -> None:
        """Read a call: its arguments, then its site."""
        value = self.value(node.func)
        components = self.unit.components
        if not isinstance(node.func, ast.Name):
            self.visit(node.func)
        names = self.parameters(node, value)
        for number, arg in enumerate(node.args):
            name = names[number] if number < len(names) else ""
            self.argument(arg, name, value, purpose)
        for keyword in node.keywords:
            name = keyword.arg or ""
            self.argument(keyword.value, name if name in names or not names else "", value, purpose)
        if (node, "loop") in components:
            key = next((keyword.value for keyword in node.keywords if keyword.arg == "key"), None)
            function = key if key is not None else _function_argument(node, value)
            if function is not None:
                loop = self.loop(node, components[node, "loop"])
                outer = self.inner(loop)
                entry = self.add("call", components[node, "call"], node, self.callee(function))
                entry.text = given.of(node) or entry.text
                self.here, self.arms, self.scope = outer
        elif node in components and value not in SCORES and value is not words.mem:
            self.site(node, value, purpose)

    def site(self, node: ast.Call, value: Any, purpose: Purpose) -> None:
        """Add the site of a call."""
        component, text = self.unit.components[node], given.of(node)
        if value in vocabulary.DRAWS or value in CHOICES:
            entry = self.add("end", component, node, None)
            entry.purpose = Purpose(text) if text else purpose
        elif value is words.emit:
            name = part_name(node)
            entry = self.add("part", component, node, None)
            entry.text = text or (spoken(name) if name else self.shown(node.args))
        else:
            function = _function_argument(node, value) or node.func
            entry = self.add("call", component, node, self.callee(function))
            name = component.partition("#")[0]
            entry.text = text or PLAIN.get(name, spoken(name))
        self.all.calls[node] = entry

    def add(
        self, kind: Literal["end", "part", "call"], component: str, node: ast.AST, inside: int | None
    ) -> Entry:
        """Add a site to the current activation."""
        entry = Entry(kind, component, node, self.arms, reader=self, inside=inside)
        if kind == "call":
            entry.text = PLAIN.get(component, spoken(component.partition("#")[0]))
        self.all.entries[self.here].append(entry)
        return entry

    def argument(self, node: ast.expr, name: str, value: Any, purpose: Purpose) -> None:
        """Read an argument of a call: it is for the parameter, or for what the call is for."""
        if value is words.query and isinstance(node, ast.Constant):
            return
        if not name:
            self.visit(node, UNUSED if value is words.emit else purpose)
        elif value is words.vec:
            self.visit(node, Purpose(f"{purpose.name} {name}" if purpose.name else name))
        elif value in vocabulary.WORDS and value not in SHAPES:
            self.visit(node, Purpose(spoken(name)) if purpose == UNUSED else purpose)
        elif value in SHAPES and isinstance(node, (ast.Tuple, ast.List)) and len(node.elts) <= len(AXES):
            places = COLORS if name == "color" else AXES
            for place, element in zip(places, node.elts, strict=False):
                self.visit(element, Purpose(f"{spoken(name)} {place}"))
        else:
            self.visit(node, Purpose(spoken(name)))

    def parameters(self, node: ast.Call, value: Any) -> Sequence[str]:
        """Return the names of a callee's parameters; none for built-ins and for what only the run knows."""
        function = _function_argument(node, value) if value in FUNCTION_PLACES else None
        if function is not None:
            skipped = [""] * (1 + FUNCTION_PLACES[value])
            return [*skipped, *self._parameters(function, self.value(function))]
        return self._parameters(node.func, value)

    def _parameters(self, node: ast.expr, value: Any) -> Sequence[str]:
        meaning_here = self.unit.scopes.find(node.id, self.scope) if isinstance(node, ast.Name) else None
        if isinstance(node, ast.Lambda):
            meaning_here = self.unit.scopes.of.get(node)
        if isinstance(meaning_here, Scope):
            return meaning_here.parameters
        if isinstance(value, Memoised):
            value = underlying(value.function)
        if isinstance(value, type) and is_record_class(value):
            return record_fields(value)
        is_word = value in vocabulary.DRAWS or value in FAMILIES
        if is_word or (value in vocabulary.WORDS and value not in vocabulary.NUMBERS):
            kind = vocabulary.DRAWS.get(value, value)
            return [parameter.name for parameter in vocabulary.parameters_of(kind)]
        if isinstance(value, FunctionType) and value not in vocabulary.ALL_WORDS:
            code = value.__code__
            return code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        return []

    def callee(self, node: ast.expr | None) -> int | None:
        """Return the activation of a callee; None for a function that only the run knows."""
        if node is None:
            return None
        meaning_here: Any = self.unit.scopes.find(node.id, self.scope) if isinstance(node, ast.Name) else None
        if isinstance(node, ast.Lambda):
            meaning_here = self.unit.scopes.of.get(node)
        value = self.value(node)
        if isinstance(value, FunctionType) and value in self.all.program.units:
            meaning_here = self.all.program.units[value].scopes.root
        return self.all.scopes.get(meaning_here) if isinstance(meaning_here, Scope) else None

    def value(self, node: ast.expr, scope: Scope | None = None) -> Any:
        """Return the object of a name from outside of the model, or MISSING."""
        value = meaning(node, scope or self.scope, self.unit.scopes, self.unit.namespace)
        return value if hashable(value) else MISSING

    def shape(self, node: ast.Call, scope: Scope | None) -> str:
        """Return the words of a shape's word; empty for another call."""
        value = self.value(node.func, scope)
        return spoken(value.__name__) if value in SHAPES else ""

    def shown(self, shapes: Sequence[ast.expr]) -> str:
        """Return the label of a part: its first shape, or the function that makes it."""
        node: ast.AST | None = shapes[0] if shapes else None
        while node is not None:
            match node:
                case ast.List(elts=[first, *_]) | ast.Tuple(elts=[first, *_]):
                    node = first
                case ast.IfExp():
                    node = node.body
                case ast.ListComp() | ast.GeneratorExp():
                    node = node.elt
                case ast.Starred():
                    node = node.value
                case ast.Name():
                    return spoken(node.id)
                case ast.Call(func=ast.Name(id=name)) | ast.Call(func=ast.Attribute(attr=name)):
                    return self.shape(node, self.scope) or spoken(name)
                case _:
                    break
        return "part"

    def word(self, node: ast.Call) -> str:
        """Return the word of a choice."""
        value = self.value(node.func)
        if value is words.sample and node.args and isinstance(node.args[0], ast.Call):
            return spoken(self.unit.components[node].partition("#")[0])
        name = getattr(value, "__name__", "choice")
        return {"choose": "choice", "sample": "choice", "infer": "inner search"}.get(name, spoken(name))


def is_stored(node: ast.AST) -> TypeGuard[ast.Name]:
    """Return whether a node is a name that is assigned."""
    return isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)


def _loop_name(target: ast.expr) -> str:
    """Return the first name of a loop's target that says something, else the first name."""
    names = [part.id for part in ast.walk(target) if isinstance(part, ast.Name)]
    return next((name for name in names if not is_anonymous(name)), names[0] if names else "")


def _function_argument(node: ast.Call, value: Any) -> ast.expr | None:
    """Return the function that a word or a built-in is given to call, or None."""
    place = 0 if value in (map, filter) else FUNCTION_PLACES.get(value) if hashable(value) else None
    return node.args[place] if place is not None and len(node.args) > place else None
