"""Advice on a model that compiles, about code that delays the scoring of particles.

Two habits slow a search most (dissertation 5.4 and 5.6.1): a decision on a random value in place where it could be a
future, and a choice drawn before a barrier that does not need it. The text of a model shows both: `emit`, `factor`,
`observe` and `condition` are barriers, and so are calls that reach a barrier.

Advice is only about code that can move. A branch or call gets none if later code reads its results, if it leaves the
function or the loop, or if no later code builds parts. A choice gets advice only if a later part of the same block is
the first to read it. Randomness is followed through variables and calls, not through arguments.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, wraps
from heapq import heappop, heappush
from types import FunctionType
from typing import Any

from niwaki import words
from niwaki.errors.kinds import fill, notes, snippet
from niwaki.errors.messages import MESSAGES
from niwaki.errors.source import Span, span_of
from niwaki.lang import vocabulary
from niwaki.lang.deep import deep
from niwaki.lang.lower import lowered
from niwaki.lang.marks import underlying
from niwaki.lang.names import MISSING, hashable, is_library
from niwaki.lang.program import Program, Unit
from niwaki.lang.scope import Scope, Variable

BARRIERS = (words.emit, words.factor, words.observe, words.condition)
CHOSEN = (words.sample, words.choose)
LEAVES = (ast.Return, ast.Break, ast.Continue)
FUNCTIONS = (ast.FunctionDef, ast.Lambda)
Function = ast.FunctionDef | ast.Lambda


@dataclass(frozen=True)
class Advice:
    """Advice about a place in a model.

    Attributes
    ----------
    code : str
        The name of the kind of advice; docs/errors has a page for each.
    span, second : Span
        The place, and the code that it delays.
    values : dict
        Values for the names in the message's templates.
    """

    code: str
    span: Span
    second: Span
    values: dict[str, str] = field(default_factory=dict)

    def __str__(self) -> str:
        message = MESSAGES[self.code]
        first = (self.span, fill(message.label, self.values))
        lines = snippet(first, (self.second, fill(message.second, self.values)))
        head = f"advice[{self.code}]: {fill(message.title, self.values)}"
        return "\n".join([head, *lines, *notes(message, self.values, margin=lines[-1].removesuffix("|"))])


@deep
def advise(function: FunctionType) -> list[Advice]:
    """Return the advice on a model and on every function that it can call, in the order of the source."""
    program = lowered(function)
    facts = _Facts(program)
    advice = [entry for unit in program.units.values() for entry in _Reader(unit, facts).read()]
    return sorted(advice, key=lambda entry: (entry.span.file.path, entry.span.line, entry.span.column))


Question = Callable[["_Reader", ast.AST], bool]


def once(ask: Question) -> Question:
    """Store the answers to a question about parts in the reader; the reader forgets them when facts are added."""

    @wraps(ask)
    def answer(reader: _Reader, part: ast.AST) -> bool:
        key = ask.__name__, part
        if key not in reader.known:
            reader.known[key] = ask(reader, part)
        return reader.known[key]

    return answer


class _Facts:
    """Facts about the functions of a program: which reach barriers, random choices, decisions on random values."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.builds: set[ast.AST] = set()
        self.draws: set[ast.AST] = set()
        self.decides: set[ast.AST] = set()
        readers: dict[Function, _Reader] = {}
        for unit in program.units.values():
            reader = _Reader(unit, self)
            readers |= {node: reader for node in ast.walk(unit.node) if isinstance(node, FUNCTIONS)}
        callers: dict[Function, list[Function]] = {node: [] for node in readers}
        callees = {node: reader.functions(node) for node, reader in readers.items()}
        for node, called in callees.items():
            for callee in called:
                callers[callee].append(node)
        # A fixed point: callers reach all that their callees reach. Callees come first, so that only functions in a
        # cycle of calls are read again.
        place = {node: number for number, node in enumerate(_callees_first(callees))}
        waiting, queue = set(readers), sorted(place[node] for node in readers)
        nodes = sorted(readers, key=place.__getitem__)
        while queue:
            node = nodes[heappop(queue)]
            waiting.discard(node)
            before = self._known(node)
            self._look(readers[node], node)
            if self._known(node) != before:
                for caller in callers[node]:
                    # The caller's answers about its calls may have changed.
                    readers[caller].known.clear()
                    if caller not in waiting:
                        waiting.add(caller)
                        heappush(queue, place[caller])

    def _known(self, node: Function) -> tuple[bool, bool, bool]:
        return node in self.builds, node in self.draws, node in self.decides

    def _look(self, reader: _Reader, node: Function) -> None:
        body = body_of(node)
        if any(map(reader.is_barrier, body)):
            self.builds.add(node)
        if any(map(reader.is_random, body)):
            self.draws.add(node)
        in_place = (
            reader.function(value) in self.decides for part in body for _, value in reader.calls(part)
        )
        if reader.decisions(body) or any(in_place):
            self.decides.add(node)


