"""A model to core form: its function, every function it can call, and the constants they read.

The pipeline: `source` finds the text, `scope` the owners of names, `sites` the names of choices; `statements`,
`expressions`, `comprehensions` and `calls` write forms; `core` prints them.
"""

from __future__ import annotations

import ast
import os
from types import FunctionType

from niwaki.errors.source import head_span
from niwaki.lang import calls, comprehensions, looking  # noqa: F401  (they register themselves)
from niwaki.lang.body import Body
from niwaki.lang.callees import live_defaults
from niwaki.lang.core import Core, Expr, Form, literal, write_tree
from niwaki.lang.deep import deep
from niwaki.lang.expressions import expression
from niwaki.lang.names import is_named_tuple, record_fields
from niwaki.lang.program import Program, Unit, check_signature
from niwaki.lang.scope import Scope, Variable, functions
from niwaki.lang.statements import statement


@deep
def lower(function: FunctionType, lifts: bool = False) -> Core:
    """The core form of a model's function and of everything it can call.

    Parameters
    ----------
    function
        The Python function.
    lifts
        Whether each real number of the source is a constant of the table, with its place in `Core.lifted`.
    """
    program = Program(lifts)
    entry = program.unit(function)
    forms = lower_waiting(program)
    form = Form("module", [*module_head(program), *forms, Form("entry", [literal(entry.name)])])
    parameters = entry.scopes.root.parameters
    defaults = len(function.__defaults__ or ()) + len(function.__kwdefaults__ or {})
    return Core(
        write_tree(form, 0, True, True) + "\n",
        program.constants,
        program.classes,
        program.files,
        entry.name,
        tuple(parameters),
        len(parameters) - defaults,
        form,
        program.lifted or {},
    )


@deep
def lowered(function: FunctionType) -> Program:
    """What lowering a model finds out: its functions, their texts, what their names mean."""
    program = Program()
    program.unit(function)
    lower_waiting(program)
    return program


def module_head(program: Program) -> list[Expr]:
    """The files and the record classes of a program."""
    # A name that is not in the encoding of file names has halves of characters in Python, and the engine none.
    paths = [os.fsencode(file.path).decode("utf-8", "replace") for file in program.files]
    head: list[Expr] = [Form("file", [str(n), literal(path)]) for n, path in enumerate(paths)]
    for number, record in enumerate(program.classes):
        fields = Form("", [literal(field) for field in record_fields(record)])
        kind = ["namedtuple"] if is_named_tuple(record) else []
        head.append(Form("class", [str(number), literal(record.__name__), fields, *kind]))
    return head


def lower_waiting(program: Program) -> list[Expr]:
    """Every function that waits, and those that they call."""
    forms: list[Expr] = []
    while program.waiting:
        unit = program.waiting.pop(0)
        forms += [_function(program, unit, scope) for scope in functions(unit.scopes)]
    return forms


def _function(program: Program, unit: Unit, scope: Scope) -> Form:
    """One `fn`."""
    node = scope.node
    assert isinstance(node, (ast.FunctionDef, ast.Lambda))
    check_signature(unit.file, node)
    body = Body(program, unit, scope)
    if isinstance(node, ast.Lambda):
        block, value = body.within(lambda: expression(body, node.body))
        body.block = [*block, body.form("return", [value], node.body)]
    else:
        for part in node.body:
            statement(body, part)
    head: list[Expr] = [
        literal(unit.names[scope]),
        Form("file", [str(program.file_number(unit.file))]),
        Form("params", [scope.variables[name].core for name in scope.parameters]),
        Form("defaults", _defaults(body, unit, scope)),
        Form("captures", [needed.core for needed in scope.needed]),
    ]
    return Form("fn", [*head, *body.block], head_span(node, unit.file))


def _defaults(body: Body, unit: Unit, scope: Scope) -> list[Expr]:
    if scope is unit.scopes.root:
        return [
            atom for _, atom in sorted(live_defaults(body.program, unit).items(), key=lambda pair: pair[0])
        ]
    return [
        default.core if isinstance(default, Variable) else expression(body, default)
        for default in scope.defaults.values()
    ]
