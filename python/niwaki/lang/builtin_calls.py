"""Lowering of built-ins and words that take functions or generators, or are shorthands of simpler forms."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any, cast

from niwaki import words
from niwaki.lang import comprehensions, vocabulary
from niwaki.lang.arguments import bind, no_keywords
from niwaki.lang.body import Body
from niwaki.lang.callees import applied, nested, operate, user_function
from niwaki.lang.core import Expr, Form, literal
from niwaki.lang.expressions import closure, expression, expressions, keep_defaults, later, static
from niwaki.lang.marks import underlying
from niwaki.lang.names import MISSING, hashable
from niwaki.lang.scope import Scope
from niwaki.words.choices import words_of

TABLE: dict[Any, Callable[[Body, ast.Call], Expr]] = {}


def lowers(*functions: Any) -> Callable[[Callable[[Body, ast.Call], Expr]], Callable[[Body, ast.Call], Expr]]:
    """Register a function that lowers the calls of Python functions."""

    def register(lower: Callable[[Body, ast.Call], Expr]) -> Callable[[Body, ast.Call], Expr]:
        TABLE.update(dict.fromkeys(functions, lower))
        return lower

    return register


def iterable(body: Body, node: ast.expr) -> Expr:
    """Lower an argument; a generator becomes the list of its values."""
    return (
        comprehensions.collect(body, node) if isinstance(node, ast.GeneratorExp) else expression(body, node)
    )


def items_later(body: Body, node: ast.expr) -> Callable[[], Expr]:
    """Return a function that lowers an argument as `iterable` does."""
    return lambda: iterable(body, node)


def _operate(body: Body, node: ast.Call, name: str) -> Expr:
    return operate(body, node, vocabulary.OPERATIONS[getattr(builtins, name)])


def _generator(node: ast.Call) -> ast.GeneratorExp | None:
    first = node.args[0] if node.args else None
    return first if isinstance(first, ast.GeneratorExp) else None


def _keyword(node: ast.Call, name: str) -> ast.expr | None:
    return next((keyword.value for keyword in node.keywords if keyword.arg == name), None)


@lowers(any, all)
def decide(body: Body, node: ast.Call) -> Expr:
    """Lower `any` and `all`, which stop early on a generator and are operations on a list."""
    assert isinstance(node.func, (ast.Name, ast.Attribute))
    name = body.span(node.func).text.rpartition(".")[2]
    generator = _generator(node)
    if generator is None or len(node.args) != 1 or node.keywords:
        return _operate(body, node, name)
    return comprehensions.decide(body, generator, name == "any")


@lowers(sum, list, tuple, enumerate, reversed)
def over(body: Body, node: ast.Call) -> Expr:
    """Lower `sum(generator)`, `list(generator)`, ..., which work on the list of the generator's values."""
    generator = _generator(node)
    name = body.span(node.func).text.rpartition(".")[2]
    if generator is None:
        return _operate(body, node, name)
    start = [keyword.value for keyword in node.keywords if keyword.arg == "start"]
    if len(start) != len(node.keywords) or len(node.args) + len(start) > 2:
        return _operate(body, node, name)
    makers = [
        items_later(body, generator),
        *(later(body, arg) for arg in (*node.args[1:], *start)),
    ]
    values = body.in_order(makers)
    if name == "list":
        return values[0]
    head = {"tuple": "to_tuple"}.get(name, name)
    return body.form(head, values, node)


@lowers(zip)
def zip_(body: Body, node: ast.Call) -> Expr:
    """Lower `zip(xs, ys)`; the run checks `strict=True`."""
    strict = _keyword(node, "strict")
    if any(keyword.arg != "strict" for keyword in node.keywords):
        no_keywords(body, node, "zip")
    values = body.in_order([items_later(body, arg) for arg in node.args])
    if isinstance(strict, ast.Constant) and strict.value is True:
        return body.form("zip_strict", values, node)
    if strict is not None and not isinstance(strict, ast.Constant):
        body.refuse("unsupported-syntax", strict)
    return body.form("zip", values, node)


@lowers(dict)
def dict_(body: Body, node: ast.Call) -> Expr:
    """Lower `dict(a=1, b=2)`."""
    if node.args:
        body.refuse("dict-key", node.args[0])
    keys = Form("", [literal(keyword.arg) for keyword in node.keywords])
    return Form("dict", [keys, *expressions(body, [keyword.value for keyword in node.keywords])])


