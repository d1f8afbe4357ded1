"""Operations of the core form for the functions that a model may call: built-ins, `math`, and words of the package.

An `Op` is the operation that the call of a Python function becomes.
"""

from __future__ import annotations

import builtins
import inspect
import math
import re
from dataclasses import dataclass
from typing import Any

from niwaki import _engine, words
from niwaki.lang.core import is_literal
from niwaki.words.distributions import FAMILIES, Distribution
from niwaki.words.measures import LOOKS
from niwaki.words.shapes import SHAPES


@dataclass(frozen=True)
class Parameter:
    """A parameter; `default` is REQUIRED, OMITTED (not written into the core form), or a value."""

    name: str
    default: Any


REQUIRED: Any = type("Required", (), {"__repr__": lambda self: "required"})()
OMITTED: Any = type("Omitted", (), {"__repr__": lambda self: "omitted"})()


@dataclass(frozen=True)
class Op:
    """An operation of the core form with its parameters; a `variadic` operation takes further positional arguments."""

    head: str
    parameters: tuple[Parameter, ...] = ()
    variadic: bool = False
    keywords: bool = True


def _op(head: str, names: str = "", optional: str = "", variadic: bool = False, keywords: bool = False) -> Op:
    needed = [Parameter(name, REQUIRED) for name in names.split()]
    return Op(head, (*needed, *(Parameter(name, OMITTED) for name in optional.split())), variadic, keywords)


def parameters_of(function: Any) -> tuple[Parameter, ...]:
    """Return the parameters of a function or class, with their defaults; a word's `label` is not an argument."""
    parameters = inspect.signature(function).parameters.values()
    is_word = (getattr(function, "__module__", None) or "").startswith("niwaki.words.")
    return tuple(
        Parameter(p.name, REQUIRED if p.default is p.empty else p.default)
        for p in parameters
        if not is_word or p.name != "label"
    )


BUILTINS: dict[Any, Op] = {
    len: _op("len", "xs"),
    abs: _op("abs", "x"),
    round: _op("round", "number", "ndigits", keywords=True),
    reversed: _op("reversed", "xs"),
    enumerate: _op("enumerate", "iterable", "start", keywords=True),
    zip: _op("zip", variadic=True),
    range: _op("range", "start", "stop step"),
    list: _op("to_list", "xs"),
    tuple: _op("to_tuple", "xs"),
    int: _op("int", "x"),
    float: _op("float", "x"),
    bool: _op("bool", "x"),
    str: _op("str", "x"),
    repr: _op("repr", "x"),
    sum: _op("sum", "xs", "start", keywords=True),
    min: _op("min", "xs", variadic=True),
    max: _op("max", "xs", variadic=True),
    any: _op("any", "xs"),
    all: _op("all", "xs"),
    pow: _op("pow", "base exp", keywords=True),
    divmod: _op("divmod", "a b"),
}

_UNARY_MATH = (
    "sqrt exp log2 log10 log1p expm1 sin cos tan asin acos atan sinh cosh tanh floor ceil trunc fabs"
)
_UNARY_MATH += " degrees radians isfinite isnan isinf factorial lgamma erf"

MATH: dict[Any, Op] = {
    **{getattr(math, name): _op(name, "x") for name in _UNARY_MATH.split()},
    **{getattr(math, name): _op(name, "x y") for name in "atan2 copysign fmod comb".split()},
    math.pow: _op("math_pow", "x y"),
    math.gcd: _op("gcd", variadic=True),
    math.hypot: _op("hypot", "x", variadic=True),
    math.log: _op("log", "x", "base"),
}

_VECTORS = (
    words.vec,
    words.dot,
    words.cross,
    words.norm,
    words.normalize,
    words.distance,
    words.rotate,
    words.rotation,
)
_COLORS = (words.rgb, words.hsv, words.lab, words.to_hsv, words.to_lab, words.color_difference)
_POLYGONS = (
    words.polygon_area,
    words.polygon_contains,
    words.polygon_distance,
    words.polygon_disc_area,
    words.polygon_inset,
)
NUMBERS = (words.clip, words.lerp, words.linspace, words.sign, words.smoothstep)
_SOFT = (
    words.softeq,
    words.soft_at_least,
    words.soft_at_most,
    words.smooth_max,
    words.smooth_min,
    words.smooth_abs,
)


def _word(function: Any, omit: bool) -> Op:
    parameters = parameters_of(function)
    if omit:
        parameters = tuple(Parameter(p.name, OMITTED if p.default is None else p.default) for p in parameters)
    return Op(function.__name__, parameters)


def _shape(function: Any) -> Op:
    """Return the operation of a word for a shape; metalness and roughness are left out if a call does not have them."""
    parameters = _word(function, False).parameters
    return Op(
        function.__name__,
        tuple(Parameter(p.name, OMITTED) if p.name in LOOKS[1:] else p for p in parameters),
    )


WORDS: dict[Any, Op] = {
    **{function: _word(function, True) for function in (*_VECTORS, *_COLORS, *_POLYGONS, *NUMBERS, *_SOFT)},
    **{function: _shape(function) for function in SHAPES},
}

OPERATIONS: dict[Any, Op] = {**BUILTINS, **MATH, **WORDS}

EFFECTS: dict[Any, str] = {
    words.sample: "sample",
    words.observe: "observe",
    words.factor: "factor",
    words.condition: "condition",
    words.query: "query",
    words.emit: "emit",
    words.force: "force",
}

