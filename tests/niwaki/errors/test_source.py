"""Claim: a function object is found in its file: decorated, nested, or among several lambdas on a line."""

from __future__ import annotations

import ast
import linecache

from niwaki.errors.source import find_function, span_of


def load(text: str) -> dict[str, object]:
    linecache.cache["found.py"] = (len(text), None, text.splitlines(True), "found.py")
    space: dict[str, object] = {"__name__": "found"}
    exec(compile(text, "found.py", "exec"), space)
    return space


def test_lambdas_on_one_line_are_distinguished() -> None:
    space = load("fs = [lambda x: x + 1, lambda y: y * 2, lambda: (lambda z: z)]\n")
    fs = space["fs"]
    assert isinstance(fs, list)
    for function, name in zip([fs[0], fs[1], fs[2]()], "xyz", strict=True):
        source = find_function(function)
        assert source is not None and isinstance(source[1], ast.Lambda)
        assert source[1].args.args[0].arg == name


def test_two_definitions_of_a_name() -> None:
    space = load("def f():\n    return 1\ng = f\n\ndef f():\n    return 2\n")
    for name, line in (("g", 1), ("f", 5)):
        source = find_function(space[name])  # type: ignore[arg-type]
        assert source is not None and source[1].lineno == line


def test_columns_count_characters() -> None:
    space = load('def f():\n    return "\u00e9\u00e9" + x\n')
    source = find_function(space["f"])  # type: ignore[arg-type]
    assert source is not None
    name = next(node for node in ast.walk(source[1]) if isinstance(node, ast.Name))
    assert str(span_of(name, source[0])) == "2:19-2:20"
    assert span_of(name, source[0]).text == "x"


def test_no_source() -> None:
    space: dict[str, object] = {}
    exec("def f(): return 1", space)
    assert find_function(space["f"]) is None  # type: ignore[arg-type]