@lowers(map)
def map_(body: Body, node: ast.Call) -> Expr:
    """Lower `map(f, xs)` and `map(f, xs, ys)` to a list, made at once."""
    no_keywords(body, node, "map")
    if len(node.args) < 2:
        body.refuse(
            "wrong-number-of-arguments",
            node,
            name="map",
            expected="at least 2 arguments",
            found=str(len(node.args)),
        )
    function, items = function_and_items(body, node.args[0], node.args[1:])
    many = len(node.args) - 1

    def use(variable: str) -> Sequence[Expr]:
        if many == 1:
            return [function([variable], node)]
        return [function([Form("index", [variable, str(n)]) for n in range(many)], node)]

    return comprehensions.mapped(body, items, "map", node, use)


@lowers(filter)
def filter_(body: Body, node: ast.Call) -> Expr:
    """Lower `filter(f, xs)` to a list, made at once; `filter(None, xs)` keeps the values that are true."""
    no_keywords(body, node, "filter")
    if len(node.args) != 2:
        body.refuse(
            "wrong-number-of-arguments",
            node,
            name="filter",
            expected="2 arguments",
            found=str(len(node.args)),
        )
    test = node.args[0]
    if isinstance(test, ast.Constant) and test.value is None:
        items = iterable(body, node.args[1])
        function: Callable[[Sequence[Expr], ast.AST], Expr] = lambda args, _: args[0]  # noqa: E731
    else:
        function, items = function_and_items(body, test, node.args[1:])
    result = body.temporary()
    body.put(Form("set", [result, Form("list", [])]))

    def use(variable: str) -> Sequence[Expr]:
        keep = Form("set", [result, Form("append", [result, variable])])
        body.put(Form("if", [function([variable], node), Form("then", [keep]), Form("else", [])]))
        return []

    comprehensions.mapped(body, items, "filter", node, use)
    return result


@lowers(sorted)
def sorted_(body: Body, node: ast.Call) -> Expr:
    """Lower `sorted(xs, key=f, reverse=True)`; each key is computed once, in order."""
    if len(node.args) != 1:
        body.refuse(
            "wrong-number-of-arguments", node, name="sorted", expected="1 argument", found=str(len(node.args))
        )
    _only(body, node, ("key", "reverse"))
    key, reverse = _keyword(node, "key"), _keyword(node, "reverse")
    if key is None or (isinstance(key, ast.Constant) and key.value is None):
        makers = [items_later(body, node.args[0])]
        if reverse is not None:
            makers.append(later(body, reverse))
        return body.form("sorted", body.in_order(makers), node)
    items, function, flag = _with_key(body, node, key, reverse)
    keys = comprehensions.mapped(body, items, "sorted", node, lambda variable: [function([variable], node)])
    return body.form("sorted_by", [items, keys, *([flag] if flag is not None else [])], node)


@lowers(min, max)
def extreme(body: Body, node: ast.Call) -> Expr:
    """Lower `min(xs)`, `min(a, b)`, `min(xs, key=f)`, `min(xs, default=d)`, and `max`."""
    name = body.span(node.func).text.rpartition(".")[2]
    _only(body, node, ("key", "default"))
    key, default = _keyword(node, "key"), _keyword(node, "default")
    if not node.args or (default is not None and len(node.args) != 1):
        body.refuse(
            "wrong-number-of-arguments", node, name=name, expected="1 argument", found=str(len(node.args))
        )
    if key is None and default is None:
        return body.form(name, body.in_order([items_later(body, arg) for arg in node.args]), node)
    single = len(node.args) == 1
    items: Expr
    other: Expr | None = None
    if key is None:
        assert default is not None
        items, other = body.in_order([items_later(body, node.args[0]), later(body, default)])
        items = body.kept(items)
        best: Expr = body.form(name, [items], node)
    else:
        whole = node.args[0] if single else ast.copy_location(ast.List(list(node.args), ast.Load()), node)
        items, function, other = _with_key(body, node, key, default, whole)
        keys = comprehensions.mapped(body, items, name, node, lambda variable: [function([variable], node)])
        best = body.form("argmin_by" if name == "min" else "argmax_by", [items, keys], node)
    if other is None:
        return best
    empty = Form("eq", [Form("len", [items]), "0"])
    return Form("cond", [empty, other, best], body.span(node))


def _only(body: Body, node: ast.Call, names: Sequence[str]) -> None:
    for keyword in node.keywords:
        if keyword.arg not in names:
            name = body.span(node.func).text
            hint = f"its keywords are {', '.join(names)}"
            body.refuse("unknown-keyword", keyword, name=name, keyword=keyword.arg, suggestion=hint)


