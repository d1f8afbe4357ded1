"""Captures: a nested function needs what it reads and what the functions that it calls need."""

from __future__ import annotations

import ast

from niwaki.lang.scope import Scope, analyse


def scopes(text: str) -> dict[str, Scope]:
    node = ast.parse(text).body[0]
    assert isinstance(node, ast.FunctionDef)
    return {scope.name: scope for scope in analyse(node).of.values() if scope.is_function}


def needed(scope: Scope) -> list[str]:
    return sorted(variable.name for variable in scope.needed)


def test_a_function_needs_what_its_callees_need() -> None:
    found = scopes(
        "def m(a, b):\n    def f(x): return g(x) + a\n    def g(x): return f(x) + b\n    return f(1)\n"
    )
    assert needed(found["f"]) == needed(found["g"]) == ["a", "b"]
    assert needed(found["m"]) == []


def test_needs_pass_through_the_function_between() -> None:
    found = scopes(
        "def m(a):\n    def f(x):\n        def g(y): return y + x + a\n        return g(1)\n    return f(1)\n"
    )
    assert needed(found["g"]) == ["a", "x"]
    assert needed(found["f"]) == ["a"]


def test_the_variable_of_a_comprehension_is_its_own() -> None:
    node = ast.parse("def m(x):\n    return [x for x in range(x)]\n").body[0]
    assert isinstance(node, ast.FunctionDef)
    found = analyse(node)
    names = {variable.core for scope in found.of.values() for variable in scope.variables.values()}
    assert len(names) == 2 and "$x" in names


def test_one_definition_is_known_two_are_a_variable() -> None:
    found = scopes("def m(a):\n    def f(): return 1\n    return f()\n")
    assert set(found["m"].nested) == {"f"}
    found = scopes(
        "def m(a):\n    if a:\n        def f(): return 1\n    else:\n        def f(): return 2\n    return f()\n"
    )
    assert not found["m"].nested and "f" in found["m"].variables


def test_a_default_is_kept_in_a_variable() -> None:
    found = scopes("def m(a):\n    def f(x, y=a + 1, z=3): return x + y\n    return f(1)\n")
    assert needed(found["f"]) == ["y"]
