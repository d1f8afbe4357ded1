"""Random model programs that enumeration can answer, with many futures that wait.

Every choice has few values, every program few runs. What can be forced (a future, or a value that is none) is chosen by
branches, unpacked from tuples, and lies in lists, records, dictionaries and closures; it goes through calls, is forced
twice, late, in loops and in comprehensions, and futures make futures. Names are shadowed by parameters, comprehensions
and loops, and assigned again in branches and loops, also a number after a future. A barrier may be anywhere, so that a
force waits or does not.

With `memo`, some functions of the module and some closures are memoised: they are asked for from anywhere, also through
futures, by arguments that are choices, and call themselves with smaller ones.

`text(seed)` is a whole module with the model `m`; the same seed gives the same text. `looking(seed)` is one whose every
run looks at a future that is not forced. `reduced` makes a text that fails smaller, line by line.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace

HEADER = """from dataclasses import dataclass
from niwaki import model; from niwaki.words import *

LOGS = (0.0, -0.7, 0.6)
COINS = [Bernoulli(0.3), Bernoulli(0.5), Bernoulli(0.8)]

@dataclass(frozen=True)
class Both:
    first: object
    second: object

def through(promise):
    return promise

def late(promise, n=1):
    factor(LOGS[n % 3])
    return force(promise)
