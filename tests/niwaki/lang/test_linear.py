"""Claim: the work of compiling a model and of advising on it grows as the model does.

The work is counted, in calls of Python functions, for a program and for one four times as long: linear work is four
times as much, and quadratic work up to sixteen times. The threshold is six: `n log n` lies below it.
"""

from __future__ import annotations

import cProfile
import importlib.util
import pstats
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from niwaki.errors import InputError
from niwaki.lang.advice import advise
from niwaki.lang.models import Model


def functions(n: int) -> str:
    """Functions of one line, all called by the model."""
    functions_ = "".join(f"def f{i}(x):\n    return x + {i}\n" for i in range(n))
    return functions_ + _model("    x = gaussian(0, 1)\n" + "".join(f"    x = f{i}(x)\n" for i in range(n)))


def chain(n: int) -> str:
    """Functions of one line, each called by the next."""
    first = "def f0(x):\n    emit(box((x, 0, 0), (1, 1, 1)))\n    return gaussian(x, 1)\n"
    links = "".join(f"def f{i}(x):\n    return f{i - 1}(x)\n" for i in range(1, n))
    return first + links + _model(f"    x = f{n - 1}(0)\n")


def lines(n: int) -> str:
    """Assignments that nothing needs until the end."""
    return _model(
        "    x = 0\n"
        + "".join(f"    y{i} = x + gaussian(0, {i + 1})\n" for i in range(n))
        + "    factor(y0)\n"
    )


def decisions(n: int) -> str:
    """Branches on choices that build."""
    part = "    if flip():\n        emit(box((x, {}, 0), (1, 1, 1)))\n"
    return _model("    x = gaussian(0, 1)\n" + "".join(part.format(i) for i in range(n)))


def branches(n: int) -> str:
    """One `if` with many branches, each inside the one before."""
    arms = "".join(f"    elif x > -{i + 1}:\n        y = {i}\n" for i in range(n))
    return _model(f"    x = gaussian(0, 1)\n    if x > 0:\n        y = 0\n{arms}    else:\n        y = 1\n")


def lambdas(n: int) -> str:
    """Function values, each a lambda of its own line."""
    definitions = "".join(f"f{i} = lambda x: x + {i}\n" for i in range(n))
    return definitions + _model("    x = gaussian(0, 1)\n" + "".join(f"    x = f{i}(x)\n" for i in range(n)))


def _model(body: str) -> str:
    return f"@nw.model\ndef m():\n{body}    return x\n"


def loaded(folder: Path, source: str) -> Model[..., Any]:
    path = folder / f"long_{len(source)}.py"
    path.write_text("import niwaki as nw\nfrom niwaki.words import *\n" + source)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module
    spec.loader.exec_module(module)
    model: Model[..., Any] = module.m
    return model


def calls(work: Callable[[], object]) -> int:
    """How many calls of functions the work takes."""
    profile = cProfile.Profile()
    profile.runcall(work)
    return pstats.Stats(profile).total_calls  # type: ignore[attr-defined, no-any-return]


@pytest.mark.parametrize("program", [functions, chain, lines, decisions, branches, lambdas])
def test_compiling_and_advice_are_linear(tmp_path: Path, program: Callable[[int], str]) -> None:
    counted: list[tuple[int, int]] = []
    for n in (100, 400):
        model = loaded(tmp_path, program(n))
        counted.append((calls(model.core), calls(lambda model=model: advise(model.function))))  # type: ignore[misc]
    for small, large in zip(*counted, strict=True):
        assert large < 6 * small, counted


def test_the_error_about_a_large_function_has_the_limit(tmp_path: Path) -> None:
    model = loaded(tmp_path, lines(17_000))
    with pytest.raises(InputError, match=r"`m` is too large: it has more than 16384 values") as caught:
        model.program()
    assert caught.value.code == "machine-limit"
