"""A simple interpreter of the core form: an independent check of plain Python and the engine.

It reads the *text*, so it tests the writer too, and it knows nothing of Python's syntax trees. Calls recurse on the
host stack, closures are (name, values), every effect is done by a `PlainRun`, whose path it keeps by the labels in the
text. It is only for tests.
"""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from typing import Any

from niwaki import words
from niwaki.lang import densities
from niwaki.lang.core import Core
from niwaki.lang.plain import PlainRun, Run
from niwaki.words.choices import words_of
from niwaki.words.distributions import FAMILIES

TOKEN = re.compile(r'\s*(\(|\)|"(?:[^"\\]|\\.)*"|[^\s()"]+)')
FAMILY = {family.family: family for family in FAMILIES}


class Stop(Exception):
    """`break`, `continue` or `return`, as an exception."""

    def __init__(self, kind: str, value: Any = None) -> None:
        super().__init__(kind)
        self.kind = kind
        self.value = value


class Text(str):
    """A string literal, as against a bare word."""


@dataclass(frozen=True)
class Closure:
    """A function value."""

    name: str
    captured: tuple[Any, ...]


def parse(text: str) -> list[Any]:
    """Nested lists of words and strings; spans are dropped, labels become the list's second item."""
    stack: list[list[Any]] = [[]]
    for token in TOKEN.findall(text):
        if token == "(":
            stack.append([])
        elif token == ")":
            done = stack.pop()
            stack[-1].append(done)
        elif token.startswith('"'):
            stack[-1].append(Text(json.loads(token)))
        elif not token.startswith("@"):
            stack[-1].append(token)
    return stack[0]


class Reader:
    """One run of a core form."""

    def __init__(self, core: Core, state: PlainRun) -> None:
        self.core = core
        self.state = state
        module = parse(core.write(components=True))[0][1:]
        self.functions = {part[1]: part for part in module if part[0] == "fn"}
        self.entry = next(part[1] for part in module if part[0] == "entry")

    def call(self, name: str, values: list[Any], label: str | None) -> Any:
        """A function with its parameters and then its captures."""
        function = self.functions[name]
        params, captures = function[3][1:], function[5][1:]
        assert len(values) == len(params) + len(captures), (name, len(values))
        variables = dict(zip([*params, *captures], values, strict=True))
        depth = len(self.state.path)
        if label is not None:
            self.state.path.append(label)
        try:
            self.block(function[6:], variables)
        except Stop as stop:
            return stop.value
        finally:
            del self.state.path[depth:]
        return None

    def apply(self, closure: Closure, args: list[Any], label: str) -> Any:
        function = self.functions[closure.name]
        params, defaults, captures = function[3][1:], function[4][1:], function[5][1:]
        missing = len(params) - len(args)
        around = dict(zip(captures, closure.captured, strict=True))
        filled = (
            [self.value(default, around) for default in defaults[len(defaults) - missing :]]
            if missing
            else []
        )
        return self.call(closure.name, [*args, *filled, *closure.captured], label)

    def block(self, statements: list[Any], v: dict[str, Any]) -> None:
        for statement in statements:
            self.statement(statement, v)

    def statement(self, s: Any, v: dict[str, Any]) -> None:
        head, label, args = split(s)
        if head == "set":
            v[args[0]] = self.value(args[1], v)
        elif head == "unpack":
            values = list(self.value(args[1], v))
            v.update(zip(args[0], values, strict=True))
        elif head == "unpack_star":
            first, rest, last, value = args
            values = list(self.value(value, v))
            v.update(zip(first, values[: len(first)], strict=True))
            v[rest] = values[len(first) : len(values) - len(last)]
            v.update(zip(last, values[len(values) - len(last) :], strict=True))
        elif head == "if":
            self.block((args[1] if self.value(args[0], v) else args[2])[1:], v)
        elif head in ("for", "while"):
            self.loop(head, label, args, v)
        elif head in ("break", "continue"):
            raise Stop(head)
        elif head == "return":
            raise Stop(head, self.value(args[0], v))
        elif head == "do":
            self.value(args[0], v)
        elif head == "assert":
            assert self.value(args[0], v), self.value(args[1], v)
        else:
            raise AssertionError(head)

    def loop(self, head: str, label: str, args: list[Any], v: dict[str, Any]) -> None:
        path = self.state.path
        depth = len(path)
        items = iter(self.value(args[1], v)) if head == "for" else None
        body = args[2][1:] if head == "for" else args[1][1:]
        number = 0
        while True:
            if items is not None:
                try:
                    v[args[0]] = next(items)
                except StopIteration:
                    return
            path.append(label.replace("[]", f"[{number}]"))
            try:
                if head == "while" and not self.value(args[0], v):
                    return
                self.block(body, v)
            except Stop as stop:
                if stop.kind == "break":
                    return
                if stop.kind == "return":
                    raise
            finally:
                del path[depth:]
            number += 1

    def value(self, e: Any, v: dict[str, Any]) -> Any:
        if isinstance(e, Text):
            return str(e)
        if isinstance(e, str):
            return v[e] if e.startswith("$") else atom(e)
        head, label, args = split(e)
        if head == "and":
            value = None
            for part in args:
                value = self.value(part, v)
                if not value:
                    break
            return value
        if head == "or":
            value = None
            for part in args:
                value = self.value(part, v)
                if value:
                    break
            return value
        if head == "cond":
            return self.value(args[1] if self.value(args[0], v) else args[2], v)
        if head == "data":
            return self.core.constants[int(args[0])]
        if head == "fstr":
            return "".join(str(part) if isinstance(part, Text) else self.formatted(part, v) for part in args)
        if head == "dict":
            keys = [str(key) if isinstance(key, Text) else atom(key) for key in args[0]]
            return dict(zip(keys, [self.value(part, v) for part in args[1:]], strict=True))
        if head == "field":
            return getattr(self.value(args[0], v), args[1])
        if head in ("call", "future"):
            return self.call(args[0], [self.value(part, v) for part in args[1:]], label)
        if head == "closure":
            return Closure(args[0], tuple(self.value(part, v) for part in args[1:]))
        if head == "dist":
            return FAMILY[args[0]](*[self.value(part, v) for part in args[1:]])
        if head in ("record", "host"):
            table: Any = self.core.classes if head == "record" else self.core.constants
            return table[int(args[0])](*[self.value(part, v) for part in args[1:]])
        if head == "method":
            target = self.value(args[0], v)
            shape = getattr(target, args[1])(*[self.value(part, v) for part in args[2:]])
            return list(shape) if args[1] in ("keys", "values", "items") else shape
        values = [self.value(part, v) for part in args]
        if head in ("apply", "future_apply"):
            return self.apply(values[0], values[1:], label)
        if head in ("sample", "observe", "factor", "condition", "query", "emit", "force"):
            self.state.pending = label
            if head == "sample":
                return self.state.sample(values[0], *map(words_of, values[1:]))
            return getattr(self.state, head)(values) if head == "emit" else getattr(self.state, head)(*values)
        return OPERATIONS[head](*values)

    def formatted(self, part: list[Any], v: dict[str, Any]) -> str:
        value, spec, conversion = self.value(part[1], v), part[2], part[3]
        return format({"r": repr, "s": str}.get(conversion, lambda x: x)(value), spec)


