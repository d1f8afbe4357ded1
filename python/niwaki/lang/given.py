"""The keyword `label=` of choices, calls and `emit`, which names a site for people.

It is taken off a call before any pass reads the call, so that nothing else knows it: functions and words do not have
such a parameter. A function that does have a parameter `label` gets it as any other argument.
"""

from __future__ import annotations

import ast
from typing import Any
from weakref import WeakKeyDictionary

from niwaki.errors import ModelError
from niwaki.errors.source import SourceFile, span_of

#: The most characters of a label.
MOST = 100

#: Labels by the call. Syntax trees are kept with their file, so each label is taken off once.
_labels: WeakKeyDictionary[ast.Call, str] = WeakKeyDictionary()


def of(node: ast.AST) -> str:
    """Return the label that a call gives its site; empty without one."""
    return _labels.get(node, "") if isinstance(node, ast.Call) else ""


def take(node: ast.Call, file: SourceFile) -> None:
    """Take the label off a call.

    Raises
    ------
    ModelError
        The label is not a constant text of one line.
    """
    keyword = next((keyword for keyword in node.keywords if keyword.arg == "label"), None)
    if keyword is None:
        return
    value: Any = keyword.value.value if isinstance(keyword.value, ast.Constant) else ""
    if value is not None:
        is_line = isinstance(value, str) and value.strip() != "" and value.isprintable()
        if not is_line or len(value) > MOST:
            raise ModelError("label-text", span_of(keyword.value, file))
        _labels[node] = value.strip()
    node.keywords = [other for other in node.keywords if other is not keyword]
