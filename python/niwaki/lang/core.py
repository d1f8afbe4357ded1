"""The core form, the text that crosses from Python to the engine, and its writer.

Grammar (each `(HEAD ...)` may carry a span atom right after its head, `@L:C-L:C`, from 1, end excluded)

    module  := (module const* file* class* fn* (entry "NAME"))
    const   := (const K E)                            only in standalone text: constant K
    file    := (file K "path")                        K numbers the files
    class   := (class K "Name" ("field" ...) KIND?)    K numbers the record classes; KIND `namedtuple`, else a dataclass
    fn      := (fn "NAME" (file K) (params $v ...) (defaults D ...) (captures $v ...) STMT ...)
    D       := ATOM | E made of closure, dist, record, list, tuple, dict and D alone
    STMT    := (set $v E) | (unpack ($v ...) E) | (unpack_star ($v ...) $v ($v ...) E)
             | (if E (then STMT ...) (else STMT ...)) | (for $v E (body STMT ...)) | (while E (body STMT ...))
             | (break) | (continue) | (return E) | (do E) | (assert E E)
    E       := ATOM | $v | (data K) | (and E E+) | (or E E+) | (cond C A B)
             | (call "NAME" E ...) | (closure "NAME" E ...) | (apply E E ...)
             | (sample E OPTIONS?) | (observe E E) | (factor E) | (condition E) | (query E E) | (emit E ...) | (force E)
             | (future "NAME" E ...) | (future_apply E E ...) | (mem E) | (mem E "NAME")
             | (dist FAMILY E ...) | (host K E ...) | (record K E ...) | (field E "name")
             | (list E ...) | (tuple E ...) | (dict (KEY ...) E ...) | (fstr PART ...) | (method E "name" E ...)
             | (OP E ...)
    OPTIONS := E                                      the list of which the choice draws a place
    PART    := STRING | (format E "spec" "conversion")
    ATOM    := integer | float | inf | -inf | nan | true | false | none | JSON string | (data K) | $v (a capture)
    (data K) and (host K) refer to the table of constants that is passed with the text (`Core.constants`).

Variables. `$name` is a variable of the user. `$name%N` is a variable that the front end created, or a second variable
of the same name; its readable name is the part before the `%`, and may be empty: `$%N`. Numbers are unique within a
top-level function and the functions nested in it. The statement `look(...)` assigns `$%look`, the frame from which the
choices after it are seen.

Functions. NAME is the qualified name: `ship`, nested `ship.wing`, a lambda `ship.lambda`, a second function of the same
name `ship.#2.lambda`. The part after the last dot is the short name.

Captures. A nested function that only a single `def` binds is called directly, by `(call "f" ARGUMENT ... CAPTURE ...)`
or `(future "f" ARGUMENT ... CAPTURE ...)`, with the captured values in the order of `captures`. So `call` and `future`
always have as many arguments as the function has params and captures together. A function that is used as a value is
`(closure "f" CAPTURE ...)`, made again at each use. So nested functions may call themselves and one another in any
order, and no closure contains itself.

Memoised functions. `(mem E)` makes a new memoised function at each activation that reaches it. `(mem E "NAME")` is the
memoised function of a module, the same wherever it is written. Both are called by `apply`.

Order. Arguments are in the order of evaluation. The front end puts keywords that are written in another order into
temporaries.

Sites. The readable address of a choice is a path of components joined by "/". The static component of a site is the
atom `#component` after the span, see `niwaki.lang.sites`: on `sample`, `observe`, `factor`, `condition`, `query`,
`emit`, `mem`, `call`, `apply`, `future`, `future_apply`, `for` and `while` (with empty brackets, `#i[]`, `#i[]#1`).
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from niwaki.errors.source import SourceFile, Span


@dataclass
class Form:
    """A form `(HEAD @SPAN #COMPONENT args...)`; its arguments are forms or atoms."""

    head: str
    args: list[Expr]
    span: Span | None = None
    component: str = ""


Expr = Form | str

#: The variable of a statement `look(...)`, see `niwaki.lang.looking`.
LOOK = "$%look"

TREES = frozenset({"fn", "if", "for", "while", "then", "else", "body", "module"})


def literal(value: Any) -> str:
    """Return a number, truth value, None or string as an atom."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(int(value))
    if isinstance(value, float):
        if math.isnan(value):
            return "nan"
        if math.isinf(value):
            return "inf" if value > 0 else "-inf"
        return repr(float(value))
    return json.dumps(value)


