"""Lowering of `look(position, forward, up)` to a record of the directions that the operation `look` computes.

As a statement, it assigns a variable that no model can name, `$%look`. The engine shows a guide of later choices the
scene from this frame.
"""

from __future__ import annotations

import ast

from niwaki import words
from niwaki.lang.arguments import bind
from niwaki.lang.body import Body
from niwaki.lang.builtin_calls import lowers
from niwaki.lang.core import Expr, Form
from niwaki.lang.vocabulary import parameters_of


@lowers(words.look)
def look(body: Body, node: ast.Call) -> Expr:
    """Lower a call of `look` to a frame."""
    values = bind(body, node, node.args, node.keywords, parameters_of(words.look), "look")
    parts = body.kept(body.form("look", ["none" if value is None else value for value in values], node))
    fields = [Form("index", [parts, str(number)]) for number in range(3)]
    return body.form("record", [str(body.program.class_number(words.Frame)), *fields, "1.0"], node)
