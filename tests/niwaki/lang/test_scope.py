"""Claim: a nested function captures the variables that it reads, and the variables that its callees need."""

from __future__ import annotations

import ast

from niwaki.lang.scope import Scope, analyse


def scopes(text: str) -> dict[str, Scope]:
    node = ast.parse(text).body[0]
    assert isinstance(node, ast.FunctionDef)
    return {scope.name: scope for scope in analyse(node).of.values() if scope.is_function}


def needed(scope: Scope) -> list[str]:
    return sorted(variable.name for variable in scope.needed)


def test_a_function_needs_the_variables_of_its_callees() -> None:
    scope = scopes(
        "def m(a, b):\n    def f(x): return g(x) + a\n    def g(x): return f(x) + b\n    return f(1)\n"
    )
    assert needed(scope["f"]) == needed(scope["g"]) == ["a", "b"]
    assert needed(scope["m"]) == []


def test_needed_variables_pass_through_the_function_between() -> None:
    scope = scopes(
        "def m(a):\n    def f(x):\n        def g(y): return y + x + a\n        return g(1)\n    return f(1)\n"
    )
    assert needed(scope["g"]) == ["a", "x"]
    assert needed(scope["f"]) == ["a"]


def test_the_variable_of_a_comprehension_is_its_own() -> None:
    node = ast.parse("def m(x):\n    return [x for x in range(x)]\n").body[0]
    assert isinstance(node, ast.FunctionDef)
    analysis = analyse(node)
    names = {variable.core for scope in analysis.of.values() for variable in scope.variables.values()}
    assert len(names) == 2 and "$x" in names


def test_a_single_definition_is_nested_and_two_are_a_variable() -> None:
    scope = scopes("def m(a):\n    def f(): return 1\n    return f()\n")
    assert set(scope["m"].nested) == {"f"}
    scope = scopes(
        "def m(a):\n    if a:\n        def f(): return 1\n    else:\n        def f(): return 2\n    return f()\n"
    )
    assert not scope["m"].nested and "f" in scope["m"].variables


def test_a_default_is_kept_in_a_variable() -> None:
    scope = scopes("def m(a):\n    def f(x, y=a + 1, z=3): return x + y\n    return f(1)\n")
    assert needed(scope["f"]) == ["y"]