def split(form: list[Any]) -> tuple[str, str, list[Any]]:
    """Head, label, arguments."""
    if (
        len(form) > 1
        and isinstance(form[1], str)
        and not isinstance(form[1], Text)
        and form[1].startswith("#")
    ):
        return form[0], form[1][1:], form[2:]
    return form[0], "", form[1:]


def atom(word: str) -> Any:
    """A literal."""
    named = {"true": True, "false": False, "none": None, "inf": math.inf, "-inf": -math.inf, "nan": math.nan}
    if word in named:
        return named[word]
    return int(word) if re.fullmatch(r"-?\d+", word) else float(word)


def _by(xs: list[Any], keys: list[Any], word: Any, **settings: Any) -> Any:
    return word(range(len(xs)), key=lambda n: keys[n], **settings)


OPERATIONS: dict[str, Any] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "floordiv": lambda a, b: a // b,
    "mod": lambda a, b: a % b,
    "pow": pow,
    "neg": lambda a: -a,
    "pos": lambda a: +a,
    "not": lambda a: not a,
    "invert": lambda a: ~a,
    "band": lambda a, b: a & b,
    "bor": lambda a, b: a | b,
    "bxor": lambda a, b: a ^ b,
    "shl": lambda a, b: a << b,
    "shr": lambda a, b: a >> b,
    "eq": lambda a, b: a == b,
    "ne": lambda a, b: a != b,
    "lt": lambda a, b: a < b,
    "le": lambda a, b: a <= b,
    "gt": lambda a, b: a > b,
    "ge": lambda a, b: a >= b,
    "in": lambda a, b: a in b,
    "is_none": lambda a: a is None,
    "index": lambda xs, i: xs[i],
    "slice": lambda xs, lo, hi, step: xs[lo:hi:step],
    "append": lambda xs, x: [*xs, x],
    "list": lambda *xs: list(xs),
    "tuple": lambda *xs: xs,
    "to_list": list,
    "to_tuple": tuple,
    "options": lambda xs: xs,
    "sorted": lambda xs, reverse=False: sorted(xs, reverse=reverse),
    "sorted_by": lambda xs, keys, reverse=False: [xs[n] for n in _by(xs, keys, sorted, reverse=reverse)],
    "argmin_by": lambda xs, keys: xs[_by(xs, keys, min)],
    "argmax_by": lambda xs, keys: xs[_by(xs, keys, max)],
    "reversed": lambda xs: list(reversed(xs)),
    "enumerate": lambda xs, start=0: list(enumerate(xs, start)),
    "zip": lambda *xs: list(zip(*xs, strict=False)),
    "zip_strict": lambda *xs: list(zip(*xs, strict=True)),
    **{
        word.__name__: word
        for word in (len, sum, min, max, abs, round, any, all, range, int, float, bool, str, repr, divmod)
    },
    **{name: getattr(math, name) for name in dir(math) if not name.startswith("_") and name != "pow"},
    **{
        name: getattr(words, name) for name in "vec dot cross norm normalize distance rotate rotation".split()
    },
    **{name: getattr(words, name) for name in ["clip", "lerp", "sign", *words.shapes.__all__]},
    "look": lambda *parts: words.look(*parts)[:3],
    **{name: getattr(words, name) for name in "softeq soft_at_least soft_at_most".split()},
    **{name: getattr(words, name) for name in "smooth_max smooth_min smooth_abs".split()},
}


def read(core: Core, args: list[Any], seed: int | None = None, choices: dict[str, Any] | None = None) -> Run:
    """Run a core form; the answer is a plain run's."""
    state = PlainRun(seed, choices)
    reader = Reader(core, state)
    value = reader.call(reader.entry, args, None)
    log_prior, log_score = densities.total(state.priors), densities.total(state.scores)
    return Run(value, state.choices_made, log_prior, log_score, state.scene, state.answers)
