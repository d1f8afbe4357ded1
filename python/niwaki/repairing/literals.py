"""Literals of a script: which numbers of a text may change, of what kind each is, and how far it may go.

| kind | which literals | width: one standard deviation of the prior |
| --- | --- | --- |
| length | every other number | a quarter of it, at least 2 % of the scene |
| count | whole numbers that a loop uses; small whole factors and powers are fixed | 1, or a quarter of it |
| angle | arguments of functions and names of angles | 15 degrees |
| colour | arguments and names of colours | 0.15 of a channel's range |
| word | names that the caller says may replace one another | each the same |
| size | numbers named as sizes, and those whose change resizes a part | 15 % of it |

Sizes, counts, colours and strings stay as they are, unless the caller frees them by name or line.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

#: Names of sizes, angles and colours, as parts of names between underscores.
SIZES = {
    *(
        "size",
        "width",
        "depth",
        "height",
        "length",
        "thickness",
        "thick",
        "radius",
        "diameter",
        "scale",
        "d",
        "h",
    ),
    *("r", "r1", "r2", "d1", "d2", "w"),
}
ANGLES = {
    "angle",
    "angles",
    "rotation",
    "rotate",
    "rot",
    "yaw",
    "pitch",
    "roll",
    "turn",
    "degrees",
    "radians",
    "a",
}
COLOURS = {"color", "colour", "colors", "colours", "rgb", "rgba"}
#: Functions whose numbers are counts or places in a list.
COUNTING = {"range", "linspace", "round", "islice", "repeat"}
#: Functions of angles.
TURNING = {"radians", "rotate", "sin", "cos", "tan", "deg2rad", "rotation"}
#: Settings of how fine, or how random, a result is.
SETTINGS = {"seed", "fn", "fa", "fs", "segments", "sections", "resolution", "samples", "convexity", "dpi"}
#: Whole factors up to this one, and all whole divisors and powers, belong to a formula.
FORMULA = 4
#: Kinds that change only if the caller frees them.
FIXED = {"size", "count", "colour"}

_SCAD_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|\$?[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|\S', re.DOTALL
)


@dataclass(frozen=True)
class Literal:
    """A literal of a script.

    Attributes
    ----------
    start, end : int
        Its place in the text, with its sign.
    line : int
        The line, from 1.
    text : str
        What is written.
    value : float
        Its value; of a word, its place among the words.
    kind : str
        "length", "count", "angle", "colour", "word" or "size".
    names : tuple of str
        Names around it, nearest first: of the argument, of what it is assigned to, of the function that is called.
    sign : int
        The place of the `+` or `-` before it that becomes the other when the number changes its sign; -1 without one.
    words : tuple of str
        The words that may stand here.
    is_fixed : bool
        Whether it keeps its value.
    """

    start: int
    end: int
    line: int
    text: str
    value: float
    kind: str
    names: tuple[str, ...] = ()
    sign: int = -1
    words: tuple[str, ...] = ()
    is_fixed: bool = False

    @property
    def key(self) -> str:
        """Its place in the text, as a key."""
        return str(self.start)

    @property
    def name(self) -> str:
        """The nearest name around it; empty without one."""
        return self.names[0] if self.names else ""

    @property
    def is_whole(self) -> bool:
        """Whether it is written as a whole number."""
        return bool(re.fullmatch(r"[-+]?\s*\d+", self.text))

    def width(self, size: float) -> float:
        """Return one standard deviation of its prior in a scene of a size."""
        if self.kind == "count":
            return max(1.0, 0.25 * abs(self.value))
        if self.kind == "angle":
            return math.radians(15.0) if "." in self.text and abs(self.value) <= 2.0 * math.pi else 15.0
        if self.kind == "colour":
            return 0.15 if abs(self.value) <= 1.0 else 38.0
        if self.kind == "size":
            return max(0.15 * abs(self.value), 0.01 * size)
        return max(0.25 * abs(self.value), 0.02 * size)


def literals(
    text: str,
    is_scad: bool = False,
    free: Collection[str | int] = (),
    fix: Collection[str | int] = (),
    words: Sequence[Collection[str]] = (),
) -> list[Literal]:
    """Return the literals of a text in their order.

    Parameters
    ----------
    text
        The script.
    is_scad
        Whether it is written in OpenSCAD's language; else it is Python.
    free, fix
        Names (of an argument, a variable or a called function) and lines whose literals may change, or stay.
    words
        Sets of names that may replace one another, such as `{"LEFT", "RIGHT"}`.

    Raises
    ------
    SyntaxError
        The text is not Python.
    """
    rows = list(_of_scad(text) if is_scad else _of_python(text, [tuple(entry) for entry in words]))
    out = []
    for row in sorted(rows, key=lambda row: row.start):
        about: set[str | int] = {*row.names, row.line}
        is_fixed = row.is_fixed or row.kind in FIXED
        out.append(replace(row, is_fixed=(is_fixed and not about & set(free)) or bool(about & set(fix))))
    return out


def kind_of(names: Sequence[str], called: str) -> str:
    """Return the kind of a number by the names around it."""
    first = [part for name in names[:1] for part in name.lower().strip("$").split("_")]
    if set(first) & COLOURS or called.lower() in COLOURS:
        return "colour"
    if set(first) & ANGLES or called.lower() in TURNING:
        return "angle"
    return "length"


def _of_python(text: str, words: list[tuple[str, ...]]) -> Iterator[Literal]:
    tree = ast.parse(text)
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)

    def place(line: int, column: int) -> int:
        # Columns of `ast` count bytes.
        return starts[line - 1] + len(lines[line - 1].encode()[:column].decode())

    counts = {
        node.id
        for outer in ast.walk(tree)
        if (isinstance(outer, ast.Call) and _called(outer) in COUNTING) or isinstance(outer, ast.Subscript)
        for inner in (outer.args if isinstance(outer, ast.Call) else [outer.slice])
        for node in ast.walk(inner)
        if isinstance(node, ast.Name)
    }

    def walk(node: ast.AST, names: tuple[str, ...], called: str, state: str, sign: int) -> Iterator[Literal]:
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
            if isinstance(node.operand, ast.Constant):
                yield from number(
                    node, node.operand, isinstance(node.op, ast.USub), names, called, state, sign
                )
                return
        if isinstance(node, ast.Constant):
            yield from number(node, node, False, names, called, state, sign)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            for entry in words:
                if node.id in entry:
                    start = place(node.lineno, node.col_offset)
                    value = float(entry.index(node.id))
                    yield Literal(
                        start, start + len(node.id), node.lineno, node.id, value, "word", names, -1, entry
                    )
        elif isinstance(node, ast.Call):
            inside = _called(node)
            yield from walk(node.func, names, called, state, -1)
            counting = "count" if inside in COUNTING else state
            for argument in node.args:
                yield from walk(argument, (inside, *names), inside, counting, -1)
            for keyword in node.keywords:
                about = (keyword.arg or "", inside, *names)
                sized = bool({*(keyword.arg or "").lower().split("_")} & SIZES)
                yield from walk(keyword.value, about, inside, "size" if sized else counting, -1)
        elif isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            about = tuple(name for target in targets for name in _names_of(target))
            for target in targets:
                yield from walk(target, names, called, state, -1)
            pairs = _paired(targets, node.value)
            for names_of_one, single in pairs:
                counted = (
                    "count" if set(names_of_one) & counts and isinstance(single, ast.Constant) else state
                )
                yield from walk(single, (*names_of_one, *names), "", counted, -1)
            if node.value is not None and not pairs:
                counted = "count" if set(about) & counts and isinstance(node.value, ast.Constant) else state
                yield from walk(node.value, (*about, *names), "", counted, -1)
        elif isinstance(node, ast.Subscript):
            yield from walk(node.value, names, called, state, -1)
            yield from walk(node.slice, names, called, "fixed", -1)
        elif isinstance(node, ast.Compare | ast.JoinedStr | ast.Import | ast.ImportFrom):
            return
        elif isinstance(node, ast.BinOp):
            yield from walk(node.left, names, called, state, -1)
            operator = -1
            if isinstance(node.op, ast.Add | ast.Sub):
                end = place(node.left.end_lineno or 1, node.left.end_col_offset or 0)
                begin = place(node.right.lineno, node.right.col_offset)
                operator = end + text[end:begin].find("+" if isinstance(node.op, ast.Add) else "-")
                operator = operator if text[operator] in "+-" and "#" not in text[end:begin] else -1
            yield from walk(node.right, names, called, state, operator)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            about = () if isinstance(node, ast.Lambda) else (node.name,)
            every = [*node.args.posonlyargs, *node.args.args]
            later = every[len(every) - len(node.args.defaults) :]
            for parameter, default in zip(later, node.args.defaults, strict=True):
                counted = "count" if parameter.arg in counts else state
                yield from walk(default, (parameter.arg, *about), "", counted, -1)
            for only, other in zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True):
                if other is not None:
                    yield from walk(other, (only.arg, *about), "", state, -1)
            for statement in node.body if isinstance(node.body, list) else [node.body]:
                yield from walk(statement, about, "", state, -1)
        elif isinstance(node, ast.Dict):
            for key, inner in zip(node.keys, node.values, strict=True):
                word = key.value if isinstance(key, ast.Constant) and isinstance(key.value, str) else ""
                yield from walk(inner, (word, *names) if word else names, called, state, -1)
        else:
            for child in ast.iter_child_nodes(node):
                yield from walk(child, names, called, state, -1)

    def number(
        node: ast.expr,
        inner: ast.Constant,
        minus: bool,
        names: tuple[str, ...],
        called: str,
        state: str,
        sign: int,
    ) -> Iterator[Literal]:
        if isinstance(inner.value, bool) or not isinstance(inner.value, int | float):
            return
        start = place(node.lineno, node.col_offset)
        end = place(node.end_lineno or 1, node.end_col_offset or 0)
        value = -float(inner.value) if minus else float(inner.value)
        if sign >= 0 and text[sign] == "-":
            value = -value
        is_whole = isinstance(inner.value, int)
        names = tuple(name for name in names if name)
        setting = bool(names) and bool({*names[0].lower().strip("$").split("_")} & SETTINGS)
        kind = state if state in ("count", "size") else kind_of(names, called)
        if kind == "count" and not is_whole:
            kind = "length"
        # A mean of two, and a number of turns.
        formula = (is_whole and node in factors) or (value == 2.0 and node in halves) or _is_turn(value)
        fixed = state == "fixed" or setting or formula or not math.isfinite(value)
        yield Literal(start, end, node.lineno, text[start:end], value, kind, names, sign, (), fixed)

    factors, halves = set[ast.AST](), set[ast.AST]()
    for outer in ast.walk(tree):
        if isinstance(outer, ast.BinOp):
            sides = {outer.left, outer.right}
            if isinstance(outer.op, ast.Div | ast.FloorDiv | ast.Mod | ast.Pow):
                factors |= sides
                halves.add(outer.right)
            elif isinstance(outer.op, ast.Mult):
                factors |= {
                    side for side in sides if isinstance(side, ast.Constant) and _is_formula(side.value)
                }
    yield from walk(tree, (), "", "", -1)


def _is_formula(value: object) -> bool:
    return isinstance(value, int) and value <= FORMULA


def _is_turn(value: float) -> bool:
    """Tell whether a number is half a turn, or a simple part of one, in radians, with three digits or more."""
    return any(abs(abs(value) - share * math.pi) < 4e-3 for share in (0.5, 1.0, 1.5, 2.0))


def _called(node: ast.Call) -> str:
    function = node.func
    return function.id if isinstance(function, ast.Name) else getattr(function, "attr", "")


def _paired(targets: Sequence[ast.AST], value: ast.AST | None) -> list[tuple[tuple[str, ...], ast.expr]]:
    """Return the names of each entry of `a, b = 1, 2`; nothing for another assignment."""
    if len(targets) != 1 or not isinstance(targets[0], ast.Tuple) or not isinstance(value, ast.Tuple):
        return []
    if len(targets[0].elts) != len(value.elts):
        return []
    return [(tuple(_names_of(name)), entry) for name, entry in zip(targets[0].elts, value.elts, strict=True)]


def _names_of(node: ast.AST) -> Iterator[str]:
    """Return the names of a target of an assignment: `a.b.c` is named `a.b.c`, `c`, `b` and `a`."""
    if isinstance(node, ast.Name):
        yield node.id
    elif isinstance(node, ast.Attribute):
        yield ast.unparse(node)
        yield node.attr
        yield from _names_of(node.value)
    elif isinstance(node, ast.Tuple | ast.List):
        for entry in node.elts:
            yield from _names_of(entry)
    elif isinstance(node, ast.Subscript):
        yield from _names_of(node.value)


def _of_scad(text: str) -> Iterator[Literal]:
    tokens = [(match.start(), match[0]) for match in _SCAD_TOKEN.finditer(text)]
    tokens = [(place, word) for place, word in tokens if not word.startswith(("//", "/*"))]
    #: Names of the brackets that are open: of the call, or empty.
    stack: list[str] = []
    assigned, argument = "", ""
    counted = set(re.findall(r"for\s*\([^)]*?\b([A-Za-z_]\w*)\s*(?:-\s*1)?\s*\]", text))
    for number, (start, word) in enumerate(tokens):
        before = tokens[number - 1][1] if number else ""
        after = tokens[number + 1][1] if number + 1 < len(tokens) else ""
        if word in "([{":
            named = before if word == "(" and re.match(r"\$?[A-Za-z_]", before) else ""
            stack.append(named or (stack[-1] if stack and word == "[" else ""))
        elif word in ")]}":
            if stack:
                stack.pop()
            if word != "]":
                argument = ""
            if word == "}":
                assigned = ""
        elif word == ";":
            assigned = argument = ""
        elif word == ",":
            argument = argument if _inside_list(tokens, number) else ""
        elif (
            re.match(r"\$?[A-Za-z_]", word)
            and after == "="
            and tokens[min(number + 2, len(tokens) - 1)][1] != "="
        ):
            if stack and stack[-1]:
                argument = word
            else:
                assigned = word
        elif re.match(r"\.?\d", word):
            called = stack[-1] if stack else ""
            names = tuple(name for name in (argument, assigned, called) if name)
            value, begin, sign = float(word), start, -1
            if before in "+-" and number > 1:
                earlier = tokens[number - 2][1]
                if earlier in "([{,=:?<>*/%!&|" or earlier == "=":
                    begin = tokens[number - 1][0]
                else:
                    sign = tokens[number - 1][0]
                value = -value if before == "-" else value
            kind = kind_of(names, called)
            fixed = False
            first = set(names[0].lower().strip("$").split("_")) if names else set[str]()
            if called == "for" or assigned in counted or called in ("len", "rands"):
                kind = "count"
            elif called in ("cube", "sphere", "cylinder", "square", "circle", "linear_extrude", "scale") or (
                argument and first & SIZES
            ):
                kind = "size"
            whole = re.fullmatch(r"\d+", word) is not None
            factor = before == "*" or after == "*"
            fixed = (
                bool(first & SETTINGS) or _is_turn(value) or (whole and (before in "/%^" or after in "/%^"))
            )
            fixed = fixed or (whole and factor and float(word) <= FORMULA)
            fixed = fixed or bool(stack and _is_index(tokens, number))
            end = start + len(word)
            line = text.count("\n", 0, start) + 1
            yield Literal(begin, end, line, text[begin:end], value, kind, names, sign, (), fixed)


def _inside_list(tokens: list[tuple[int, str]], number: int) -> bool:
    """Tell whether a comma stands in square brackets."""
    depth = 0
    for _, word in reversed(tokens[:number]):
        if word in ")]}":
            depth += 1
        elif word in "([{":
            if depth == 0:
                return word == "["
            depth -= 1
    return False


def _is_index(tokens: list[tuple[int, str]], number: int) -> bool:
    """Tell whether a number is the place of an entry: `points[2]`."""
    return (
        0 < number < len(tokens) - 1
        and tokens[number - 1][1] == "["
        and tokens[number + 1][1] == "]"
        and number > 1
        and re.match(r"[\w\])]", tokens[number - 2][1]) is not None
    )
