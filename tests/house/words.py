"""Writes what follows from the engine's table of solids: `python tests/house/words.py`; a test compares it.

The words for shapes in Python with their docstrings, their signatures in the manual, and the names of all words in the
package's stub.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from itertools import groupby
from pathlib import Path

from niwaki import _engine

ROOT = Path(__file__).parents[2]
WORDS = "python/niwaki/words/shapes.py"
STUB = "python/niwaki/__init__.pyi"
GUIDE = "docs/guide/language.md"

Row = tuple[str, str, str | None, str]

_HEAD = '''"""Shapes, the things that `emit` adds to a scene. Right-handed, y up, metres by default.

A point is a 3-tuple, a list or a `vec`. Flat shapes lie on a plane parallel to z = 0, and are seen from +z. A colour
is `(r, g, b)` in [0, 1]. A rotation is three rows of three numbers, as `rotation(axis, angle)` gives. In a
plain-Python run a shape is the engine's own `Shape`.

Written by tests/house/words.py from the engine's table of solids.
"""

from __future__ import annotations

from typing import Any

from niwaki.words.measures import Axis, Bark, Color, Frame, Rotation, make
from niwaki.words.vectors import VecLike
'''


def texts() -> dict[str, str]:
    """Every file that follows from the engine, by its place: what it should hold."""
    stub, guide = ((ROOT / name).read_text(encoding="utf-8") for name in (STUB, GUIDE))
    return {WORDS: _words(), STUB: _stub(stub), GUIDE: _guide(guide)}


def _words() -> str:
    names = sorted(_engine.SHAPES)
    listed = f"__all__ = [{', '.join(map(_quoted, names))}]"
    if len(listed) > 110:
        listed = "__all__ = [\n" + "".join(f"    {_quoted(name)},\n" for name in names) + "]"
    functions = [_function(name, doc.strip(), rows) for name, (doc, rows) in _engine.SHAPES.items()]
    all_words = f"SHAPES = ({', '.join(_engine.SHAPES)})"
    if len(all_words) > 110:
        all_words = "SHAPES = (\n" + "".join(f"    {name},\n" for name in _engine.SHAPES) + ")"
    last = f"#: The functions for shapes; the engine has one of the same name for each.\n{all_words}\n"
    return "\n\n".join([f"{_HEAD}\n{listed}\n", *functions, last])


def _quoted(name: str) -> str:
    return f'"{name}"'


def _function(name: str, doc: str, rows: list[Row]) -> str:
    """A word in Python: the signature, the docstring and the call."""
    parameters = [_parameter(*row) for row in rows]
    given = ", ".join([_quoted(name), *(row[0] for row in rows)])
    lines = [_fitted(f"def {name}(", parameters, ") -> Any:", ""), f'    """{_indented(doc)}', ""]
    lines += ["    Parameters", "    ----------"]
    for about, group in groupby(rows, key=lambda row: row[3]):
        lines += [f"    {', '.join(row[0] for row in group)}", f"        {_indented(about.strip(), 8)}"]
    lines += ['    """', _call(given)]
    return "\n".join(lines) + "\n"


def _parameter(name: str, kind: str, default: str | None, _: str) -> str:
    if default is None:
        return f"{name}: {kind}"
    return f"{name}: {kind}{' | None' if default == 'None' else ''} = {default}"


def _fitted(opening: str, parts: list[str], closing: str, indent: str) -> str:
    """The parts on one line, on a line of their own or on one each, as the formatter has them."""
    for text in f"{opening}{', '.join(parts)}{closing}", f"{opening}\n    {', '.join(parts)}\n{closing}":
        if all(len(indent + line) <= 110 for line in text.split("\n")):
            return text
    return "\n".join([opening, *(f"    {part}," for part in parts), closing])


def _call(given: str) -> str:
    line = f"    return make({given})"
    return line if len(line) <= 110 else f"    return make(\n        {given}\n    )"


def _indented(doc: str, by: int = 4) -> str:
    """The text of a comment as a docstring: a blank after each line's start is the comment's."""
    return "\n".join(
        " " * by * (k > 0 and bool(line)) + line
        for k, line in enumerate(re.sub(r"\n ", "\n", doc).split("\n"))
    )


def _stub(stub: str) -> str:
    """The stub with a line for each lower-case word for shapes."""
    lines = stub.split("\n")
    present = [line for line in lines if line.startswith("from .words import ")]
    start, end = lines.index(present[0]), lines.index(present[-1]) + 1
    shapes = {f"from .words import {name} as {name}" for name in _engine.SHAPES}
    return "\n".join([*lines[:start], *sorted({*present, *shapes}), *lines[end:]])


def _guide(guide: str) -> str:
    """The manual with the signature of each word for shapes."""
    block = re.search(r"(?s)(## Shapes\n\n```text\n).*?(\n```)", guide)
    assert block is not None, f"{GUIDE} has no block of signatures below `## Shapes`"
    return guide[: block.end(1)] + "\n".join(_signatures()) + guide[block.start(2) :]


def _signatures() -> Iterator[str]:
    for name, (_, rows) in _engine.SHAPES.items():
        parts = [row[0] if row[2] is None else f"{row[0]}={row[2]}" for row in rows]
        text = f"{name}({', '.join(parts)})"
        yield textwrap.fill(text, 122, subsequent_indent=" " * (len(name) + 1), break_long_words=False)


if __name__ == "__main__":
    for place, text in texts().items():
        (ROOT / place).write_text(text, encoding="utf-8")