def _callees_first(callees: Mapping[Function, Sequence[Function]]) -> list[Function]:
    """Return the functions in an order with callees before callers, except in cycles of calls."""
    ordered: dict[Function, None] = {}
    entered: set[Function] = set()
    for first in callees:
        waiting = [(first, iter(callees[first]))] if first not in entered else []
        entered.add(first)
        while waiting:
            node, rest = waiting[-1]
            following = next((callee for callee in rest if callee not in entered), None)
            if following is None:
                ordered[node] = None
                waiting.pop()
            else:
                entered.add(following)
                waiting.append((following, iter(callees[following])))
    return list(ordered)


class _Reader:
    """Reader of a unit of the program, a top-level function with its nested functions."""

    def __init__(self, unit: Unit, facts: _Facts) -> None:
        self.unit = unit
        self.facts = facts
        self.owner: dict[ast.AST, Scope] = {}
        self.known: dict[tuple[str, ast.AST], bool] = {}
        self._set_owners(unit.node, unit.scopes.root)

    def _set_owners(self, node: ast.AST, scope: Scope) -> None:
        for child in ast.iter_child_nodes(node):
            inner = self.unit.scopes.of.get(child, scope)
            self.owner[child] = scope
            self._set_owners(child, inner)

    def read(self) -> Iterator[Advice]:
        """Yield the advice on this unit."""
        for node in ast.walk(self.unit.node):
            if isinstance(node, ast.FunctionDef):
                yield from self.block(node.body, _After(None, lambda _: False), None)

    # callees

    def meaning(self, node: ast.expr) -> Any:
        """Return the object, or the node of a nested function, that a callee means; else MISSING."""
        if isinstance(node, ast.Lambda):
            return node
        if isinstance(node, ast.Name):
            meaning = self.unit.scopes.find(node.id, self.owner.get(node, self.unit.scopes.root))
            if isinstance(meaning, Scope):
                return meaning.node
            return MISSING if isinstance(meaning, Variable) else underlying(self.unit.namespace.find(node.id))
        if isinstance(node, ast.Attribute):
            owner = self.meaning(node.value)
            return MISSING if owner is MISSING else underlying(getattr(owner, node.attr, MISSING))
        return MISSING

    def calls(self, part: ast.AST) -> Iterator[tuple[ast.Call, Any]]:
        """Yield the calls of a part with their callees, without calls inside functions that the part defines."""
        waiting = [part]
        while waiting:
            node = waiting.pop()
            if isinstance(node, ast.Call):
                yield node, self.called(node)
            waiting.extend(below(node))

    def functions(self, node: Function) -> list[Function]:
        """Return the user's functions that a function calls in place."""
        called = (self.function(value) for part in body_of(node) for _, value in self.calls(part))
        return [*dict.fromkeys(callee for callee in called if callee is not None)]

    def called(self, node: ast.AST) -> Any:
        """Return the callee of a call; MISSING for other parts."""
        value = self.meaning(node.func) if isinstance(node, ast.Call) else MISSING
        return value if isinstance(value, ast.AST) or hashable(value) else MISSING

    def function(self, value: Any) -> Function | None:
        """Return the node of a user's function; None for other values."""
        if isinstance(value, ast.FunctionDef | ast.Lambda):
            return value
        if isinstance(value, FunctionType) and not is_library(value) and value in self.facts.program.units:
            return self.facts.program.units[value].node
        return None

    @once
    def is_barrier(self, part: ast.AST) -> bool:
        """Return whether a part adds to the scene or the score, itself or by a call."""
        value = self.called(part)
        if value in BARRIERS or self.function(value) in self.facts.builds:
            return True
        return any([self.is_barrier(child) for child in below(part)])

    @once
    def is_random(self, part: ast.AST) -> bool:
        """Return whether a part makes a random choice, itself or by a call."""
        value = self.called(part)
        if value in vocabulary.DRAWS or value in CHOSEN or self.function(value) in self.facts.draws:
            return True
        return any([self.is_random(child) for child in below(part)])

    @once
    def makes_futures(self, part: ast.AST) -> bool:
        """Return whether a part creates futures."""
        return self.called(part) is words.future or any([self.makes_futures(child) for child in below(part)])

    # dependence on random choices

    def random_names(self, body: Sequence[ast.AST]) -> set[str]:
        """Return the variables of a function that depend on a random choice."""
        names: set[str] = set()
        grown = -1
        while grown != (grown := len(names)):
            for part in body:
                for node in statements(part):
                    if (
                        isinstance(node, (ast.Assign, ast.AnnAssign, ast.AugAssign))
                        and node.value is not None
                    ):
                        if self.is_random(node.value) or reads(node.value) & names:
                            names |= writes(node)
                    elif isinstance(node, ast.For) and (
                        self.is_random(node.iter) or reads(node.iter) & names
                    ):
                        names |= writes(node.target)
        return names

    def decisions(self, body: Sequence[ast.AST]) -> list[ast.If]:
        """Return the branches on random values that build parts."""
        return self.random_of(body, [node for part in body for node in statements(part)])

    def random_of(self, body: Sequence[ast.AST], parts: Iterable[ast.AST]) -> list[ast.If]:
        """Return the branches on random values that build parts, among some parts of a block."""
        builds = [
            node
            for node in parts
            if isinstance(node, ast.If) and any(map(self.is_barrier, [*node.body, *node.orelse]))
        ]
        names = self.random_names(body) if builds else set()
        return [node for node in builds if self.is_random(node.test) or reads(node.test) & names]

    # blocks of statements

    def block(self, body: Sequence[ast.stmt], after: _After, loop: ast.stmt | None) -> Iterator[Advice]:
        """Yield the advice on a block; `after` describes the code after the block, `loop` the loop that repeats it."""
        decided = set(self.random_of(body, body))
        following = self.following(body, after.builds)
        first, last = read_places(body)
        early = self.early(body, last)
        builds = self.following(body, None)[0] if loop is not None else None

        def is_read_after(number: int) -> Callable[[str], bool]:
            return lambda name: (
                last.get(name, -1) > number
                or (loop is not None and first.get(name, len(body)) <= number)
                or after.is_read(name)
            )

        for number, part in enumerate(body):
            rest = following[number + 1] or loop
            if isinstance(part, ast.If) and part in decided:
                free = not any(map(is_read_after(number), writes_in(part))) and not leaves(part)
                if free and rest is not None:
                    yield self.advice("decides-in-place", part.test, rest)
            elif isinstance(part, ast.Expr) and isinstance(part.value, ast.Call) and rest is not None:
                callee = self.function(self.meaning(part.value.func))
                if callee is not None and callee in self.facts.decides:
                    yield self.call_advice(part.value, rest)
            if number in early:
                name = min(writes(part))
                yield self.advice("chosen-early", part, early[number], name=name)
            then = _After(following[number + 1] or builds, is_read_after(number))
            for inner, repeats in blocks(part):
                yield from self.block(inner, then, repeats or loop)

    def following(self, body: Sequence[ast.stmt], after: ast.stmt | None) -> list[ast.stmt | None]:
        """Return, for each statement of a block and for its end, the next statement that builds or makes a future."""
        following = [after]
        for part in reversed(body):
            following.append(part if self.is_barrier(part) or self.makes_futures(part) else following[-1])
        return following[::-1]

    def call_advice(self, call: ast.Call, rest: ast.stmt) -> Advice:
        """Return advice on a call that could be a future."""
        name = ast.unparse(call.func)
        arguments = [ast.unparse(argument) for argument in call.args]
        arguments += [f"{keyword.arg}={ast.unparse(keyword.value)}" for keyword in call.keywords]
        return self.advice(
            "calls-in-place", call, rest, name=name, cure=f"future({', '.join([name, *arguments])})"
        )

    def early(self, body: Sequence[ast.stmt], last: Mapping[str, int]) -> dict[int, ast.stmt]:
        """Return the choices of a block that are read only after the next barrier, each with that barrier.

        The block is read backwards. `needed` has the names that the barrier needs, or a statement before it that is
        no assignment; `later` has the names that a statement after the barrier needs.
        """
        early: dict[int, ast.stmt] = {}
        barrier: int | None = None
        needed: set[str] = set()
        later: set[str] = set()
        for number in range(len(body) - 1, -1, -1):
            part = body[number]
            if self.is_barrier(part):
                barrier, needed, later = number, set(reads(part)), set()
                continue
            if barrier is None:
                continue
            if not isinstance(part, ast.Assign | ast.AnnAssign):
                needed |= reads(part)
                continue
            names = writes(part)
            is_needed = bool(names & needed)
            is_later = bool(names & later) or any(last.get(name, -1) > barrier for name in names)
            if isinstance(part, ast.Assign) and self.is_random(part.value) and is_later and not is_needed:
                early[number] = body[barrier]
            if is_needed:
                needed |= reads(part)
            if is_later:
                later |= reads(part)
        return early

    def advice(self, code: str, node: ast.AST, rest: ast.AST, **values: str) -> Advice:
        return Advice(code, span_of(node, self.unit.file), first_line(span_of(rest, self.unit.file)), values)


