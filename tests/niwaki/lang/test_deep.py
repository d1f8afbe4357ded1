"""Claim: long sums, chains of `elif` and the like run; code that is nested too deeply has an error with its place."""

from __future__ import annotations

import linecache
import os
import subprocess
import sys
import threading
from pathlib import Path
from typing import Any

import niwaki as nw
import pytest
from niwaki import kernels
from niwaki.errors import ModelError, NiwakiError
from niwaki.lang.advice import advise
from niwaki.lang.deep import MOST
from niwaki.lang.plain import run_python

MANY = 900


def elifs(count: int) -> str:
    arms = "".join(f"    elif n == {k}:\n        x = {k}.5\n" for k in range(count))
    return f"    if n == -1:\n        x = 0.5\n{arms}    return x\n"


LONG = {
    "sum": f"    return {' + '.join(['x'] * 250)}\n",
    "longer sum": f"    return {' + '.join(['x'] * MANY)}\n",
    "elif": elifs(300),
    "and": f"    return {' and '.join(['x < 9'] * 1000)}\n",
    "or": f"    return {' or '.join(['x > 9'] * 1000)}\n",
    "conditions with statements": f"    return {' and '.join(['all(v < 9 for v in [x])'] * 1000)}\n",
    "comparisons": f"    return {' < '.join(f'x + {k}' for k in range(1000))}\n",
    "statements": "".join(f"    x = x + {k}\n" for k in range(2000)) + "    return x\n",
    "choices": "".join(f"    x = gaussian(x, {k})\n" for k in range(1, 1000)) + "    return x\n",
    "not": f"    return {'not ' * MANY}x\n",
    "conditional": f"    return {'1 if x > 9 else ' * MANY}2\n",
    "methods": f"    return 'a'{'.upper()' * 400}\n",
    "slices": f"    return [1]{'[:]' * MANY}\n",
    "list": f"    return [{', '.join(['x'] * 5000)}]\n",
    "lists in lists": f"    return {'[' * 190}x{']' * 190}\n",
    "calls in calls": f"    return {'abs(' * 190}x{')' * 190}\n",
}

DEEP = {
    "sum": f"    return {' + '.join(['x'] * 2000)}\n",
    "elif": elifs(1500),
    "not": f"    return {'not ' * 2000}x\n",
    "methods": f"    return 'a'{'.upper()' * 700}\n",
}


def model(body: str) -> Any:
    text = (
        f"from niwaki import model\nfrom niwaki.words import *\n\n@model\ndef m():\n    x, n = 1.5, 7\n{body}"
    )
    name = f"deep-{hash(text)}.py"
    linecache.cache[name] = (len(text), None, text.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "made"}
    exec(compile(text, name, "exec"), space)
    return space["m"]


@pytest.mark.parametrize("name", LONG)
def test_long_code_runs(name: str) -> None:
    long_model = model(LONG[name])
    here = run_python(long_model, seed=1)
    there = nw.run(long_model, choices=here.choices).best
    assert here.value == there.value
    assert advise(long_model.function) == []


@pytest.mark.parametrize("name", DEEP)
def test_deep_code_has_an_error_with_its_place(name: str) -> None:
    deep_model = model(DEEP[name])
    for use in (
        deep_model.core,
        lambda: run_python(deep_model, seed=1),
        lambda: nw.run(deep_model),
        lambda: advise(deep_model.function),
    ):
        with pytest.raises(ModelError, match="nested too deeply") as caught:
            use()
        assert "^" in str(caught.value)


def test_the_recursion_limit_stays() -> None:
    before = sys.getrecursionlimit()
    wrong = []

    def use() -> None:
        for name in ("sum", "elif"):
            try:
                model(LONG[name]).core()
            except NiwakiError as error:
                wrong.append(error)

    threads = [threading.Thread(target=use) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong and sys.getrecursionlimit() == before and before < MOST + 1000


@pytest.mark.parametrize(
    "text", [f"    return {' + '.join(['x'] * 9000)}\n", f"    return {'(' * 250}x{')' * 250}\n"]
)
def test_the_shell_reports_code_that_python_cannot_read(text: str, tmp_path: Path) -> None:
    file = tmp_path / "deep.py"
    file.write_text(f"from niwaki import model\n\n@model\ndef m():\n    x = 1\n{text}")
    command = [sys.executable, "-c", "from niwaki.shell.main import main; main()", "check", f"{file}:m"]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ, check=False)
    assert done.returncode != 0 and "Traceback" not in done.stderr and "error" in done.stderr
    assert len(done.stderr) < 5000


@pytest.mark.parametrize(
    "text", ["-" * 9000 + "1", "+".join("1" * 30_000), "f" + ".a" * 3000, "cycle(" * 900]
)
def test_a_deep_kernel_has_an_error(text: str) -> None:
    with pytest.raises(NiwakiError, match="nested") as caught:
        kernels.parse(text)
    assert caught.value.code == "unreadable-kernel"