Caller = Callable[[Sequence[Expr], ast.AST], Expr]


def _with_key(
    body: Body, node: ast.Call, key: ast.expr, extra: ast.expr | None, whole: ast.expr | None = None
) -> tuple[Expr, Caller, Expr | None]:
    """Return the items and an extra keyword's value as atoms, with the caller of the key function between them."""
    items = body.kept(iterable(body, node.args[0] if whole is None else whole))
    function = caller(body, key)
    return items, function, body.kept(expression(body, extra)) if extra is not None else None


def function_and_items(body: Body, function: ast.expr, nodes: Sequence[ast.expr]) -> tuple[Caller, Expr]:
    """Return the caller of `function`, and its items; several lists become their `zip`."""
    call = caller(body, function)
    values = body.in_order([items_later(body, node) for node in nodes])
    return call, values[0] if len(values) == 1 else Form("zip", values)


def caller(body: Body, node: ast.expr) -> Caller:
    """Return the caller of a function argument that is used at once: direct if it is known, else by value."""
    scope = body.scopes.of.get(node) if isinstance(node, ast.Lambda) else None
    if isinstance(node, ast.Name):
        meaning = body.scopes.find(node.id, body.scope)
        scope = meaning if isinstance(meaning, Scope) else None
    if scope is not None:
        if isinstance(node, ast.Lambda):
            keep_defaults(body, scope)
        kept = closure(body, scope, node, immediate=True)
        if len(scope.parameters) == 1 and not scope.defaults:
            name, captures = literal(body.unit.names[scope]), [needed.core for needed in scope.needed]
            return lambda args, at: _named(body, "call", [name, *args, *captures], at)
        return lambda args, at: _named(body, "apply", [kept, *args], at)
    value = underlying(static(body, node))
    operation = vocabulary.OPERATIONS.get(value) if value is not MISSING and hashable(value) else None
    if operation is not None:
        head = operation.head
        return lambda args, at: Form(head, list(args), body.span(at))
    function = body.kept(expression(body, node))
    return lambda args, at: _named(body, "apply", [function, *args], at)


def _named(body: Body, head: str, args: Sequence[Expr], node: ast.AST) -> Form:
    form = body.form(head, args, None)
    form.span, form.component = body.span(node), body.unit.components.get((node, "call"), "")
    return form


@lowers(words.choose)
def choose(body: Body, node: ast.Call) -> Expr:
    """Lower `choose(values, weights)` to the draw of an index; the site has the options if they may be words."""
    options = node.args[0] if node.args else _keyword(node, "values")
    if len(node.args) > 1 and (len(node.args) > 2 or isinstance(node.args[1], ast.Constant)):
        written = ", ".join(body.span(arg).text for arg in node.args)
        body.refuse("options-as-arguments", node, cure=f"choose([{written}])")
    table = _table(body, options) if options is not None else None
    weights: Expr | None
    if table is not None and len(node.args) + len(node.keywords) == 1:
        values, weights = table
    elif table is not None and (len(node.args) == 2 or _keyword(node, "weights") is not None):
        body.refuse("argument-twice", node, name="choose", keyword="weights")
    else:
        parameters = vocabulary.parameters_of(words.choose)
        bound, weights = bind(body, node, node.args, node.keywords, parameters, "choose")
        assert bound is not None
        values = bound
    assert options is not None
    if not isinstance(options, ast.List | ast.Tuple | ast.Dict) and static(body, options) is MISSING:
        values = Form("options", [values], body.span(node))
    values = body.kept(values)
    if weights is None:
        last = Form("sub", [Form("len", [values]), "1"])
        dist = Form("dist", ["discrete_uniform", "0", last], body.span(node))
    else:
        dist = Form("dist", ["categorical", weights], body.span(node))
    drawn = body.form("sample", [dist, values] if _may_be_words(body, options) else [dist], node)
    return body.form("index", [values, drawn], None)


def _table(body: Body, node: ast.expr) -> tuple[Expr, Expr] | None:
    """Return the keys and the values of a dict of weights as lists, if it is a display or a constant of the module."""
    known = static(body, node)
    if isinstance(known, dict):
        place, text = body.span(node), body.span(node).text
        return (
            body.program.constant(list(known), place, text),
            body.program.constant(list(known.values()), place, text),
        )
    if not isinstance(node, ast.Dict):
        return None
    keys, *weights = cast("list[Any]", cast("Form", expression(body, node)).args)
    weight_of = dict(zip(keys.args, weights, strict=True))
    return Form("list", [*weight_of]), Form("list", [*weight_of.values()])