def first_line(span: Span) -> Span:
    """Return a span reduced to its first line."""
    if span.end_line == span.line:
        return span
    return Span(span.file, span.line, span.column, span.line, len(span.file.line(span.line).rstrip()) + 1)


def below(part: ast.AST) -> list[ast.AST]:
    """Return the parts of a part; none for the definition of a function."""
    return [] if isinstance(part, FUNCTIONS) else [*ast.iter_child_nodes(part)]


@dataclass(frozen=True)
class _After:
    """The code after a block: its first statement that builds, and a test of the names that it reads."""

    builds: ast.stmt | None
    is_read: Callable[[str], bool]


def body_of(node: Function) -> Sequence[ast.AST]:
    """Return the statements of a function; for a lambda, its expression."""
    return node.body if isinstance(node, ast.FunctionDef) else [node.body]


def read_places(body: Sequence[ast.stmt]) -> tuple[dict[str, int], dict[str, int]]:
    """Return the numbers of the first and the last statement of a block that read each name."""
    first: dict[str, int] = {}
    last: dict[str, int] = {}
    for number, part in enumerate(body):
        for name in reads(part):
            first.setdefault(name, number)
            last[name] = number
    return first, last


@lru_cache(maxsize=10_000)
def statements(part: ast.AST) -> tuple[ast.AST, ...]:
    """Return a statement and all statements in it, without those of functions that it defines."""
    inner = [
        child for child in below(part) if isinstance(child, ast.stmt) and not isinstance(child, FUNCTIONS)
    ]
    return (part, *[nested for child in inner for nested in statements(child)])


