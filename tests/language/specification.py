"""Reads the specification: Markdown with programs that run.

A fenced block that starts with ```python is a program; it defines a model `m`. The blocks after it state the result:

    ```value         m() with seed 1, or with the choices of a ```choices block before it, gives this
    ```choices       a dict of choices by address, given to the run
    ```made          the addresses of the choices that the run makes, one to a line
    ```scene         the addresses of its primitives, one to a line
    ```score         the log score, to 9 digits
    ```error         compiling it is refused with exactly this message
    ```fault         running it fails with exactly this message
"""

from __future__ import annotations

import linecache
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

PRELUDE = "import math, random; from niwaki import host, model; from niwaki.words import *\n"
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@dataclass
class Case:
    """A program and its expectations."""

    name: str
    program: str
    expected: dict[str, str] = field(default_factory=dict)


def cases(path: Path) -> Iterator[Case]:
    """The programs of a file."""
    text = path.read_text()
    programs: list[Case] = []
    for match in FENCE.finditer(text):
        kind, body = match.groups()
        if kind == "python":
            line = text.count("\n", 0, match.start()) + 1
            programs.append(Case(f"{path.stem}:{line}", body))
        elif programs:
            programs[-1].expected[kind] = body
    yield from programs


def load(program: str, name: str) -> Any:
    """The model `m` of a program. The prelude is on the line before the first, so that lines count from 1."""
    text = program if program.startswith("from __future__") else program
    linecache.cache[name] = (len(text), None, text.splitlines(True), name)
    space: dict[str, Any] = {"__name__": "specification"}
    exec(PRELUDE, space)
    exec(compile(text, name, "exec"), space)
    return space["m"]