def _may_be_words(body: Body, options: ast.expr) -> bool:
    """Return whether the options of a choice can be strings: only the run knows the values of variables."""
    if isinstance(options, ast.List | ast.Tuple):
        return all(not isinstance(part, ast.Constant) or isinstance(part.value, str) for part in options.elts)
    if isinstance(options, ast.Dict):
        return True
    known = static(body, options)
    return known is MISSING or words_of([*known] if isinstance(known, dict) else known) is not None


@lowers(words.future)
def future(body: Body, node: ast.Call) -> Expr:
    """Lower `future(f, *args)`, directly if `f` is known."""
    _at_least(body, node, "future", 1, "at least 1 argument")
    return _directly(body, node, ("future", "future_apply"), node.args[0], node.args[1:])


@lowers(words.place)
def place(body: Body, node: ast.Call) -> Expr:
    """Lower `place(frame, f, *args)`: a call with the frame beside it."""
    _at_least(body, node, "place", 2, "a frame and a function")
    frame = body.kept(expression(body, node.args[0]))
    called = _directly(body, node, ("call", "apply"), node.args[1], node.args[2:])
    return Form("place", [frame, called], body.span(node))


@lowers(words.mirrored)
def mirrored(body: Body, node: ast.Call) -> Expr:
    """Lower `mirrored(axis, f, *args)`: a loop over no frame and a reflection."""
    _at_least(body, node, "mirrored", 2, "an axis and a function")
    reflection = body.form("reflection", [expression(body, node.args[0])], node)
    return _in_each(body, node, "mirrored", Form("tuple", ["none", reflection]))


@lowers(words.arrayed)
def arrayed(body: Body, node: ast.Call) -> Expr:
    """Lower `arrayed(frames, f, *args)`: a loop over the frames."""
    _at_least(body, node, "arrayed", 2, "a list of frames and a function")
    return _in_each(body, node, "arrayed", iterable(body, node.args[0]))


def _in_each(body: Body, node: ast.Call, word: str, frames: Expr) -> Expr:
    """Call a function in each frame; its arguments are computed once."""
    frames = body.kept(frames)
    _no_word(body, node.args[1], node.args[2:])
    call = caller(body, node.args[1])
    args = [body.kept(value) for value in expressions(body, node.args[2:])]

    def use(variable: str) -> Sequence[Expr]:
        called = call(args, node)
        if not isinstance(called, Form) or called.head not in ("call", "apply"):
            return [called]  # A word that computes emits nothing.
        return [Form("place", [variable, called], body.span(node))]

    return comprehensions.mapped(body, frames, word, node, use)


def _at_least(body: Body, node: ast.Call, name: str, count: int, expected: str) -> None:
    """Refuse keywords, and a call with too few arguments."""
    if len(node.args) < count:
        count_text = str(len(node.args))
        body.refuse("wrong-number-of-arguments", node, name=name, expected=expected, found=count_text)
    no_keywords(body, node, name)


def _no_word(body: Body, function: ast.expr, args: Sequence[ast.expr]) -> None:
    """Refuse a word that is a site of its own as the function, and show the lambda that calls it."""
    value = underlying(static(body, function))
    if hashable(value) and value in vocabulary.ALL_WORDS and value not in vocabulary.OPERATIONS:
        name = body.span(function).text
        inner = ", ".join(body.span(arg).text for arg in args)
        body.refuse("word-as-value", function, name=name, cure=f"lambda: {name}({inner})")


def _directly(
    body: Body, node: ast.Call, heads: tuple[str, str], function: ast.expr, args: Sequence[ast.expr]
) -> Expr:
    """Lower the call of a function argument, by the first head if the function is known, else as a value."""
    known, value_head = heads
    _no_word(body, function, args)
    if isinstance(function, ast.Lambda):
        keep_defaults(body, body.scopes.of[function])
        return nested(body, node, body.scopes.of[function], known, args, [])
    if isinstance(function, ast.Name):
        meaning = body.scopes.find(function.id, body.scope)
        if isinstance(meaning, Scope):
            return nested(body, node, meaning, known, args, [])
    value = underlying(static(body, function))
    if isinstance(value, FunctionType) and value not in vocabulary.ALL_WORDS:
        return user_function(body, node, value, known, args, [])
    return applied(body, node, value_head, function, args)