_NAMES = {"bernoulli": "flip"}
DRAWS: dict[Any, type[Distribution]] = {
    getattr(words, _NAMES.get(family.family, family.family)): family
    for family in FAMILIES
    if hasattr(words, _NAMES.get(family.family, family.family))
}

ALL_WORDS: frozenset[Any] = frozenset(
    {
        *WORDS,
        *EFFECTS,
        *DRAWS,
        *FAMILIES,
        words.arrayed,
        words.choose,
        words.future,
        words.infer,
        words.look,
        words.mem,
        words.mirrored,
        words.place,
    }
)

METHODS: dict[str, tuple[int, int]] = {
    "index": (1, 1),
    "count": (1, 1),
    "upper": (0, 0),
    "lower": (0, 0),
    "strip": (0, 1),
    "split": (0, 1),
    "join": (1, 1),
    "replace": (2, 2),
    "startswith": (1, 1),
    "endswith": (1, 1),
    "get": (1, 2),
    "keys": (0, 0),
    "values": (0, 0),
    "items": (0, 0),
}

CHANGERS: dict[str, str] = {
    "append": "{target} = {target} + [{argument}]",
    "extend": "{target} = {target} + {argument}",
    "insert": "{target} = {target}[:i] + [value] + {target}[i:]",
    "pop": "{target} = {target}[:-1]",
    "remove": "{target} = [x for x in {target} if x != {argument}]",
    "clear": "`{target} = []`, or `{target} = {{}}` for a dict",
    "sort": "{target} = sorted({target})",
    "reverse": "{target} = {target}[::-1]",
    "update": "a dict with all its keys, `{{...}}`",
    "setdefault": "`{target}.get(key, default)`",
    "popitem": "a dict with all its keys, `{{...}}`",
    "add": "a list, `{target} = {target} + [{argument}]`",
    "discard": "{target} = [x for x in {target} if x != {argument}]",
    "fill": "a new list",
    "resize": "a new list",
}

BINARY: dict[str, str] = {
    "Add": "add",
    "Sub": "sub",
    "Mult": "mul",
    "Div": "div",
    "FloorDiv": "floordiv",
    "Mod": "mod",
    "Pow": "pow",
    "BitAnd": "band",
    "BitOr": "bor",
    "BitXor": "bxor",
    "LShift": "shl",
    "RShift": "shr",
}

UNARY: dict[str, str] = {"USub": "neg", "UAdd": "pos", "Not": "not", "Invert": "invert"}

COMPARE: dict[str, str] = {
    "Eq": "eq",
    "NotEq": "ne",
    "Lt": "lt",
    "LtE": "le",
    "Gt": "gt",
    "GtE": "ge",
    "In": "in",
}

NOT_IN_A_MODEL: dict[Any, tuple[str, str]] = {
    print: (
        "prints",
        "remove the line; to watch a run, step through `niwaki.run_python(model, seed=1)` in a debugger",
    ),
    isinstance: ("asks-for-a-type", "give records a field for their kind, and compare that field"),
    issubclass: ("asks-for-a-type", "give records a field for their kind, and compare that field"),
    type: ("asks-for-a-type", "give records a field for their kind, and compare that field"),
    set: ("set-value", "use a list, and `in` to look for a value"),
    frozenset: ("set-value", "use a list, and `in` to look for a value"),
}

FORBIDDEN_BUILTINS: frozenset[Any] = frozenset(
    getattr(builtins, name)
    for name in (
        "open input eval exec compile globals locals vars dir id hash iter next getattr setattr delattr hasattr super "
        "object memoryview bytes bytearray complex slice callable format ord chr hex oct bin ascii breakpoint exit "
        "property classmethod staticmethod"
    ).split()
    if hasattr(builtins, name)
)


#: What arguments of shapes are, by type, beside points.
_SHAPE_ARGUMENTS = {
    "Pairs": "a list of pairs of numbers, such as `[(0, 0), (1, 0), (0, 1)]`",
    "Points": "a list of points of three numbers, such as `[(0, 0, 0), (0, 1, 0)]`",
}


def shape_help(message: str) -> str | None:
    """Return help about a cut of which nothing is left, or about a point, size or colour that is not a vector."""
    if message == "nothing is left of the solid":
        return (
            "in `a - b` some of `a` must be outside of `b`; in `a & b` the two must overlap, not only touch"
        )
    match = re.match(r"`(\w+)` of `(\w+)` takes (a vector|vectors|a list of points)\b", message)
    if match is None or match[2] not in {"emit", *(word.__name__ for word in SHAPES)}:
        return None
    if match[1] == "color":
        return (
            "a color is a tuple of red, green and blue from 0 to 1, such as `(1, 0, 0)`, or a name such as "
            '`"tomato"` or `"#c83c1e"`; `hsv` and `lab` make such colors'
        )
    kind = next(row[1] for row in _engine.SHAPES[match[2]][1] if row[0] == match[1])
    what = _SHAPE_ARGUMENTS.get(kind, "a tuple of three numbers, such as `(0, 1, 0)`")
    return f"`{match[1]}` of `{match[2]}` is {what}"


def plain_default(value: Any) -> bool:
    """Return whether a word's default can be written into the core form."""
    return is_literal(value) or (isinstance(value, tuple) and all(map(is_literal, value)))