"""


@dataclass(frozen=True)
class Scope:
    """The names that can be read, by what they hold."""

    integers: tuple[str, ...]
    truths: tuple[str, ...]
    #: A future, or an integer.
    promises: tuple[str, ...] = ()
    #: Two or more futures.
    lists: tuple[str, ...] = ()
    pairs: tuple[str, ...] = ()
    records: tuple[str, ...] = ()
    dicts: tuple[str, ...] = ()
    #: Functions of an integer that give an integer, and those that give a future.
    functions: tuple[str, ...] = ()
    makers: tuple[str, ...] = ()
    #: Memoised functions of an integer that give an integer.
    memos: tuple[str, ...] = ()


@dataclass
class Maker:
    """Makes programs; integers are small, `n` and `b` are assigned again and again, other names once."""

    random: random.Random
    scope: Scope = field(default_factory=lambda: Scope((), ()))
    count: int = 0
    #: So many choices may still be written.
    choices: int = 5
    #: Whether `n` and `b` are the function's own, so that they may be assigned.
    in_closure: bool = False
    tops: list[str] = field(default_factory=list)
    #: Whether functions may be memoised.
    memo: bool = False

    # names

    def fresh(self, stem: str) -> str:
        """A new name."""
        self.count += 1
        return f"{stem}{self.count}"

    def declare(self, kind: str, name: str) -> None:
        """From here on the name can be read."""
        self.scope = replace(self.scope, **{kind: (*getattr(self.scope, kind), name)})

    @contextmanager
    def inside(self, **names: tuple[str, ...]) -> Iterator[None]:
        """A block whose names are gone after it."""
        outside = self.scope
        self.scope = replace(outside, **names)
        yield
        self.scope = outside

    @contextmanager
    def closure(self) -> Iterator[None]:
        """A nested function of `n` and `b`: it must not capture what is assigned again."""
        outside = self.in_closure
        self.in_closure = True
        with self.inside(
            integers=("n",), truths=("b",), memos=tuple(m for m in self.scope.memos if m[0] == "m")
        ):
            yield
        self.in_closure = outside

    def choose(self, options: list[Callable[[], str]]) -> str:
        return self.random.choice(options)()

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    # expressions

    def integer(self, depth: int) -> str:
        """An integer expression."""
        s = self.scope
        plain: list[Callable[[], str]] = [
            lambda: self.random.choice([*s.integers, "1", "2"]),
            lambda: self.random.choice(s.integers),
        ]
        if depth <= 0:
            return self.choose(plain)
        inner = depth - 1
        options = [
            *plain,
            lambda: f"({self.integer(inner)} + {self.integer(inner)})",
            lambda: f"({self.integer(inner)} - {self.integer(inner)})",
            lambda: f"({self.integer(inner)} if {self.truth(inner)} else {self.integer(inner)})",
            lambda: f"min({self.integer(inner)}, {self.integer(inner)})",
        ]
        options += [lambda: f"force({self.promise(inner)})"] * 4
        options += [
            lambda: f"(force({self.promise(inner)}) + force({self.promise(inner)}))",
            lambda: f"late({self.promise(inner)}, {self.integer(0)})",
        ]
        if s.functions:
            options.append(lambda: f"{self.random.choice(s.functions)}({self.integer(inner)})")
        if s.memos:
            options += [lambda: f"{self.random.choice(s.memos)}({self.integer(inner)} % 2)"] * 4
            options += [lambda: f"sum([{self.random.choice(s.memos)}(k) for k in range(2)])"]
        if s.lists:
            name = self.random.choice(s.lists)
            options += [
                lambda: f"sum([force(q) for q in {name}])",
                lambda: f"[force(n) + 1 for n in {name}][{self.integer(0)} % 2]",
                lambda: f"len({name})",
                lambda: f"sum(force({name}[k]) for k in range(2))",
            ]
        if self.choices > 0:
            options += [lambda: self.choice()] * 2
        return self.choose(options)

    def choice(self) -> str:
        """A random choice of an integer."""
        self.choices -= 1
        return self.choose(
            [
                lambda: f"discrete_uniform(0, 1 + {self.integer(0)} % 2)",
                lambda: f"(2 if flip(0.3 + 0.1 * ({self.integer(0)} % 3)) else 0)",
                lambda: "categorical([1.0, 2.0, 1.0])",
                lambda: f"(1 if sample(COINS[{self.integer(0)} % 3]) else 0)",
            ]
        )

    def truth(self, depth: int) -> str:
        """A truth value."""
        s = self.scope
        options: list[Callable[[], str]] = [
            lambda: self.random.choice(s.truths),
            lambda: f"({self.integer(depth - 1)} > {self.random.choice(['0', '1'])})",
            lambda: f"({self.integer(depth - 1)} % 2 == 0)",
        ]
        if depth > 0:
            options += [
                lambda: f"(not {self.truth(depth - 1)})",
                lambda: f"({self.truth(depth - 1)} and {self.truth(depth - 1)})",
                lambda: f"({self.truth(depth - 1)} or {self.truth(depth - 1)})",
            ]
            if self.choices > 0:
                self.choices -= 1
                options += [lambda: f"flip({self.random.choice(['0.3', '0.5', '0.8'])})"] * 2
        return self.choose(options)

    def future(self, depth: int) -> str:
        """A new future."""
        s = self.scope
        known = self.random.choice(self.tops)
        options: list[Callable[[], str]] = [
            lambda: f"future({known}, {self.integer(depth - 1)})",
            lambda: f"future({known}, {self.integer(depth - 1)}, {self.truth(0)})",
            lambda: f"future(late, {self.promise(depth - 1)})",
        ]
        if not self.in_closure:
            # A lambda must not capture what is assigned again.
            with self.inside(integers=("2",), truths=("True",)):
                options.append(lambda: f"future(lambda: {known}({self.integer(0)}) + {self.integer(0)})")
        if s.functions:
            options.append(lambda: f"future({self.random.choice(s.functions)}, {self.integer(0)})")
        if s.memos:
            options += [lambda: f"future({self.random.choice(s.memos)}, {self.integer(0)} % 2)"] * 2
        return self.choose(options)

    def promise(self, depth: int) -> str:
        """Return an expression that can be forced."""
        s = self.scope
        options: list[Callable[[], str]] = []
        if s.promises:
            options += [lambda: self.random.choice(s.promises)] * 2
        if s.lists:
            name = self.random.choice(s.lists)
            options += [lambda: f"{name}[{self.integer(0)} % 2]", lambda: f"{name}[-1]"]
        if s.pairs:
            options += [lambda: f"{self.random.choice(s.pairs)}[{self.random.randint(0, 1)}]"]
        if s.records:
            options += [
                lambda: f"{self.random.choice(s.records)}.{self.random.choice(['first', 'second'])}"
            ] * 2
        if s.dicts:
            options += [lambda: f"{self.random.choice(s.dicts)}['{self.random.choice('ab')}']"] * 2
        if s.makers:
            options += [lambda: f"{self.random.choice(s.makers)}({self.integer(0)})"]
        if depth > 0 or not options:
            options += [lambda: self.future(min(depth, 1))]
        if depth > 0 and s.promises:
            options += [
                lambda: f"through({self.promise(depth - 1)})",
                lambda: f"({self.promise(depth - 1)} if {self.truth(0)} else {self.promise(depth - 1)})",
                lambda: f"({self.promise(depth - 1)} if {self.truth(0)} else {self.integer(0)})",
            ]
        return self.choose(options)

    # statements, as lines

    def statement(self, depth: int, loop: bool = False) -> list[str]:
        """A statement."""
        kinds: list[Callable[[], list[str]]] = [
            lambda: [f"n = {self.integer(2)} % 3"],
            lambda: [f"n = {self.integer(2)} % 3"],
            lambda: [f"b = {self.truth(2)}"],
            # Kept until much later, by those who read them again and again.
            lambda: self.held("integers", "c", f"{self.integer(2)} % 3"),
            lambda: self.held(
                "truths", "c", f"{self.truth(2)} {self.random.choice(['and', 'or'])} {self.truth(1)}"
            ),
            *([self.score] * 3),
            *([lambda: self.held("promises", "f", self.promise(2))] * 2),
            lambda: self.held("promises", "f", f"{self.future(1)} if {self.truth(1)} else {self.integer(0)}"),
            self.unpacked,
            lambda: self.held("lists", "fs", f"[{self.promise(1)}, {self.promise(1)}]"),
            lambda: self.held("lists", "fs", f"[{self.future_of('k')} for k in range(2)]"),
            lambda: self.held("pairs", "t", f"({self.promise(1)}, {self.promise(1)})"),
            lambda: self.held("records", "r", f"Both({self.promise(1)}, {self.promise(1)})"),
            lambda: self.held("dicts", "d", f'{{"a": {self.promise(1)}, "b": {self.promise(1)}}}'),
            self.rebound,
        ]
        if self.scope.lists:
            name = self.random.choice(self.scope.lists)
            kinds.append(lambda: self.held("lists", "fs", f"{name} + [{self.promise(1)}]"))
            kinds.append(lambda: self.held("lists", "fs", f"{name}[::-1]"))
        if depth > 0:
            kinds += [lambda: self.branch(depth, loop), lambda: self.for_loop(depth)] * 2
            kinds += [lambda: self.while_loop(depth)]
            if not loop and not self.in_closure:
                kinds += [self.nested] * 3
        if loop:
            kinds.append(lambda: [f"if {self.truth(1)}:", f"    {self.random.choice(['break', 'continue'])}"])
        elif not self.in_closure and self.chance(0.1):
            kinds.append(lambda: [f"if n == {self.random.randint(0, 2)} and b:", "    return (n, -1)"])
        return self.random.choice(kinds)()

    def future_of(self, name: str) -> str:
        """A future whose argument is that name."""
        return f"future({self.random.choice(self.tops)}, {name})"

    def held(self, kind: str, stem: str, text: str) -> list[str]:
        """A new name for it."""
        name = self.fresh(stem)
        self.declare(kind, name)
        return [f"{name} = {text}"]

    def unpacked(self) -> list[str]:
        """Two futures out of one value."""
        a, b = self.fresh("f"), self.fresh("f")
        pair = self.random.choice([*self.scope.pairs, f"({self.promise(1)}, {self.promise(1)})"])
        self.declare("promises", a)
        self.declare("promises", b)
        return [f"{a}, {b} = {pair}"]

    def score(self) -> list[str]:
        """A barrier."""
        return [
            self.choose(
                [
                    lambda: f"factor(LOGS[{self.integer(2)} % 3])",
                    lambda: f"factor(0.5 if {self.truth(1)} else -0.4)",
                    lambda: f"observe(COINS[{self.integer(1)} % 3], {self.truth(1)})",
                    lambda: f"observe(Bernoulli(0.2 + 0.3 * ({self.integer(1)} % 3)), True)",
                    lambda: f"condition({self.truth(1)} or {self.integer(1)} % 3 > 0 or flip(0.5))",
                    lambda: "factor(-0.1)",
                ]
            )
        ]

    def block(self, depth: int, loop: bool) -> list[str]:
        """An indented block."""
        with self.inside():
            lines = [
                line for _ in range(self.random.randint(1, 2)) for line in self.statement(depth - 1, loop)
            ]
        return [f"    {line}" for line in lines]

    def rebound(self) -> list[str]:
        """A name that is assigned again, in a branch or in a loop, with another kind of value or as its variable."""
        v = self.random.choice(["v", "w", self.fresh("v")])
        kinds: list[Callable[[], list[str]]] = [
            lambda: [f"{v} = {self.promise(1)}", f"if {self.truth(1)}:", f"    {v} = force({v}) % 3"],
            lambda: [
                f"if {self.truth(1)}:",
                f"    {v} = {self.integer(1)}",
                "else:",
                f"    {v} = {self.future(1)}",
            ],
            lambda: [
                f"{v} = {self.integer(0)}",
                f"for {v} in ({v}, {self.promise(1)}):",
                f"    {v} = force({v}) % 3",
            ],
            lambda: [
                f"{v} = {self.integer(0)}",
                f"while {v} < 2:",
                f"    {v} = ({v} if {v} > 0 else 0) + max(1, [{v} for {v} in range(3)][{self.integer(0)} % 3])",
            ],
            lambda: [
                f"for {v} in range(2):",
                f"    {v} = future(late, {v}, {self.integer(0)})",
                f"    late({v}, 1)",
            ],
            lambda: [
                f"{v} = {self.integer(1)}",
                f"n, {v} = {v} % 3, n",
                f"{v} = sum([n + {v} for n in ({v}, 1)])",
            ],
        ]
        return [*self.random.choice(kinds)(), f"n = (n + force({v})) % 3"]

    def branch(self, depth: int, loop: bool) -> list[str]:
        """`if`, perhaps with `else`; a future that one of its arms creates."""
        if self.chance(0.3):
            # Assigned twice, so no closure may capture it.
            name = self.fresh("f")
            lines = [f"{name} = {self.integer(0)}", f"if {self.truth(1)}:", *self.block(depth, loop)]
            return [*lines, f"    {name} = {self.promise(1)}", f"n = force({name}) % 3"]
        lines = [f"if {self.truth(2)}:", *self.block(depth, loop)]
        if self.chance(0.6):
            lines += ["else:", *self.block(depth, loop)]
        return lines

    def for_loop(self, depth: int) -> list[str]:
        """A loop, over futures or numbers; its variable may shadow."""
        if self.scope.lists and self.chance(0.5):
            name = self.random.choice(self.scope.lists)
            k = self.fresh("k")
            if self.chance(0.5):
                head = [f"for {k} in range(2):", f"    n = (n + force({name}[{k}])) % 3"]
            else:
                head = [f"for {k} in {name}:", f"    n = (2 * n + force({k})) % 3"]
        else:
            head = [f"for {self.random.choice(['n', self.fresh('k')])} in range(2):"]
        return [*head, *self.block(depth, True)]

    def while_loop(self, depth: int) -> list[str]:
        """A loop that counts, and carries a future from one iteration to the next."""
        k, f = self.fresh("k"), self.fresh("f")
        return [
            f"{k}, {f} = 0, {self.promise(1)}",
            f"while {k} < 2 and {self.truth(0)}:",
            f"    {k} += 1",
            *self.block(depth, True),
            f"    {f} = future(late, {f}, {k})",
            f"n = force({f}) % 3",
        ]

    def sure(self, depth: int) -> str:
        """A future, whatever the choices."""
        future = self.future(1)
        if depth <= 0:
            return future
        inner, other = self.sure(depth - 1), self.promise(0)
        return self.choose(
            [
                lambda: future,
                lambda: f"through({inner})",
                lambda: f"({inner} if {self.truth(0)} else {future})",
                lambda: f"({other}, {inner})[1]",
                lambda: f"[{inner}, {other}][0]",
                lambda: f"[q for q in [{inner}, {future}]][{self.integer(0)} % 2]",
                lambda: f"Both({other}, {inner}).second",
                lambda: f"{{'a': {inner}, 'b': {other}}}['a']",
                lambda: f"force(future(through, {inner}))",
            ]
        )

    def look(self) -> list[str]:
        """A look at a future that is not forced."""
        name = self.fresh("f")
        other = self.integer(0)
        looks = [
            [f"n = 1 if {name} else 0"],
            [f"if {name}:", "    n = 1"],
            [f"while not {name}:", "    n = 1"],
            [f"b = {name} == {self.random.choice([other, name, 'None'])}"],
            [f"b = [{name}, {other}] != [{other}]"],
            [f"b = {name} < {other}"],
            [f"b = {name} in [{other}]"],
            [f"b = {other} in [{name}]"],
            [f"n = {name} + {other}"],
            [f"n = {other} - {name}"],
            [f"n = max({other}, {name})"],
            [f"n = sum([{other}, {name}])"],
            [f"n = LOGS[{name}]"],
            [f"n = len({name})"],
            [f"n = late({name} + 1)"],
            [f"n = f'{{{name}}}'"],
            [f"n = f'{{[{name}]}}'"],
            [f"for k in {name}:", "    n = k"],
            [f"for k in range({name}):", "    n = k"],
            [f"n = [{name} * k for k in range(2)]"],
            [f"n, b = {name}"],
            [f"n = {name}()"],
            [f"n = {name}.first"],
            [f"factor({name})"],
            [f"condition({name})"],
            [f"n = 1 if flip({name}) else 0"],
            [f"observe(Bernoulli(0.5), {name})"],
            [f"query({name}, 1)"],
            [f"n = future(h0, 1) + {name}"],
        ]
        return [f"{name} = {self.sure(2)}", *self.random.choice(looks)]

    def nested(self) -> list[str]:
        """A closure that captures futures, and whose parameters shadow."""
        name = self.fresh("g")
        kind = self.random.choice(["functions", "functions", "makers"])
        with self.closure():
            result = f"{self.integer(2)} % 3" if kind == "functions" else self.promise(1)
            if self.chance(0.5):
                body = [f"{name} = lambda n, b={self.random.choice(['True', 'False'])}: {result}"]
            else:
                lines = self.block(1, False) if self.chance(0.6) else []
                body = [f"def {name}(n, b=True):", *lines, f"    return {result}"]
        self.declare(kind, name)
        if self.memo and kind == "functions" and self.chance(0.7):
            memo = self.fresh("r")
            self.declare("memos", memo)
            return [*body, f"{memo} = mem({name})"]
        return body

    def remembered(self, number: int) -> str:
        """A memoised function of the module; it may call itself, and those before it."""
        name = f"m{number}"
        self.choices = 1
        lines = ["factor(LOGS[n % 3])"] if self.chance(0.5) else []
        with self.inside(integers=("n",), truths=("True",)):
            lines.append(f"k = {self.choice()}")
            self.choices = 0
            self.declare("integers", "k")
            if self.chance(0.5):
                lines.append("factor(LOGS[k % 3])")
            result = f"({self.integer(1)} + {name}(n - 1)) % 3 if n > 0 else k" if self.chance(0.5) else "k"
        body = "\n".join(f"    {line}" for line in [*lines, f"return {result}"])
        return f"@mem\ndef {name}(n):\n{body}\n"

    def top(self) -> str:
        """A function of the module: an integer and a truth value to an integer."""
        name = f"h{len(self.tops)}"
        self.choices = 1
        lines = []
        with self.inside(integers=("n",), truths=("b",)):
            tops = self.tops
            before = self.score() if tops and self.chance(0.3) else ["factor(LOGS[n % 3])"]
            lines += before if self.chance(0.6) else []
            self.choices = 1
            lines.append(f"k = {self.choice()}")
            self.choices = 0
            self.declare("integers", "k")
            if self.chance(0.6):
                lines.append(self.random.choice(["factor(LOGS[k % 3])", "factor(0.3 * k - 0.2)"]))
            if tops and self.chance(0.6):
                lines += [line for _ in range(self.random.randint(1, 2)) for line in self.statement(1)]
            result = f"{self.integer(1 if tops else 0)} % 3"
        body = "\n".join(f"    {line}" for line in [*lines, f"return {result}"])
        body = body.replace("return (n, -1)", "return 1")
        return f"def {name}(n, b=True):\n{body}\n"


def looking(seed: int) -> str:
    """A random program whose every run looks at a future that is not forced."""
    whole = text(seed, 5, looks=True)
    # A run that ends before its look, or is impossible, need not be refused.
    return re.sub(r"condition\((?!f\d+\))", "bool(", whole).replace("return (n, -1)", "n = 0")


def text(seed: int, size: int = 6, looks: bool = False, memo: bool = False) -> str:
    """A random program of `size` statements, perhaps with a look at a future among them, or with memoised functions."""
    maker = Maker(random.Random(seed), memo=memo)
    helpers = []
    memos = [f"m{number}" for number in range(2 * memo)]
    for number, name in enumerate(memos):
        maker.tops.append(name)
        helpers.append(maker.remembered(number))
        maker.declare("memos", name)
    maker.tops.clear()
    for _ in range(maker.random.randint(1, 3)):
        helpers.append(maker.top())
        maker.tops.append(f"h{len(maker.tops)}")
    maker.choices = 2
    maker.scope = Scope(("n",), ("b",), memos=tuple(memos))
    lines = [f"n, b = {maker.random.randint(0, 2)}, flip(0.6)"]
    at = maker.random.randrange(size) if looks else size
    for i in range(size):
        lines += maker.statement(2) if i != at else maker.look()
    s = maker.scope
    # A future may be what a model returns: its value is seen.
    seen = [*s.integers[1:][-1:], *s.truths[1:][-2:], *s.promises[-2:], *s.lists[-1:], *s.pairs[-1:]]
    lines.append(f"return ({', '.join(['n', 'b', *seen])})")
    body = "\n".join(f"    {line}" for line in lines)
    return "\n".join([HEADER, *helpers, f"@model\ndef m():\n{body}\n"])


def reduced(whole: str, fails: Callable[[str], bool]) -> str:
    """The smallest text that can be reached by leaving out lines, with the blocks below them, and that still fails."""
    lines = whole.split("\n")
    smaller = True
    while smaller:
        smaller = False
        at = len(lines) - 1
        while at >= 0:
            less = lines[:at] + lines[_end(lines, at) :]
            if lines[at].strip() and fails("\n".join(less)):
                lines, smaller = less, True
            at = min(at, len(lines)) - 1
    return "\n".join(lines)


def _end(lines: list[str], at: int) -> int:
    """The line after a line and the block below it."""
    indent = len(lines[at]) - len(lines[at].lstrip())
    end = at + 1
    while end < len(lines) and lines[end].strip() and len(lines[end]) - len(lines[end].lstrip()) > indent:
        end += 1
    return end
