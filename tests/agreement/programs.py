"""Random terminating model programs, as source text, to compare executors.

Names are shadowed wherever Python has a scope: by parameters, by variables of loops and comprehensions, by functions
in functions and in branches. Inner models are nested functions, functions of the module, lambdas, or any of these
given as arguments.

`program(seed, size)` is a whole module whose last function is the model `m`; the same seed gives the same text. A
program consists of numbered fragments, so that `shrink` can leave fragments out: what fails is tried again with less.
Loops have fixed bounds and recursion counts down, so every program ends.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass

HEADER = (
    "import math\nfrom niwaki import model; from niwaki.words import *\n"
    "from niwaki import forward, importance, mh, smc\n\n"
    "WEIGHTS = [1.0, 2.0, 3.0]\nTABLE = {'a': 1, 'b': 2.5}\n\n"
)


@dataclass(frozen=True)
class Program:
    """A program as the list of its fragments: helper functions, and statements of the model."""

    helpers: tuple[str, ...]
    statements: tuple[tuple[str, ...], ...]

    @property
    def text(self) -> str:
        """The module's text."""
        lines = [line for statement in self.statements for line in statement]
        body = "\n".join(f"    {line}" for line in lines)
        start = "    n, x, b, xs, t, f = 3, 0.5, True, [1, 2.5, 3], (1, 2.0), 0.0"
        result = "    return (n, x, b, xs, t, f)"
        helpers = "\n\n".join(
            f"@model\n{helper}" if number % 2 and not helper.startswith("@") else helper
            for number, helper in enumerate(self.helpers)
        )
        return f"{HEADER}{helpers}\n\n@model\ndef m():\n{start}\n{body}\n{result}\n"


