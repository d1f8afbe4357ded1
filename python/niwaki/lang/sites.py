"""Names of sites: the components that choices, calls and loops add to readable addresses.

    ship/      a call of a function, a call of a value, a future, a `place`: the callee's short name (the part after the
               last dot; `lambda`), the name of a called variable, or `apply` for any other called value
    i[3]/      an iteration of `for i in ...` (the first name of a pattern), also in a comprehension; `while[3]`;
               `map[3]`, `filter[3]`, `sorted[3]`, `min[3]`, `max[3]` if these call a function;
               `mirrored[1]`, `arrayed[3]`
    zc         a choice: the first name of the assignment around it, else the distribution's family
    layout     the seed of an `infer`: the first name of the assignment around it, else `infer`
    color(3)   a call of a memoised function, from the root: the address of the `mem`, which is named like a choice,
               or the name of a function of a module; and the arguments
    observe    an effect: `observe`, `factor`, `condition`, `query`, `emit`; for an `emit` with a `name`, the name

The model itself adds no component: the address of its choice `zc` is "zc".

Equal names within an activation (a call, or an iteration of a loop) get `#1`, `#2` for the second, third occurrence in
the order of evaluation: `zc#1`, `wing#1`, `i[3]#1`. Four kinds are counted separately, because they cannot be confused:
ends of addresses, calls, loops, and memoised functions. Every site counts, whether or not its call can reach an effect.
The head of a loop belongs to the activation around it, the test of a `while` to each of its iterations.

A component has empty brackets for a loop, `i[]#1`; the run puts the index into the brackets.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterable, Sequence
from types import FunctionType, ModuleType
from typing import Any

from niwaki import words
from niwaki.errors.source import SourceFile
from niwaki.lang import given, vocabulary
from niwaki.lang.marks import underlying
from niwaki.lang.names import MISSING, Namespace, hashable, is_library
from niwaki.lang.scope import Scope, Scopes, Variable, default_expressions

#: Words beside those that draw from a family whose calls can have a label.
LABELLED = (
    words.sample,
    words.choose,
    words.emit,
    words.future,
    words.infer,
    words.place,
    words.mirrored,
    words.arrayed,
)

CALLS_A_FUNCTION = {
    map: "map",
    filter: "filter",
    sorted: "sorted",
    min: "min",
    max: "max",
    words.mirrored: "mirrored",
    words.arrayed: "arrayed",
}


def components_of(scopes: Scopes, namespace: Namespace, file: SourceFile) -> dict[Any, str]:
    """Return the components of all sites by syntax node; for `map` and the like by (node, "loop"), (node, "call")."""
    namer = _Namer(scopes, namespace, file)
    for scope in scopes.of.values():
        if scope.is_function:
            assert isinstance(scope.node, (ast.FunctionDef, ast.Lambda))
            namer.activation(
                scope, scope.node.body if isinstance(scope.node.body, list) else [scope.node.body]
            )
    return namer.components


class _Namer:
    def __init__(self, scopes: Scopes, namespace: Namespace, file: SourceFile) -> None:
        self.scopes, self.namespace, self.file = scopes, namespace, file
        self.components: dict[Any, str] = {}
        self.scope: Scope = scopes.root
        self.counts: Counter[tuple[str, str]] = Counter()
        self.target = ""

    def activation(self, scope: Scope, parts: Iterable[ast.AST], target: str = "") -> None:
        """Name the sites of a function's body or of an iteration, with fresh counts."""
        outer = self.scope, self.counts, self.target
        self.scope, self.counts, self.target = scope, Counter(), target
        for part in parts:
            self.visit(part)
        self.scope, self.counts, self.target = outer

    def count(self, key: Any, kind: str, name: str) -> None:
        seen = self.counts[kind, name]
        self.counts[kind, name] += 1
        self.components[key] = f"{name}#{seen}" if seen else name

    def visit(self, node: ast.AST) -> None:
        match node:
            case ast.Assign() | ast.AnnAssign() | ast.AugAssign():
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                self.target = next((t.id for t in targets if isinstance(t, ast.Name)), "")
                if node.value is not None:
                    self.visit(node.value)
                self.target = ""
            case ast.For():
                self.visit(node.iter)
                self.count(node, "loop", f"{first_name(node.target)}[]")
                self.activation(self.scope, node.body)
            case ast.While():
                self.count(node, "loop", "while[]")
                self.activation(self.scope, [node.test, *node.body])
            case ast.ListComp() | ast.GeneratorExp() | ast.SetComp():
                self.generators(node, 0, self.scope)
            case ast.FunctionDef() | ast.Lambda():
                for default in default_expressions(node).values():
                    self.visit(default)
            case ast.Call():
                self.call(node)
            case _:
                for child in ast.iter_child_nodes(node):
                    self.visit(child)

    def generators(
        self, node: ast.ListComp | ast.GeneratorExp | ast.SetComp, number: int, scope: Scope
    ) -> None:
        if number == len(node.generators):
            self.visit(node.elt)
            return
        part = node.generators[number]
        self.visit(part.iter)
        self.count(part, "loop", f"{first_name(part.target)}[]")
        outer = self.scope, self.counts
        self.scope, self.counts = self.scopes.of.get(node, scope), Counter()
        for test in part.ifs:
            self.visit(test)
        self.generators(node, number + 1, self.scope)
        self.scope, self.counts = outer

    def call(self, node: ast.Call) -> None:
        value = self.meaning(node.func)
        if not hashable(value):
            value = None
        if self.takes_label(node.func, value):
            given.take(node, self.file)
        if not isinstance(node.func, ast.Name):
            self.visit(node.func)
        for arg in (*node.args, *(keyword.value for keyword in node.keywords)):
            self.visit(arg)
        if value in vocabulary.DRAWS:
            self.count(node, "end", self.target or vocabulary.DRAWS[value].family)
        elif value is words.sample:
            self.count(node, "end", self.target or self.family(node.args[0] if node.args else None))
        elif value is words.choose:
            weights = any(keyword.arg == "weights" for keyword in node.keywords)
            weighted = len(node.args) > 1 or weights or self.is_table(node.args)
            self.count(node, "end", self.target or ("categorical" if weighted else "discrete_uniform"))
        elif value is words.emit:
            self.count(node, "end", part_name(node) or "emit")
        elif value in vocabulary.EFFECTS:
            self.count(node, "end", vocabulary.EFFECTS[value])
        elif value is words.infer:
            self.count(node, "end", self.target or "infer")
        elif value is words.mem:
            self.count(node, "memo", self.target or "mem")
        elif value is words.future:
            self.count(node, "call", self.callee(node.args[0]) if node.args else "apply")
        elif value is words.place:
            self.count(node, "call", self.callee(node.args[1]) if len(node.args) > 1 else "apply")
        elif value in CALLS_A_FUNCTION:
            self.count((node, "loop"), "loop", f"{CALLS_A_FUNCTION[value]}[]")
            key = next((keyword.value for keyword in node.keywords if keyword.arg == "key"), None)
            # The function is the first argument; behind a frame, the second.
            at = 1 if value in (words.mirrored, words.arrayed) else 0
            function = key if key is not None else (node.args[at] if len(node.args) > at else None)
            self.components[(node, "call")] = self.callee(function) if function is not None else "apply"
        elif self.is_site(node.func, value):
            self.count(node, "call", self.callee(node.func))

    def takes_label(self, node: ast.expr, value: Any) -> bool:
        """Return whether the keyword `label` of a call is its label, and not an argument."""
        if value in vocabulary.DRAWS or value in LABELLED:
            return True
        meaning = self.scopes.find(node.id, self.scope) if isinstance(node, ast.Name) else None
        if isinstance(meaning, Scope):
            return "label" not in meaning.parameters
        if isinstance(value, FunctionType):
            code = value.__code__
            parameters = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
            return self.is_site(node, value) and "label" not in parameters
        return isinstance(meaning, Variable)

    def is_table(self, args: Sequence[ast.expr]) -> bool:
        """Return whether the first argument is a dict, as far as the text shows."""
        return bool(args) and (isinstance(args[0], ast.Dict) or isinstance(self.meaning(args[0]), dict))

    def is_site(self, node: ast.expr, value: Any) -> bool:
        """Return whether a call runs the user's code: a built-in, a word that computes or a record's class does not."""
        if value is not MISSING:
            return (
                isinstance(value, FunctionType)
                and value not in vocabulary.ALL_WORDS
                and not is_library(value)
            )
        if isinstance(node, ast.Attribute):
            return self.namespace.has_field(node.attr)
        return True

    def family(self, dist: ast.expr | None) -> str:
        """Return the family of a distribution if the text shows it, else `sample`."""
        if isinstance(dist, ast.Call):
            live = self.meaning(dist.func)
            return (
                live.family if isinstance(live, type) and issubclass(live, words.Distribution) else "sample"
            )
        value = self.meaning(dist) if dist is not None else MISSING
        return value.family if isinstance(value, words.Distribution) else "sample"

    def callee(self, node: ast.expr) -> str:
        """Return the component that a callee adds to an address."""
        if isinstance(node, ast.Lambda):
            return "lambda"
        if isinstance(node, ast.Name):
            meaning = self.scopes.find(node.id, self.scope)
            if isinstance(meaning, (Scope, Variable)):
                return meaning.name
        value = self.meaning(node)
        if isinstance(value, FunctionType) and not is_library(value):
            return value.__name__.replace("<lambda>", "lambda")
        return "apply"

    def meaning(self, node: ast.expr) -> Any:
        """Return the object of a name from outside of the model, or MISSING."""
        return meaning(node, self.scope, self.scopes, self.namespace)


def meaning(node: ast.expr, scope: Scope, scopes: Scopes, namespace: Namespace) -> Any:
    """Return the object of a name from outside of the model, or MISSING."""
    if isinstance(node, ast.Name):
        if scopes.find(node.id, scope) is not None:
            return MISSING
        return underlying(namespace.find(node.id))
    if isinstance(node, ast.Attribute):
        owner = meaning(node.value, scope, scopes, namespace)
        if isinstance(owner, ModuleType):
            return underlying(getattr(owner, node.attr, MISSING))
    return MISSING


def part_name(node: ast.Call) -> str | None:
    """Return the name that an `emit` gives its part, if an address can have it, else None."""
    value = next((keyword.value for keyword in node.keywords if keyword.arg == "name"), None)
    text = value.value if isinstance(value, ast.Constant) else None
    return text if isinstance(text, str) and re.fullmatch(r"[\w-]+", text) else None


def first_name(target: ast.AST) -> str:
    """Return the first name of a loop's target."""
    return next((part.id for part in ast.walk(target) if isinstance(part, ast.Name)), "")