@lru_cache(maxsize=10_000)
def reads(part: ast.AST) -> frozenset[str]:
    """Return the names that a part reads, also in functions that it defines."""
    names: set[str] = set()
    waiting: list[ast.AST] = [part]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            names.add(node.id)
        elif isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name):
            names.add(node.target.id)
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.stmt):
                names |= reads(child)
            else:
                waiting.append(child)
    return frozenset(names)


def writes(part: ast.AST) -> set[str]:
    """Return the names that an assignment or a target assigns."""
    return {
        node.id for node in ast.walk(part) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }


def writes_in(part: ast.If) -> set[str]:
    """Return the names that the arms of a branch assign."""
    return {name for arm in (*part.body, *part.orelse) for name in writes(arm)}


def leaves(part: ast.If) -> bool:
    """Return whether an arm leaves the function or the loop around the branch."""
    return any(isinstance(node, LEAVES) for arm in (*part.body, *part.orelse) for node in statements(arm))


def blocks(part: ast.stmt) -> Iterator[tuple[list[ast.stmt], ast.stmt | None]]:
    """Yield the blocks of a compound statement, each with the loop that repeats it."""
    if isinstance(part, ast.If):
        yield part.body, None
        yield part.orelse, None
    elif isinstance(part, (ast.For, ast.While)):
        yield part.body, part