def is_literal(value: Any) -> bool:
    """Return whether `literal` can write a value."""
    return value is None or type(value) in (bool, int, float, str)


def write(form: Expr, spans: bool = True, components: bool = True) -> str:
    """Write an expression on one line."""
    if isinstance(form, str):
        return form
    head = [form.head] if form.head else []
    parts = [*head, *_marks(form, spans, components), *[write(arg, spans, components) for arg in form.args]]
    return f"({' '.join(parts)})"


def _marks(form: Form, spans: bool, components: bool) -> list[str]:
    marks = [f"@{form.span}"] if spans and form.span is not None else []
    return [*marks, f"#{form.component}"] if components and form.component else marks


def write_tree(form: Expr, indent: int = 0, spans: bool = True, components: bool = True) -> str:
    """Write each statement on a line, with indented bodies."""
    lines: list[str] = []
    _put(lines, form, indent, spans, components)
    return "\n".join(lines)


def _put(lines: list[str], form: Expr, indent: int, spans: bool, components: bool) -> None:
    """Append the lines of a tree, each written once, however deep the tree is."""
    pad = "  " * indent
    if isinstance(form, str) or form.head not in TREES:
        lines.append(pad + write(form, spans, components))
        return
    head = [form.head, *_marks(form, spans, components)]
    split = 0
    if form.head in ("fn", "if", "for", "while"):
        split = next((n for n, arg in enumerate(form.args) if _breaks(form.head, arg)), len(form.args))
    lines.append(pad + "(" + " ".join(head + [write(arg, spans, components) for arg in form.args[:split]]))
    for arg in form.args[split:]:
        _put(lines, arg, indent + 1, spans, components)
    lines[-1] += ")"


def _breaks(head: str, arg: Expr) -> bool:
    inline = ("file", "params", "defaults", "captures")
    if head == "fn":
        return isinstance(arg, Form) and arg.head not in inline
    return isinstance(arg, Form) and arg.head in ("then", "else", "body")


@dataclass(frozen=True)
class Core:
    """A lowered model: its text, and the data that travel with it.

    Attributes
    ----------
    text : str
        The core form.
    constants : list
        The objects of `(data K)` and `(host K)`; K is the index.
    classes : list
        The classes of `(record K ...)`.
    files : list of SourceFile
        The files of `(file K)`.
    entry : str
        The model's qualified name.
    parameters : tuple of str
        The model's parameters.
    required : int
        The number of parameters without a default.
    lifted : mapping
        The places in the source of numbers that are constants of the table, by index.
    """

    text: str
    constants: Sequence[Any]
    classes: Sequence[type]
    files: Sequence[SourceFile]
    entry: str
    parameters: tuple[str, ...] = ()
    required: int = 0
    form: Form = field(default_factory=lambda: Form("module", []), repr=False)
    lifted: Mapping[int, Span] = field(default_factory=dict, repr=False)

    def write(self, spans: bool = True, components: bool = True) -> str:
        """Write the text again, with or without spans and the sites' components of addresses."""
        return write_tree(self.form, 0, spans, components) + "\n"

    def standalone(self) -> str:
        """Write the text with its constants, `(const K E)`, for bug reports and for tests without Python.

        Host functions, arrays of NumPy and shapes cannot be written, and are left out.
        """
        written = ((number, constant_form(value)) for number, value in enumerate(self.constants))
        items: list[Expr] = [Form("const", [str(n), form]) for n, form in written if form is not None]
        return write_tree(Form("module", [*items, *self.form.args])) + "\n"


def constant_form(value: Any) -> Expr | None:
    """Return plain data as an expression, or None if a part cannot be written."""
    if is_literal(value):
        return literal(value)
    if type(value) in (list, tuple):
        parts = [constant_form(part) for part in value]
        forms: list[Expr] = [part for part in parts if part is not None]
        return Form(type(value).__name__, forms) if len(forms) == len(parts) else None
    if type(value) is dict:
        values = constant_form(list(value.values()))
        if isinstance(values, Form):
            return Form("dict", [Form("", [literal(key) for key in value]), *values.args])
    return None