class Maker:
    """Makes fragments; integers are called n, reals x, truth values b, lists of reals xs, pairs t."""

    def __init__(self, seed: int, inner: bool = True) -> None:
        self.inner = inner
        self.random = random.Random(seed)
        self.count = 0
        self.helpers: list[str] = []
        self.locals: list[str] = []

    def fresh(self, stem: str) -> str:
        """A new name."""
        self.count += 1
        return f"{stem}{self.count}"

    def pick(self, *makers: Callable[[int], str] | str, depth: int = 0) -> str:
        """One of several continuations."""
        expression = self.random.choice(makers)
        return expression if isinstance(expression, str) else expression(depth - 1)

    # expressions, by the kind of their value

    def integer(self, depth: int) -> str:
        """An integer expression."""
        small = str(self.random.randint(-3, 5))
        if depth <= 0:
            return self.pick("n", small, "len(xs)")
        a, b, c = (
            (lambda: self.integer(depth - 1)),
            (lambda: self.integer(depth - 1)),
            (lambda: self.boolean(depth - 1)),
        )
        return self.random.choice(
            [
                lambda: f"({a()} + {b()})",
                lambda: f"({a()} - {b()})",
                lambda: f"({a()} * {small})",
                lambda: f"({a()} // {self.random.choice(['2', '3', '-2'])})",
                lambda: f"({a()} % {self.random.choice(['2', '5', '-3'])})",
                lambda: f"({a()} if {c()} else {b()})",
                lambda: f"min({a()}, {b()})",
                lambda: f"max({a()}, {b()}, {small})",
                lambda: f"abs({a()})",
                lambda: f"int({self.real(depth - 1)})",
                lambda: f"discrete_uniform({small}, {small} + 2)",
                lambda: "categorical(WEIGHTS)",
                lambda: f"sum(1 for v in xs if v > {small})",
                lambda: f"len([v for v in {self.sequence(depth - 1)}])",
                lambda: f"(n & {self.random.randint(0, 7)} | 1)",
                lambda: f"choose([1, n, {small}])",
            ]
        )()

    def real(self, depth: int) -> str:
        """A real expression."""
        small = repr(round(self.random.uniform(-3, 3), 2))
        if depth <= 0:
            return self.pick("x", small, "xs[0]", "t[1]", "TABLE['b']")
        r = lambda: self.real(depth - 1)  # noqa: E731
        options: list[Callable[[], str]] = [
            lambda: f"({r()} + {r()})",
            lambda: f"({r()} - {self.integer(depth - 1)})",
            lambda: f"({r()} * {small})",
            lambda: f"({r()} / {self.random.choice(['2', '3.5', '-4'])})",
            lambda: f"gaussian({r()}, {self.random.choice(['1', '0.5'])})",
            lambda: f"gaussian(sd=2.0, mean={r()})",
            lambda: f"uniform({small}, {small} + 1.5)",
            lambda: f"math.sin({r()})",
            lambda: f"math.sqrt(abs({r()}))",
            lambda: f"clip({r()}, -10, 10)",
            lambda: f"xs[{self.integer(depth - 1)} % len(xs)]",
            lambda: f"sum({self.sequence(depth - 1)})",
            lambda: f"max({self.sequence(depth - 1)}, key=lambda v: v * v - x)",
            lambda: f"min({self.sequence(depth - 1)}, default={small})",
            lambda: f"(lambda u: u * {small} + x)({r()})",
            lambda: f"float({self.integer(depth - 1)})",
            lambda: f"({r()} if {self.boolean(depth - 1)} else {r()})",
            lambda: (
                f"sample(Mixture([1, 2], [Gaussian({r()}, 1), Uniform(0, 1)]))" if False else f"({r()} ** 2)"
            ),
            lambda: f"dot(vec(x, 1), vec({r()}, {r()}))",
        ]
        if self.helpers:
            options += [
                lambda: f"h{self.random.randrange(len(self.helpers))}({r()}, {self.random.randint(0, 3)})"
            ] * 3
            options += [lambda: self.forced(depth)] * 2
        if self.locals:
            options += [lambda: f"{self.random.choice(self.locals)}({r()})"] * 2
        options += [
            lambda: f"sum([x * n + {small} for n, x in enumerate({self.sequence(depth - 1)})])",
            lambda: f"max([x for x in [x, {r()}] for n in (x, 1)])",
            lambda: f"(lambda x, n={self.integer(depth - 1)}: x + n)({r()})",
            lambda: f"(lambda n: (lambda n: n * 2)(n) - n)({r()})",
        ]
        if self.inner and self.callables():
            options += [lambda: self.inferred(depth)]
        return self.random.choice(options)()

    def callables(self) -> list[str]:
        """Functions of a real number, as they are called by name."""
        return [*self.locals, *(f"h{k}" for k in range(len(self.helpers)))]

    def inferred(self, depth: int) -> str:
        """The value of an inner search."""
        r = lambda: self.real(depth - 1)  # noqa: E731
        name, q = self.random.choice(self.callables()), self.fresh("q")
        args = f"{r()}, 1" if name.startswith("h") else r()
        call = f"{name}({q}, 1)" if name.startswith("h") else f"{name}({q})"
        method = self.random.choice(
            ["forward()", "importance(4)", "smc(3)", "mh(steps=6)", "smc(2, order='depth-first')"]
        )
        keep = self.random.choice(["", ", keep='best'"])
        return self.pick(
            f"infer({name}, {method}, {args}{keep})",
            f"infer(lambda {q}: {call} + gaussian(0, 1), {method}, {r()}{keep})",
            f"infer(lambda f, {q}: {call.replace(name, 'f')} * 0.5, {method}, {name}, {r()}{keep})",
            f"infer(lambda f, {q}: {call.replace(name, 'f[1]')} * 0.5, {method}, (1, {name}), {r()}{keep})",
        )

    def forced(self, depth: int) -> str:
        """The value of a future, wherever that lies."""
        r, q = (lambda: self.real(depth - 1)), self.fresh("q")
        f = lambda: f"future(h{self.random.randrange(len(self.helpers))}, {r()}, 1)"  # noqa: E731
        return self.pick(
            f"force({f()})",
            f"force({f()} if {self.boolean(depth - 1)} else {r()})",
            f"(force({f()}) - force({f()}))",
            f"force([{f()}, {f()}][n % 2])",
            f"force({{'a': {f()}, 'b': 1.5}}['a'])",
            f"sum([force({q}) for {q} in ({f()}, {r()})])",
            f"(lambda {q}: force({q}) + force({q}))({f()})",
            f"force(future(lambda {q}: force({q}), {f()}))",
        )

    def boolean(self, depth: int) -> str:
        """A truth value."""
        if depth <= 0:
            return self.pick("b", "True", "flip(0.5)", "n > 1")
        r, c = (lambda: self.real(depth - 1)), (lambda: self.boolean(depth - 1))
        return self.random.choice(
            [
                lambda: f"({r()} < {r()})",
                lambda: f"({r()} < {r()} <= {r()})",
                lambda: f"({c()} and {c()})",
                lambda: f"({c()} or {c()} or {c()})",
                lambda: f"(not {c()})",
                lambda: "flip(0.3)",
                lambda: f"(n in [1, 2, {self.integer(depth - 1)}])",
                lambda: f"any(v > {r()} for v in {self.sequence(depth - 1)})",
                lambda: f"all(v < {r()} and flip(0.9) for v in xs)",
                lambda: f"({self.integer(depth - 1)} == {self.integer(depth - 1)})",
            ]
        )()

    def sequence(self, depth: int) -> str:
        """A list of numbers, never empty."""
        if depth <= 0:
            return self.pick("xs", "[x, 1]", "[1.5, n]")
        r = lambda: self.real(depth - 1)  # noqa: E731
        v = self.fresh("v")
        return self.random.choice(
            [
                lambda: f"[{r()}, {r()}]",
                lambda: f"({self.sequence(depth - 1)} + [{r()}])",
                lambda: f"[{v} * 2 for {v} in {self.sequence(depth - 1)}]",
                lambda: f"([{v} + gaussian() for {v} in range(3) if {v} != n] + [0])",
                lambda: f"[{v} + w for {v} in xs[:2] for w in (1, x)]",
                lambda: f"sorted({self.sequence(depth - 1)})",
                lambda: f"sorted({self.sequence(depth - 1)}, key=lambda u: -u, reverse={self.boolean(0)})",
                lambda: f"list(map(lambda u: u + x, {self.sequence(depth - 1)}))",
                lambda: f"([0] + list(filter(lambda u: u > x, {self.sequence(depth - 1)})))",
                lambda: f"{self.sequence(depth - 1)}[::-1]",
                lambda: f"[{v} for {v}, _ in zip(xs, range(9))]",
                lambda: f"[{v} + k for k, {v} in enumerate({self.sequence(depth - 1)})]",
            ]
        )()

    # statements, as lines

    def statement(self, depth: int, loop: bool = False) -> list[str]:
        """A statement."""
        r, i = (lambda: self.real(2)), (lambda: self.integer(2))
        kinds: list[Callable[[], list[str]]] = [
            lambda: [f"x = {r()}"],
            lambda: [f"n = {i()} % 7"],
            lambda: [f"b = {self.boolean(2)}"],
            lambda: [f"xs = {self.sequence(2)}[:5]"],
            lambda: [f"t = ({i()} % 9, {r()})"],
            lambda: ["n, x = t", "n = n % 9"],
            lambda: [f"f += {r()}"],
            lambda: [f"x, *rest = {self.sequence(1)}", "f = f + len(rest)"],
            lambda: [f"factor(-abs({r()}))"],
            lambda: [f"observe(Gaussian({r()}, 2), {r()})"],
            lambda: [f"emit(box((0, n, {r()}), (1, 1, {self.random.randint(1, 3)})))"],
            lambda: (
                [f"query('{self.fresh('q')}' + str({len(self.helpers)}), {r()})"]
                if not loop
                else ["f = f + 1"]
            ),
            lambda: [f"t = (n, len(f'{{x:.3f}} {{n}}') * 1.0)"],  # noqa: F541
        ]
        if depth > 0:
            kinds += [
                lambda: self.branch(depth, loop),
                lambda: self.for_loop(depth),
                lambda: self.while_loop(depth),
            ] * 2
            kinds += [lambda: self.closure()] * (not loop)
            kinds += [lambda: self.shadowing()] * (2 * (not loop))
            kinds += [
                lambda: ["for x in [x, 1.5, x]:", "    f = f + x", *self.block(depth, True)],
                lambda: ["for n in range(n % 4):", *self.block(depth, True)],
                lambda: [f"for n, x in enumerate({self.sequence(1)}[:3]):", *self.block(depth, True)],
            ]
        if loop:
            kinds += [
                lambda: [f"if {self.boolean(1)}:", "    break"],
                lambda: [f"if {self.boolean(1)}:", "    continue"],
            ]
        else:
            kinds += [lambda: [f"if x > {self.random.randint(5, 50)}:", "    return (n, x)"]]
        return self.random.choice(kinds)()

    def block(self, depth: int, loop: bool) -> list[str]:
        """An indented block."""
        lines = [line for _ in range(self.random.randint(1, 3)) for line in self.statement(depth - 1, loop)]
        return [f"    {line}" for line in lines]

    def branch(self, depth: int, loop: bool) -> list[str]:
        """`if`, with or without `else`."""
        lines = [f"if {self.boolean(2)}:", *self.block(depth, loop)]
        if self.random.random() < 0.6:
            lines += ["else:", *self.block(depth, loop)]
        return lines

    def for_loop(self, depth: int) -> list[str]:
        """A loop over a few items."""
        i = self.random.choice(["i", self.fresh("i")])
        head = self.random.choice(
            [f"for {i} in range({self.random.randint(1, 4)}):", f"for {i}, _ in enumerate(xs):"]
        )
        return [head, f"    f = f + {i}", *self.block(depth, True)]

    def while_loop(self, depth: int) -> list[str]:
        """A loop with a counter."""
        k = self.fresh("k")
        return [
            f"{k} = 0",
            f"while {k} < 3 and {self.boolean(1)}:",
            f"    {k} += 1",
            *self.block(depth, True),
        ]

    def closure(self) -> list[str]:
        """A nested function, perhaps recursive, that captures variables."""
        name = self.fresh("g")
        kept = self.fresh("kept")
        lines = [f"{kept} = {self.real(1)}"]
        if self.random.random() < 0.5:
            lines += [f"def {name}(u, depth=2):", f"    y = gaussian(u, 1) + {kept}"]
            lines += [f"    return y if depth == 0 else {name}(y, depth - 1)"]
        else:
            lines += [f"{name} = lambda u, w={self.real(1)}: u + w + {kept}"]
        self.locals.append(name)
        return [*lines, f"f = f + {name}(x)"]

    def shadowing(self) -> list[str]:
        """A nested function whose names are those of the function around it, called with keywords in any order."""
        name, kept = self.fresh("g"), self.fresh("kept")
        before = [f"{kept} = {self.real(1)}"]
        default = self.pick("2", f"{self.integer(1)}", f"(lambda n: n + {self.integer(0)})(1)")
        outside, self.locals = self.locals, [*self.locals]
        inner = [line for _ in range(self.random.randint(1, 3)) for line in self.statement(1)]
        self.locals = outside
        body = ["t = (1, x)", "f = 0.0", "xs = [x, n, 1.5]", f"y = gaussian(x + {kept}, 1)", *inner]
        body = [without_queries(line).replace("return (n, x)", "return x") for line in body]
        head = f"def {name}(x, n={default}, *, b=True, w={self.real(1)}):"
        lines = [head, *(f"    {line}" for line in body), "    return y + f * 0.1 + x * n + w"]
        if self.random.random() < 0.3:
            other = [
                f"    def {name}(x, n={default}, *, b=True, w=1.0):",
                "        return x + n + gaussian(w, 1)",
            ]
            lines = [f"if {self.boolean(1)}:", *(f"    {line}" for line in lines), "else:", *other]
            return [*before, *lines, f"f = f + {name}({self.real(1)})"]
        self.locals.append(name)
        parameters = [
            f"x={self.real(1)}",
            f"w={self.real(1)}",
            f"b={self.boolean(1)}",
            f"n={self.integer(1)} % 4",
        ]
        self.random.shuffle(parameters)
        return [*before, *lines, f"f = f + {name}({', '.join(parameters)})"]

    def helper(self) -> str:
        """A function of a real and a counter, that may call itself and the helpers before it."""
        name = f"h{len(self.helpers)}"
        lines = [
            f"def {name}(x, n, xs=(1, 2.5), b=True):",
            "    t = (1, x)",
            "    f = 0.0",
            "    xs = list(xs)",
        ]
        lines += [f"    y = {self.pick('gaussian(x, 1)', 'uniform(0, 1) + x', 'sample(Gaussian(x, 0.5))')}"]
        lines += [f"    {without_queries(line)}" for line in self.statement(1)]
        lines = [line.replace("return (n, x)", "return x") for line in lines]
        lines += ["    if n > 0 and flip(0.6):", f"        return {name}(y, n - 1) + f", "    return y + x"]
        return "\n".join(lines)


def without_queries(line: str) -> str:
    """A line of a function that is called more than once: a query may be written only once."""
    indent = line[: len(line) - len(line.lstrip())]
    return f"{indent}f = f + 1" if line.lstrip().startswith("query(") else line


def program(seed: int, size: int = 8, inner: bool = True) -> Program:
    """A random program of `size` statements, with inner searches or without."""
    maker = Maker(seed, inner)
    for _ in range(maker.random.randint(0, 3)):
        maker.helpers.append(maker.helper())
    statements = []
    for _ in range(size):
        statements.append(tuple(maker.statement(2)))
    return Program(tuple(maker.helpers), tuple(statements))


def smaller(whole: Program) -> Iterator[Program]:
    """Yield the program without one of its statements, or without its last helper."""
    for place in range(len(whole.statements)):
        yield Program(whole.helpers, whole.statements[:place] + whole.statements[place + 1 :])
    if whole.helpers:
        yield Program(whole.helpers[:-1], whole.statements)


def shrink(whole: Program, fails: Callable[[str], bool]) -> Program:
    """The smallest program that can be reached by leaving things out and that still fails."""
    for less in smaller(whole):
        if fails(less.text):
            return shrink(less, fails)
    return whole
