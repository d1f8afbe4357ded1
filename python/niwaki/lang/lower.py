"""Lowering of a model to core form: its function, every function that it can call, and their constants.

The pipeline: `source` finds the text, `scope` the owners of names, and `sites` the names of choices; `statements`,
`expressions`, `comprehensions` and `calls` make forms; `core` writes the text.
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
    """Lower a model's function, and every function that it can call, to core form.

    Parameters
    ----------
    function
        The Python function.
    lifts
        Whether real numbers of the source become constants of the table, with their places in `Core.lifted`.
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
    """Return the program of a model: its functions, their texts, and the meanings of their names."""
    program = Program()
    program.unit(function)
    lower_waiting(program)
    return program


def module_head(program: Program) -> list[Expr]:
    """Return the forms of a program's files and record classes."""
    # Python keeps undecodable bytes of a path as surrogates, which the engine's texts cannot have.
    paths = [os.fsencode(file.path).decode("utf-8", "replace") for file in program.files]
    head: list[Expr] = [Form("file", [str(n), literal(path)]) for n, path in enumerate(paths)]
    for number, record in enumerate(program.classes):
        fields = Form("", [literal(field) for field in record_fields(record)])
        kind = ["namedtuple"] if is_named_tuple(record) else []
        head.append(Form("class", [str(number), literal(record.__name__), fields, *kind]))
    return head


def lower_waiting(program: Program) -> list[Expr]:
    """Lower all waiting functions, and the functions that they call."""
    forms: list[Expr] = []
    while program.waiting:
        unit = program.waiting.pop(0)
        forms += [_function(program, unit, scope) for scope in functions(unit.scopes)]
    return forms


def _function(program: Program, unit: Unit, scope: Scope) -> Form:
    """Return the form `fn` of a function."""
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
